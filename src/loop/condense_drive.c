/* condense_drive.c -- drives: constraints that know the time, C(q, t) = s(q) - c(t) (2-2).
 *
 * Over a step they move by their means, C_t = -(c_b - c_a)/(t_b - t_a) and C_tt = -(c'_b - c'_a)/(t_b - t_a): a corner
 * of c delivers its impulse, whole, in the step it lies in.  The power lambda C_t does the drive's work exactly; an
 * impulse works with the mean of the rates before and behind the corner, and in such a step so does all of lambda.  A
 * scheme that looks at points of time takes the impulse by itself: where the rates of drives jump by dc', the momentum
 * of the independent coordinates stays,
 *
 *     T' M (T dv_i + g) = 0,   g_d = C_qd^-1 dc'
 */
#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "loop/condense_parts.h"

void condense_time(struct condense *o, double t, double ta, double tb)
{
    if (o->model->ndrive == 0) return;
    if (ta == tb)
        loops_when(o->rows.loops, t, 0);
    else
        loops_where(o->rows.loops, t, 0);
    loops_over(o->rows.loops, ta, tb);
}

int condense_jumps(const struct condense *o)
{
    const struct loops *loops = o->rows.loops;
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++)
        if (loops->cw[loops->first[l]] != loops->c1[loops->first[l]]) return 1;
    return 0;
}

enum status condense_driven(const struct condense *o, bool accelerations, double t, struct trouble *why)
{
    const struct model *m = o->model;
    const struct loops *loops = o->rows.loops;
    for (int l = model_first_drive(m); l < m->nloop; l++) {
        const int row = loops->first[l];
        if (!isfinite(loops->c[row]) || !isfinite(loops->c1[row]) || (accelerations && !isfinite(loops->c2[row])))
            return trouble_set(why, TROUBLE_DRIVE, l, NAN, t);
    }
    return OK;
}

void condense_power(const struct condense *o, double *w, const double *lambda)
{
    for (const struct part *p = o->split.part; p < o->split.part + o->split.npart; p++)
        for (int k = 0; k < p->nlead; k++) {
            const int row = p->row[p->lead[k]];
            w[POWER_DRIVE] -= lambda[row] * o->rows.loops->cw[row];
        }
}

/* With V the velocities that drives alone give the tree, V_d = C_qd^-1 c', their power -lambda c' is V' r of the tree, which
 * changes by (T' M V)' a. */
int condense_power_of(const struct ode2 *ode, double *w, const double *a)
{
    struct condense *o = ode->self;
    const int nt = o->rows.n;
    double *V = o->Tx, *y = o->rt;
    if (o->sided || !solve_at_hand(&o->solve)) return 0; /* found, or looked for, beside */
    memset(V, 0, sizeof *V * (size_t)nt);
    solve_follow(&o->solve, V, o->rows.loops->cw);
    if (o->few) {
        condense_momentum(o, y, V, o->still, ALL);
    } else {
        memset(y, 0, sizeof *y * (size_t)nt);
        dense_gemv(y, 1, o->M, V, nt, nt, nt);
    }
    solve_reduce(&o->solve, o->driven, o->lambda, y);
    for (int i = 0; i < ode->n; i++) w[POWER_DRIVE] += o->driven[i] * a[i];
    return 1;
}

double condense_fastest(const struct ode2 *ode, double t)
{
    const struct condense *o = ode->self;
    return loops_fastest(o->rows.loops, t);
}

double condense_corner(const struct ode2 *ode, double ta, double tb)
{
    const struct condense *o = ode->self;
    const struct model *m = o->model;
    double first = INFINITY;
    for (int l = model_first_drive(m); l < m->nloop; l++)
        first = fmin(first, signal_corner_time(m->loop[l].drive, ta, fmin(first, tb)));
    return first;
}

enum status condense_jump(const struct ode2 *ode, int *met, double *v, double *work, const double *q, double ta,
                          double tb, struct trouble *why)
{
    struct condense *o = ode->self;
    const int n = ode->n, nt = o->rows.n;
    double *dv = o->mean, *M = o->M_solve;
    *met = loops_corners(o->jump, o->rows.loops, ta, tb);
    if (!*met) return OK;
    TRY(condense_rates(o, o->vt, NULL, q, v, NULL, ta, why));
    TRY(condense_mass(ode, M, q, ta, ALL, why));
    const int pivot = dense_cholesky(M, n, n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, ta);
    TRY(solve_factor(&o->solve, q, ta, why));
    memset(o->at, 0, sizeof *o->at * (size_t)nt);
    solve_follow(&o->solve, o->at, o->jump);
    condense_still(o, o->still, q, ALL);
    condense_momentum(o, o->rt, o->at, o->still, ALL);
    solve_reduce(&o->solve, dv, o->lambda, o->rt);
    dense_cholesky_solve(M, dv, n, n);
    for (int i = 0; i < n; i++) dv[i] = -dv[i];
    split_spread(&o->split, o->at, dv);
    solve_follow(&o->solve, o->at, o->jump); /* all of the jump */
    condense_momentum(o, o->rt, o->at, o->still, ALL);
    for (int i = 0; i < nt; i++) *work += o->rt[i] * (o->vt[i] + o->at[i] / 2);
    for (int i = 0; i < n; i++) v[i] += dv[i];
    return OK;
}
