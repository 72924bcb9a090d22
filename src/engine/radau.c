/* radau.c -- Radau IIA collocation of order 5 and 9, implicit, steps of its own: for what is stiff
 *
 * The unknowns are the accelerations a_i of the s stages, at t_i = t0 + c_i h:
 *
 *     v_i = v0 + h sum A_ij a_j,   u_i = h sum A_ij rate(u_j, v_j),   r(q0 (+) u_i, v_i, a_i, t_i) = 0
 *
 * with rate() as in rk.h.  Simplified Newton with the matrices M, C, K of one point: T^-1 A T = diag(lambda) takes the s n
 * equations apart into real and complex ones of n,
 *
 *     (M + h lambda C + h^2 lambda^2 K) (T^-1 da) = -T^-1 r
 *
 * (Hairer & Wanner, Solving Ordinary Differential Equations II, IV.8, for systems of second order), and u_i follows
 * v_i through rate(): of rotations, where rate() reads u, again and again until it stands.  The error, (8.19), by the real lambda:
 *
 *     g_u = h (lambda v0 + sum d_i u'_i),   g_v = h (lambda a0 + sum d_i a_i)
 *     (M + h lambda C + h^2 lambda^2 K) e_v = M g_v - h lambda K g_u,    e_u = g_u + h lambda e_v
 *
 * of order s, which bounds what stiff components make of it.  Step control: Gustafsson (IV.8, (8.24)). */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "base/scalar.h"
#include "engine/motion.h"
#include "engine/radau_parts.h"

static const double KEPT = 1.2; /* a step that may grow by less keeps h and its matrices */
static const double WORN = .02; /* contraction from which the next step takes another matrix */
static const double SLOWLY = 3; /* times what was left: other steps may leave more */

static void open(struct stepper *s, struct adaptive *m, struct arena *life)
{
    const struct ode2 *o = s->ode;
    const int stages = m->scheme->order - 1; /* which is the order of the estimate */
    struct radau *x = TAKE(life, struct radau, 1);
    collocation_radau(&x->table, stages);
    for (int i = 0; i < stages; i++) {
        double **vector[] = {&x->a[i], &x->v[i],    &x->u[i],    &x->du[i],
                             &x->r[i], &x->gain[i], &x->last[i], &x->before[i]};
        for (int k = 0; k < 8; k++) *vector[k] = TAKE(life, double, o->n);
        x->q[i] = TAKE(life, double, o->nq);
    }
    double **vector[] = {&x->e, &x->gu, &x->gv};
    for (int k = 0; k < 3; k++) *vector[k] = TAKE(life, double, o->n);
    stage_matrix_open(&x->matrix, &x->table, o, &s->effort, life);
    m->tolerance = .1 * pow(s->options.tolerance, (stages + 1) / (2. * stages));
    x->stale = true;
    x->faded = WORN;
    m->own = x;
    m->ahead = x->a[stages - 1];
}

static void forget(struct adaptive *m)
{
    struct radau *x = m->own;
    x->h_before = x->longer = x->matrix.h = 0;
    x->stale = true;
    x->here = false;
}

/* ---- a trial --------------------------------------------------------------------------------------------------- */

/* Root mean square of what velocities are off by, e, and positions, gu + by e. */
static double in_scales(const struct stepper *s, const double *e, const double *gu, double by)
{
    double sum = 0;
    for (int k = 0; k < s->ode->n; k++) {
        const double ev = e[k] / adaptive_scale_v(s, k), eq = (gu[k] + by * e[k]) / adaptive_scale_q(s, k);
        sum += ev * ev + eq * eq;
    }
    return sqrt(sum / (2 * s->ode->n));
}

static double error(const struct stepper *s, struct adaptive *m, double h)
{
    struct radau *x = m->own;
    const int n = s->ode->n;
    const double lambda = x->table.mode[0].re;
    for (int k = 0; k < n; k++) {
        double gu = lambda * m->v[k], gv = lambda * m->a[k];
        for (int i = 0; i < x->table.s; i++) {
            gu += x->table.d[i] * x->du[i][k];
            gv += x->table.d[i] * x->a[i][k];
        }
        x->gu[k] = h * gu;
        x->gv[k] = h * gv;
    }
    stage_matrix_error(&x->matrix, x->e, x->gu, x->gv);
    return in_scales(s, x->e, x->gu, h * lambda);
}

/* Of the works, by the same weights. */
static double error_of_works(struct stepper *s, struct adaptive *m, double t, double h)
{
    const struct radau *x = m->own;
    double e[POWER_CHANNELS], work[POWER_CHANNELS] = {0};
    for (int c = 0; c < POWER_CHANNELS; c++) e[c] = h * x->table.mode[0].re * m->rk.w[0][c];
    for (int i = 0; i < x->table.s; i++)
        for (int c = 0; c < POWER_CHANNELS; c++) {
            e[c] += h * x->table.d[i] * x->w[i][c];
            work[c] += h * x->table.b[i] * x->w[i][c];
        }
    return adaptive_works(s, e, work, t, h);
}

static enum status attempt(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why)
{
    struct radau *x = m->own;
    const int n = s->ode->n, last = x->table.s - 1;
    copy(m->q1, m->q, s->ode->nq); /* the scales look at the end, which is not known yet */
    copy(m->v1, m->v, n);
    TRY(radau_stages(s, m, t, h, why));
    motion_point(s->ode, m->q1, m->q, x->u[last], 1, t + h);
    copy(m->v1, x->v[last], n);
    *err = larger(error(s, m, h), error_of_works(s, m, t, h));
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
}

static void take(struct stepper *s, struct adaptive *m, double h)
{
    struct radau *x = m->own;
    const int n = s->ode->n, last = x->table.s - 1;
    for (int i = 0; i <= last; i++) {
        for (int c = 0; c < POWER_CHANNELS; c++) m->work[c] += h * x->table.b[i] * x->w[i][c];
        copy(x->before[i], x->a[i], n);
    }
    for (int k = 0; k < n; k++) m->span[k] += x->u[last][k];
    copy(m->a, x->a[last], n);
    copy(m->rk.w[0], x->w[last], POWER_CHANNELS);
    const bool cut = fabs(h) < m->h; /* by no error of its own */
    x->longer = !cut && x->h_before != 0 ? fabs(h / x->h_before) : 0;
    x->h_before = h;
    x->stale = x->theta > WORN;
    x->here = false;
}

/* ---- records in the step --------------------------------------------------------------------------------------- */

/* Displacements u and velocities v [n] at the part x of the step h from velocities v0 with slopes a0. */
static void along(const struct radau *o, double *u, double *v, const double *v0, const double *a0, double h, double x,
                  int n)
{
    double w[STAGES + 1];
    collocation_along(&o->table, w, x);
    for (int k = 0; k < n; k++) {
        double du = w[0] * v0[k], dv = w[0] * a0[k];
        for (int i = 0; i < o->table.s; i++) {
            du += w[i + 1] * o->du[i][k];
            dv += w[i + 1] * o->a[i][k];
        }
        u[k] = h * du;
        v[k] = v0[k] + h * dv;
    }
}

static void between(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x)
{
    along(m->own, u, v, m->v0, m->a0, m->t1 - m->t0, x, s->ode->n);
}

/* By how much the slopes of the motion at one point inside, by the equations, differ from those of the polynomial: stiff
 * components bounded, as of the error of a step.  It takes no smoothness for granted, as a power of an estimate would. */
static enum status ready(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why)
{
    static const double MORE =
        10; /* at other points, of forces that are steep in a velocity: measured, belt friction */
    struct radau *x = m->own;
    struct rk *k = &m->rk;
    const int n = s->ode->n;
    const double at = x->table.widest, share = h * x->table.share;
    double w[STAGES + 1], *du = k->du[1], *a = k->dv[1], *e = x->last[0], *eu = x->last[1], *ev = x->last[2];
    along(x, k->u, k->v, m->v, m->a, h, at, n);
    motion_point(s->ode, k->q, m->q, k->u, 1, t + at * h);
    motion_rate(s->ode, du, k->q, m->q, k->u, k->v, t + at * h);
    TRY(accel_solve(k->accel, a, NULL, k->q, k->v, t + at * h, why));
    collocation_slope(&x->table, w, at);
    for (int i = 0; i < n; i++) {
        double gu = du[i] - w[0] * m->v[i], gv = a[i] - w[0] * m->a[i];
        for (int j = 0; j < x->table.s; j++) {
            gu -= w[j + 1] * x->du[j][i];
            gv -= w[j + 1] * x->a[j][i];
        }
        eu[i] = share * gu;
        ev[i] = share * gv;
    }
    stage_matrix_error(&x->matrix, e, eu, ev);
    *err = MORE * in_scales(s, e, eu, h * x->table.mode[0].re) * m->tolerance / s->options.tolerance;
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
}

static void off(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h)
{
    const struct radau *x = m->own;
    for (int k = 0; k < s->ode->n; k++) {
        position[k] = x->gu[k] + h * x->table.mode[0].re * x->e[k];
        velocity[k] = x->e[k];
    }
}

/* x, farther from 0. */
static double farther(double x, double by)
{
    return x + copysign(by, x);
}

/* Of the last iteration's change of the end, what is left behind it.  Of which sign it is is not known: signs of the estimate stay. */
static void left(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h)
{
    const struct radau *x = m->own;
    const int last = x->table.s - 1;
    const double rest = SLOWLY * x->faded;
    for (int k = 0; k < s->ode->n; k++) {
        double change = 0;
        for (int j = 0; j <= last; j++) change += h * x->table.A[last][j] * x->r[j][k];
        velocity[k] = farther(velocity[k], rest * fabs(change));
        position[k] = farther(position[k], rest * fabs(x->gain[last][k]));
    }
}

static double root(const struct radau *x, double err)
{
    return pow(larger(err, 1e-10), 1. / (x->table.s + 1));
}

static double shrink(const struct adaptive *m, double err)
{
    return larger(.1, .9 / root(m->own, err));
}

static double grow(const struct adaptive *m, double err)
{
    const struct radau *x = m->own;
    const double safe = .9 * (2 * MOST_ITERATIONS + 1) / (2 * MOST_ITERATIONS + x->count);
    double factor = safe / root(x, err);
    if (x->longer > 0) { /* what was foreseen for this step was wrong by as much as the next one's will be */
        const double again = x->longer * .9 * root(x, m->old) / pow(root(x, err), 2);
        factor = smaller(factor, again);
    }
    factor = smaller(8, larger(.2, factor));
    return factor >= 1 && factor <= KEPT && !x->stale ? 1 : factor;
}

/* What is factored follows from M, C and K. */
static enum status recall(struct stepper *s, struct adaptive *m, struct recall *r)
{
    struct radau *x = m->own;
    for (int i = 0; i < x->table.s; i++) {
        char name[24];
        snprintf(name, sizeof name, "before%d", i);
        recall_list(r, name, x->before[i], (size_t)s->ode->n);
    }
    recall_one(r, "h_before", x->h_before);
    recall_one(r, "longer", x->longer);
    recall_one(r, "theta", x->theta);
    recall_one(r, "faded", x->faded);
    recall_one(r, "trials", x->trials);
    recall_one(r, "stale", x->stale);
    if (x->stale) return OK;
    return stage_matrix_recall(&x->matrix, r);
}

#define RADAU                                                                                                          \
    .stages = 2, .open = open, .forget = forget, .attempt = attempt, .take = take, .shrink = shrink, .grow = grow,     \
    .recall = recall, .off = off, .left = left, .ready = ready, .between = between
static const struct adaptive_scheme radau5 = {.order = 4, .sharper = .5, .drifts = 1, RADAU},
                                    radau9 = {.order = 6, .sharper = .45, .drifts = .04, RADAU};

const struct stepper_kind step_radau5 = {
    .name = "radau5",
    .brief = "Radau IIA of 3 stages, implicit, for stiff scenes, steps of its own inside H",
    .order = 5,
    .full = true,
    .formulas = &radau5,
    ADAPTIVE,
};

const struct stepper_kind step_radau9 = {
    .name = "radau9",
    .brief = "Radau IIA of 5 stages, implicit, for stiff scenes and many digits, steps of its own inside H",
    .order = 9,
    .full = true,
    .formulas = &radau9,
    ADAPTIVE,
};
