/* touch_own.c -- steps that are chosen by their error: one smooth part at a time; see touch.h */
#include <math.h>

#include "base/scalar.h"
#include "engine/touch_parts.h"

static const double AS_BEFORE = .9; /* of what it was, a usual step at least */

enum status touch_first(struct touch *o, bool *struck, struct state *x, struct trouble *why)
{
    const long all = o->all;
    *struck = false;
    if (o->begun) return OK;
    o->hardest = 0;
    TRY(touch_at_start(o, x, 0, why));
    *struck = o->all != all;
    return OK;
}

enum status touch_part(struct touch *o, bool *turned, struct state *x, int *cuts, double h, double t1,
                       struct trouble *why)
{
    double most = INFINITY;
    enum status status;
    touch_save(&o->start, o, x);
    do {
        status = touch_to_next(o, x, &most, cuts, turned, h, t1, why);
    } while (status == OK && *turned && most < INFINITY);
    if (t1 - x->t <= 1e-12 * h) x->t = t1;
    if (status != OK) touch_restore(&o->start, o, x);
    return status;
}

/* ---- what comes to rest across two directions ---- */

/* How fast the k-th slides at the rates u, where that is next to nothing; 0: it sticks, or slides well. */
static double creeps(const struct touch *o, int k, const double *u)
{
    const struct cone *c = &o->cone[k];
    if (c->across < 2 || o->state[o->contact[k]] != TOUCH_SLIDES) return 0;
    const double slip = touch_slip(u, c);
    return slip <= TOUCH_SMALL * o->stepper->options.tolerance * o->top ? slip : 0;
}

/* Is there one that creeps ever more slowly?  Its way turns ever faster, and no rate of it passes through 0: it is to
 * stick, as all that stick already. */
static enum status any_to_stick(struct touch *o, bool *any, const struct state *x, struct trouble *why)
{
    const struct touch_saved *from = &o->start;
    const struct state before = {from->t, from->at.q, from->at.v, from->at.a};
    *any = false;
    touch_choose_closed(o);
    if (o->n == 0) return OK;
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) *any |= creeps(o, k, o->u) > 0;
    if (!*any) return OK;
    *any = false;
    TRY(touch_look(o, o->u1, &o->end, &before, why));
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) {
        struct cone *c = &o->cone[k];
        const double slip = creeps(o, k, o->u);
        const bool stops = slip > 0 && slip < touch_slip(o->u1, c);
        c->held = true;
        if (!stops && o->state[o->contact[k]] != TOUCH_STICKS) c->across = 0;
        *any |= stops;
    }
    return OK;
}

static void note_stuck(struct touch *o, double t)
{
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (o->cone[k].across < 2 || o->state[i] == TOUCH_STICKS) continue;
        o->state[i] = TOUCH_STICKS;
        touch_note(o, (struct touch_event){.what = TOUCH_STARTS_STICKING, .contact = i, .t = t});
    }
}

static enum status stick(struct touch *o, struct state *x, struct trouble *why)
{
    bool any;
    TRY(any_to_stick(o, &any, x, why));
    if (!any) return OK;
    TRY(touch_mass(o, x, why));
    zero(o->l, o->rows);
    if (!cone_solve(o->l, o->W, o->u, o->cone, o->n, o->rows, o->top, 0, &o->work))
        return trouble_set(why, TROUBLE_CONTACT, o->contact[0], INFINITY, x->t);
    copy(o->vf, x->v, o->ode->n);
    touch_kick(o, o->vf, o->l);
    touch_rates(o, o->u1, &o->end, o->vf);
    touch_strike(o, x->q, x->v, x->t);
    note_stuck(o, x->t);
    return OK;
}

enum status touch_meet(struct touch *o, bool *changed, struct state *x, struct trouble *why)
{
    const int seen = o->start.nevent + o->start.lost_events;
    int impacts = 0;
    o->hardest = 0;
    TRY(touch_at_end(o, x, 0, &impacts, why));
    TRY(stick(o, x, why));
    *changed = o->nevent + o->lost_events != seen;
    if (!*changed) o->usual = larger(x->t - o->start.t, AS_BEFORE * o->usual);
    return *changed ? touch_accelerations(o, x, why) : OK;
}

void touch_back(struct touch *o, struct state *x)
{
    touch_restore(&o->start, o, x);
}

/* ---- beside steps of two rates ---- */

static enum status all_far(struct touch *o, bool *far, const struct state *x, double reach, struct trouble *why)
{
    TRY(touch_gaps(o, x, reach * o->longest, why));
    *far = true;
    for (int k = 0; k < o->g.n && *far; k++) {
        const int i = o->g.which[k];
        *far = !o->closed[i] && !o->c->of[i].joint && o->g.gap[i] > reach * larger(1, o->size[i]);
    }
    return OK;
}

enum status touch_far(struct touch *o, bool *far, const struct state *x, double H, struct trouble *why)
{
    static const double REACH = 4; /* times what the fastest does */
    touch_grow(o, x->v);
    touch_save(&o->start, o, x);
    return all_far(o, far, x, REACH * H * o->top, why);
}

enum status touch_was_far(struct touch *o, bool *far, const struct state *x, double H, struct trouble *why)
{
    static const double REACH = 2;
    touch_grow(o, x->v);
    return all_far(o, far, x, REACH * H * o->top, why);
}
