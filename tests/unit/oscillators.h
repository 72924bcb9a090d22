/* oscillators.h -- systems written by hand for the tests of the integrators.
 *
 * linear:   M a + C v + K q = f cos(w t), any matrices, each split into what slow and fast bodies bring
 * chain:    two links hinged one to the other in a plane, under gravity, with springs and dampers in the
 *           hinges; M^ depends on the configuration.  The outer hinge is coordinate 0 (fast).
 * carrier:  a body on a ball joint, unit quaternion and body-frame omega, and optionally a particle that
 *           slides in it on a spring (coordinate 0, fast): rotations with inertial coupling */
#ifndef FMDSUB_TESTS_OSCILLATORS_H
#define FMDSUB_TESTS_OSCILLATORS_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "engine/stepper.h"
#include "multirate/schemes.h"

/* ---- random numbers: splitmix64, the same on all machines */

struct dice {
    uint64_t x;
};

static inline double dice_range(struct dice *d, double lo, double hi)
{
    uint64_t z = d->x += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return lo + (hi - lo) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static inline int dice_int(struct dice *d, int lo, int hi)
{
    int i = lo + (int)dice_range(d, 0, hi - lo + 1);
    return i > hi ? hi : i;
}

/* A := H A H with a random reflection H = 1 - 2 u u'/(u'u): the eigenvalues stay. */
static inline void random_turn(double *A, int n, int ld, struct dice *d)
{
    double u[80], uu = 0;
    for (int i = 0; i < n; i++) {
        u[i] = dice_range(d, -1, 1);
        uu += u[i] * u[i];
    }
    for (int j = 0; j < n; j++) {
        double s = 0;
        for (int i = 0; i < n; i++) s += u[i] * A[i + j * ld];
        for (int i = 0; i < n; i++) A[i + j * ld] -= 2 * s / uu * u[i];
    }
    for (int i = 0; i < n; i++) {
        double s = 0;
        for (int j = 0; j < n; j++) s += u[j] * A[i + j * ld];
        for (int j = 0; j < n; j++) A[i + j * ld] -= 2 * s / uu * u[j];
    }
}

/* Symmetric, eigenvalues spread over [lo, hi] in the logarithm. */
static inline void random_positive(double *A, int n, int ld, struct dice *d, double lo, double hi)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) A[i + j * ld] = i == j ? lo * pow(hi / lo, dice_range(d, 0, 1)) : 0;
    for (int k = 0; k < 3; k++) random_turn(A, n, ld, d);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) A[i + j * ld] = A[j + i * ld] = (A[i + j * ld] + A[j + i * ld]) / 2;
}

/* ---- linear */

enum { LINEAR_MOST = 12, PARTS = 2 }; /* part 0: fast bodies, part 1: slow bodies */

struct linear {
    struct ode2 ode;
    double M[PARTS][LINEAR_MOST * LINEAR_MOST], K[PARTS][LINEAR_MOST * LINEAR_MOST],
        C[PARTS][LINEAR_MOST * LINEAR_MOST];
    double f[LINEAR_MOST], w; /* load, on fast bodies */
    long calls[4];            /* resid or mass calls by class */
};

static inline double quadratic(const double *A, const double *x, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) sum += x[i] * A[i + j * n] * x[j];
    return sum;
}

static inline void multiply_add(double *y, const double *A, const double *x, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) y[i] += A[i + j * n] * x[j];
}

static inline enum status linear_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                                       unsigned cls, struct trouble *why)
{
    struct linear *s = o->self;
    (void)why;
    memset(r, 0, (size_t)o->n * sizeof *r);
    if (w) memset(w, 0, POWER_CHANNELS * sizeof *w);
    if (dk) *dk = 0;
    for (int part = 0; part < PARTS; part++) {
        if (!(cls & (part ? SLOW : FAST))) continue;
        if (x->a) multiply_add(r, s->M[part], x->a, o->n);
        multiply_add(r, s->C[part], x->v, o->n);
        multiply_add(r, s->K[part], x->q, o->n);
        if (w) w[POWER_DAMPER] -= quadratic(s->C[part], x->v, o->n);
    }
    if (cls & FAST)
        for (int i = 0; i < o->n; i++) {
            double load = s->f[i] * cos(s->w * x->t);
            r[i] -= load;
            if (w) w[POWER_EXTERNAL] += load * x->v[i];
        }
    s->calls[cls]++;
    return OK;
}

static inline void linear_sum(double *A, double (*parts)[LINEAR_MOST * LINEAR_MOST], int n, unsigned cls)
{
    for (int i = 0; i < n * n; i++) A[i] = (cls & FAST ? parts[0][i] : 0) + (cls & SLOW ? parts[1][i] : 0);
}

static inline enum status linear_mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls,
                                      struct trouble *why)
{
    struct linear *s = o->self;
    (void)q, (void)t, (void)why;
    linear_sum(M, s->M, o->n, cls);
    return OK;
}

static inline enum status linear_slopes(const struct ode2 *o, double *K, double *C, const struct instant *x,
                                        unsigned cls, struct trouble *why)
{
    struct linear *s = o->self;
    (void)x, (void)why;
    if (K) linear_sum(K, s->K, o->n, cls);
    if (C) linear_sum(C, s->C, o->n, cls);
    return OK;
}

static inline void linear_open(struct linear *s, int n, int ns)
{
    static const struct ode2_ops ops = {.resid = linear_resid, .mass = linear_mass, .slopes = linear_slopes};
    memset(s, 0, sizeof *s);
    s->ode = (struct ode2){.n = n, .ns = ns, .nq = n, .ops = &ops, .self = s};
}

static inline double linear_energy(const struct linear *s, const double *q, const double *v)
{
    int n = s->ode.n;
    return (quadratic(s->M[0], v, n) + quadratic(s->M[1], v, n) + quadratic(s->K[0], q, n) + quadratic(s->K[1], q, n)) /
           2;
}

/* Two coordinates, S = {0}, L = {1}: M = [mS mu; mu mL] and so on; all on fast bodies. */
static inline void linear_pair(struct linear *s, const double *M, const double *K, const double *C)
{
    linear_open(s, 2, 1);
    memcpy(s->M[0], M, 4 * sizeof *M);
    memcpy(s->K[0], K, 4 * sizeof *K);
    if (C) memcpy(s->C[0], C, 4 * sizeof *C);
}

/* ---- chain */

struct chain {
    struct ode2 ode;
    double l1, j1, md1;   /* length, inertia about the pivot, mass times centre distance of the inner link */
    double m2, j2, d2;    /* the outer one: mass, inertia about its hinge, centre distance */
    double k[2], c[2], g; /* springs and dampers: [0] outer hinge, [1] inner hinge */
};

static inline void chain_fast(const struct chain *s, double *r, const struct instant *x)
{
    double c2 = cos(x->q[0]), s2 = sin(x->q[0]), m = s->m2 * s->l1 * s->d2;
    double u2 = x->v[0], u1 = x->v[1], a2 = x->a ? x->a[0] : 0, a1 = x->a ? x->a[1] : 0;
    double fall = s->m2 * s->g * s->d2 * sin(x->q[0] + x->q[1]);
    r[0] += s->j2 * (a1 + a2) + m * c2 * a1 + m * s2 * u1 * u1 + fall + s->k[0] * x->q[0] + s->c[0] * u2;
    r[1] += s->j2 * (a1 + a2) + m * c2 * (2 * a1 + a2) + s->m2 * s->l1 * s->l1 * a1 - m * s2 * (2 * u1 + u2) * u2 +
            fall + s->m2 * s->g * s->l1 * sin(x->q[1]);
}

static inline enum status chain_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                                      unsigned cls, struct trouble *why)
{
    const struct chain *s = o->self;
    (void)why;
    r[0] = r[1] = 0;
    if (w) memset(w, 0, POWER_CHANNELS * sizeof *w);
    if (dk) *dk = 0;
    if (cls & FAST) {
        chain_fast(s, r, x);
        if (w) w[POWER_DAMPER] -= s->c[0] * x->v[0] * x->v[0];
    }
    if (cls & SLOW) {
        r[1] += s->j1 * (x->a ? x->a[1] : 0) + s->md1 * s->g * sin(x->q[1]) + s->k[1] * x->q[1] + s->c[1] * x->v[1];
        if (w) w[POWER_DAMPER] -= s->c[1] * x->v[1] * x->v[1];
    }
    return OK;
}

static inline enum status chain_mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls,
                                     struct trouble *why)
{
    const struct chain *s = o->self;
    double m = s->m2 * s->l1 * s->d2 * cos(q[0]);
    (void)t, (void)why;
    memset(M, 0, 4 * sizeof *M);
    if (cls & FAST) {
        M[0] = s->j2;
        M[1] = M[2] = s->j2 + m;
        M[3] = s->j2 + 2 * m + s->m2 * s->l1 * s->l1;
    }
    if (cls & SLOW) M[3] += s->j1;
    return OK;
}

static inline enum status chain_slopes(const struct ode2 *o, double *K, double *C, const struct instant *x,
                                       unsigned cls, struct trouble *why)
{
    const struct chain *s = o->self;
    (void)x, (void)why;
    for (int i = 0; i < 2; i++) {
        unsigned mine = i ? SLOW : FAST;
        if (K) K[3 * i] = cls & mine ? s->k[i] : 0;
        if (C) C[3 * i] = cls & mine ? s->c[i] : 0;
    }
    if (K) K[1] = K[2] = 0;
    if (C) C[1] = C[2] = 0;
    return OK;
}

/* Uniform rods of mass and length 1. */
static inline void chain_open(struct chain *s, double k_outer, double k_inner, double g)
{
    static const struct ode2_ops ops = {.resid = chain_resid, .mass = chain_mass, .slopes = chain_slopes};
    *s = (struct chain){.l1 = 1, .j1 = 1. / 3, .md1 = .5, .m2 = 1, .j2 = 1. / 3, .d2 = .5, .g = g};
    s->k[0] = k_outer;
    s->k[1] = k_inner;
    s->ode = (struct ode2){.n = 2, .ns = 1, .nq = 2, .ops = &ops, .self = s};
}

static inline double chain_energy(const struct chain *s, const double *q, const double *v)
{
    double M[4];
    (void)chain_mass(&s->ode, M, q, 0, ALL, NULL); /* never fails */
    return quadratic(M, v, 2) / 2 + (s->k[0] * q[0] * q[0] + s->k[1] * q[1] * q[1]) / 2 -
           s->g * ((s->md1 + s->m2 * s->l1) * cos(q[1]) + s->m2 * s->d2 * cos(q[0] + q[1]));
}

/* ---- carrier */

struct carrier {
    struct ode2 ode;
    double J[3];     /* body, about the ball joint, principal axes */
    double md[3];    /* mass times centre of mass */
    double m, at[3]; /* particle, its place in the body; it slides along body y */
    double k, c, g;  /* spring, damper, gravity along -z */
};

static inline void cross(double *c, const double *a, const double *b)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* p = a b, quaternions (w, x, y, z). */
static inline void quaternion_product(double *p, const double *a, const double *b)
{
    double w = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    double x = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    double y = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    double z = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
    p[0] = w, p[1] = x, p[2] = y, p[3] = z;
}

/* Third row of R(q): the world's z axis seen from the body. */
static inline void upward(double *up, const double *q)
{
    up[0] = 2 * (q[1] * q[3] - q[0] * q[2]);
    up[1] = 2 * (q[2] * q[3] + q[0] * q[1]);
    up[2] = q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3];
}

/* R x. */
static inline void turned(double *y, const double *q, const double *x)
{
    double p[4] = {0, x[0], x[1], x[2]}, c[4] = {q[0], -q[1], -q[2], -q[3]};
    quaternion_product(p, q, p);
    quaternion_product(p, p, c);
    y[0] = p[1], y[1] = p[2], y[2] = p[3];
}

static inline void carrier_point(const struct ode2 *o, double *q1, const double *q0, const double *dx, double s,
                                 double t)
{
    (void)t;
    int f = o->ns;
    if (f) q1[0] = q0[0] + s * dx[0];
    double size = sqrt(dx[f] * dx[f] + dx[f + 1] * dx[f + 1] + dx[f + 2] * dx[f + 2]);
    double half = s * atan(size / 2), c = size > 0 ? sin(half) / size : 0;
    double turn[4] = {cos(half), c * dx[f], c * dx[f + 1], c * dx[f + 2]};
    quaternion_product(q1 + f, q0 + f, turn);
}

static inline void carrier_diff(const struct ode2 *o, double *dx, const double *q1, const double *q0)
{
    int f = o->ns;
    if (f) dx[0] = q1[0] - q0[0];
    double back[4] = {q0[f], -q0[f + 1], -q0[f + 2], -q0[f + 3]}, p[4];
    quaternion_product(p, back, q1 + f);
    for (int i = 0; i < 3; i++) dx[f + i] = 2 * p[i + 1] / p[0];
}

static inline void carrier_rate(const struct ode2 *o, double *rate, const double *q1, const double *q0,
                                const double *dx, const double *v, double t)
{
    (void)q1, (void)q0, (void)t;
    int f = o->ns;
    const double *x = dx + f, *u = v + f;
    double xu[3], s = (x[0] * u[0] + x[1] * u[1] + x[2] * u[2]) / 4;
    cross(xu, x, u);
    if (f) rate[0] = v[0];
    for (int i = 0; i < 3; i++) rate[f + i] = u[i] + xu[i] / 2 + x[i] * s;
}

/* The particle: m (A + g up) along the slide and as a moment. */
static inline void carrier_fast(const struct carrier *s, double *r, const struct instant *x)
{
    static const double rest[4] = {0};
    const double *a = x->a ? x->a : rest, *u = x->v + 1, e[3] = {0, 1, 0};
    double p[3] = {s->at[0], s->at[1] + x->q[0], s->at[2]}, up[3], ap[3], up_[3], uup[3], ue[3], F[3], pF[3];
    upward(up, x->q + 1);
    cross(ap, a + 1, p);
    cross(up_, u, p);
    cross(uup, u, up_);
    cross(ue, u, e);
    for (int i = 0; i < 3; i++) F[i] = s->m * (ap[i] + uup[i] + 2 * x->v[0] * ue[i] + a[0] * e[i] + s->g * up[i]);
    cross(pF, p, F);
    r[0] += F[1] + s->k * x->q[0] + s->c * x->v[0];
    for (int i = 0; i < 3; i++) r[1 + i] += pF[i];
}

static inline void carrier_slow(const struct carrier *s, double *r, const struct instant *x, int f)
{
    const double *u = x->v + f;
    double Ju[3], uJu[3], up[3], fall[3];
    upward(up, x->q + f);
    for (int i = 0; i < 3; i++) Ju[i] = s->J[i] * u[i];
    cross(uJu, u, Ju);
    cross(fall, s->md, up);
    for (int i = 0; i < 3; i++) r[f + i] += s->J[i] * (x->a ? x->a[f + i] : 0) + uJu[i] + s->g * fall[i];
}

static inline enum status carrier_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                                        unsigned cls, struct trouble *why)
{
    const struct carrier *s = o->self;
    (void)why;
    memset(r, 0, (size_t)o->n * sizeof *r);
    if (w) memset(w, 0, POWER_CHANNELS * sizeof *w);
    if (dk) *dk = 0;
    if (o->ns && (cls & FAST)) {
        carrier_fast(s, r, x);
        if (w) w[POWER_DAMPER] -= s->c * x->v[0] * x->v[0];
    }
    if (cls & SLOW) carrier_slow(s, r, x, o->ns);
    return OK;
}

static inline enum status carrier_mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls,
                                       struct trouble *why)
{
    const struct carrier *s = o->self;
    int n = o->n, f = o->ns;
    (void)t, (void)why;
    memset(M, 0, (size_t)(n * n) * sizeof *M);
    if (cls & SLOW)
        for (int i = 0; i < 3; i++) M[(f + i) * (n + 1)] += s->J[i];
    if (!f || !(cls & FAST)) return OK;
    double p[3] = {s->at[0], s->at[1] + q[0], s->at[2]}, pp = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    double e[3] = {0, 1, 0}, pe[3];
    cross(pe, p, e);
    M[0] = s->m;
    for (int i = 0; i < 3; i++) {
        M[1 + i] = M[(1 + i) * n] = s->m * pe[i];
        for (int j = 0; j < 3; j++) M[1 + i + (1 + j) * n] += s->m * ((i == j) * pp - p[i] * p[j]);
    }
    return OK;
}

/* Gyroscopic slopes of the body, d(u x J u)/du; the particle's spring and damper. */
static inline enum status carrier_slopes(const struct ode2 *o, double *K, double *C, const struct instant *x,
                                         unsigned cls, struct trouble *why)
{
    const struct carrier *s = o->self;
    int n = o->n, f = o->ns;
    (void)why;
    if (K) memset(K, 0, (size_t)(n * n) * sizeof *K);
    if (C) memset(C, 0, (size_t)(n * n) * sizeof *C);
    for (int j = 0; C && (cls & SLOW) && j < 3; j++) {
        double e[3] = {0}, Ju[3], ue[3], eJ[3];
        e[j] = s->J[j];
        for (int i = 0; i < 3; i++) Ju[i] = s->J[i] * x->v[f + i];
        cross(ue, x->v + f, e);
        e[j] = 1;
        cross(eJ, e, Ju);
        for (int i = 0; i < 3; i++) C[f + i + (f + j) * n] = ue[i] + eJ[i];
    }
    if (!f || !(cls & FAST)) return OK;
    if (K) K[0] = s->k;
    if (C) C[0] = s->c;
    return OK;
}

static inline void carrier_open(struct carrier *s, int slider)
{
    static const struct ode2_ops ops = {.resid = carrier_resid, .mass = carrier_mass, .slopes = carrier_slopes};
    static const struct ode2_move move = {.point = carrier_point, .diff = carrier_diff, .rate = carrier_rate};
    *s = (struct carrier){.J = {2, 3, 1.5}, .md = {.1, 0, .8}, .m = .5, .at = {.7, .2, .3}, .k = 200, .g = 9.81};
    s->ode = (struct ode2){.n = 3 + slider, .ns = slider, .nq = 4 + slider, .ops = &ops, .move = &move, .self = s};
}

static inline double carrier_energy(const struct carrier *s, const double *q, const double *v)
{
    double M[16], up[3], y = 0, E;
    int f = s->ode.ns;
    (void)carrier_mass(&s->ode, M, q, 0, ALL, NULL); /* never fails */
    upward(up, q + f);
    for (int i = 0; i < 3; i++) y += s->md[i] * up[i] + (f ? s->m * s->at[i] * up[i] : 0);
    E = quadratic(M, v, s->ode.n) / 2;
    if (f) E += s->k * q[0] * q[0] / 2 + s->m * s->g * q[0] * up[1];
    return E + s->g * y;
}

/* ---- runs */

enum { RUN_MOST = 16 };

static const struct step_options step_defaults = {.order = 2,
                                                  .most_order = 5,
                                                  .beta = .25,
                                                  .gamma = .5,
                                                  .iteration = ITERATION_NEWTON,
                                                  .rho_infinity = 1,
                                                  .alpha = -.05,
                                                  .tolerance = 1e-6};

struct run {
    struct stepper stepper;
    struct state x;
    struct arena *life;
    double q[RUN_MOST], v[RUN_MOST], a[RUN_MOST];
    double work[POWER_CHANNELS], lost, left;
    struct trouble why;
};

static inline enum status run_open(struct run *r, const char *scheme, struct ode2 *ode,
                                   const struct step_options *options, const double *q, const double *v)
{
    memset(r, 0, sizeof *r);
    r->life = arena_open();
    r->x = (struct state){0, r->q, r->v, r->a};
    memcpy(r->q, q, (size_t)ode->nq * sizeof *q);
    memcpy(r->v, v, (size_t)ode->n * sizeof *v);
    stepper_open(&r->stepper, stepper_find(scheme), ode, options, r->life);
    return stepper_start(&r->stepper, &r->x, &r->why);
}

static inline void run_close(struct run *r)
{
    arena_close(r->life);
}

static inline enum status run_steps(struct run *r, double h, int ratio, int majors)
{
    double t0 = r->x.t;
    for (int k = 1; k <= majors; k++) {
        TRY(stepper_step(&r->stepper, &r->x, h, ratio, t0 + k * (ratio * h), &r->why));
        for (int c = 0; c < POWER_CHANNELS; c++) r->work[c] += r->stepper.work[c];
        r->lost += r->stepper.lost;
        r->left += r->stepper.left;
    }
    return OK;
}

/* Iterated to round-off. */
static inline struct step_options sharp(void)
{
    struct step_options o = step_defaults;
    o.newton_tolerance = 1e-13;
    return o;
}

/* Largest difference of q and v after T = majors ratio h from the solution by Dormand-Prince to 1e-12. */
static inline double run_error(const char *scheme, struct ode2 *ode, const struct step_options *options,
                               const double *q, const double *v, double T, int ratio, int majors)
{
    struct run a, b;
    struct step_options fine = step_defaults;
    double worst = 0;
    fine.tolerance = 1e-12;
    if (run_open(&a, scheme, ode, options, q, v) != OK || run_open(&b, "dopri5", ode, &fine, q, v) != OK) return NAN;
    if (run_steps(&a, T / (ratio * majors), ratio, majors) != OK) worst = NAN;
    if (run_steps(&b, T, 1, 1) != OK) worst = NAN;
    for (int i = 0; i < ode->nq; i++) worst = worst >= fabs(a.q[i] - b.q[i]) ? worst : fabs(a.q[i] - b.q[i]);
    for (int i = 0; i < ode->n; i++) worst = worst >= fabs(a.v[i] - b.v[i]) ? worst : fabs(a.v[i] - b.v[i]);
    run_close(&a);
    run_close(&b);
    return worst;
}

/* Observed order between majors and 4 majors steps. */
static inline double run_order(const char *scheme, struct ode2 *ode, const struct step_options *options,
                               const double *q, const double *v, double T, int ratio, int majors)
{
    double coarse = run_error(scheme, ode, options, q, v, T, ratio, majors);
    double fine = run_error(scheme, ode, options, q, v, T, ratio, 4 * majors);
    return log2(coarse / fine) / 2;
}

/* Two coordinates coupled by inertia and by stiffness, frequencies 3.3 and 21; S = {0}. */
static inline void linear_both(struct linear *s)
{
    linear_pair(s, (double[]){1, .6, .6, 2}, (double[]){400, -20, -20, 24}, NULL);
}

static const double both_q[2] = {.2, 1}, both_v[2] = {0, .3};

/* The spinning body thrown, its particle plucked. */
static const double carrier_q[5] = {.05, .8, .6, 0, 0}, carrier_v[4] = {.1, .5, -.4, 2};

/* Observed orders of a single-rate scheme: coupled oscillators, free and damped and driven; two links; a spinning body,
 * by itself and with its particle. */
enum { ORDERS = 5 };
static inline void single_rate_orders(double order[ORDERS], const char *scheme, const struct step_options *o)
{
    struct linear pair;
    struct chain chain;
    struct carrier top, slide;
    linear_both(&pair);
    order[0] = run_order(scheme, &pair.ode, o, both_q, both_v, 1, 1, 400);
    memcpy(pair.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
    pair.f[0] = 5, pair.f[1] = -3, pair.w = 4;
    order[1] = run_order(scheme, &pair.ode, o, both_q, both_v, 1, 1, 400);
    chain_open(&chain, 30, 2, 9.81);
    order[2] = run_order(scheme, &chain.ode, o, (double[]){.3, 1}, (double[]){0, .5}, 1, 1, 200);
    carrier_open(&top, 0);
    order[3] = run_order(scheme, &top.ode, o, carrier_q + 1, carrier_v + 1, 1, 1, 200);
    carrier_open(&slide, 1);
    order[4] = run_order(scheme, &slide.ode, o, carrier_q, carrier_v, 1, 1, 200);
}

#endif
