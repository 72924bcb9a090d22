/* t-broyden.c -- the inverse of the iteration matrix learns from iterations and goes on with time. */
#include "engine/broyden.h"
#include "engine/motion.h"

/* the harness has a macro of that name */
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

enum { N = 4 };

/* A system that is its own mass: M(t) = 1/(A + t D) as a matrix, so that its inverse is a line in time; stiffness K. */
struct plant {
    double A[N * N], D[N * N], K[N * N];
    bool steady; /* D is not there */
};

static void inverse_at(const struct plant *p, double *B, double t)
{
    for (int k = 0; k < N * N; k++) B[k] = p->A[k] + (p->steady ? 0 : t * p->D[k]);
}

/* By Gauss and Jordan. */
static void invert(double *X, const double *A)
{
    double W[N * N];
    copy(W, A, N * N);
    for (int k = 0; k < N * N; k++) X[k] = k % (N + 1) == 0;
    for (int j = 0; j < N; j++) {
        const double pivot = W[j * (N + 1)];
        for (int k = 0; k < N; k++) W[j + k * N] /= pivot, X[j + k * N] /= pivot;
        for (int i = 0; i < N; i++) {
            const double f = i == j ? 0 : W[i + j * N];
            for (int k = 0; k < N; k++) W[i + k * N] -= f * W[j + k * N], X[i + k * N] -= f * X[j + k * N];
        }
    }
}

static enum status mass(const struct ode2 *ode, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    double B[N * N];
    (void)q, (void)cls, (void)why;
    inverse_at(ode->self, B, t);
    invert(M, B);
    return OK;
}

static enum status slopes(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why)
{
    const struct plant *p = ode->self;
    (void)x, (void)cls, (void)why;
    copy(K, p->K, N * N);
    zero(C, N * N);
    return OK;
}

static const struct ode2_ops ops = {.mass = mass, .slopes = slopes};

static const struct plant moving = {
    .A = {4, 1, 0, .5, 1, 5, 1, 0, 0, 1, 6, 1, .5, 0, 1, 7},
    .D = {1, .2, 0, 0, .2, -1, .3, 0, 0, .3, 2, .1, 0, 0, .1, -2},
};

struct bench {
    struct arena *arena;
    struct plant plant;
    struct ode2 ode;
    struct effort effort;
    struct broyden o;
};

static void open_bench(struct bench *b, const struct plant *plant)
{
    *b = (struct bench){.arena = arena_open(), .plant = *plant};
    b->ode = (struct ode2){.n = N, .nq = N, .ops = &ops, .self = &b->plant};
    broyden_open(&b->o, &b->ode, &b->effort, b->arena);
}

static void form(struct bench *b, double h, double ck, double t)
{
    const double q[N] = {0};
    assert_int_equal(broyden_form(&b->o, h, 0, ck, &(struct instant){.t = t, .q = q}, NULL), OK);
}

static double worst(const double *a, const double *b, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* Two matrices are a line, the third shows that it holds; then B is right between them and beyond, and what vibration is
 * foreseen by, too. */
static void goes_on(void **state)
{
    struct bench b;
    double B[N * N], x[N], y[N], a[N] = {1, -2, 3, -1};
    (void)state;
    open_bench(&b, &moving);
    for (int k = 0; k < N * N; k++) b.plant.K[k] = k % (N + 1) == 0;
    for (int k = 0; k < 3; k++) {
        form(&b, .01, 0, .1 * k);
        inverse_at(&b.plant, B, .1 * k);
        assert_true(worst(b.o.B, B, N * N) < 1e-14);
        broyden_go(&b.o, .1 * k + .02);
        inverse_at(&b.plant, B, .1 * k + .02);
        assert_true(k < 2 ? worst(b.o.B, B, N * N) > .01 : worst(b.o.B, B, N * N) < 1e-13);
    }
    broyden_solve(&b.o, x, a);
    zero(y, N);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) y[i] += B[i + j * N] * a[j];
    assert_true(worst(x, y, N) < 1e-13);
    assert_int_equal(broyden_drift(&b.o, x, 1, a, y), N);
    assert_true(worst(x, y, N) < 1e-13);
    form(&b, .02, 0, .4); /* of another step: no line */
    broyden_go(&b.o, .5);
    inverse_at(&b.plant, B, .4);
    assert_true(worst(b.o.B, B, N * N) < 1e-14);
    arena_close(b.arena);
}

/* Turned round at each look: a line would lead astray. */
static void stays(void **state)
{
    struct bench b;
    double B[N * N];
    (void)state;
    open_bench(&b, &moving);
    for (int k = 0; k < 6; k++) {
        for (int i = 0; i < N * N; i++) b.plant.D[i] = k % 2 ? -moving.D[i] : moving.D[i];
        form(&b, .01, 0, 1 + .1 * k);
        broyden_go(&b.o, 1.05 + .1 * k);
        inverse_at(&b.plant, B, 1 + .1 * k);
        assert_true(worst(b.o.B, B, N * N) < 1e-14);
    }
    arena_close(b.arena);
}

/* One iteration of r = J z from z [N], z0: r there; returns whether it has learnt.  B y = s then. */
static bool iterate(struct broyden *o, const double *J, double *r, double *z)
{
    double d[N], s[N], r1[N], y[N], dr[N];
    broyden_solve(o, s, r);
    for (int i = 0; i < N; i++) z[i] -= s[i];
    zero(r1, N);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) r1[i] += J[i + j * N] * z[j];
    broyden_solve(o, d, r1);
    const bool learnt = broyden_learn(o, d, s, r, r1);
    if (learnt) {
        broyden_solve(o, y, r1);
        assert_true(worst(y, d, N) < 1e-13 * fabs(s[0]) + 1e-300);
        for (int i = 0; i < N; i++) dr[i] = r[i] - r1[i];
        broyden_solve(o, y, dr);
        assert_true(worst(y, s, N) < 1e-13);
    }
    copy(r, r1, N);
    return learnt;
}

/* J is another than the one that was formed, by a tenth, and not symmetric: steps from elsewhere each, of one correction
 * after the first, teach it until first corrections leave nothing; forming it anew forgets. */
static void learns(void **state)
{
    struct bench b;
    double J[N * N], first = 0, last = 0;
    (void)state;
    open_bench(&b, &moving);
    b.plant.steady = true;
    form(&b, .01, 0, 0);
    invert(J, b.plant.A);
    for (int k = 0; k < N * N; k++) J[k] *= 1 + .02 * (k % 5) - .02 * (k % 3);
    for (int step = 0; step < 160; step++) {
        double r[N] = {0}, z[N];
        for (int i = 0; i < N; i++) z[i] = cos(1.7 * i + 2.3 * step);
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++) r[i] += J[i + j * N] * z[j];
        const bool learnt = iterate(&b.o, J, r, z);
        double left = 0;
        for (int i = 0; i < N; i++) left = fmax(left, fabs(z[i]));
        if (step == 0) assert_true(learnt);
        if (step == 0) first = left;
        last = left;
    }
    assert_true(first > 1e-3 && last < 1e-9);
    form(&b, .01, 0, 1);
    assert_true(worst(b.o.B, b.plant.A, N * N) < 1e-14);
    arena_close(b.arena);
}

/* Corrections that turn the residual round, or leave much of it, show nothing that is near the slope. */
static void is_not_taught_nonsense(void **state)
{
    struct bench b;
    const double s[N] = {1, 0, 0, 0}, r0[N] = {1, 0, 0, 0}, poor[N] = {.4, 0, 0, 0}, turned[N] = {-.4, 0, 0, 0};
    double d[N] = {1, 2, 3, 4};
    (void)state;
    open_bench(&b, &moving);
    form(&b, .01, 0, 0);
    assert_false(broyden_learn(&b.o, d, s, r0, poor));
    assert_false(broyden_learn(&b.o, d, s, r0, turned));
    assert_false(broyden_learn(&b.o, d, (const double[N]){0}, r0, poor));
    assert_true(worst(b.o.B, moving.A, N * N) < 1e-14 && d[3] == 4);
    arena_close(b.arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(goes_on), cmocka_unit_test(stays), cmocka_unit_test(learns),
                                       cmocka_unit_test(is_not_taught_nonsense)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
