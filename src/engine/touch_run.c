/* touch_run.c -- a step from impact to impact; see touch.h */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

enum { MOST_IMPACTS = 50, NO_END = 20000, TRIALS = 60 };
static const double CLOSED = 1e-12; /* of a usual gap: where an impact is found */
static const double DEEP = 1e-6;    /* likewise: where one has gone through the other */
static const double SHORT = 1e-4;   /* of a step: no shorter part is looked at for what may be passed in it */
static const double AT_REST = 1e-9; /* of the largest velocity */

/* What a trial may have to go back to. */
struct saved {
    double t, work[POWER_CHANNELS], lost, left, struck, top;
    int fresh, nevent, lost_events;
    double took;
};

static void save(struct saved *o, struct single *at, int *closed, int *state, double *p, const struct touch *t,
                 const struct state *x)
{
    const struct stepper *s = t->stepper;
    const size_t m = (size_t)t->c->m;
    *o = (struct saved){.t = x->t, .lost = s->lost, .left = s->left, .struck = s->struck, .top = t->top};
    o->fresh = s->fresh;
    o->nevent = t->nevent;
    o->lost_events = t->lost_events;
    o->took = t->took;
    copy(o->work, s->work, POWER_CHANNELS);
    single_save(at, t->ode, x);
    memcpy(closed, t->closed, m * sizeof *closed);
    memcpy(state, t->state, m * sizeof *state);
    copy(p, t->p, t->c->nrow);
}

static void restore(const struct saved *o, const struct single *at, const int *closed, const int *state,
                    const double *p, struct touch *t, struct state *x)
{
    struct stepper *s = t->stepper;
    const size_t m = (size_t)t->c->m;
    copy(s->work, o->work, POWER_CHANNELS);
    s->lost = o->lost;
    s->left = o->left;
    s->struck = o->struck;
    s->fresh = 1; /* its predictors have gone ahead */
    t->top = o->top;
    t->nevent = o->nevent;
    t->lost_events = o->lost_events;
    t->took = o->took;
    single_restore(at, t->ode, x, o->t);
    memcpy(t->closed, closed, m * sizeof *closed);
    memcpy(t->state, state, m * sizeof *state);
    copy(t->p, p, t->c->nrow);
}

static enum status attempt(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    struct stepper *s = o->stepper;
    bool any = false;
    for (int i = 0; i < o->c->m; i++) any = any || o->closed[i];
    if (any) return touch_held(o, x, h, t1, why);
    zero(o->p, o->c->nrow);
    o->took = h;
    return s->kind->step(s, x, h, 1, t1, why);
}

/* The deepest of the open ones, in usual gaps. */
static enum status deepest(struct touch *o, double *g, const struct state *x, struct trouble *why)
{
    *g = INFINITY;
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    for (int i = 0; i < o->c->m; i++)
        if (!o->closed[i]) *g = smaller(*g, o->g[i] / o->size[i]);
    return OK;
}

/* Of a step that has gone too deep, the part that ends where the first gap is 0, by Illinois' rule of false position. */
static enum status locate(struct touch *o, struct state *x, const struct saved *from, double h, double deep, double g0,
                          struct trouble *why)
{
    double lo = 0, hi = h, glo = larger(g0, 0), ghi = deep, g = deep;
    int side = 0;
    for (int k = 0; k < TRIALS && fabs(g) > CLOSED && hi - lo > 4 * DBL_EPSILON * (fabs(from->t) + h); k++) {
        double part = glo > 0 ? lo + (hi - lo) * glo / (glo - ghi) : .5 * (lo + hi);
        part = larger(lo + 1e-3 * (hi - lo), smaller(part, hi - 1e-6 * (hi - lo)));
        restore(from, &o->part, o->closed1, o->state1, o->p1, o, x);
        TRY(attempt(o, x, part, from->t + part, why));
        TRY(deepest(o, &g, x, why));
        if (g > 0) {
            lo = part;
            glo = g;
            if (side == 1) ghi /= 2;
            side = 1;
        } else {
            hi = part;
            ghi = g;
            if (side == -1) glo /= 2;
            side = -1;
        }
    }
    return OK;
}

/* Contacts that were closed in the part of the step that was taken. */
static enum status renew(struct touch *o, const struct state *x, struct trouble *why)
{
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    for (int i = 0; i < o->c->m; i++) o->on[i] = o->closed[i];
    touch_choose(o, o->p);
    if (o->n == 0) return OK;
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k], was = o->state[i];
        const double ut = touch_slip(o, c);
        o->impulse[i] += o->l[c->row];
        if (!(o->l[c->row] > 0) && (o->u[c->row] > CLOSED * o->top || o->g[i] > CLOSED * o->size[i])) {
            o->closed[i] = 0;
            o->state[i] = TOUCH_OPEN;
            touch_note(o, (struct touch_event){.what = TOUCH_OPENS, .contact = i, .t = x->t});
            continue;
        }
        o->state[i] = c->across && ut <= AT_REST * o->top ? TOUCH_STICKS : TOUCH_SLIDES;
        if (c->across && o->state[i] != was)
            touch_note(o,
                       (struct touch_event){.what = was == TOUCH_STICKS ? TOUCH_STARTS_SLIDING : TOUCH_STARTS_STICKING,
                                            .contact = i,
                                            .t = x->t});
    }
    return OK;
}

/* The impact of all that touches and comes nearer, if there is any. */
static enum status strike(struct touch *o, struct state *x, double h, int *count, struct trouble *why)
{
    int any = 0;
    for (int i = 0; i < o->c->m; i++) o->on[i] = !o->closed[i] && o->g[i] <= 2 * CLOSED * o->size[i];
    for (int i = 0; i < o->c->m; i++) any |= o->on[i];
    if (!any) return OK;
    touch_choose(o, o->p);
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    any = 0;
    for (int k = 0; k < o->n; k++) any |= o->u[o->cone[k].row] < 0;
    if (!any) return OK;
    memcpy(o->closed1, o->on, sizeof *o->on * (size_t)o->c->m);
    if (++*count > NO_END) return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->t);
    return touch_impact(o, x, h, o->closed1, *count > MOST_IMPACTS, why);
}

/* May a gap that is open at both ends of the step h from o->part to x have been closed in between?  Where it falls at first and
 * grows at last it is above both its tangents, if it is convex as that of two balls is. */
static enum status may_have_passed(struct touch *o, bool *passed, const struct state *x, double t0, double h,
                                   struct trouble *why)
{
    bool any = false;
    *passed = false;
    for (int i = 0; i < o->c->m; i++) {
        const double far = 4 * h * o->top * larger(1, o->size[i]);
        o->on[i] = !o->closed[i] && smaller(o->g0[i], o->g[i]) < far;
        any |= o->on[i];
    }
    if (!any) return OK;
    touch_choose(o, o->p);
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, o->part.q, t0, why));
    touch_rates(o, o->u1, &o->end, o->part.v);
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) {
        const double a = o->u1[o->cone[k].row], b = o->u[o->cone[k].row];
        const double g0 = o->g0[o->contact[k]], g1 = o->g[o->contact[k]];
        *passed |= a < 0 && b > 0 && g0 + a * (g1 - g0 - b * h) / (a - b) < 0;
    }
    return OK;
}

/* What pushes into what cannot give way, as a drive does, ends the run. */
static enum status none_is_deep(const struct touch *o, double t, struct trouble *why)
{
    for (int i = 0; i < o->c->m; i++)
        if (o->g[i] < -DEEP * o->size[i]) return trouble_set(why, TROUBLE_CONTACT, i, INFINITY, t);
    return OK;
}

/* From impact to impact to t1. */
static enum status parts(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    int impacts = 0;
    double most = INFINITY;
    struct saved from;
    o->hardest = 0;
    while (x->t < t1) {
        double g0, g1, left = smaller(t1 - x->t, most);
        const double end = left < t1 - x->t ? x->t + left : t1;
        bool passed = false;
        if (fabs(left - h) <= 1e-9 * h) left = h;
        TRY(deepest(o, &g0, x, why));
        copy(o->g0, o->g, o->c->m);
        save(&from, &o->part, o->closed1, o->state1, o->p1, o, x);
        TRY(attempt(o, x, left, end, why));
        TRY(deepest(o, &g1, x, why));
        touch_grow(o, x->v);
        if (g1 >= -CLOSED && left > SHORT * h) TRY(may_have_passed(o, &passed, x, from.t, left, why));
        if (passed) {
            restore(&from, &o->part, o->closed1, o->state1, o->p1, o, x);
            most = left / 2;
            continue;
        }
        most = INFINITY;
        if (g1 < -CLOSED) TRY(locate(o, x, &from, left, g1, g0, why));
        touch_grow(o, x->v);
        TRY(renew(o, x, why));
        TRY(strike(o, x, h, &impacts, why));
        TRY(none_is_deep(o, x->t, why));
        if (t1 - x->t <= 1e-12 * h) x->t = t1;
    }
    return OK;
}

/* What touches at the start and comes nearer. */
static enum status begin(struct touch *o, struct state *x, double h, struct trouble *why)
{
    int any = 0;
    o->begun = 1;
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    touch_choose_drawn(o);
    if (o->n == 0) return OK;
    TRY(o->c->rows(o->c, o->end.G, o->end.b, o->on, x->q, x->t, why));
    touch_rates(o, o->u, &o->end, x->v);
    for (int k = 0; k < o->n; k++) any |= !o->closed[o->contact[k]] && o->u[o->cone[k].row] < 0;
    if (!any) return OK;
    memcpy(o->closed1, o->on, sizeof *o->on * (size_t)o->c->m);
    return touch_impact(o, x, h, o->closed1, 0, why);
}

enum status touch_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct touch *o = s->touch;
    const double t0 = x->t;
    const long minors = s->effort.minors, all = o->all;
    const int begun = o->begun;
    struct saved from;
    enum status status = OK;
    save(&from, &o->start, o->closed0, o->state0, o->p0, o, x);
    for (int i = 0; i < o->c->m; i++) o->shown[i].impulse = o->impulse[i], o->shown[i].impacts = o->impacts[i];
    if (!o->begun) status = begin(o, x, h, why);
    for (int k = 1; k <= ratio && status == OK; k++) status = parts(o, x, h, k < ratio ? t0 + k * h : to, why);
    s->effort.minors = minors + (status == OK ? ratio : 0);
    if (status == OK) return OK;
    restore(&from, &o->start, o->closed0, o->state0, o->p0, o, x);
    for (int i = 0; i < o->c->m; i++) o->impulse[i] = o->shown[i].impulse, o->impacts[i] = o->shown[i].impacts;
    o->all = all;
    o->begun = begun;
    return status;
}

enum status touch_driven(struct touch *o, const struct state *x, struct trouble *why)
{
    TRY(o->c->gap(o->c, o->g, x->q, x->t, why));
    return none_is_deep(o, x->t, why);
}
