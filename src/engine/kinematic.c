/* kinematic.c -- see kinematic.h.  The drives' power over each part comes from inverse dynamics at its middle, with
 * their mean rates and accelerations, and from what rubs there. */
#include "engine/kinematic.h"

#include <math.h>

#include "engine/motion.h"
#include "engine/single.h"
#include "engine/touch.h"

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
    if (s->touch) {
        const struct state middle = {mid.t, x->q, x->v, x->a};
        TRY(touch_driven_power(s->touch, w, &middle, why));
    }
    for (int c = 0; c < POWER_CHANNELS; c++) work[c] += h * w[c];
    motion_point(o, x->q, x->q, nothing, 1, t1);
    x->t = t1;
    if (isfinite(x->q[0])) return OK;
    mid.q = x->q; /* whose owner can tell what is lost */
    TRY(o->ops->resid(o, r, w, NULL, &mid, ALL, why));
    return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, t1);
}

/* The whole step in n equal parts, their work in work; x stays where one of them fails. */
static enum status parts(struct stepper *s, struct state *x, double *work, int n, double to, struct trouble *why)
{
    const double t0 = x->t, h = (to - t0) / n;
    zero(work, POWER_CHANNELS);
    for (int k = 1; k <= n; k++) {
        enum status status = part(s, x, work, k < n ? t0 + k * h : to, why);
        if (status == OK) continue;
        single_restore(s->keep, s->ode, x, t0);
        return status;
    }
    s->effort.minors += n;
    return OK;
}

/* Twice as many parts until the works agree; their error goes with the square of a part, and is taken off. */
static enum status enough_parts(struct stepper *s, struct state *x, double to, struct trouble *why)
{
    enum { FIRST = 4, MOST = 4096 };
    const double t0 = x->t, close = fmax(s->options.tolerance, 1e-6);
    double coarse[POWER_CHANNELS], fine[POWER_CHANNELS];
    TRY(parts(s, x, coarse, FIRST, to, why));
    for (int n = 2 * FIRST, agreed = 0; n <= MOST && !agreed; n *= 2) {
        single_restore(s->keep, s->ode, x, t0);
        TRY(parts(s, x, fine, n, to, why));
        agreed = 1;
        for (int c = 0; c < POWER_CHANNELS; c++) {
            const double off = (fine[c] - coarse[c]) / 3;
            s->work[c] = fine[c] + off;
            coarse[c] = fine[c];
            if (fabs(off) > close * (fabs(fine[c]) + fabs(off))) agreed = 0;
        }
    }
    return OK;
}

enum status kinematic_step(struct stepper *s, struct state *x, int ratio, double to, struct trouble *why)
{
    single_save(s->keep, s->ode, x);
    return s->kind->adaptive ? enough_parts(s, x, to, why) : parts(s, x, s->work, ratio, to, why);
}
