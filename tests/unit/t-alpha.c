/* t-alpha.c -- generalized-alpha and hht: a published figure, order, damping of what is not resolved, and its ledger */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

/* Both schemes with some of their damping; the last of each has none. */
static const struct {
    const char *scheme;
    double rho, alpha, radius; /* what is left of an unresolved vibration by a step */
} way[] = {{"generalized-alpha", .9, 0, .9},
           {"generalized-alpha", .5, 0, .5},
           {"generalized-alpha", 0, 0, 0},
           {"hht", 1, -.05, .95 / 1.05},
           {"hht", 1, -1. / 3, .5},
           {"generalized-alpha", 1, 0, 1},
           {"hht", 1, 0, 1}};
enum { WAYS = sizeof way / sizeof *way, DAMPED = 5 };

static struct step_options options(int i)
{
    struct step_options o = sharp();
    o.rho_infinity = way[i].rho;
    o.alpha = way[i].alpha;
    return o;
}

static void oscillator(struct linear *s, double k, double c)
{
    linear_open(s, 1, 0);
    s->M[0][0] = 1;
    s->K[0][0] = k;
    s->C[0][0] = c;
}

/* 1 kg, 100 N/m, 1 N s/m, from 1.05 m, rest length 1 m: x(1 s) as published, to its last digit. */
static void test_published(void **state)
{
    struct linear s;
    struct run r;
    const struct step_options o = options(0);
    double q = .05, v = 0;
    (void)state;
    oscillator(&s, 100, 1);
    assert_int_equal(run_open(&r, "generalized-alpha", &s.ode, &o, &q, &v), OK);
    assert_int_equal(run_steps(&r, .01, 1, 100), OK);
    assert_true(fabs(1 + r.q[0] - 0.973382899576304) < 2e-15);
    run_close(&r);
}

static void test_order(void **state)
{
    (void)state;
    for (int k = 0; k < WAYS; k++) {
        const struct step_options o = options(k);
        double order[ORDERS];
        single_rate_orders(order, way[k].scheme, &o);
        for (int i = 0; i < ORDERS; i++)
            if (!(order[i] > 1.9 && order[i] < 2.1))
                fail_msg("%s %d, system %d: order %g", way[k].scheme, k, i, order[i]);
    }
}

/* omega h = 1e4.  Eigenvalues that are equal leave n^2 rho^n: the limit from above. */
static void test_radius(void **state)
{
    (void)state;
    for (int k = 0; k < WAYS; k++) {
        struct linear s;
        struct run r;
        const struct step_options o = options(k);
        double q = 1, v = 0, E[2];
        oscillator(&s, 1e8, 0);
        assert_int_equal(run_open(&r, way[k].scheme, &s.ode, &o, &q, &v), OK);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(run_steps(&r, 1, 1, 40), OK);
            E[i] = linear_energy(&s, r.q, r.v);
        }
        double radius = pow(E[1] / E[0], 1. / 80);
        if (!(radius >= .98 * way[k].radius && radius < 1.06 * way[k].radius + 1e-9))
            fail_msg("%s %d: %g, expected %g", way[k].scheme, k, radius, way[k].radius);
        run_close(&r);
    }
}

/* The energy of a linear system without dampers is short of what is booked as lost, to round-off, at any step. */
static void test_balance(void **state)
{
    (void)state;
    for (int k = 0; k < WAYS; k++)
        for (double h = .01; h < 2; h *= 5) {
            struct linear s;
            struct run r;
            const struct step_options o = options(k);
            linear_both(&s);
            assert_int_equal(run_open(&r, way[k].scheme, &s.ode, &o, both_q, both_v), OK);
            double E0 = linear_energy(&s, r.q, r.v);
            assert_int_equal(run_steps(&r, h, 1, 50), OK);
            double E1 = linear_energy(&s, r.q, r.v);
            if (!(fabs(E1 + r.lost - E0) < 1e-12 * E0)) fail_msg("way %d, h %g: %g of %g", k, h, E1 + r.lost - E0, E0);
            assert_true(k < DAMPED ? r.lost > 1e-7 * E0 : r.lost == 0);
            run_close(&r);
        }
}

/* Where M^ depends on the posture, too, nine tenths of what is lost are booked; the scheme of least damping has an error
 * of its order that is as large. */
static void test_balance_of_links(void **state)
{
    (void)state;
    for (int k = 1; k < DAMPED; k++) {
        struct chain chain;
        struct run r;
        const struct step_options o = options(k);
        double q[2] = {.3, 1}, v[2] = {0, .5};
        chain_open(&chain, 400, 0, 9.81);
        assert_int_equal(run_open(&r, way[k].scheme, &chain.ode, &o, q, v), OK);
        double E0 = chain_energy(&chain, r.q, r.v);
        assert_int_equal(run_steps(&r, 6.25e-4, 1, 3200), OK);
        double missed = chain_energy(&chain, r.q, r.v) + r.lost - E0;
        if (!(r.lost > 1e-3 && fabs(missed) < .1 * r.lost)) fail_msg("way %d: lost %g, missed %g", k, r.lost, missed);
        run_close(&r);
    }
}

/* Without damping hht is newmark. */
static void test_newmark(void **state)
{
    struct chain chain;
    struct run a, b;
    const struct step_options o = options(WAYS - 1);
    double q[2] = {.3, 1}, v[2] = {0, .5};
    (void)state;
    chain_open(&chain, 300, 2, 9.81);
    assert_int_equal(run_open(&a, "hht", &chain.ode, &o, q, v), OK);
    assert_int_equal(run_open(&b, "newmark", &chain.ode, &o, q, v), OK);
    assert_int_equal(run_steps(&a, .01, 5, 20), OK);
    assert_int_equal(run_steps(&b, .01, 5, 20), OK);
    for (int i = 0; i < 2; i++) assert_true(fabs(a.q[i] - b.q[i]) < 1e-12 && fabs(a.v[i] - b.v[i]) < 1e-11);
    run_close(&a);
    run_close(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published),        cmocka_unit_test(test_order),
        cmocka_unit_test(test_radius),           cmocka_unit_test(test_balance),
        cmocka_unit_test(test_balance_of_links), cmocka_unit_test(test_newmark),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
