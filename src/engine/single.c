/* single.c -- see single.h */
#include "engine/single.h"

#include "engine/missed.h"

void single_open(struct single *keep, const struct ode2 *ode, struct arena *life)
{
    keep->q = TAKE(life, double, ode->nq);
    keep->v = TAKE(life, double, ode->n);
    keep->a = TAKE(life, double, ode->n);
}

void single_save(struct single *keep, const struct ode2 *o, const struct state *x)
{
    copy(keep->q, x->q, o->nq);
    copy(keep->v, x->v, o->n);
    copy(keep->a, x->a, o->n);
}

void single_restore(const struct single *keep, const struct ode2 *o, struct state *x, double t)
{
    copy(x->q, keep->q, o->nq);
    copy(x->v, keep->v, o->n);
    copy(x->a, keep->a, o->n);
    x->t = t;
}

/* One step whose local error is looked at. */
static enum status one_looked_at(struct stepper *s, struct state *x, double h, double t1,
                                 enum status (*one)(struct stepper *s, struct state *x, double h, double t1,
                                                    struct trouble *why),
                                 struct trouble *why)
{
    const struct stepper_kind *kind = s->kind;
    const double fades = kind->fades ? kind->fades(&s->options) : 0;
    missed_begin(s->missed, s->fresh || motion_sides(s->ode, x->t), h);
    const long told = s->missed->told;
    missed_before(s->missed, x->v);
    const enum status status = one(s, x, h, t1, why);
    if (status != OK)
        missed_break(s->missed);
    else
        missed_after(s->missed, s->ode, x->v, fades != 0 ? 1 : kind->order,
                     fades != 0 ? fades : kind->late(&s->options), kind->order <= 2);
    if (fades != 0 && s->missed->told > told)
        missed_drift(s->missed, s->ode, x->v, h * (double)(s->missed->told - told), 1);
    return status;
}

enum status single_steps(struct single *keep, struct stepper *s, struct state *x, double h, int ratio, double to,
                         enum status (*one)(struct stepper *s, struct state *x, double h, double t1,
                                            struct trouble *why),
                         struct trouble *why)
{
    double t0 = x->t;
    if (ratio > 1) single_save(keep, s->ode, x);
    for (int k = 1; k <= ratio; k++) {
        const double t1 = k < ratio ? t0 + k * h : to;
        const bool look = s->missed && s->kind->late && missed_looks(s->missed);
        enum status status = look ? one_looked_at(s, x, h, t1, one, why) : one(s, x, h, t1, why);
        if (status == OK) continue;
        if (k > 1) {
            single_restore(keep, s->ode, x, t0);
            s->fresh = 1; /* the predictors have gone ahead */
        }
        return status;
    }
    s->effort.minors += ratio;
    return OK;
}
