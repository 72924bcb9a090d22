/* closing_again.c -- from one closed posture to another nearby.
 *
 * The iterates of a step differ by their corrections.  From one of them, where C_q is factored, dependents go along the
 * tangent there by the change d of the independents, and by what is missed there, if it is not closed, and then,
 *
 *     dx_d := dx_d - C_qd^-1 (C(q) + C_qi d),   then dx_d := dx_d - C_qd^-1 C(q) again and again,
 *
 * with the same factor.  C_qd changes by something like d, so that the first correction s is half of d squared and the
 * later ones shrink at the rate 2 s/d.  Where the motion at that iterate is known, and the way goes along it, they begin on its
 * curve (closing_bend), and s is of third order.  For the last iterates nothing is missed.  The others need not be looked at: what
 * one of them leaves open by d squared, the next one closes; and one that is looked at stays as it is where it misses no more
 * than that, so that its residual finds the tree there.
 */
#include <math.h>

#include "base/scalar.h"
#include "loop/closing.h"

static const double UNSEEN = 1e-9; /* way whose square is none: so near, the tangent leads to a closed posture */

static inline double farther(double far, double x, double per)
{
    const double way = fabs(x) * per;
    return way > far ? way : far;
}

/* o->last: of the independents the way from q1 to where s full leads from q0, of the dependents that from q0 to q1.  Vectors of
 * rotations do not subtract: what is left of them is taken from one posture to the other. */
static void look_back(struct closing *o, const double *q1, const double *q0, double s)
{
    const struct moves *moves = &o->rows->tree->moves;
    const int run = o->split->run, *ind = o->split->ind;
    double *restrict last = o->last;
    const double *restrict full = o->full;
    moves_diff(moves, last, q1, q0);
    for (int i = 0; i < run; i++) last[ind[0] + i] = s * full[ind[0] + i] - last[ind[0] + i];
    for (int i = run; i < o->split->n; i++) last[ind[i]] = s * full[ind[i]] - last[ind[i]];
    moves_left(moves, o->last, q1, q0, o->full, s);
}

/* dx of the dependents along the tangent at the posture that `last` tells of, which then is the way from there; how far that
 * is, in scales. */
static double go_along(struct closing *o, double *dx, double *last, bool open)
{
    const double *per = o->rows->per;
    double far = UNSEEN; /* at least: the rate of less would be that of round-off */
    for (int i = 0; i < o->split->n; i++) {
        const int k = o->split->ind[i];
        far = farther(far, last[k], per[k]);
    }
    if (open) rows_values(o->C, o->rows);
    for (int i = 0; i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        for (int r = 0; r < p->nr; r++) o->x[r] = open ? -o->C[p->row[r]] : 0;
        factor_take(&o->solve->block[i].C_qd, o->x, last);
        factor_solve(&o->solve->block[i].C_qd, o->x);
        for (int r = 0; r < p->nr; r++) {
            const int k = p->dep[r];
            dx[k] = last[k] + o->x[r];
            last[k] = o->x[r];
            far = farther(far, o->x[r], per[k]);
        }
    }
    return far;
}

/* Closes a way that begins `far` from a closed posture, on a curve off the tangent there by `bent`, with the factors of there.
 * WAY_LOST: not closed, or not quickly. */
static enum way_end step_on(struct closing *o, double *q1, const struct way *way, double far, const struct again *how,
                            double bent)
{
    static const double QUICK = 1e-2;    /* rate at which corrections must shrink */
    static const double LITTLE = 1e-16;  /* correction that may be missing */
    static const double NOTHING = 1e-15; /* and one that is round-off */
    const double worth = how->left > 0 || how->ajar > 0 ? closing_worth(o) : 0;
    const double left = how->left * worth, ajar = how->ajar * worth;
    double size = far, rate = 2 / size;
    for (int i = 0; i < how->corrections; i++) {
        closing_put(o, q1, way);
        rows_place(o->rows, q1);
        rows_values(o->C, o->rows);
        const double next = closing_correct(o, way->dx, o->C);
        if (next <= NOTHING) return WAY_CLOSED;
        if (next <= ajar * ajar) return WAY_AJAR;
        rate = i ? next / size : rate * (bent + next);
        size = next;
        if (!(rate < QUICK)) return WAY_LOST;
        if (rate * size > larger(LITTLE, left)) continue;
        closing_put(o, q1, way);
        return rate * size > LITTLE ? WAY_AJAR : WAY_CLOSED;
    }
    return WAY_LOST;
}

/* Where rotations are dependent in part, C_q is not that of their Cayley vectors. */
static bool any_follows(const struct closing *o)
{
    for (int i = 0; i < o->rows->tree->moves.nturn; i++)
        if (o->split->follows[i]) return true;
    return false;
}

enum way_end closing_again(struct closing *o, double *q1, const double *q0, const double *dx, double s,
                           const struct again *how)
{
    if (isnan(q1[0]) || q1 == q0 || any_follows(o) || solve_factor(o->solve, q1, 0, NULL) != OK) return WAY_LOST;
    split_spread(o->split, o->full, dx);
    for (int i = 0; i < o->rows->n; i++) o->dx[i] = s * o->full[i];
    look_back(o, q1, q0, s);
    const double far = go_along(o, o->dx, o->last, how->open);
    const struct way way = {q0, o->full, s, o->dx};
    const bool closed = far <= UNSEEN;
    if (!closed && !(how->ajar > 0 && far <= how->ajar * closing_worth(o))) {
        if (how->a) closing_find_bend(o, how->v, how->a);
        return step_on(o, q1, &way, far, how, how->a ? closing_follow_bend(o, o->dx, o->last) : 0);
    }
    closing_put(o, q1, &way);
    return closed ? WAY_CLOSED : WAY_AJAR;
}
