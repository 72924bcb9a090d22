/* t-daniel.c -- explicit sub-cycling by partition: as written out, its order with lumped masses, where it is stable and
 * where it is not */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

static const char *const schemes[] = {"daniel", "neal-belytschko"};

/* Lumped masses, joined by a spring: order 2 in H at a fixed ratio. */
static void test_order(void **state)
{
    (void)state;
    const int ratios[] = {1, 2, 5};
    struct step_options o = sharp();
    struct linear s;
    for (int which = 0; which < 2; which++)
        for (int k = 0; k < 3; k++) {
            linear_pair(&s, (double[]){1, 0, 0, 2}, (double[]){4, -.5, -.5, 2}, NULL);
            const double order = run_order(schemes[which], &s.ode, &o, both_q, both_v, 1, ratios[k], 800 / ratios[k]);
            if (!(order > 1.9 && order < 2.1)) print_error("%s n %d: order %g\n", schemes[which], ratios[k], order);
            assert_true(order > 1.9 && order < 2.1);
        }
}

/* Shared inertia, which neither was made for: q''_L is held over the major step, order 1. */
static void test_shared_inertia(void **state)
{
    (void)state;
    struct step_options o = sharp();
    struct linear s;
    linear_pair(&s, (double[]){1, .6, .6, 2}, (double[]){4, 0, 0, 2}, NULL);
    for (int which = 0; which < 2; which++) {
        const double order = run_order(schemes[which], &s.ode, &o, both_q, both_v, 1, 2, 800);
        if (!(order > .9 && order < 1.1)) print_error("%s: order %g\n", schemes[which], order);
        assert_true(order > .9 && order < 1.1);
    }
}

/* A body that turns: places are moved along it. */
static void test_rotations(void **state)
{
    (void)state;
    struct step_options o = sharp();
    struct carrier turn;
    carrier_open(&turn, 0);
    for (int which = 0; which < 2; which++) {
        const double order = run_order(schemes[which], &turn.ode, &o, carrier_q, carrier_v, .5, 1, 400);
        if (!(order > 1.85 && order < 2.3)) print_error("%s: order %g\n", schemes[which], order);
        assert_true(order > 1.85 && order < 2.3);
    }
}

/* A major step of the lumped pair by hand. */
static void written_out(double *q, double *v, const double *M, const double *K, double h, int n, bool straight)
{
    const double H = n * h, qL = q[1], vL = v[1], aL = -(K[1] * q[0] + K[3] * qL) / M[3];
    const double end = qL + H * vL + H * H / 2 * aL;
    double aS = -(K[0] * q[0] + K[2] * qL) / M[0];
    for (int i = 1; i <= n; i++) {
        const double s = i * h, there = straight ? qL + s / H * (end - qL) : qL + s * vL + s * s / 2 * aL;
        q[0] += h * v[0] + h * h / 2 * aS;
        const double next = -(K[0] * q[0] + K[2] * (i < n ? there : end)) / M[0];
        v[0] += h / 2 * (aS + next);
        aS = next;
    }
    q[1] = end;
    v[1] = vL + H / 2 * (aL - (K[1] * q[0] + K[3] * end) / M[3]);
}

static void test_written_out(void **state)
{
    (void)state;
    const double M[] = {1, 0, 0, 2}, K[] = {4, -.5, -.5, 2};
    struct step_options o = sharp();
    for (int which = 0; which < 2; which++) {
        struct linear s;
        struct run r;
        linear_pair(&s, M, K, NULL);
        assert_int_equal(run_open(&r, schemes[which], &s.ode, &o, both_q, both_v), OK);
        double q[] = {both_q[0], both_q[1]}, v[] = {both_v[0], both_v[1]};
        for (int k = 0; k < 10; k++) {
            assert_int_equal(run_steps(&r, .05, 4, 1), OK);
            written_out(q, v, M, K, .05, 4, which == 1);
            for (int i = 0; i < 2; i++) assert_true(fabs(r.q[i] - q[i]) < 1e-12 && fabs(r.v[i] - v[i]) < 1e-12);
        }
        run_close(&r);
    }
}

/* By what the energy of a pair with frequencies wS, wL (for h = 1) grows in so many major steps; INFINITY: beyond bounds. */
static double growth(const char *scheme, double inertia, double wS, double wL, double stiffness, int ratio, int majors)
{
    struct linear s;
    struct run r;
    const double k = stiffness * wS * wL;
    linear_pair(&s, (double[]){1, inertia, inertia, 1}, (double[]){wS * wS, k, k, wL * wL}, NULL);
    assert_int_equal(run_open(&r, scheme, &s.ode, &step_defaults, both_q, both_v), OK);
    const double before = linear_energy(&s, r.q, r.v);
    const enum status status = run_steps(&r, 1, ratio, majors);
    const double after = linear_energy(&s, r.q, r.v);
    run_close(&r);
    return status == OK && isfinite(after) ? after / before : INFINITY;
}

/* Constant velocity is stable below the limits of both parts, constant acceleration all but; above the limit of either
 * there is no bound. */
static void test_stability(void **state)
{
    (void)state;
    assert_true(growth("neal-belytschko", 0, .5, .05, .3, 5, 20000) < 2);
    assert_true(growth("daniel", 0, .5, .02, .3, 5, 1000) < 3);
    for (int which = 0; which < 2; which++) {
        assert_true(growth(schemes[which], 0, 2.1, .05, .3, 5, 1000) > 1e6);
        assert_true(growth(schemes[which], 0, .5, .42, .3, 5, 1000) > 1e6); /* w_L H = 2.1 */
    }
}

/* A band of constant velocity: w_S H near pi, each part far below its own limit. */
static void test_band(void **state)
{
    (void)state;
    double most = 0;
    for (int i = 0; i <= 100; i++) {
        const double wS = (3.14159265358979 / 20) * (.95 + .1 * i / 100);
        most = fmax(most, growth("neal-belytschko", 0, wS, .9 / 20, .9, 20, 400));
    }
    assert_true(most > 1e6);
    assert_true(growth("subcycle", 0, 3.14159265358979 / 20, .9 / 20, .9, 20, 400) < 1 + 1e-6);
}

/* Shared inertia makes both grow at small steps, where subcycle does not. */
static void test_unstable(void **state)
{
    (void)state;
    for (int which = 0; which < 2; which++) assert_true(growth(schemes[which], .7, .5, .05, 0, 5, 400) > 1e6);
    assert_true(growth("subcycle", .7, .5, .05, 0, 5, 400) < 1 + 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),       cmocka_unit_test(test_shared_inertia), cmocka_unit_test(test_rotations),
        cmocka_unit_test(test_written_out), cmocka_unit_test(test_stability),      cmocka_unit_test(test_band),
        cmocka_unit_test(test_unstable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
