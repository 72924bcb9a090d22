/* rotations.c -- how far a ball or free joint turns in one step.
 *
 * The implicit schemes turn a body about one axis by the Cayley map, by 2 atan(|omega| h/2) in place of |omega| h: a
 * seventh is lost at pi/2, and of 10 rad 2.75 are left.  Energy and momenta are kept all the same, so the balance
 * (2-26) says nothing: beyond pi/2 these words do. */
#include "la/vec3.h"
#include "sim/parts.h"

static const double quarter_turn = 1.57079632679489662;

/* A scheme of its own steps watches its own error. */
void rotations_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    if (sim->stepper.kind->adaptive) return;
    sim->rotation = TAKE(life, int, m->njoint);
    for (int i = 0; i < m->njoint; i++)
        if (m->joint[i].nq != m->joint[i].nv) sim->rotation[sim->nrotation++] = i;
}

/* After an accepted step of `ratio` minor steps h; rates as the last system_energy_at left them. */
void rotations_note(struct sim *sim, double h, int ratio)
{
    const struct model *m = sim->model;
    const double *v = m->nloop ? system_rates(sim->system) : sim->x.v;
    for (int i = 0; i < sim->nrotation; i++) {
        const struct model_joint *j = &m->joint[sim->rotation[i]];
        int iv = j->iv[j->nv - 3];
        double span = iv < m->ns || !sim->stepper.kind->two_rates ? h : h * ratio;
        double turn = v3_norm(v + iv) * span;
        if (!(turn > sim->turn)) continue;
        sim->turn = turn;
        sim->turn_joint = sim->rotation[i];
        sim->t_turn = sim->x.t;
    }
}

void warn_of_rotations(struct sim *sim)
{
    if (!(sim->turn > quarter_turn)) return;
    sim_warn(sim,
             "'%s' turns by %.3g rad in one step at t = %.6g s: more than pi/2 is not resolved; try a smaller "
             "step",
             sim->model->joint[sim->turn_joint].name, sim->turn, sim->t_turn);
}
