/* spins.c -- how fast flexible bodies without geometric stiffening turn.
 *
 * Beyond the speed from which linear elasticity gives way (flex/spin.h) such a body bends away without bound; its
 * equations are consistent all the same and the balance (2-26) closes, so that the run's verdict says it, with exit
 * status 1, these words and the summary's "buckling_speed_passed". */
#include <math.h>

#include "la/vec3.h"
#include "sim/parts.h"

void spins_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    sim->spin = TAKE(life, struct turning, m->nbody);
    for (int i = 1; i < m->nbody; i++)
        if (m->body[i].flex && !m->body[i].flex->s) sim->spin[sim->nspin++].body = i;
}

void spins_note(struct sim *sim)
{
    for (int i = 0; i < sim->nspin; i++) {
        struct turning *s = &sim->spin[i];
        double w[3];
        system_frame_spin(sim->system, w, s->body);
        double speed = v3_norm(w);
        if (!(speed > s->most)) continue;
        s->most = speed;
        s->t = sim->x.t;
        v3_scale(s->axis, 1 / speed, w);
    }
}

/* The speed that body i should not have passed; INFINITY: there is none. */
static double limit_of(const struct sim *sim, int i)
{
    const struct turning *s = &sim->spin[i];
    return s->most > 0 ? bent_spin_limit(&sim->model->body[s->body], s->axis) : INFINITY;
}

bool spins_passed(const struct sim *sim)
{
    for (int i = 0; i < sim->nspin; i++)
        if (sim->spin[i].most > limit_of(sim, i)) return true;
    return false;
}

void warn_of_spins(struct sim *sim)
{
    for (int i = 0; i < sim->nspin; i++) {
        const struct turning *s = &sim->spin[i];
        double limit = limit_of(sim, i);
        if (!(s->most > limit)) continue;
        sim_warn(sim,
                 "'%s' turned by up to %.4g rad/s (at t = %.6g s): without geometric stiffening it buckles "
                 "from Omega = %.4g rad/s about that axis, and what it did beyond is wrong; turn on geometric "
                 "stiffening [W-stiffening]",
                 sim->model->body[s->body].name, s->most, s->t, limit);
    }
}
