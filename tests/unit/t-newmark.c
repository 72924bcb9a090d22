/* t-newmark.c -- Newmark's method: order, the paper's iteration, static equilibrium, the owner's solver */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "la/dense.h"
#include "multirate/schemes.h"
#include "unit/oscillators.h"

#include <cmocka.h>

static void test_order(void **state)
{
    double order[ORDERS];
    const struct step_options o = sharp();
    (void)state;
    single_rate_orders(order, "newmark", &o);
    for (int i = 0; i < ORDERS; i++)
        if (!(order[i] > 1.9 && order[i] < 2.1)) fail_msg("system %d: order %g", i, order[i]);
}

/* One step against the closed formula of the scalar oscillator: a1 (1 + beta (w h)^2) = -w^2 q*. */
static void test_formula(void **state)
{
    (void)state;
    struct linear s;
    double w2 = 9, h = .2, beta = .3, gamma = .6, q = 1, v = -.5;
    linear_open(&s, 1, 0);
    s.M[0][0] = 1;
    s.K[0][0] = w2;
    struct step_options o = sharp();
    o.beta = beta, o.gamma = gamma;
    struct run r;
    assert_int_equal(run_open(&r, "newmark", &s.ode, &o, &q, &v), OK);
    double a = -w2 * q;
    for (int k = 0; k < 5; k++) {
        double star = q + h * v + h * h * (.5 - beta) * a, a1 = -w2 * star / (1 + beta * w2 * h * h);
        v += h * ((1 - gamma) * a + gamma * a1);
        q = star + beta * h * h * a1;
        a = a1;
        assert_int_equal(run_steps(&r, h, 1, 1), OK);
        assert_true(fabs(r.q[0] - q) < 1e-14 && fabs(r.v[0] - v) < 1e-13 && fabs(r.a[0] - a) < 1e-12);
    }
    run_close(&r);
}

/* For a linear unforced system the trapezoidal and the midpoint rule give the same states when the
 * start is consistent. */
static void test_midpoint(void **state)
{
    (void)state;
    struct linear s;
    struct run a, b;
    struct step_options o = sharp();
    linear_both(&s);
    assert_int_equal(run_open(&a, "newmark", &s.ode, &o, both_q, both_v), OK);
    assert_int_equal(run_open(&b, "midpoint", &s.ode, &o, both_q, both_v), OK);
    assert_int_equal(run_steps(&a, .02, 5, 40), OK);
    assert_int_equal(run_steps(&b, .02, 5, 40), OK);
    for (int i = 0; i < 2; i++) assert_true(fabs(a.q[i] - b.q[i]) < 1e-11 && fabs(a.v[i] - b.v[i]) < 1e-10);
    run_close(&a);
    run_close(&b);
}

/* (2-9) contracts by beta (w h)^2: it converges at w h = 1 and not at 2.05; Newton does at both. */
static void test_fixed_point(void **state)
{
    (void)state;
    struct linear s;
    linear_open(&s, 1, 0);
    s.M[0][0] = s.K[0][0] = 1;
    double q = 1, v = 0;
    for (int large = 0; large < 2; large++)
        for (int newton = 0; newton < 2; newton++) {
            struct step_options o = step_defaults;
            struct run r;
            o.iteration = newton ? ITERATION_NEWTON : ITERATION_FIXED_POINT;
            assert_int_equal(run_open(&r, "newmark", &s.ode, &o, &q, &v), OK);
            enum status status = run_steps(&r, large ? 2.05 : 1, 1, 20);
            assert_int_equal(status, large && !newton ? E_NUMERIC : OK);
            if (status != OK) {
                assert_int_equal(r.why.code, TROUBLE_DIVERGED);
                assert_true(r.q[0] == q && r.v[0] == v && r.x.t == 0);
            } else {
                assert_true(fabs(linear_energy(&s, r.q, r.v) - .5) < 1e-7);
            }
            run_close(&r);
        }
}

/* A smooth problem takes about two residuals a step, and hardly ever a new matrix. */
static void test_effort(void **state)
{
    (void)state;
    struct chain chain;
    struct run r;
    chain_open(&chain, 5, 1, 9.81);
    assert_int_equal(run_open(&r, "newmark", &chain.ode, &step_defaults, (double[]){.3, 1}, (double[]){0, .5}), OK);
    struct effort e = r.stepper.effort;
    assert_int_equal(run_steps(&r, 1e-3, 1, 2000), OK);
    double each = (double)(r.stepper.effort.fast - e.fast) / 2000;
    if (each > 2.3) print_error("%g residuals a step\n", each);
    assert_true(each < 2.3);
    assert_true(r.stepper.effort.factors < 100);
    assert_true(r.stepper.effort.majors == 2000 && r.stepper.effort.minors == 2000);
    run_close(&r);
}

/* At rest under cancelling forces, and with one coordinate at rest among moving ones. */
static void test_rest(void **state)
{
    (void)state;
    const char *schemes[] = {"newmark", "midpoint", "miao", "subcycle"};
    for (int k = 0; k < 4; k++) {
        struct chain chain;
        struct run r;
        double q[2] = {0, 0}, v[2] = {0, 0}; /* hanging straight down */
        chain_open(&chain, 1e5, 2e4, 9.81);
        assert_int_equal(run_open(&r, schemes[k], &chain.ode, &step_defaults, q, v), OK);
        assert_int_equal(run_steps(&r, 1e-3, 4, 100), OK);
        assert_true(r.stepper.last_sweeps <= 8);
        run_close(&r);

        struct linear s;
        linear_open(&s, 3, 1);
        double load = 1e4 / 3;
        for (int i = 0; i < 3; i++) s.M[0][4 * i] = 1, s.K[0][4 * i] = 1e5 * (i + 1);
        s.f[0] = s.f[1] = load; /* held by the springs: cancels but for round-off */
        double qs[3] = {load / 1e5, load / 2e5, k % 2 ? .1 : 0}, vs[3] = {0, 0, 0};
        assert_int_equal(run_open(&r, schemes[k], &s.ode, &step_defaults, qs, vs), OK);
        assert_int_equal(run_steps(&r, 1e-3, 4, 100), OK);
        assert_true(fabs(r.q[0] - qs[0]) < 1e-14 && fabs(r.q[1] - qs[1]) < 1e-14);
        assert_true(r.stepper.effort.factors <= 3);
        assert_true(r.stepper.effort.sweeps <= 3 * r.stepper.effort.minors);
        run_close(&r);
    }
}

/* Work by the trapezoid of the end powers: the balance closes with the square of the step. */
static void test_work(void **state)
{
    (void)state;
    double gap[2];
    for (int fine = 0; fine < 2; fine++) {
        struct linear s;
        struct run r;
        linear_both(&s);
        memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
        s.f[0] = 5, s.w = 4;
        assert_int_equal(run_open(&r, "newmark", &s.ode, &step_defaults, both_q, both_v), OK);
        double E0 = linear_energy(&s, r.q, r.v);
        assert_int_equal(run_steps(&r, fine ? .0025 : .005, 1, fine ? 400 : 200), OK);
        gap[fine] = linear_energy(&s, r.q, r.v) - E0 - r.work[POWER_DAMPER] - r.work[POWER_EXTERNAL];
        assert_true(fabs(r.work[POWER_EXTERNAL]) > .01);
        run_close(&r);
    }
    assert_true(fabs(gap[0]) < .05 && gap[0] / gap[1] > 3.5 && gap[0] / gap[1] < 4.5);
}

/* Time runs backwards: h < 0 undoes h > 0 (beta = 1/4, gamma = 1/2 is symmetric). */
static void test_backwards(void **state)
{
    (void)state;
    const char *schemes[] = {"newmark", "midpoint"};
    for (int k = 0; k < 2; k++) {
        struct carrier top;
        struct run r;
        struct step_options o = sharp();
        carrier_open(&top, 1);
        assert_int_equal(run_open(&r, schemes[k], &top.ode, &o, carrier_q, carrier_v), OK);
        assert_int_equal(run_steps(&r, .01, 1, 50), OK);
        assert_int_equal(run_steps(&r, -.01, 1, 50), OK);
        for (int i = 0; i < 5; i++) assert_true(fabs(r.q[i] - carrier_q[i]) < 1e-10);
        for (int i = 0; i < 4; i++) assert_true(fabs(r.v[i] - carrier_v[i]) < 1e-9);
        run_close(&r);
    }
}

/* ---- a long chain with a solver of its own: a tridiagonal matrix */

enum { LONG = 20 };

struct rope {
    struct ode2 ode;
    double k[LONG + 1];
    int refuse;
    long factors;
};

static void rope_matrix(const struct rope *s, double *A, double cm, double ck)
{
    memset(A, 0, LONG * LONG * sizeof *A);
    for (int i = 0; i < LONG; i++) {
        A[i * (LONG + 1)] = 2 * cm + ck * (s->k[i] + s->k[i + 1]);
        if (i) A[i * (LONG + 1) - 1] = A[(i - 1) * (LONG + 1) + 1] = .3 * cm - ck * s->k[i];
    }
}

static enum status rope_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                              unsigned cls, struct trouble *why)
{
    double A[LONG * LONG];
    (void)why;
    memset(r, 0, LONG * sizeof *r);
    if (w) memset(w, 0, POWER_CHANNELS * sizeof *w);
    if (dk) *dk = 0;
    if (!(cls & FAST)) return OK;
    rope_matrix(o->self, A, 1, 0);
    if (x->a) multiply_add(r, A, x->a, LONG);
    rope_matrix(o->self, A, 0, 1);
    multiply_add(r, A, x->q, LONG);
    return OK;
}

static enum status rope_mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls,
                             struct trouble *why)
{
    (void)q, (void)t, (void)why;
    rope_matrix(o->self, M, cls & FAST ? 1 : 0, 0);
    return OK;
}

static enum status rope_slopes(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                               struct trouble *why)
{
    (void)x, (void)why;
    rope_matrix(o->self, K, 0, cls & FAST ? 1 : 0);
    memset(C, 0, LONG * LONG * sizeof *C);
    return OK;
}

static enum status rope_factor(const struct ode2 *o, void *F, double cm, double cc, double ck, const struct instant *x,
                               struct trouble *why)
{
    struct rope *s = o->self;
    (void)cc;
    s->factors++;
    if (s->refuse) return trouble_set(why, TROUBLE_SINGULAR, 0, 0, x->t);
    rope_matrix(s, F, cm, ck);
    return dense_cholesky(F, LONG, LONG) < 0 ? OK : E_NUMERIC;
}

static void rope_solve(const struct ode2 *o, const void *F, double *x)
{
    (void)o;
    dense_cholesky_solve(F, x, LONG, LONG);
}

static enum status rope_accel(const struct ode2 *o, double *a, double *w, const double *q, const double *v, double t,
                              struct trouble *why)
{
    double A[LONG * LONG];
    (void)v, (void)t, (void)why;
    if (w) memset(w, 0, POWER_CHANNELS * sizeof *w);
    memset(a, 0, LONG * sizeof *a);
    rope_matrix(o->self, A, 0, -1);
    multiply_add(a, A, q, LONG);
    rope_matrix(o->self, A, 1, 0);
    dense_cholesky(A, LONG, LONG);
    dense_cholesky_solve(A, a, LONG, LONG);
    return OK;
}

static void test_direct(void **state)
{
    (void)state;
    static const struct ode2_ops ops = {.resid = rope_resid, .mass = rope_mass, .slopes = rope_slopes};
    static const struct ode2_direct direct = {
        .accel = rope_accel, .factor_size = LONG * LONG * sizeof(double), .factor = rope_factor, .solve = rope_solve};
    const char *schemes[] = {"newmark", "midpoint", "rk4"};
    double q[LONG], v[LONG] = {0}, end[3][LONG];
    for (int i = 0; i < LONG; i++) q[i] = sin(.3 * i);
    for (int k = 0; k < 3; k++)
        for (int way = 0; way < 3; way++) { /* dense; by the owner; by an owner that refuses */
            struct rope s = {.refuse = way == 2};
            struct state x = {0, (double[LONG]){0}, (double[LONG]){0}, (double[LONG]){0}};
            struct stepper st;
            struct arena *life = arena_open();
            for (int i = 0; i <= LONG; i++) s.k[i] = 100 + i;
            s.ode = (struct ode2){.n = LONG, .nq = LONG, .ops = &ops, .direct = way ? &direct : NULL, .self = &s};
            memcpy(x.q, q, sizeof q);
            memcpy(x.v, v, sizeof v);
            stepper_open(&st, stepper_find(schemes[k]), &s.ode, &step_defaults, life);
            assert_int_equal(stepper_start(&st, &x, NULL), OK);
            for (int i = 1; i <= 20; i++) assert_int_equal(stepper_step(&st, &x, .01, 1, i * .01, NULL), OK);
            memcpy(end[way], x.q, sizeof q);
            for (int i = 0; i < LONG; i++) assert_true(fabs(end[way][i] - end[0][i]) < 1e-8);
            if (k < 2) assert_int_equal(s.factors, way ? 1 : 0);
            arena_close(life);
        }
}

/* Nothing is allocated once the first step is done, by any scheme. */
static void test_memory(void **state)
{
    (void)state;
    for (int k = 0; stepper_kinds[k]; k++) {
        struct chain chain;
        struct run r;
        chain_open(&chain, 50, 2, 9.81);
        assert_int_equal(
            run_open(&r, stepper_kinds[k]->name, &chain.ode, &step_defaults, (double[]){.3, 1}, (double[]){0, .5}), OK);
        size_t used = arena_used(r.life);
        assert_int_equal(run_steps(&r, .002, 10, 1), OK);
        assert_int_equal(run_steps(&r, .001, 20, 50), OK);
        assert_true(arena_used(r.life) == used);
        run_close(&r);
    }
}

/* A trial state that cannot be reached leaves the state as it was, also after good minor steps. */
static enum status wall(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x, unsigned cls,
                        struct trouble *why)
{
    if (x->q[1] < .9) return trouble_set(why, TROUBLE_LAW, 7, 0, x->t);
    return chain_resid(o, r, w, dk, x, cls, why);
}

static void test_failure(void **state)
{
    (void)state;
    static const struct ode2_ops ops = {.resid = wall, .mass = chain_mass, .slopes = chain_slopes};
    for (int k = 0; stepper_kinds[k]; k++) {
        struct chain chain;
        struct run r;
        double q[2] = {0, 1}, v[2] = {0, -1};
        if (stepper_kinds[k]->adaptive) continue;
        chain_open(&chain, 50, 2, 9.81);
        chain.ode.ops = &ops;
        assert_int_equal(run_open(&r, stepper_kinds[k]->name, &chain.ode, &step_defaults, q, v), OK);
        memcpy(v, r.a, sizeof v);
        assert_int_equal(run_steps(&r, .01, 20, 1), E_NUMERIC);
        assert_int_equal(r.why.code, TROUBLE_LAW);
        assert_int_equal(r.why.index, 7);
        assert_true(r.x.t == 0 && r.q[0] == 0 && r.q[1] == 1 && r.v[0] == 0 && r.v[1] == -1);
        assert_memory_equal(r.a, v, sizeof v);
        assert_int_equal(r.stepper.effort.rejected, 1);
        assert_int_equal(r.stepper.effort.majors, 0);
        assert_int_equal(run_steps(&r, .01, 3, 1), OK);
        run_close(&r);
    }
}

/* The same run twice gives the same bits. */
static void test_bits(void **state)
{
    (void)state;
    for (int k = 0; stepper_kinds[k]; k++) {
        struct run r[2];
        struct chain chain;
        chain_open(&chain, 300, 2, 9.81);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(run_open(&r[i], stepper_kinds[k]->name, &chain.ode, &step_defaults, (double[]){.3, 1},
                                      (double[]){0, .5}),
                             OK);
            assert_int_equal(run_steps(&r[i], .002, 5, 20), OK);
        }
        assert_memory_equal(r[0].q, r[1].q, 2 * sizeof(double));
        assert_memory_equal(r[0].v, r[1].v, 2 * sizeof(double));
        run_close(&r[0]);
        run_close(&r[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),       cmocka_unit_test(test_formula),   cmocka_unit_test(test_midpoint),
        cmocka_unit_test(test_fixed_point), cmocka_unit_test(test_effort),    cmocka_unit_test(test_rest),
        cmocka_unit_test(test_work),        cmocka_unit_test(test_backwards), cmocka_unit_test(test_direct),
        cmocka_unit_test(test_memory),      cmocka_unit_test(test_failure),   cmocka_unit_test(test_bits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
