/* closing_again.c -- from one closed posture to another nearby.
 *
 * The iterates of a step differ by their corrections.  From one of them, where C_q is factored, dependents go along the
 * tangent there by the change d of the independents, and by what is then missed,
 *
 *     dx_d := dx_d - C_qd^-1 C_qi d,   then dx_d := dx_d - C_qd^-1 C(q) again and again,
 *
 * with the same factor.  C_qd changes by something like d, so that the first correction s is half of d squared and the
 * later ones shrink at the rate 2 s/d.  For late iterates nothing is missed, and all that is left to do is to see it.
 */
#include <math.h>

#include "loop/condense_parts.h"

static const double QUICK = 1e-2;    /* rate at which corrections must shrink */
static const double LITTLE = 1e-16;  /* correction that may be missing */
static const double NOTHING = 1e-15; /* and one that is round-off */
static const double NEAR = 1e-9;     /* way that is none: its rate would be that of round-off */
enum { MOST_CORRECTIONS = 3 };

static inline double farther(double far, double x, double per)
{
    const double way = fabs(x) * per;
    return way > far ? way : far;
}

/* o->dx of the dependents along the tangent at the posture that o->last leads to; how far that is, in scales. */
static double go_along(struct condense *o)
{
    double far = NEAR;
    for (int i = 0; i < o->ode.n; i++) {
        const int k = o->ind[i];
        o->last[k] = o->dx[k] - o->last[k];
        far = farther(far, o->last[k], o->rows.per[k]);
    }
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        for (int r = 0; r < c->nr; r++) c->x[r] = 0;
        component_take(c, c->x, o->last);
        component_solve(c, c->x);
        for (int r = 0; r < c->nr; r++) {
            const int k = c->of->k[c->dep[r]];
            o->dx[k] = o->last[k] + c->x[r];
            far = farther(far, c->x[r], o->rows.per[k]);
        }
    }
    return far;
}

/* 0: not closed, or not quickly. */
static int step_on(struct condense *o, double *q1, const double *base, double s)
{
    double size = go_along(o), rate = 2 / size;
    int row;
    for (int i = 0; i < MOST_CORRECTIONS; i++) {
        condense_put(o, q1, base, s);
        rows_misfit(o->C, &row, &o->rows, q1);
        const double next = condense_correct(o);
        if (next <= NOTHING) return 1;
        rate = i ? next / size : rate * next;
        size = next;
        if (!(rate < QUICK)) return 0;
        if (rate * size > LITTLE) continue;
        condense_put(o, q1, base, s);
        return 1;
    }
    return 0;
}

/* Where rotations are dependent in part, C_q is not that of their Cayley vectors. */
static bool any_bound(const struct condense *o)
{
    for (int i = 0; i < o->moves->nturn; i++)
        if (o->bound[i]) return true;
    return false;
}

void condense_again(const struct ode2 *ode, double *q1, const double *q0, const double *dx, double s, double t)
{
    struct condense *o = ode->self;
    struct trouble why;
    loops_when(o->loops, t);
    if (!isnan(q1[0]) && q1 != q0 && !any_bound(o) && condense_factor(o, q1, t, &why) == OK) {
        moves_diff(o->moves, o->last, q1, q0);
        condense_spread(o, o->dxs, dx);
        for (int i = 0; i < o->nt; i++) o->dx[i] = s * o->dxs[i];
        if (step_on(o, q1, q0, s)) return;
    }
    condense_point(ode, q1, q0, dx, s, t);
}
