/* radau_stages.c -- the stages of Radau IIA by simplified Newton: see radau.c */
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "engine/radau_parts.h"

enum { MOST_PASSES = 20, SELDOM = 24, SHORTEST = 16 };
static const double REST = .02;     /* of the tolerance: what the iteration may leave */
static const double LOST = 1000;    /* round-off of an iterate, of usual sizes */
static const double SLUGGISH = .99; /* contraction that leads nowhere */

/* M, C and K of the start of the step. */
static enum status linearize(const struct adaptive *m, double t, struct trouble *why)
{
    struct radau *x = m->own;
    const struct instant there = {.t = t, .q = m->q, .v = m->v, .a = m->a, .ta = t, .tb = t};
    TRY(stage_matrix_form(&x->matrix, &there, why));
    x->stale = false;
    x->here = true;
    return OK;
}

/* y_i = y0 + h sum A_ij f_j; y0 NULL: zero. */
static void collocate(double *const *y, const struct radau *x, const double *y0, double *const *f, double h, int n)
{
    const int s = x->table.s;
    for (int i = 0; i < s; i++) {
        for (int k = 0; k < n; k++) y[i][k] = y0 ? y0[k] : 0;
        for (int j = 0; j < s; j++)
            for (int k = 0; k < n; k++) y[i][k] += h * x->table.A[i][j] * f[j][k];
    }
}

/* Accelerations of the stages: the last step's polynomial goes on. */
static void foresee(struct radau *x, const struct adaptive *m, double h, int n)
{
    const int s = x->table.s;
    const double on = x->h_before != 0 ? h / x->h_before : 0;
    for (int i = 0; i < s; i++) {
        double w[STAGES];
        copy(x->a[i], m->a, n);
        if (!(on > 0 && on < 3)) continue;
        collocation_through(&x->table, w, 1 + x->table.c[i] * on);
        zero(x->a[i], n);
        for (int j = 0; j < s; j++)
            for (int k = 0; k < n; k++) x->a[i][k] += w[j] * x->before[j][k];
    }
}

/* Rms over all stages of changes dv = h c_i da (NULL: none) and du. */
static double size(const struct stepper *s, const struct radau *x, double *const *da, double *const *du, double h)
{
    const int n = s->ode->n, stages = x->table.s;
    double sum = 0;
    for (int i = 0; i < stages; i++)
        for (int k = 0; k < n; k++) {
            const double ev = da ? h * x->table.c[i] * da[i][k] / adaptive_scale_v(s, k) : 0;
            const double eq = du[i][k] / adaptive_scale_q(s, k);
            sum += ev * ev + eq * eq;
        }
    return sqrt(sum / (2 * n * stages));
}

/* Places of the stages for their velocities. */
static void place(const struct stepper *s, struct radau *x, const struct adaptive *m, double t, double h, bool first)
{
    for (int i = 0; i < x->table.s; i++) {
        const double ti = t + x->table.c[i] * h;
        if (first)
            motion_point(s->ode, x->q[i], m->q, x->u[i], 1, ti);
        else
            motion_again(s->ode, x->q[i], m->q, x->u[i], 1, ti, 0);
    }
}

/* Displacements for the velocities, each pass from the rates at those of the one before.  Places are those before all of
 * them: where rates read these, too, the next iteration sees it. */
static void follow(const struct stepper *s, struct radau *x, const struct adaptive *m, double t, double h)
{
    const int n = s->ode->n, stages = x->table.s;
    for (int i = 0; i < stages; i++) zero(x->gain[i], n);
    for (int pass = 0; pass < MOST_PASSES; pass++) {
        for (int i = 0; i < stages; i++)
            motion_rate(s->ode, x->du[i], x->q[i], m->q, x->u[i], x->v[i], t + x->table.c[i] * h);
        collocate(x->last, x, NULL, x->du, h, n);
        for (int i = 0; i < stages; i++)
            for (int k = 0; k < n; k++) {
                const double by = x->last[i][k] - x->u[i][k];
                x->u[i][k] = x->last[i][k];
                x->last[i][k] = by;
                x->gain[i][k] += by;
            }
        if (!(size(s, x, NULL, x->last, h) > .1 * x->fnewt)) return; /* nor where it is not a number */
    }
}

static enum status residuals(struct stepper *s, struct radau *x, double t, double h, struct trouble *why)
{
    for (int i = 0; i < x->table.s; i++) {
        const double ti = t + x->table.c[i] * h;
        const struct instant there = {.t = ti, .q = x->q[i], .v = x->v[i], .a = x->a[i], .ta = ti, .tb = ti};
        TRY(s->ode->ops->resid(s->ode, x->r[i], x->w[i], NULL, &there, ALL, why));
        s->effort.slow++;
        s->effort.fast++;
    }
    return OK;
}

/* All stages from what foresee() has given.  The contraction of the first changes is that of what fades soon, stiff and slow
 * parts may do so far slower: of some trials one more iteration shows what the last one has left.  In a step of the round-off
 * of t stages are on one side of a jump or the other by round-off: the step's error tells what that matters. */
static enum status iterate(struct stepper *s, struct adaptive *m, double t, double h, struct trouble *why)
{
    struct radau *x = m->own;
    const int n = s->ode->n;
    bool once_more = false;
    double last = 0;
    x->fnewt =
        larger(LOST * DBL_EPSILON / m->tolerance, smaller(REST, sqrt(m->tolerance)) * adaptive_share(m, fabs(h)));
    collocate(x->v, x, m->v, x->a, h, n);
    collocate(x->u, x, NULL, x->v, h, n);
    place(s, x, m, t, h, true);
    follow(s, x, m, t, h);
    for (x->count = 1; x->count <= MOST_ITERATIONS + once_more; x->count++) {
        place(s, x, m, t, h, false);
        TRY(residuals(s, x, t, h, why));
        stage_matrix_solve(&x->matrix, x->r);
        s->effort.sweeps++;
        for (int i = 0; i < x->table.s; i++)
            for (int k = 0; k < n; k++) x->a[i][k] += x->r[i][k];
        collocate(x->v, x, m->v, x->a, h, n);
        follow(s, x, m, t, h);
        const double now = size(s, x, x->r, x->gain, h), rounding = 1e-2 * x->fnewt;
        if (!isfinite(now)) break;
        if (once_more) {
            x->faded = larger(smaller(now / last, 1), x->faded / 2); /* one that grows went over a corner */
            x->count--;
            return OK;
        }
        if (x->count > 1) x->theta = now / last;
        if (x->count > 1 && x->theta >= SLUGGISH && now > rounding) break;
        const double theta = x->count > 1 ? smaller(x->theta, SLUGGISH) : smaller(larger(x->theta, .1), .9);
        if (now <= rounding || larger(theta / (1 - theta), smaller(x->faded, .05)) * now <= x->fnewt) {
            once_more = ++x->trials % SELDOM == 0 && now > LOST * DBL_EPSILON / m->tolerance;
            if (!once_more) return OK;
        }
        last = now;
    }
    if (isfinite(last) && fabs(h) <= SHORTEST * DBL_EPSILON * fabs(t)) return OK;
    return trouble_set(why, TROUBLE_DIVERGED, -1, last, t + h);
}

/* What a kept matrix does not solve, one of this place may. */
enum status radau_stages(struct stepper *s, struct adaptive *m, double t, double h, struct trouble *why)
{
    struct radau *x = m->own;
    for (int round = 0;; round++) {
        if (x->stale) TRY(linearize(m, t, why));
        if (x->matrix.h != h) TRY(stage_matrix_factor(&x->matrix, h, t, why));
        foresee(x, m, h, s->ode->n);
        const enum status status = iterate(s, m, t, h, why);
        if (status == OK || x->here || round > 0) return status;
        x->stale = true;
    }
}
