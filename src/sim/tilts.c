/* tilts.c -- how far bushings tilt whose stiffnesses about their axes differ.
 *
 * Which part of a large rotation belongs to which axis is a convention (swing and twist, see kind/bushing.c; Cardan angles
 * are another): torques by two of them differ by about a sixth of the angle squared, 4 % at half a radian.  Turns about
 * one axis are exact, and so is the tilt of a bushing that is the same all round. */
#include "sim/parts.h"

void tilts_open(struct sim *sim, struct arena *life)
{
    const struct model *m = sim->model;
    sim->tilt = TAKE(life, struct tilting, m->nforce);
    for (int i = 0; m->space == 3 && i < m->nforce; i++)
        if (m->force[i].type == FORCE_BETWEEN) sim->tilt[sim->ntilt++].force = i;
}

void tilts_note(struct sim *sim)
{
    for (int i = 0; i < sim->ntilt; i++) {
        struct tilting *o = &sim->tilt[i];
        const double tilt = system_tilt(sim->system, o->force);
        if (!(tilt > o->most)) continue;
        o->most = tilt;
        o->t = sim->x.t;
    }
}

void warn_of_tilts(struct sim *sim)
{
    static const double little = 0.5; /* [rad] */
    for (int i = 0; i < sim->ntilt; i++) {
        const struct tilting *o = &sim->tilt[i];
        if (!(o->most > little)) continue;
        sim_warn(sim,
                 "'%s' tilts by %.3g rad (at t = %.6g s), and its stiffnesses about its axes differ: how they "
                 "share so large a rotation is a convention [W-bushing]",
                 sim->model->force[o->force].name, o->most, o->t);
    }
}
