/* t-explicit.c -- rk4, dopri5, dop853, radau5, radau9: order on known solutions, also with rotations; error control; landing */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

/* q = cos(3 t), both coordinates turned by a shear: known in closed form. */
static void oscillator(struct linear *s)
{
    /* M = A'A, K = A' diag(9, 400) A with A = [1 .5; 0 1]: normal coordinates p = A q */
    linear_pair(s, (double[]){1, .5, .5, 1.25}, (double[]){9, 4.5, 4.5, 402.25}, NULL);
}

static double oscillator_error(const struct run *r, double t)
{
    double p0 = cos(3 * t), p1 = .1 * cos(20 * t), v0 = -3 * sin(3 * t), v1 = -2 * sin(20 * t);
    double e[4] = {r->q[0] + .5 * r->q[1] - p0, r->q[1] - p1, r->v[0] + .5 * r->v[1] - v0, r->v[1] - v1};
    double worst = 0;
    for (int i = 0; i < 4; i++) worst = fmax(worst, fabs(e[i]));
    return worst;
}

static const double start_q[2] = {1 - .05, .1}, start_v[2] = {0, 0};

static void test_rk4_order(void **state)
{
    (void)state;
    struct linear s;
    double err[3];
    oscillator(&s);
    for (int k = 0; k < 3; k++) {
        struct run r;
        assert_int_equal(run_open(&r, "rk4", &s.ode, &step_defaults, start_q, start_v), OK);
        int steps = 200 << k;
        assert_int_equal(run_steps(&r, 1. / steps, steps / 10, 10), OK);
        err[k] = oscillator_error(&r, 1);
        run_close(&r);
    }
    for (int k = 0; k < 2; k++) {
        double order = log2(err[k] / err[k + 1]);
        if (!(order > 3.9 && order < 4.15)) print_error("order %g\n", order);
        assert_true(order > 3.9 && order < 4.15);
    }
    struct carrier top;
    carrier_open(&top, 1);
    double order = run_order("rk4", &top.ode, &step_defaults, carrier_q, carrier_v, 1, 5, 20);
    if (!(order > 3.85 && order < 4.15)) print_error("rotations: order %g\n", order);
    assert_true(order > 3.85 && order < 4.15);
}

/* Error against tolerance: steps grow as tol^(-1/p), the error follows down to 1e-10. */
static void test_tolerance(void **state)
{
    (void)state;
    static const struct {
        const char *scheme;
        double p;
    } of[] = {{"dopri5", 5}, {"dop853", 8}, {"radau5", 6}, {"radau9", 10}};
    for (int i = 0; i < 4; i++) {
        struct linear s;
        long steps[3];
        oscillator(&s);
        for (int k = 0; k < 3; k++) {
            struct run r;
            struct step_options o = step_defaults;
            o.tolerance = pow(10, -6 - 3 * k);
            assert_int_equal(run_open(&r, of[i].scheme, &s.ode, &o, start_q, start_v), OK);
            assert_int_equal(run_steps(&r, 2, 1, 1), OK);
            double err = oscillator_error(&r, 2);
            if (!(err < 60 * o.tolerance)) print_error("%s: %g at %g\n", of[i].scheme, err, o.tolerance);
            assert_true(err < 60 * o.tolerance);
            assert_true(k < 2 || err < 1e-10);
            assert_true(r.x.t == 2.);
            steps[k] = r.stepper.effort.minors;
            run_close(&r);
        }
        for (int k = 0; k < 2; k++) {
            double ratio = (double)steps[k + 1] / (double)steps[k], wanted = pow(1000, 1 / of[i].p);
            if (!(ratio > .75 * wanted && ratio < 1.3 * wanted))
                print_error("%s: steps %ld %ld\n", of[i].scheme, steps[k], steps[k + 1]);
            assert_true(ratio > .75 * wanted && ratio < 1.3 * wanted);
        }
    }
}

/* Against rk4 with a step a hundred times smaller: two implementations, one answer. */
static void test_rotations(void **state)
{
    (void)state;
    static const char *const scheme[] = {"dopri5", "dop853", "radau5", "radau9"};
    struct carrier top;
    struct step_options o = step_defaults;
    struct run b;
    o.tolerance = 1e-12;
    carrier_open(&top, 1);
    assert_int_equal(run_open(&b, "rk4", &top.ode, &o, carrier_q, carrier_v), OK);
    double E0 = carrier_energy(&top, b.q, b.v);
    assert_int_equal(run_steps(&b, 1e-4, 100, 200), OK);
    for (int k = 0; k < 4; k++) {
        struct run a;
        assert_int_equal(run_open(&a, scheme[k], &top.ode, &o, carrier_q, carrier_v), OK);
        assert_int_equal(run_steps(&a, 1, 1, 2), OK);
        for (int i = 0; i < 5; i++) assert_true(fabs(a.q[i] - b.q[i]) < 1e-10);
        for (int i = 0; i < 4; i++) assert_true(fabs(a.v[i] - b.v[i]) < 1e-9);
        assert_true(fabs(carrier_energy(&top, a.q, a.v) / E0 - 1) < 1e-10);
        run_close(&a);
    }
    run_close(&b);
}

/* The balance with the method's own weights: both close the ledger to their order. */
static void test_work(void **state)
{
    (void)state;
    const char *schemes[] = {"rk4", "dopri5", "dop853", "radau5", "radau9"};
    for (int k = 0; k < 5; k++) {
        struct linear s;
        struct run r;
        struct step_options o = step_defaults;
        o.tolerance = 1e-10;
        linear_both(&s);
        memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
        s.f[0] = 5, s.w = 4;
        assert_int_equal(run_open(&r, schemes[k], &s.ode, &o, both_q, both_v), OK);
        double E0 = linear_energy(&s, r.q, r.v);
        assert_int_equal(run_steps(&r, .0005, 10, 200), OK);
        double gap = linear_energy(&s, r.q, r.v) - E0 - r.work[POWER_DAMPER] - r.work[POWER_EXTERNAL];
        assert_true(fabs(gap) < 1e-8 && r.work[POWER_DAMPER] < -1);
        run_close(&r);
    }
}

/* ---- a load that starts at t = .35: a kink in time that is announced */

static enum status late_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                              unsigned cls, struct trouble *why)
{
    TRY(linear_resid(o, r, w, dk, x, cls, why));
    if (x->t > .35) r[0] -= 100 * (x->t - .35); /* the slope jumps */
    return OK;
}

static double late_next(const struct ode2 *o, double t)
{
    (void)o;
    return t < .35 ? .35 : INFINITY;
}

static void test_breaks(void **state)
{
    (void)state;
    static const struct ode2_ops ops = {.resid = late_resid, .mass = linear_mass, .slopes = linear_slopes};
    static const struct ode2_breaks breaks = {.next = late_next};
    long rejected[2];
    for (int told = 0; told < 2; told++) {
        struct linear s;
        struct run r;
        struct step_options o = step_defaults;
        double q = 0, v = 0;
        o.tolerance = 1e-11;
        linear_open(&s, 1, 0);
        s.M[0][0] = 1;
        s.ode.ops = &ops;
        if (told) s.ode.breaks = &breaks;
        assert_int_equal(run_open(&r, "dopri5", &s.ode, &o, &q, &v), OK);
        assert_int_equal(run_steps(&r, 1, 1, 1), OK);
        assert_true(fabs(r.v[0] - 50 * .65 * .65) < 1e-9); /* v = 100 (t-.35)^2/2, q = 100 (t-.35)^3/6 */
        assert_true(fabs(r.q[0] - 100. / 6 * .65 * .65 * .65) < 1e-9);
        rejected[told] = r.stepper.effort.rejected;
        run_close(&r);
    }
    assert_true(rejected[1] == 0 && rejected[0] > 0);
}

static enum status jumps_not(const struct ode2 *o, int *met, double *v, double *work, const double *q, double ta,
                             double tb, struct trouble *why)
{
    (void)o, (void)v, (void)work, (void)q, (void)tb;
    *met = 1;
    return trouble_set(why, TROUBLE_MASS, 0, 0, ta);
}

static double no_next(const struct ode2 *o, double t)
{
    (void)o, (void)t;
    return INFINITY;
}

static double corner_at_once(const struct ode2 *o, double ta, double tb)
{
    (void)o, (void)tb;
    return ta;
}

/* An impulse that cannot be found is not left out. */
static void test_jump_fails(void **state)
{
    (void)state;
    static const struct ode2_breaks breaks = {.next = no_next, .jump = jumps_not, .corner = corner_at_once};
    static const char *const scheme[] = {"dopri5", "rk4", "newmark"};
    for (int k = 0; k < 3; k++) {
        struct linear s;
        struct run r;
        double q = 1, v = 2;
        linear_open(&s, 1, 0);
        s.M[0][0] = s.K[0][0] = 1;
        s.ode.breaks = &breaks;
        assert_int_equal(run_open(&r, scheme[k], &s.ode, &step_defaults, &q, &v), OK);
        assert_int_equal(run_steps(&r, .1, 1, 1), E_NUMERIC);
        assert_int_equal(r.why.code, TROUBLE_MASS);
        assert_true(r.q[0] == 1 && r.v[0] == 2 && r.x.t == 0);
        run_close(&r);
    }
}

/* A singularity that cannot be passed is reported, the state kept. */
static enum status pole_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                              unsigned cls, struct trouble *why)
{
    TRY(linear_resid(o, r, w, dk, x, cls, why));
    r[0] += 1 / (x->q[0] * x->q[0] * x->q[0]);
    return OK;
}

static void test_pole(void **state)
{
    (void)state;
    static const struct ode2_ops ops = {.resid = pole_resid, .mass = linear_mass, .slopes = linear_slopes};
    struct linear s;
    struct run r;
    double q = 1, v = -1;
    linear_open(&s, 1, 0);
    s.M[0][0] = 1;
    s.ode.ops = &ops;
    assert_int_equal(run_open(&r, "dopri5", &s.ode, &step_defaults, &q, &v), OK);
    assert_int_equal(run_steps(&r, 10, 1, 1), E_NUMERIC);
    assert_int_equal(r.why.code, TROUBLE_TOO_SMALL);
    assert_true(r.q[0] == 1 && r.v[0] == -1 && r.x.t == 0);
    run_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rk4_order),  cmocka_unit_test(test_tolerance), cmocka_unit_test(test_rotations),
        cmocka_unit_test(test_work),       cmocka_unit_test(test_breaks),    cmocka_unit_test(test_pole),
        cmocka_unit_test(test_jump_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
