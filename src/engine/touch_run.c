/* touch_run.c -- a step from impact to impact; see touch.h */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/bracket.h"
#include "engine/motion.h"
#include "engine/touch_parts.h"

enum { MOST_IMPACTS = 50, MOST_CUTS = 12, NO_END = 20000, TRIALS = 60 };
static const double DEEP = 1e-6;  /* of a usual gap: where one has gone through the other */
static const double SHORT = 1e-4; /* of a step: no shorter part is looked at for what may be passed in it */

/* What is held of contacts, now or where it was saved. */
struct held {
    int *closed, *state;
    long *impacts;
    double *impulse, *p, *way;
};

static struct held now(const struct touch *t)
{
    return (struct held){t->closed, t->state, t->impacts, t->impulse, t->p, t->way};
}

static struct held then(const struct touch_saved *o)
{
    return (struct held){o->closed, o->state, o->impacts, o->impulse, o->p, o->way};
}

/* Of those that may differ, and then do not. */
static void bring(const struct held *to, const struct held *from, struct touch_saved *o, const struct touch *t)
{
    for (int k = 0; k < o->nother; k++) {
        const int i = o->other[k], row = t->first[i];
        to->closed[i] = from->closed[i];
        to->state[i] = from->state[i];
        to->impacts[i] = from->impacts[i];
        to->impulse[i] = from->impulse[i];
        copy(to->way + 2 * i, from->way + 2 * i, 2);
        copy(to->p + row, from->p + row, 1 + t->c->of[i].across);
        o->is_other[i] = 0;
    }
    o->nother = 0;
}

void touch_save(struct touch_saved *o, const struct touch *t, const struct state *x)
{
    const struct stepper *s = t->stepper;
    const struct held from = now(t), to = then(o);
    o->t = x->t;
    single_save(&o->at, t->ode, x);
    copy(o->work, s->work, POWER_CHANNELS);
    o->lost = s->lost;
    o->left = s->left;
    o->struck = s->struck;
    o->top = t->top;
    o->took = t->took;
    o->begun = t->begun;
    o->nevent = t->nevent;
    o->lost_events = t->lost_events;
    o->all = t->all;
    o->lowered = t->lowered;
    memcpy(o->which, t->which, (size_t)(o->nclosed = t->nclosed) * sizeof *o->which);
    memcpy(o->pushed, t->pushed, (size_t)(o->npushed = t->npushed) * sizeof *o->pushed);
    bring(&to, &from, o, t);
}

void touch_restore(struct touch_saved *o, struct touch *t, struct state *x)
{
    struct stepper *s = t->stepper;
    const struct held from = then(o), to = now(t);
    for (int k = 0; k < o->nother; k++) touch_change(t, o->other[k]);
    single_restore(&o->at, t->ode, x, o->t);
    copy(s->work, o->work, POWER_CHANNELS);
    s->lost = o->lost;
    s->left = o->left;
    s->struck = o->struck;
    s->fresh = 1; /* its predictors have gone ahead */
    t->top = o->top;
    t->took = o->took;
    t->begun = o->begun;
    t->nevent = o->nevent;
    t->lost_events = o->lost_events;
    t->all = o->all;
    t->lowered = o->lowered;
    memcpy(t->which, o->which, (size_t)(t->nclosed = o->nclosed) * sizeof *o->which);
    memcpy(t->pushed, o->pushed, (size_t)(t->npushed = o->npushed) * sizeof *o->pushed);
    bring(&to, &from, o, t);
}

static enum status attempt(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    struct stepper *s = o->stepper;
    if (o->nclosed > 0) return touch_held(o, x, h, t1, why);
    o->n = 0;
    touch_keep(o);
    o->took = h;
    return s->kind->step(s, x, h, 1, t1, why);
}

static void set_reach(struct touch *o, double h)
{
    static const double LEAST = 1e-3; /* of usual gaps: what is held is never as far as that */
    o->reach = o->longest * larger(LEAST, 4 * h * o->top);
}

/* How deep it is, in usual gaps, behind a start with gap g0: what an impact beside it has left inside there may come out. */
static double depth(const struct touch *o, int i, double g0)
{
    const double g = o->g.gap[i];
    return (g0 < -2 * TOUCH_CLOSED * o->size[i] ? g - g0 : g) / o->size[i];
}

/* The deepest of the open ones behind a start with gaps g0. */
static enum status deepest(struct touch *o, double *g, const struct nearby *g0, const struct state *x,
                           struct trouble *why)
{
    *g = INFINITY;
    TRY(touch_gaps(o, x, o->reach, why));
    for (int k = 0; k < o->g.n; k++) {
        const int i = o->g.which[k];
        if (!o->closed[i]) *g = smaller(*g, depth(o, i, g0->gap[i]));
    }
    return OK;
}

/* Of a step that has gone too deep, the part that ends where the first gap is 0. */
static enum status locate(struct touch *o, struct state *x, double h, double deep, double g0, struct trouble *why)
{
    const double t0 = o->part.t;
    struct bracket b = {.hi = h, .flo = isfinite(g0) ? larger(g0, 0) : 1, .fhi = deep};
    double g = deep;
    for (int k = 0; k < TRIALS && fabs(g) > TOUCH_CLOSED && b.hi - b.lo > 4 * DBL_EPSILON * (fabs(t0) + h); k++) {
        const double part = bracket_next(&b);
        touch_restore(&o->part, o, x);
        TRY(attempt(o, x, part, t0 + part, why));
        TRY(deepest(o, &g, &o->g0, x, why));
        bracket_take(&b, part, g);
    }
    return OK;
}

/* Contacts that were closed in the part of the step that was taken. */
static enum status renew(struct touch *o, const struct state *x, struct trouble *why)
{
    TRY(touch_gaps(o, x, o->reach, why));
    touch_choose_closed(o);
    if (o->n == 0) return OK;
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k], was = o->state[i];
        o->impulse[i] += o->l[c->row];
        if (!(o->l[c->row] > 0) && (o->u[c->row] > TOUCH_CLOSED * o->top || o->g.gap[i] > TOUCH_CLOSED * o->size[i])) {
            o->closed[i] = 0;
            o->state[i] = TOUCH_OPEN;
            touch_note(o, (struct touch_event){.what = TOUCH_OPENS, .contact = i, .t = x->t});
            continue;
        }
        const bool done = o->turns[i] == SWITCH_DONE;
        o->turns[i] = SWITCH_NONE;
        if (done) continue;
        touch_set_slip(o, i, o->u, c);
        if (c->across && o->state[i] != was)
            touch_note(o,
                       (struct touch_event){.what = was == TOUCH_STICKS ? TOUCH_STARTS_SLIDING : TOUCH_STARTS_STICKING,
                                            .contact = i,
                                            .t = x->t});
    }
    touch_keep_closed(o);
    return OK;
}

/* The impact of all whose gap is `near`, in usual ones, and that come nearer, if there is any. */
static enum status strike(struct touch *o, struct state *x, double h, double near, int *count, struct trouble *why)
{
    bool any = false;
    int n = 0;
    for (int k = 0; k < o->g.n; k++) {
        const int i = o->g.which[k];
        if (!o->closed[i] && o->g.gap[i] <= near * o->size[i]) o->contact[n++] = i;
    }
    touch_choose(o, n);
    if (o->n == 0) return OK;
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) any |= o->u[o->cone[k].row] < 0;
    if (!any) return OK;
    if (++*count > NO_END) return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->t);
    return touch_impact(o, x, h, *count > MOST_IMPACTS, why);
}

/* What pushes into what cannot give way, as a drive does, ends the run. */
static enum status none_is_deep(const struct touch *o, double t, struct trouble *why)
{
    for (int k = 0; k < o->g.n; k++) {
        const int i = o->g.which[k];
        if (o->g.gap[i] < -DEEP * o->size[i]) return trouble_set(why, TROUBLE_CONTACT, i, INFINITY, t);
    }
    return OK;
}

static void back(struct touch *o, struct state *x)
{
    touch_restore(&o->part, o, x);
}

/* The step to x ends where friction changes in it. */
static enum status cut(struct touch *o, struct state *x, int *cuts, bool *again, struct trouble *why)
{
    static const struct touch_try part = {back, attempt};
    enum touch_switch which;
    TRY(touch_switches(o, &which, x, why));
    if (which == SWITCH_NONE) return OK;
    ++*cuts;
    const double h = x->t - o->part.t, t1 = x->t;
    const enum status status = touch_cut(o, &part, x, h, which, again, why);
    if (status != E_NUMERIC) return status;
    back(o, x); /* as of a rod that jams: it has no motion in which it slides on */
    *again = false;
    return attempt(o, x, h, t1, why);
}

enum status touch_to_next(struct touch *o, struct state *x, double *most, int *cuts, bool *again, double h, double t1,
                          struct trouble *why)
{
    double g0, g1, left = smaller(t1 - x->t, *most);
    const double end = left < t1 - x->t ? x->t + left : t1;
    *again = false;
    if (fabs(left - h) <= 1e-9 * h) left = h;
    double met = left;
    set_reach(o, left);
    TRY(deepest(o, &g0, &o->g, x, why));
    nearby_copy(&o->g0, &o->g);
    touch_save(&o->part, o, x);
    TRY(attempt(o, x, left, end, why));
    TRY(deepest(o, &g1, &o->g0, x, why));
    touch_grow(o, x->v);
    if (g1 >= -TOUCH_CLOSED && left > SHORT * h) TRY(touch_passed(o, &met, x, left, why));
    if (met < left) {
        touch_restore(&o->part, o, x);
        *most = met;
        *again = true;
        return OK;
    }
    *most = INFINITY;
    if (g1 < -TOUCH_CLOSED) TRY(locate(o, x, left, g1, g0, why));
    if (*cuts < MOST_CUTS) TRY(cut(o, x, cuts, again, why));
    return OK;
}

enum status touch_at_end(struct touch *o, struct state *x, double back, int *impacts, struct trouble *why)
{
    touch_grow(o, x->v);
    TRY(renew(o, x, why));
    TRY(strike(o, x, back, 2 * TOUCH_CLOSED, impacts, why));
    return none_is_deep(o, x->t, why);
}

/* From impact to impact to t1. */
static enum status parts(struct touch *o, struct state *x, double h, double t1, struct trouble *why)
{
    int impacts = 0, cuts = 0;
    double most = INFINITY;
    o->hardest = 0;
    for (int k = 0; x->t < t1; k++) {
        bool again;
        if (k == NO_END) return trouble_set(why, TROUBLE_CONTACT, 0, INFINITY, x->t);
        TRY(touch_to_next(o, x, &most, &cuts, &again, h, t1, why));
        if (again) continue;
        TRY(touch_at_end(o, x, h, &impacts, why));
        if (t1 - x->t <= 1e-12 * h) x->t = t1;
    }
    return OK;
}

enum status touch_at_start(struct touch *o, struct state *x, double h, struct trouble *why)
{
    int impacts = 0;
    o->begun = 1;
    set_reach(o, h);
    TRY(touch_gaps(o, x, o->reach, why));
    return strike(o, x, h, TOUCH_DRAWN, &impacts, why);
}

enum status touch_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct touch *o = s->touch;
    const double t0 = x->t;
    const long minors = s->effort.minors;
    enum status status = OK;
    touch_save(&o->start, o, x);
    if (!o->begun) status = touch_at_start(o, x, h, why);
    for (int k = 1; k <= ratio && status == OK; k++) status = parts(o, x, h, k < ratio ? t0 + k * h : to, why);
    s->effort.minors = minors + (status == OK ? ratio : 0);
    if (status != OK) touch_restore(&o->start, o, x);
    return status;
}

enum status touch_driven(struct touch *o, const struct state *x, struct trouble *why)
{
    set_reach(o, 0);
    TRY(touch_gaps(o, x, o->reach, why));
    TRY(none_is_deep(o, x->t, why));
    return touch_driven_at(o, x, why);
}
