/* t-miao.c -- the paper's sub-cycling, corrected: order where it is stable, and that it is not always */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

/* Two coordinates with little separation: the extrapolation (2-16) costs n (w_S h)^2, so order shows
 * only at small steps. */
static void test_order(void **state)
{
    (void)state;
    const int ratios[] = {1, 2, 5};
    struct step_options o = sharp();
    struct linear s;
    for (int both = 0; both < 2; both++)
        for (int k = 0; k < 3; k++) {
            linear_pair(&s, (double[]){1, .6, .6, 2}, (double[]){4, both ? -.5 : 0, both ? -.5 : 0, 2}, NULL);
            int majors = 1600 / ratios[k];
            double order = run_order("miao", &s.ode, &o, both_q, both_v, 1, ratios[k], majors);
            if (!(order > 1.85 && order < 2.4)) print_error("both %d n %d: order %g\n", both, ratios[k], order);
            assert_true(order > 1.85 && order < 2.4);
        }
}

/* A body that turns, with a particle sliding in it: the interpolation of rotations keeps the order. */
static void test_rotations(void **state)
{
    (void)state;
    struct step_options o = sharp();
    struct carrier slide;
    carrier_open(&slide, 1);
    slide.k = 20;
    double order = run_order("miao", &slide.ode, &o, carrier_q, carrier_v, .5, 2, 400);
    if (!(order > 1.85 && order < 2.3)) print_error("order %g\n", order);
    assert_true(order > 1.85 && order < 2.3);
}

/* With one minor step it is Newmark's method. */
static void test_newmark(void **state)
{
    (void)state;
    struct step_options o = sharp();
    struct chain chain;
    struct carrier slide;
    struct run a, b;
    o.beta = .3, o.gamma = .6;
    chain_open(&chain, 300, 2, 9.81);
    carrier_open(&slide, 1);
    for (int k = 0; k < 2; k++) {
        struct ode2 *ode = k ? &slide.ode : &chain.ode;
        const double *q = k ? carrier_q : both_q, *v = k ? carrier_v : both_v;
        assert_int_equal(run_open(&a, "miao", ode, &o, q, v), OK);
        assert_int_equal(run_open(&b, "newmark", ode, &o, q, v), OK);
        assert_int_equal(run_steps(&a, .01, 1, 100), OK);
        assert_int_equal(run_steps(&b, .01, 1, 100), OK);
        for (int i = 0; i < ode->nq; i++) assert_true(fabs(a.q[i] - b.q[i]) < 1e-12);
        for (int i = 0; i < ode->n; i++) assert_true(fabs(a.v[i] - b.v[i]) < 1e-11);
        for (int c = 0; c < POWER_CHANNELS; c++) assert_true(fabs(a.work[c] - b.work[c]) < 1e-10);
        run_close(&a);
        run_close(&b);
    }
}

/* One macro step written out for the pair, (C1) and (C2) solved by Cramer's rule, then the minor steps. */
static void written_out(double *q, double *v, double *a, const double *M, const double *K, double h, int n)
{
    double b = .25, H = n * h, aS = a[0], vS = v[0], qS = q[0];
    double fS = qS + h * vS + h * h * (.5 - b) * aS, fL = q[1] + H * v[1] + H * H * (.5 - b) * a[1]; /* a = 0 */
    double j11 = M[0] + b * h * h * K[0], j12 = M[2] / n + b * H * H * K[2] / n;
    double j21 = n * M[1] + n * b * h * h * K[1], j22 = M[3] + b * H * H * K[3];
    double r1 = -(M[2] * (1 - 1. / n) * a[1] + K[0] * fS + K[2] * (q[1] + (fL - q[1]) / n));
    double r2 = -(M[1] * (1 - n) * aS + K[1] * (qS + n * (fS - qS)) + K[3] * fL);
    double aL = (j11 * r2 - j21 * r1) / (j11 * j22 - j12 * j21), aS1 = (r1 - j12 * aL) / j11;
    double qL = fL + b * H * H * aL, vL = v[1] + H / 2 * (a[1] + aL);
    for (int i = 0; i < n; i++) {
        if (i > 0) {
            double s = (i + 1.) / n, star = qS + h * vS + h * h * (.5 - b) * aS;
            double aLi = (1 - s) * a[1] + s * aL, qLi = (1 - s) * q[1] + s * qL;
            aS1 = -(M[2] * aLi + K[0] * star + K[2] * qLi) / j11;
        }
        qS += h * vS + h * h * ((.5 - b) * aS + b * aS1);
        vS += h / 2 * (aS + aS1);
        aS = aS1;
    }
    q[0] = qS, v[0] = vS, a[0] = aS, q[1] = qL, v[1] = vL, a[1] = aL;
}

static void test_written_out(void **state)
{
    (void)state;
    struct step_options o = sharp();
    struct linear s;
    struct run r;
    linear_both(&s);
    assert_int_equal(run_open(&r, "miao", &s.ode, &o, both_q, both_v), OK);
    double q[2] = {both_q[0], both_q[1]}, v[2] = {both_v[0], both_v[1]}, a[2] = {r.a[0], r.a[1]};
    for (int k = 0; k < 10; k++) {
        assert_int_equal(run_steps(&r, .004, 4, 1), OK);
        written_out(q, v, a, s.M[0], s.K[0], .004, 4);
        for (int i = 0; i < 2; i++) assert_true(fabs(r.q[i] - q[i]) < 1e-11 && fabs(r.v[i] - v[i]) < 1e-10);
    }
    run_close(&r);
}

/* Inertial coupling .7, n = 5, w_S h = .5, w_L H = .25: the macro map of (q, v, a) grows, although both
 * Newmark rules alone would be unconditionally stable; that of subcycle does not. */
static void test_unstable(void **state)
{
    (void)state;
    const char *schemes[] = {"miao", "subcycle"};
    for (int k = 0; k < 2; k++) {
        struct linear s;
        struct run r;
        linear_pair(&s, (double[]){1, .7, .7, 1}, (double[]){.25, 0, 0, .0025}, NULL);
        assert_int_equal(run_open(&r, schemes[k], &s.ode, &step_defaults, both_q, both_v), OK);
        double E0 = linear_energy(&s, r.q, r.v);
        enum status status = run_steps(&r, 1, 5, 400);
        double growth = linear_energy(&s, r.q, r.v) / E0;
        if (k == 0)
            assert_true(status != OK || !(growth < 1e6));
        else
            assert_true(status == OK && growth < 1 + 1e-6);
        run_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),       cmocka_unit_test(test_rotations), cmocka_unit_test(test_newmark),
        cmocka_unit_test(test_written_out), cmocka_unit_test(test_unstable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
