/* t-relay.c -- schemes that take turns: who does, at what work, beside closed forms */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/relay.h"
#include "unit/oscillators.h"

#include <cmocka.h>

enum { FIFTH, EIGHTH, IMPLICIT };
static const double end = 20;

/* A run to the end, by relay or by that scheme. */
static void go(struct run *r, struct linear *s, const char *name, const struct step_options *how, const double *q,
               const double *v)
{
    assert_int_equal(run_open(r, "dopri5", &s->ode, how, q, v), OK);
    stepper_open(&r->stepper, name ? stepper_find(name) : &step_relay, &s->ode, how, r->life);
    assert_int_equal(run_steps(r, 0, 1, 0), OK);
    assert_int_equal(stepper_step(&r->stepper, &r->x, 0, 1, end, &r->why), OK);
    assert_true(r->x.t == end);
}

static struct step_options options(double tolerance)
{
    struct step_options o = step_defaults;
    o.tolerance = tolerance;
    o.until = end;
    o.matrix = 1e-3;
    return o;
}

/* Evaluations of that scheme for all of it. */
static long alone(struct linear *s, const char *name, double tolerance, const double *q, const double *v)
{
    struct run r;
    const struct step_options o = options(tolerance);
    go(&r, s, name, &o, q, v);
    const long work = r.stepper.effort.slow;
    run_close(&r);
    return work;
}

/* q1'' + 200 q1' + 200 q1 = 0, which is quick at first and then all but still; q2 swings as cos 2 t. */
static void test_dies_away(void **state)
{
    static const double q[] = {1, 1}, v[] = {0, 0}, tolerance = 1e-5;
    const double root = sqrt(100 * 100 - 200), quick = -100 - root, slow = -100 + root;
    const struct step_options o = options(tolerance);
    struct linear s;
    struct run r;
    (void)state;
    linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){200, 0, 0, 4}, (double[]){200, 0, 0, 0});
    const long order5 = alone(&s, "dopri5", tolerance, q, v), order8 = alone(&s, "dop853", tolerance, q, v),
               implicit = alone(&s, "radau9", tolerance, q, v);
    go(&r, &s, NULL, &o, q, v);
    const long work = r.stepper.effort.slow;
    if (!(work < 1.25 * (double)implicit)) print_error("%ld for %ld %ld %ld\n", work, order5, order8, implicit);
    assert_true(3 * implicit < order8 && 3 * implicit < order5);
    assert_true(work < 1.25 * (double)implicit);
    assert_true(relay_steps(&r.stepper, FIFTH) > 3 && relay_steps(&r.stepper, IMPLICIT) > 20);
    assert_int_equal(relay_steps(&r.stepper, FIFTH) + relay_steps(&r.stepper, EIGHTH) +
                         relay_steps(&r.stepper, IMPLICIT),
                     r.stepper.effort.minors);
    assert_true(fabs(r.q[0] - quick / (quick - slow) * exp(slow * end)) < 10 * tolerance);
    assert_true(fabs(r.q[1] - cos(2 * end)) < 10 * tolerance && fabs(r.v[1] + 2 * sin(2 * end)) < 20 * tolerance);
    run_close(&r);
}

/* What swings alone, and linear equations are solved by the implicit one at once: as little work as by the best, or little more. */
static void test_swings(void **state)
{
    static const double q[] = {1, .1}, v[] = {0, 0};
    (void)state;
    for (int k = 0; k < 2; k++) {
        const double tolerance = k ? 1e-8 : 1e-4;
        const struct step_options o = options(tolerance);
        struct linear s;
        struct run r;
        linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){9, 0, 0, 400}, NULL);
        const long order5 = alone(&s, "dopri5", tolerance, q, v), order8 = alone(&s, "dop853", tolerance, q, v),
                   implicit = alone(&s, "radau9", tolerance, q, v);
        const long best = implicit < order8 ? implicit : order8;
        assert_true(best < order5);
        go(&r, &s, NULL, &o, q, v);
        const long work = r.stepper.effort.slow;
        if (!(work < 1.1 * (double)best)) print_error("%ld for %ld %ld %ld\n", work, order5, order8, implicit);
        assert_true(work < 1.1 * (double)best);
        assert_true((relay_steps(&r.stepper, FIFTH) == 0) == (k == 1)); /* it does not look back at records there */
        assert_true(fabs(r.q[0] - cos(3 * end)) < 20 * tolerance && fabs(r.q[1] - .1 * cos(20 * end)) < 20 * tolerance);
        run_close(&r);
    }
}

/* Without a price of matrices there are none; where something stiff is at rest the implicit one begins. */
static void test_who(void **state)
{
    static const double q[] = {0, 1}, v[] = {0, 0};
    struct step_options o = options(1e-4);
    struct linear s;
    struct run r;
    (void)state;
    assert_string_equal(relay_name(&o, FIFTH), "dopri5");
    assert_string_equal(relay_name(&o, EIGHTH), "dop853");
    assert_string_equal(relay_name(&o, IMPLICIT), "radau9");
    assert_true(relay_has(stepper_find("radau9")) && !relay_has(stepper_find("radau5")));
    linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){1e8, 0, 0, 1}, NULL);
    o.gain = 1e-5;
    go(&r, &s, NULL, &o, q, v);
    assert_int_equal(relay_steps(&r.stepper, FIFTH) + relay_steps(&r.stepper, EIGHTH), 0);
    assert_true(fabs(r.q[1] - cos(end)) < 1e-3);
    run_close(&r);
    o.matrix = 0;
    linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){9, 0, 0, 1}, NULL);
    assert_null(relay_name(&o, IMPLICIT));
    go(&r, &s, NULL, &o, q, v);
    assert_true(relay_steps(&r.stepper, FIFTH) > 0);
    assert_int_equal(relay_steps(&r.stepper, IMPLICIT) + r.stepper.effort.factors, 0);
    run_close(&r);
    o.bends = 1; /* order 8 does not follow it, and is taken where there is no other */
    assert_null(relay_name(&o, EIGHTH));
    go(&r, &s, NULL, &o, q, v);
    assert_true(relay_steps(&r.stepper, FIFTH) > 0 && relay_steps(&r.stepper, FIFTH) == r.stepper.effort.minors);
    run_close(&r);
    o.tolerance = 1e-7;
    assert_null(relay_name(&o, FIFTH));
    assert_string_equal(relay_name(&o, EIGHTH), "dop853");
}

/* A first step that is known saves those that grow up to it; one that is too long is given up once or twice. */
static void test_first(void **state)
{
    static const double q[] = {1, .1}, v[] = {0, 0}, tolerance = 1e-4;
    static const double first[] = {0, .05, 1};
    long work[3];
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct step_options o = options(tolerance);
        struct linear s;
        struct run r;
        o.first = first[k];
        o.matrix = 0;
        linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){1, 0, 0, 4}, NULL);
        assert_int_equal(run_open(&r, "dopri5", &s.ode, &o, q, v), OK);
        stepper_open(&r.stepper, &step_relay, &s.ode, &o, r.life);
        assert_int_equal(run_steps(&r, 0, 1, 0), OK);
        assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, .5, &r.why), OK);
        work[k] = r.stepper.effort.slow;
        assert_true(fabs(r.q[0] - cos(.5)) < tolerance && fabs(r.q[1] - .1 * cos(1)) < tolerance);
        run_close(&r);
    }
    assert_in_range(work[1] + 12, 0, work[0]);
    assert_in_range(work[2], 0, work[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_dies_away),
        cmocka_unit_test(test_swings),
        cmocka_unit_test(test_who),
        cmocka_unit_test(test_first),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
