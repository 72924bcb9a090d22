/* t-own-steps.c -- schemes of fixed steps under a tolerance: it is held, steps go with its root, records between steps,
 * rates of their own; what local_error.h takes a scheme to be late by */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/adaptive.h"
#include "unit/oscillators.h"

#include <cmocka.h>

/* p = A q swings as cos 3 t and 0.1 cos 20 t, with A = [1 .5; 0 1]. */
static void oscillator(struct linear *s)
{
    linear_pair(s, (double[]){1, .5, .5, 1.25}, (double[]){9, 4.5, 4.5, 402.25}, NULL);
}

static const double start_q[2] = {1 - .05, .1}, start_v[2] = {0, 0};

/* The largest error of positions in 1, of velocities in 3. */
static double off(const double *q, const double *v, double t)
{
    const double p0 = cos(3 * t), p1 = .1 * cos(20 * t), v0 = -3 * sin(3 * t), v1 = -2 * sin(20 * t);
    const double e[4] = {q[0] + .5 * q[1] - p0, q[1] - p1, (v[0] + .5 * v[1] - v0) / 3, (v[1] - v1) / 3};
    double worst = 0;
    for (int i = 0; i < 4; i++) worst = fmax(worst, fabs(e[i]));
    return worst;
}

static enum status open_tolerant(struct run *r, const struct stepper_kind *kind, struct ode2 *ode, double tolerance,
                                 const double *q, const double *v)
{
    struct step_options o = step_defaults;
    o.tolerance = tolerance;
    const enum status status = run_open(r, kind->name, ode, &o, q, v);
    stepper_open(&r->stepper, kind->tolerant, ode, &o, r->life);
    return status;
}

static void test_held(void **state)
{
    const double periods = 2 * 20 / 6.3;
    int kinds = 0;
    (void)state;
    for (int i = 0; stepper_kinds[i]; i++) {
        const struct stepper_kind *kind = stepper_kinds[i];
        long steps[3] = {0};
        if (!kind->tolerant) continue;
        kinds++;
        for (int k = 0; k < 3; k++) {
            struct linear s;
            struct run r;
            const double tolerance = pow(10, -2 - k);
            oscillator(&s);
            assert_int_equal(open_tolerant(&r, kind, &s.ode, tolerance, start_q, start_v), OK);
            assert_int_equal(run_steps(&r, 0, 1, 0), OK);
            assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, 2, &r.why), OK);
            const double err = off(r.q, r.v, 2);
            if (!(err < 10 * tolerance * periods)) print_error("%s: %g at %g\n", kind->name, err, tolerance);
            assert_true(err > 0 && err < 10 * tolerance * periods);
            assert_true(r.x.t == 2.);
            steps[k] = r.stepper.effort.minors;
            run_close(&r);
        }
        for (int k = 0; k < 2; k++) {
            const double ratio = (double)steps[k + 1] / (double)steps[k], wanted = pow(10, 1. / kind->order);
            if (!(ratio > .7 * wanted && ratio < 1.4 * wanted))
                print_error("%s: steps %ld, %ld\n", kind->name, steps[k], steps[k + 1]);
            assert_true(ratio > .7 * wanted && ratio < 1.4 * wanted);
        }
    }
    assert_int_equal(kinds, 6);
}

/* Step by step, and between the ends: as close as at them. */
static void test_between(void **state)
{
    int kinds = 0;
    (void)state;
    for (int i = 0; stepper_kinds[i]; i++) {
        struct linear s;
        struct run r;
        const double tolerance = 1e-4;
        double ends = 0, inside = 0;
        oscillator(&s);
        if (!stepper_kinds[i]->tolerant) continue;
        assert_int_equal(open_tolerant(&r, stepper_kinds[i], &s.ode, tolerance, start_q, start_v), OK);
        r.stepper.natural = adaptive_interpolates(&r.stepper);
        for (double t = 0; r.stepper.natural && r.x.t < 2; t = r.x.t) {
            double q[2], v[2];
            assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, 2, &r.why), OK);
            assert_true(r.x.t > t);
            ends = fmax(ends, off(r.q, r.v, r.x.t));
            for (int k = 1; k < 4; k++) {
                const double at = t + (r.x.t - t) * k / 4;
                adaptive_between(&r.stepper, q, v, at);
                inside = fmax(inside, off(q, v, at));
            }
        }
        if (!(inside < 2 * ends + tolerance)) print_error("%s: %g, %g\n", stepper_kinds[i]->name, ends, inside);
        assert_true(inside < 2 * ends + tolerance);
        kinds += r.stepper.natural;
        run_close(&r);
    }
    assert_int_equal(kinds, 5); /* subcycle steps onto its records */
}

/* A vibration of 1 rad/s after 1 period of fixed steps: late by (omega h)^2 late() of its phase. */
static void test_late(void **state)
{
    (void)state;
    for (int i = 0; stepper_kinds[i]; i++) {
        struct linear s;
        struct run r;
        struct step_options o = step_defaults;
        if (!stepper_kinds[i]->tolerant || stepper_kinds[i]->order != 2) continue;
        for (int k = 0; k < 3; k++) {
            const int n = 400;
            const double h = 2 * acos(-1) / n;
            o.rho_infinity = 1 - .4 * k;
            o.alpha = -.1 * k;
            o.tolerance = 0;
            o.newton_tolerance = 1e-13;
            linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){1, 0, 0, 1}, NULL);
            assert_int_equal(run_open(&r, stepper_kinds[i]->name, &s.ode, &o, (double[]){1, 1}, (double[]){0, 0}), OK);
            assert_int_equal(run_steps(&r, h, 1, n), OK);
            const double late = atan2(r.v[1], r.q[1]) / (n * h * h * h), said = stepper_kinds[i]->late(&o);
            run_close(&r);
            if (stepper_kinds[i]->two_rates && k > 0) continue; /* its damping is another matter */
            if (!(fabs(late - said) < .01 * said)) print_error("%s: %g, %g\n", stepper_kinds[i]->name, late, said);
            assert_true(fabs(late - said) < .01 * said);
        }
    }
}

/* A stiff vibration that is plucked beside a slow one: many minor steps in a major one, and fewer where it is at rest. */
static void test_rates(void **state)
{
    double ratio[2];
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct linear s;
        struct run r;
        linear_pair(&s, (double[]){.01, 0, 0, 1}, (double[]){100, 0, 0, 4}, NULL);
        assert_int_equal(
            open_tolerant(&r, stepper_find("subcycle"), &s.ode, 1e-2, (double[]){k ? 0 : .1, 1}, (double[]){0, 0}), OK);
        assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, 1, &r.why), OK);
        assert_true(fabs(r.q[1] - cos(2)) < 5e-2);
        ratio[k] = (double)r.stepper.effort.fast / (double)r.stepper.effort.slow;
        run_close(&r);
    }
    if (!(ratio[0] > 10 && ratio[1] < 3)) print_error("ratios %g, %g\n", ratio[0], ratio[1]);
    assert_true(ratio[0] > 10 && ratio[1] < 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_held),
        cmocka_unit_test(test_between),
        cmocka_unit_test(test_late),
        cmocka_unit_test(test_rates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
