/* touch_switch.c -- where friction changes: what slides comes to rest, what sticks lets go; see touch.h
 *
 * A step in which that happens is cut there.  Of what slides, the rate along its way at the start must not turn back: the
 * step is taken with its friction as of sliding that way, and ends where the rate is 0.  Of what sticks, the force that
 * holds it must not pass its bound: the step is taken with it held, and ends where the force at its end, not the mean
 * over it, reaches the bound.  How several that stick, as points of one body do, share a force is a matter of choice: they
 * let go where no choice within the bounds of all of them holds them. */
#include <float.h>
#include <math.h>

#include "base/bracket.h"
#include "engine/touch_parts.h"

enum { TRIALS = 40 };
static const double FOUND = 1e-12;  /* of the largest velocity, of the bounds */
static const double CLEARLY = 1e-9; /* of a bound */

void touch_set_slip(struct touch *o, int i, const double *u, const struct cone *c)
{
    const double size = touch_slip(u, c);
    o->state[i] = touch_sticks(o, u, c) ? TOUCH_STICKS : TOUCH_SLIDES;
    for (int j = 0; j < c->across && size > 0; j++) o->way[2 * i + j] = u[c->row + 1 + j] / size;
}

/* The rate along its way, of contact i, the k-th that is looked at. */
static double along(const struct touch *o, int k, int i)
{
    double sum = 0;
    for (int j = 0; j < o->cone[k].across; j++) sum += o->way[2 * i + j] * o->u[o->cone[k].row + 1 + j];
    return sum;
}

/* By how much forces f of contact i pass what holds it; *most: that. */
static double beyond(const struct touch *o, double *most, int i, const double *f)
{
    const struct ode2_touch *of = &o->c->of[i];
    const double *p = f + o->first[i];
    *most = of->holding * larger(p[0], 0) + of->preload;
    return hypot(p[1], of->across > 1 ? p[2] : 0) - *most;
}

/* Does what sticks seem to let go at the end of the step, by the means of this one and the last? */
static bool seems_to_go(const struct touch *o, int i)
{
    double p[3], most;
    const struct touch_saved *last = &o->part;
    const int row = o->first[i];
    if (!(last->took > 0 && o->took > 0)) return false;
    const double share = o->took / (o->took + last->took);
    for (int j = 0; j <= o->c->of[i].across; j++) {
        const double now = o->p[row + j] / o->took, before = last->p[row + j] / last->took;
        o->f[row + j] = p[j] = now + share * (now - before);
    }
    return beyond(o, &most, i, o->f) > CLEARLY * most;
}

/* Where contact i goes if it goes: as it does at the end of the step, or against what holds it. */
static void head(struct touch *o, int i, const struct cone *c, bool sticks)
{
    const double *to = sticks ? o->p + o->first[i] + 1 : o->u + c->row + 1;
    const double size = hypot(to[0], c->across > 1 ? to[1] : 0);
    for (int j = 0; j < c->across; j++) o->heads[2 * i + j] = size > 0 ? (sticks ? -1 : 1) * to[j] / size : 0;
}

static int sticking(const struct touch *o)
{
    int n = 0;
    for (int k = 0; k < o->nclosed; k++) {
        const int i = o->which[k];
        n += o->c->of[i].across > 0 && o->state[i] == TOUCH_STICKS;
    }
    return n;
}

/* a: how what is looked at as c is accelerated across by the forces that have been found; its size. */
static double accelerated(const struct touch *o, double a[2], const struct cone *c)
{
    a[0] = a[1] = 0;
    for (int j = 0; j < c->across; j++) {
        const int i = c->row + 1 + j;
        a[j] = o->u[i];
        for (int l = 0; l < o->rows; l++) a[j] += o->W[i + l * o->rows] * o->l[l];
    }
    return hypot(a[0], a[1]);
}

/* Forces within all bounds at x; *still: of accelerations, what is 0. */
static enum status within_bounds(struct touch *o, double *still, const struct state *x, struct trouble *why)
{
    static const double ROUGH = 100; /* round-offs */
    double size = DBL_MIN;
    TRY(touch_forces(o, o->held, x, why));
    for (int i = 0; i < o->rows; i++) size = larger(size, fabs(o->u[i]));
    *still = CLEARLY * size + ROUGH * o->rough;
    return OK;
}

/* Those that go: who has moved, and of what only seems to, if several stick, who is accelerated by forces within all
 * bounds, that way. */
static enum status sift(struct touch *o, const struct state *x, struct trouble *why)
{
    const bool one = sticking(o) == 1;
    double still = 0, a[2];
    if (!one) TRY(within_bounds(o, &still, x, why));
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        const struct cone *c = &o->cone[k];
        if (!c->across || o->state[i] != TOUCH_STICKS || o->turns[i] == SWITCH_GOES) continue;
        if (one || o->jammed) {
            if (o->turns[i] == SWITCH_MAY_GO) o->turns[i] = SWITCH_GOES;
            continue;
        }
        const double all = accelerated(o, a, c);
        o->turns[i] = all > still ? SWITCH_GOES : SWITCH_NONE;
        for (int j = 0; j < c->across && all > 0; j++) o->heads[2 * i + j] = a[j] / all;
    }
    return OK;
}

static bool any_turns(const struct touch *o, enum touch_switch which)
{
    for (int k = 0; k < o->n; k++)
        if (o->turns[o->contact[k]] == (int)which) return true;
    return false;
}

enum status touch_switches(struct touch *o, enum touch_switch *which, const struct state *x, struct trouble *why)
{
    bool any = false;
    *which = SWITCH_NONE;
    for (int k = 0; k < o->nclosed; k++) any |= o->c->of[o->which[k]].across > 0;
    if (!any) return OK;
    touch_choose_closed(o);
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k];
        const bool sticks = touch_sticks(o, o->u, c);
        o->turns[i] = SWITCH_NONE;
        if (!c->across) continue;
        head(o, i, c, sticks);
        if (o->state[i] == TOUCH_SLIDES && (sticks || (c->across == 1 && along(o, k, i) < 0)))
            o->turns[i] = SWITCH_STOPS;
        else if (o->state[i] == TOUCH_STICKS && !sticks)
            o->turns[i] = SWITCH_GOES;
        else if (o->state[i] == TOUCH_STICKS && seems_to_go(o, i))
            o->turns[i] = SWITCH_MAY_GO;
    }
    if (any_turns(o, SWITCH_STOPS)) {
        *which = SWITCH_STOPS;
        return OK;
    }
    if (any_turns(o, SWITCH_MAY_GO)) TRY(sift(o, x, why));
    if (any_turns(o, SWITCH_GOES)) *which = SWITCH_GOES;
    return OK;
}

static void force_those(struct touch *o, enum touch_switch which)
{
    for (int k = 0; k < o->nclosed; k++) o->forced[o->which[k]] = o->turns[o->which[k]] == (int)which;
}

static void force_none(struct touch *o)
{
    for (int k = 0; k < o->nclosed; k++) o->forced[o->which[k]] = 0;
}

static enum status far_from_stop(struct touch *o, double *far, const struct state *x, struct trouble *why)
{
    *far = INFINITY;
    touch_choose_closed(o);
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++)
        if (o->forced[o->contact[k]]) *far = smaller(*far, along(o, k, o->contact[k]));
    *far /= larger(o->top, 1e-300);
    return OK;
}

/* Does anything that is forced let go at x where it is not? */
static enum status lets_go(struct touch *o, bool *goes, const struct state *x, struct trouble *why)
{
    double still = 0, a[2];
    force_none(o);
    const enum status status = within_bounds(o, &still, x, why);
    force_those(o, SWITCH_GOES);
    *goes = o->jammed;
    for (int k = 0; status == OK && k < o->n && !*goes; k++)
        *goes = o->forced[o->contact[k]] && accelerated(o, a, &o->cone[k]) > still;
    return status;
}

/* How far it is to the switch: above 0 before it; of its size.  The sums of forces and bounds tell where all of several let
 * go together and the same way, else nearly so. */
static enum status far_from(struct touch *o, double *far, enum touch_switch which, const struct state *x,
                            struct trouble *why)
{
    if (which == SWITCH_STOPS) return far_from_stop(o, far, x, why);
    double sum = 0, all = 0, most;
    bool goes;
    TRY(touch_forces(o, o->held, x, why));
    *far = -1;
    if (o->jammed) return OK;
    for (int k = 0; k < o->nclosed; k++) {
        const int i = o->which[k];
        if (!o->forced[i]) continue;
        sum -= beyond(o, &most, i, o->held);
        all += most;
    }
    if (all > 0) *far = sum / all;
    if (sticking(o) == 1) return OK;
    TRY(lets_go(o, &goes, x, why));
    if (goes != (*far <= 0)) *far = goes ? -1 : 1;
    return OK;
}

/* What has been forced is so from here on. */
static enum status turn(struct touch *o, enum touch_switch which, const struct state *x, struct trouble *why)
{
    touch_choose_closed(o);
    TRY(touch_look(o, o->u, &o->end, x, why));
    for (int k = 0; k < o->n; k++) {
        const struct cone *c = &o->cone[k];
        const int i = o->contact[k];
        if (!o->forced[i] || (which == SWITCH_STOPS && along(o, k, i) > 1e3 * FOUND * o->top)) continue;
        o->turns[i] = SWITCH_DONE;
        if (which == SWITCH_STOPS) {
            o->state[i] = TOUCH_STICKS;
            touch_note(o, (struct touch_event){.what = TOUCH_STARTS_STICKING, .contact = i, .t = x->t});
            continue;
        }
        o->state[i] = TOUCH_SLIDES;
        copy(o->way + 2 * i, o->heads + 2 * i, c->across);
        touch_note(o, (struct touch_event){.what = TOUCH_STARTS_SLIDING, .contact = i, .t = x->t});
    }
    return OK;
}

/* Has what is held needed more than holds it, in the mean of the step?  Then it had been moving: no force stops that. */
static bool was_held(struct touch *o)
{
    static const double MORE = 1e-6;
    double sum = 0, all = 0, most;
    if (sticking(o) > 1) return true;
    for (int i = 0; i < o->c->nrow; i++) o->held[i] = o->p[i] / o->took;
    for (int k = 0; k < o->nclosed; k++) {
        const int i = o->which[k];
        if (!o->forced[i]) continue;
        sum += beyond(o, &most, i, o->held);
        all += most;
    }
    return sum <= MORE * all;
}

/* The part of the step h at whose end it is near enough. */
static enum status seek(struct touch *o, const struct touch_try *part, struct state *x, double h,
                        enum touch_switch which, double at0, bool *there, struct trouble *why)
{
    const double t0 = o->part.t;
    double far;
    part->again(o, x);
    TRY(part->take(o, x, h, t0 + h, why));
    TRY(far_from(o, &far, which, x, why));
    *there = far <= 0;
    struct bracket b = {.hi = h, .flo = at0, .fhi = far};
    for (int k = 0; k < TRIALS && *there && fabs(far) > FOUND && b.hi - b.lo > 1e-9 * h; k++) {
        const double s = bracket_next(&b);
        part->again(o, x);
        TRY(part->take(o, x, s, t0 + s, why));
        TRY(far_from(o, &far, which, x, why));
        bracket_take(&b, s, far);
    }
    return OK;
}

static enum status cut(struct touch *o, const struct touch_try *part, struct state *x, double h,
                       enum touch_switch which, bool *again, struct trouble *why)
{
    double far;
    bool there = false;
    part->again(o, x);
    TRY(far_from(o, &far, which, x, why));
    if (far <= FOUND) { /* from the start on */
        TRY(turn(o, which, x, why));
        *again = true;
    } else {
        TRY(seek(o, part, x, h, which, far, &there, why));
        if (there && which == SWITCH_GOES && !was_held(o)) {
            part->again(o, x);
            TRY(turn(o, which, x, why));
            *again = true;
        } else if (there) {
            TRY(turn(o, which, x, why));
        } else { /* it is not so, or in the next step */
            force_none(o);
            part->again(o, x);
            TRY(part->take(o, x, h, o->part.t + h, why));
        }
    }
    return OK;
}

enum status touch_cut(struct touch *o, const struct touch_try *part, struct state *x, double h, enum touch_switch which,
                      bool *again, struct trouble *why)
{
    *again = false;
    force_those(o, which);
    const enum status status = cut(o, part, x, h, which, again, why);
    force_none(o);
    return status;
}
