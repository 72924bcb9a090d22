/* kinematic.c -- see kinematic.h.  The drives' power over each part comes from inverse dynamics at its middle, with
 * their mean rates and accelerations. */
#include "engine/kinematic.h"

#include <math.h>

#include "engine/motion.h"
#include "engine/single.h"

static enum status part(struct stepper *s, struct state *x, double *work, double t1, struct trouble *why)
{
    const struct ode2 *o = s->ode;
    static const double nothing[1];
    const double h = t1 - x->t;
    double w[POWER_CHANNELS], r[1];
    struct instant mid = {.t = x->t + h / 2, .q = x->q, .v = nothing, .a = nothing, .ta = x->t, .tb = t1};
    motion_point(o, x->q, x->q, nothing, .5, mid.t);
    s->effort.slow++;
    s->effort.fast++;
    TRY(o->ops->resid(o, r, w, NULL, &mid, ALL, why));
    for (int c = 0; c < POWER_CHANNELS; c++) work[c] += h * w[c];
    motion_point(o, x->q, x->q, nothing, 1, t1);
    x->t = t1;
    if (isfinite(x->q[0])) return OK;
    mid.q = x->q; /* whose owner can tell what is lost */
    TRY(o->ops->resid(o, r, w, NULL, &mid, ALL, why));
    return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, t1);
}

enum status kinematic_step(struct stepper *s, struct state *x, int ratio, double to, struct trouble *why)
{
    const double t0 = x->t, h = (to - t0) / ratio;
    single_save(s->keep, s->ode, x);
    for (int k = 1; k <= ratio; k++) {
        enum status status = part(s, x, s->work, k < ratio ? t0 + k * h : to, why);
        if (status == OK) continue;
        single_restore(s->keep, s->ode, x, t0);
        return status;
    }
    s->effort.minors += ratio;
    return OK;
}
