/* onto.c -- when, inside a step that a scheme has chosen, something happens that events.c looks for.
 *
 * The step is looked at in parts by interpolation, the first in which it happens is halved, and the step goes back to be taken
 * again, onto that time.  A shorter step is interpolated the better: where it happens elsewhere by that one it goes back once
 * more. */
#include <float.h>
#include <math.h>

#include "engine/adaptive.h"
#include "engine/single.h"
#include "sim/parts.h"

/* At t in the last step?  What cannot be evaluated there does not. */
static bool happens(struct sim *sim, double t)
{
    const struct state end = sim->x;
    const struct trouble trouble = sim->trouble;
    bool is = false;
    if (t < end.t) {
        adaptive_look(&sim->stepper, sim->look->q, sim->look->v, t);
        sim->x = (struct state){t, sim->look->q, sim->look->v, sim->look->a};
    }
    if (events_happen(&is, sim) != OK) is = false;
    sim->x = end;
    sim->trouble = trouble;
    return is;
}

double onto_event(struct sim *sim)
{
    enum { PARTS = 16, HALVINGS = 40, MOST_BACK = 8 };
    static const double AT_END = 1e-9, /* of the step */
        ROUND_OFF = 64;                /* no step ends sooner behind its start */
    const double from = sim->kept_t, end = sim->x.t, h = end - from;
    double before = from, t = from;
    bool is = false;
    if (sim->went_back == MOST_BACK || sim->stepper.touch) return INFINITY;
    for (int i = 1; i <= PARTS && !is; i++) {
        before = t;
        t = i < PARTS ? from + i * (h / PARTS) : end;
        is = happens(sim, t);
    }
    if (!is) return INFINITY;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = before + (t - before) / 2;
        if (happens(sim, middle))
            t = middle;
        else
            before = middle;
    }
    t = fmax(t, from + ROUND_OFF * DBL_EPSILON * fmax(fabs(from), fabs(end)));
    if (!(t < end - AT_END * h)) return INFINITY;
    sim->went_back++;
    return t;
}
