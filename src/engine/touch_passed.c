/* touch_passed.c -- what touches and parts again within a step, unseen at both its ends; see touch.h
 *
 * Gaps so small that the speeds of the step may close them are looked at along the cubic of path.h: in parts, and where one
 * is smaller than at both its neighbours as far as it falls (golden section: Kiefer, Proc. Am. Math. Soc. 4 (1953) 502). */
#include <math.h>

#include "base/scalar.h"
#include "engine/touch_parts.h"

enum { GOLDEN = 32 };
static const double BELOW = 1e-9; /* of a usual gap: what is no round-off */

static enum status gaps_at(struct touch *o, double *g, double x, struct trouble *why)
{
    path_place(&o->path, o->q1, x);
    return o->c->gap(o->c, g, o->reach, o->q1, path_time(&o->path, x), why);
}

/* The fastest that gaps change, by velocities and rows of both ends: u [rows]. */
static enum status paces(struct touch *o, double *u, const struct state *from, const struct state *to,
                         struct trouble *why)
{
    const struct state *const end[2] = {from, to};
    zero(u, o->rows);
    for (int k = 0; k < 2; k++) {
        TRY(touch_look(o, o->u1, &o->end, end[k], why));
        for (int j = 0; j < o->rows; j++) u[j] = larger(u[j], fabs(o->u1[j]));
        touch_rates(o, o->u1, &o->end, end[1 - k]->v);
        for (int j = 0; j < o->rows; j++) u[j] = larger(u[j], fabs(o->u1[j]));
    }
    return OK;
}

/* Leaves on[] to those that may have been closed; is there any? */
static enum status may_have_closed(struct touch *o, bool *any, const struct state *from, const struct state *to,
                                   double h, struct trouble *why)
{
    static const double FASTER = 2; /* than at the ends, as where ways bend */
    *any = false;
    for (int i = 0; i < o->c->m; i++) {
        const double far = 4 * h * o->top * larger(1, o->size[i]);
        o->on[i] = !o->closed[i] && !o->c->of[i].joint && smaller(o->g0[i], o->g[i]) < far;
    }
    touch_choose(o, o->p);
    if (o->n == 0) return OK;
    TRY(paces(o, o->u, from, to, why));
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        o->on[i] = FASTER * h * o->u[o->cone[k].row] > o->g0[i] + o->g[i];
        *any |= o->on[i];
    }
    return OK;
}

/* The least of gap i between the parts a and b, until it is below 0: where it is, and the gap there. */
static enum status least(struct touch *o, double *x, double *g, int i, double a, double b, struct trouble *why)
{
    static const double PART = .61803398874989485;
    double c = b - PART * (b - a), d = a + PART * (b - a), gc, gd;
    TRY(gaps_at(o, o->g1, c, why));
    gc = o->g1[i];
    TRY(gaps_at(o, o->g1, d, why));
    gd = o->g1[i];
    for (int k = 0; k < GOLDEN && !(smaller(gc, gd) < -BELOW * o->size[i]); k++) {
        const bool left = gc < gd;
        if (left) {
            b = d, d = c, gd = gc;
            c = b - PART * (b - a);
        } else {
            a = c, c = d, gc = gd;
            d = a + PART * (b - a);
        }
        TRY(gaps_at(o, o->g1, left ? c : d, why));
        *(left ? &gc : &gd) = o->g1[i];
    }
    *x = gc < gd ? c : d;
    *g = smaller(gc, gd);
    return OK;
}

/* The first part of the step at which gap i has been found below 0, if that is before *first. */
static enum status look_for(struct touch *o, double *first, int i, struct trouble *why)
{
    static const double PART = 1. / TOUCH_PARTS;
    const int m = o->c->m;
    for (int k = 0; k <= TOUCH_PARTS && (k - 1) * PART < *first; k++) {
        const double *g = o->among + k * m + i, far = -BELOW * o->size[i];
        const bool begins = k == 0, ends = k == TOUCH_PARTS;
        double x = k * PART, at = *g;
        if (isfinite(at) && (begins || at <= g[-m]) && (ends || at <= g[m]) && !(at < far))
            TRY(least(o, &x, &at, i, begins ? 0 : x - PART, ends ? 1 : x + PART, why));
        if (at < far && x > 0 && x < *first) *first = x;
    }
    return OK;
}

enum status touch_passed(struct touch *o, double *met, const struct state *x, double h, struct trouble *why)
{
    const struct touch_saved *at = &o->part;
    const struct state from = {at->t, at->at.q, at->at.v, at->at.a};
    bool any;
    double first = 1;
    TRY(may_have_closed(o, &any, &from, x, h, why));
    if (!any) return OK;
    path_between(&o->path, &from, x);
    copy(o->among, o->g0, o->c->m);
    copy(o->among + TOUCH_PARTS * o->c->m, o->g, o->c->m);
    for (int k = 1; k < TOUCH_PARTS; k++) TRY(gaps_at(o, o->among + k * o->c->m, (double)k / TOUCH_PARTS, why));
    for (int i = 0; i < o->c->m; i++)
        if (o->on[i]) TRY(look_for(o, &first, i, why));
    if (first < 1) *met = first * h;
    return OK;
}
