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
    loops_when(o->loops, t);
    loops_over(o->loops, ta, tb);
}

int condense_jumps(const struct condense *o)
{
    for (int l = model_first_drive(o->model); l < o->model->nloop; l++)
        if (o->loops->cw[o->loops->first[l]] != o->loops->c1[o->loops->first[l]]) return 1;
    return 0;
}

enum status condense_driven(const struct condense *o, bool accelerations, double t, struct trouble *why)
{
    const struct model *m = o->model;
    for (int l = model_first_drive(m); l < m->nloop; l++) {
        const int row = o->loops->first[l];
        if (!isfinite(o->loops->c[row]) || !isfinite(o->loops->c1[row]) ||
            (accelerations && !isfinite(o->loops->c2[row])))
            return trouble_set(why, TROUBLE_DRIVE, l, NAN, t);
    }
    return OK;
}

enum status condense_lost(const struct condense *o, double t, struct trouble *why)
{
    TRY(condense_driven(o, false, t, why));
    return trouble_set(why, TROUBLE_CLOSURE, o->lost, o->lost_by, t);
}

void component_power(const struct condense *o, const struct part *c, double *w)
{
    for (int k = 0; k < c->nlead; k++)
        w[POWER_DRIVE] -= c->x[c->lead[k]] * o->loops->cw[c->of->row[c->kept[c->lead[k]]]];
}

enum status condense_contest(struct condense *o, double t, struct trouble *why)
{
    if (o->holds == 0) return OK;
    rows_values(o->C, &o->rows);
    for (int i = 0; i < o->npart; i++) {
        const struct part *c = &o->part[i];
        for (int r = c->nr; r < c->of->nrow; r++) {
            const int row = c->of->row[c->kept[r]];
            if (!(fabs(o->C[row]) <= o->holds))
                return trouble_set(why, TROUBLE_CLOSURE, o->loops->row[row].loop, fabs(o->C[row]), t);
        }
    }
    return OK;
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

int condense_jump(const struct ode2 *ode, double *v, double *work, const double *q, double ta, double tb)
{
    struct condense *o = ode->self;
    struct trouble why;
    const int n = ode->n, nt = o->nt;
    double *dv = o->mean, *M = o->M_jump;
    if (!loops_corners(o->loops, ta, tb) || condense_rates(o, o->vt, NULL, q, v, NULL, ta, &why) != OK) return 0;
    if (ode->ops->mass(ode, M, q, ta, ALL, &why) != OK || dense_cholesky(M, n, n) >= 0) return 0;
    condense_factor(o, q, ta, &why);
    loops_corners(o->loops, ta, tb); /* their rates have been asked for between */
    memset(o->at, 0, sizeof *o->at * (size_t)nt);
    condense_follow(o, o->at);
    condense_still(o, q, ALL);
    condense_momentum(o, o->rt, o->at, ALL);
    condense_gather(o, dv, NULL, o->rt);
    dense_cholesky_solve(M, dv, n, n);
    for (int i = 0; i < n; i++) dv[i] = -dv[i];
    condense_spread(o, o->at, dv);
    condense_follow(o, o->at); /* all of the jump */
    condense_momentum(o, o->rt, o->at, ALL);
    for (int i = 0; i < nt; i++) *work += o->rt[i] * (o->vt[i] + o->at[i] / 2);
    for (int i = 0; i < n; i++) v[i] += dv[i];
    return 1;
}
