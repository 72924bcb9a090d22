/* t-midpoint.c -- the implicit midpoint rule: order, what it keeps, its ledger */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

static void test_order(void **state)
{
    double order[ORDERS];
    struct step_options o = sharp();
    (void)state;
    for (o.rho_infinity = 1; o.rho_infinity > -.1; o.rho_infinity -= .5) {
        single_rate_orders(order, "midpoint", &o);
        for (int i = 0; i < ORDERS; i++)
            if (!(order[i] > 1.9 && order[i] < 2.1))
                fail_msg("system %d, rho %g: order %g", i, o.rho_infinity, order[i]);
    }
}

/* One step against the closed form: the Cayley transform of the first-order system. */
static void test_formula(void **state)
{
    (void)state;
    struct linear s;
    double w2 = 9, h = .2, q = 1, v = -.5, x = h * h / 4 * w2;
    struct step_options o = sharp();
    struct run r;
    linear_open(&s, 1, 0);
    s.M[0][0] = 1;
    s.K[0][0] = w2;
    assert_int_equal(run_open(&r, "midpoint", &s.ode, &o, &q, &v), OK);
    assert_int_equal(run_steps(&r, h, 1, 1), OK);
    assert_true(fabs(r.q[0] - ((1 - x) * q + h * v) / (1 + x)) < 1e-15);
    assert_true(fabs(r.v[0] - ((1 - x) * v - h * w2 * q) / (1 + x)) < 1e-14);
    run_close(&r);
}

/* A free body: energy and momentum in space to round-off, at steps of a quarter turn. */
static void test_free_body(void **state)
{
    (void)state;
    struct carrier body;
    struct run r;
    struct step_options o = sharp();
    double q[4] = {1, 0, 0, 0}, v[3] = {.1, 6, .2}, L0[3], L[3], Ju[3];
    carrier_open(&body, 0);
    body.g = 0;
    assert_int_equal(run_open(&r, "midpoint", &body.ode, &o, q, v), OK);
    for (int i = 0; i < 3; i++) L0[i] = body.J[i] * v[i];
    double E0 = carrier_energy(&body, r.q, r.v);
    for (int k = 0; k < 500; k++) {
        assert_int_equal(run_steps(&r, .2, 1, 1), OK);
        for (int i = 0; i < 3; i++) Ju[i] = body.J[i] * r.v[i];
        turned(L, r.q, Ju);
        for (int i = 0; i < 3; i++) assert_true(fabs(L[i] - L0[i]) < 2e-10);
        assert_true(fabs(carrier_energy(&body, r.q, r.v) / E0 - 1) < 1e-12);
    }
    run_close(&r);
}

/* Linear: E1 - E0 is the work, with dampers, skew velocity terms and a load, at w h from .3 to 300. */
static void test_ledger(void **state)
{
    (void)state;
    struct dice dice = {17};
    for (int k = 0; k < 50; k++) {
        struct linear s;
        struct run r;
        struct step_options o = sharp();
        double q[5], v[5], G[25];
        int n = 5;
        linear_open(&s, n, 0);
        random_positive(s.M[0], n, n, &dice, .1, 10);
        random_positive(s.K[0], n, n, &dice, 1, 1e6);
        random_positive(s.C[0], n, n, &dice, .01, 1);
        for (int i = 0; i < 25; i++) G[i] = dice_range(&dice, -1, 1);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) s.C[0][i + j * n] += G[i + j * n] - G[j + i * n];
        for (int i = 0; i < n; i++) {
            q[i] = dice_range(&dice, -.1, .1), v[i] = dice_range(&dice, -1, 1);
            s.f[i] = dice_range(&dice, -100, 100);
        }
        s.w = 3;
        assert_int_equal(run_open(&r, "midpoint", &s.ode, &o, q, v), OK);
        double E0 = linear_energy(&s, q, v);
        assert_int_equal(run_steps(&r, .1, 3, 20), OK);
        double gap = linear_energy(&s, r.q, r.v) - E0 - r.work[POWER_DAMPER] - r.work[POWER_EXTERNAL];
        assert_true(fabs(gap) < 1e-9 * E0);
        assert_true(r.work[POWER_DAMPER] < -1e-6 * E0 && fabs(r.work[POWER_EXTERNAL]) > 1e-9 * E0);
        run_close(&r);
    }
}

/* At the program's own tolerance: the ledger still closes far below what accuracy would show, and what
 * Newton left over explains it. */
static void test_own_tolerance(void **state)
{
    (void)state;
    struct linear s;
    struct run r;
    linear_both(&s);
    memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
    s.f[0] = 5, s.w = 4;
    assert_int_equal(run_open(&r, "midpoint", &s.ode, &step_defaults, both_q, both_v), OK);
    double E0 = linear_energy(&s, r.q, r.v);
    assert_int_equal(run_steps(&r, .01, 1, 500), OK);
    double gap = linear_energy(&s, r.q, r.v) - E0 - r.work[POWER_DAMPER] - r.work[POWER_EXTERNAL];
    assert_true(fabs(gap) < 1e-7 * E0);
    run_close(&r);
}

static enum status settles_not(const struct ode2 *o, double *q1, double *v1, const struct instant *x,
                               struct trouble *why)
{
    (void)o, (void)q1, (void)v1;
    return trouble_set(why, TROUBLE_CLOSURE, 7, 0, x->tb);
}

/* A state that cannot be settled is refused, the one before stays; sub-cycled, too. */
static void test_settle(void **state)
{
    (void)state;
    static const char *const scheme[] = {"midpoint", "subcycle"};
    for (int k = 0; k < 2; k++) {
        struct linear s;
        struct run r;
        linear_both(&s);
        s.ode.settle = settles_not;
        assert_int_equal(run_open(&r, scheme[k], &s.ode, &step_defaults, both_q, both_v), OK);
        const double a[2] = {r.x.a[0], r.x.a[1]};
        assert_int_equal(run_steps(&r, .01, 2, 1), E_NUMERIC);
        assert_int_equal(r.why.code, TROUBLE_CLOSURE);
        assert_int_equal(r.why.index, 7);
        assert_memory_equal(r.q, both_q, 2 * sizeof *r.q);
        assert_memory_equal(r.v, both_v, 2 * sizeof *r.v);
        assert_memory_equal(r.x.a, a, sizeof a);
        run_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),  cmocka_unit_test(test_formula),       cmocka_unit_test(test_free_body),
        cmocka_unit_test(test_ledger), cmocka_unit_test(test_own_tolerance), cmocka_unit_test(test_settle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
