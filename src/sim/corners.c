/* corners.c -- corners of drives beside friction and rigid contacts.
 *
 * Where a drive's rate jumps all that it moves is struck.  Of that impulse joints that rub and contacts that are closed
 * bear a part, which friction would take up to its coefficient; schemes take the impulse without it, or for a force of
 * their step, and what contacts count of it is not what they bear.  Nothing else tells: the balance holds.  Friction of
 * a given force has no part in an impulse. */
#include <math.h>

#include "engine/touch.h"
#include "sim/parts.h"

/* Does anything rub by what it bears, or push? */
static bool bears(const struct sim *sim)
{
    const struct model *m = sim->model;
    for (int i = 0; i < m->ncontact; i++) {
        const struct model_contact *c = &m->contact[i];
        if (c->pair == PAIR_FRICTION ? c->law.holding > 0 || c->law.sliding > 0
                                     : touch_state(sim->stepper.touch, i)->state != TOUCH_OPEN)
            return true;
    }
    return false;
}

void corners_begin(struct sim *sim)
{
    sim->corner.borne = sim->stepper.touch && bears(sim);
}

/* The first corner in [from, to), looked for in each minor step; infinity: none. */
static double corner_of(const struct sim *sim, const struct signal *s, double from, double to)
{
    const int pieces = sim->stepper.kind->adaptive ? 1 : sim->plan.ratio;
    if (s->expr && expr_is_smooth(s->expr)) return INFINITY;
    for (int k = 0; k < pieces; k++) {
        const double a = from + k * ((to - from) / pieces),
                     b = k + 1 < pieces ? from + (k + 1) * ((to - from) / pieces) : to;
        if (signal_corner(s, a, b) != 0) return fmin(b, fmax(a, signal_corner_time(s, a, b)));
    }
    return INFINITY;
}

void corners_note(struct sim *sim, double from)
{
    const struct model *m = sim->model;
    if (sim->corner.told || !sim->stepper.touch || m->ndrive == 0) return;
    const bool before = sim->corner.borne;
    sim->corner.borne = bears(sim);
    if (!before && !sim->corner.borne) return;
    for (int l = model_first_drive(m); l < m->nloop && !sim->corner.told; l++) {
        const double t = corner_of(sim, m->loop[l].drive, from, sim->x.t);
        if (!(t < INFINITY)) continue;
        sim->corner.met = sim->corner.told = true;
        sim_warn(sim,
                 "t = %.6g s: the rate of drive '%.60s' jumps while joints rub or rigid contacts are closed: friction "
                 "does not take its part of that impulse, and what contacts count of it is not right; round the "
                 "corner, as by smooth() over a short time [W-corner]",
                 t, m->loop[l].name);
    }
}
