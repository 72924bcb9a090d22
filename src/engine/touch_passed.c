/* touch_passed.c -- what touches and parts again within a step, unseen at both its ends; see touch.h
 *
 * Gaps so small that the speeds of the step may close them are looked at along the cubic of path.h: in parts, and where one
 * is smaller than at both its neighbours as far as it falls (golden section: Kiefer, Proc. Am. Math. Soc. 4 (1953) 502). */
#include <math.h>

#include "base/scalar.h"
#include "engine/touch_parts.h"

enum { GOLDEN = 32 };
static const double BELOW = 1e-9; /* of a usual gap: what is no round-off */

static enum status gaps_at(struct touch *o, struct nearby *g, double x, struct trouble *why)
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

/* Leaves contact[0..n) to those that may have been closed; what is inside already, as an impact has left it, is not. */
static enum status may_have_closed(struct touch *o, const struct state *from, const struct state *to, double h,
                                   struct trouble *why)
{
    static const double FASTER = 2; /* than at the ends, as where ways bend */
    const int all = touch_merge(o, touch_merge(o, 0, o->g.which, o->g.n), o->g0.which, o->g0.n);
    int n = 0;
    for (int k = 0; k < all; k++) {
        const int i = o->contact[k];
        const double far = 4 * h * o->top * larger(1, o->size[i]);
        if (!o->closed[i] && !o->c->of[i].joint && smaller(o->g0.gap[i], o->g.gap[i]) < far) o->contact[n++] = i;
    }
    touch_choose(o, n);
    if (o->n == 0) return OK;
    TRY(paces(o, o->u, from, to, why));
    n = 0;
    for (int k = 0; k < o->n; k++) {
        const int i = o->contact[k];
        if (o->g0.gap[i] >= -BELOW * o->size[i] && FASTER * h * o->u[o->cone[k].row] > o->g0.gap[i] + o->g.gap[i])
            o->contact[n++] = i;
    }
    o->n = n;
    return OK;
}

/* The least of gap i between the parts a and b, until it is below 0: where it is, and the gap there. */
static enum status least(struct touch *o, double *x, double *g, int i, double a, double b, struct trouble *why)
{
    static const double PART = .61803398874989485;
    double c = b - PART * (b - a), d = a + PART * (b - a), gc, gd;
    TRY(gaps_at(o, &o->g1, c, why));
    gc = o->g1.gap[i];
    TRY(gaps_at(o, &o->g1, d, why));
    gd = o->g1.gap[i];
    for (int k = 0; k < GOLDEN && !(smaller(gc, gd) < -BELOW * o->size[i]); k++) {
        const bool left = gc < gd;
        if (left) {
            b = d, d = c, gd = gc;
            c = b - PART * (b - a);
        } else {
            a = c, c = d, gc = gd;
            d = a + PART * (b - a);
        }
        TRY(gaps_at(o, &o->g1, left ? c : d, why));
        *(left ? &gc : &gd) = o->g1.gap[i];
    }
    *x = gc < gd ? c : d;
    *g = smaller(gc, gd);
    return OK;
}

/* The first part of the step at which gap i has been found below 0, if that is before *first. */
static enum status look_for(struct touch *o, double *first, int i, struct trouble *why)
{
    static const double PART = 1. / TOUCH_PARTS;
    for (int k = 0; k <= TOUCH_PARTS && (k - 1) * PART < *first; k++) {
        const struct nearby *g = o->among + k;
        const double far = -BELOW * o->size[i];
        const bool begins = k == 0, ends = k == TOUCH_PARTS;
        double x = k * PART, at = g->gap[i];
        if (isfinite(at) && (begins || at <= g[-1].gap[i]) && (ends || at <= g[1].gap[i]) && !(at < far))
            TRY(least(o, &x, &at, i, begins ? 0 : x - PART, ends ? 1 : x + PART, why));
        if (at < far && x > 0 && x < *first) *first = x;
    }
    return OK;
}

enum status touch_passed(struct touch *o, double *met, const struct state *x, double h, struct trouble *why)
{
    const struct touch_saved *at = &o->part;
    const struct state from = {at->t, at->at.q, at->at.v, at->at.a};
    double first = 1;
    TRY(may_have_closed(o, &from, x, h, why));
    if (o->n == 0) return OK;
    path_between(&o->path, &from, x);
    nearby_copy(&o->among[0], &o->g0);
    nearby_copy(&o->among[TOUCH_PARTS], &o->g);
    for (int k = 1; k < TOUCH_PARTS; k++) TRY(gaps_at(o, &o->among[k], (double)k / TOUCH_PARTS, why));
    for (int k = 0; k < o->n; k++) TRY(look_for(o, &first, o->contact[k], why));
    if (first < 1) *met = first * h;
    return OK;
}
