/* t-missed.c -- what steps leave, summed: of a vibration what it is late by; in a new split of coordinates what it was. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine/missed.h"
#include "unit/opened.h"

#include <cmocka.h>

/* A mass on a spring, omega = 3/s, from 1 m, for 20 s; late by c (omega h)^order omega t of its size. */
static double summed(const char *integrate)
{
    struct opened o;
    char text[600];
    snprintf(text, sizeof text,
             "bodies:\n"
             "  box: {mass: 1, inertia: 1, at: [0, 0]}\n"
             "constraints:\n"
             "  slide: {prismatic: [ground, box], axis: [1, 0]}\n"
             "forces:\n"
             "  spring: {spring: slide, stiffness: 9}\n"
             "initial: {slide.displacement: 1}\n"
             "integrate: {%s, until: 20}\n"
             "output: {every: 1}\n",
             integrate);
    open_deck(&o, text);
    run(&o);
    const double x = o.sim.stepper.missed->position[0], v = o.sim.stepper.missed->velocity[0];
    near(v / x, 3, .3);
    arena_close(o.life);
    return x;
}

static void within_two(double x, double late)
{
    assert_true(x > late / 2 && x < 2 * late);
}

static void test_vibration(void **state)
{
    const double h = .01, t = 20, x = 3 * h;
    (void)state;
    within_two(summed("scheme: midpoint, step: 0.01"), x * x / 12 * 3 * t);
    within_two(summed("scheme: newmark, step: 0.01, beta: 0.25, gamma: 0.5"), x * x / 12 * 3 * t);
    within_two(summed("scheme: newmark, step: 0.01, beta: 0.25, gamma: 0.5, ratio: 5"), x * x / 12 * 3 * t);
    within_two(summed("scheme: rk4, step: 0.01"), x * x * x * x / 120 * 3 * t);
}

/* Bursts ever more apart stand for all steps: a run of many steps is summed as one of few. */
static void test_bursts(void **state)
{
    const double few = summed("scheme: midpoint, step: 0.02"), many = summed("scheme: midpoint, step: 0.0002");
    (void)state;
    near(few / many, 1e4, 2e3);
}

/* Delays of steps add up, whatever the motion is then: of (v, a), what an error along it is late by, of each coordinate's share;
 * none where the motion rests, or of what is off across it. */
static void test_late(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct missed o;
    const struct ode2 ode = {.n = 2, .nq = 2};
    const double none[2] = {0, 0}, x[2] = {2, 0}, across[2] = {0, 2}, a[2] = {-3, 0};
    const double late = 1e-3, off[2] = {2 * late, 0}, bent[2] = {-3 * late, 0};
    missed_open(&o, 2, life);
    o.steps = 1;
    missed_add(&o, &ode, off, none, none, none);
    assert_true(o.late == 0);
    o.steps = 3;
    missed_add(&o, &ode, none, bent, none, a);
    near(o.late, 2 * late, 1e-15);
    o.steps = 4;
    missed_add(&o, &ode, off, none, x, none);
    near(o.late, 3 * late, 1e-15);
    o.steps = 5;
    missed_add(&o, &ode, across, none, x, none);
    near(o.late, 3 * late, 1e-15);
    near(o.position[0], 2 * 2 * late, 1e-15);
    arena_close(life);
}

/* A burst that ends with a step over an edge is taken back, with all that it has added, and counts no more; one that ended before
 * stands. */
static void test_crossed(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    for (int n = 1; n <= 2; n++) {
        struct missed o, was;
        const struct ode2 ode = {.n = n, .nq = n};
        const double x[2] = {-2e-6, 5e-6}, v[2] = {3e-6, 7e-6}, rate[2] = {1, 2}, accel[2] = {4, 5};
        missed_open(&o, n, life);
        for (int burst = 1; burst <= 3; burst++) {
            double position[2] = {o.position[0], n > 1 ? o.position[1] : 0},
                   velocity[2] = {o.velocity[0], n > 1 ? o.velocity[1] : 0};
            was = o;
            o.steps = was.steps + burst;
            missed_add(&o, &ode, x, v, rate, accel);
            for (int i = 0; i < n; i++) {
                near(o.position[i], position[i] + burst * fabs(x[i]), 1e-18);
                near(o.velocity[i], velocity[i] + burst * fabs(v[i]), 1e-18);
            }
            near(o.signed_position, was.signed_position + (n == 1 ? burst * x[0] : 0), 1e-18);
            near(o.signed_velocity, was.signed_velocity + (n == 1 ? burst * v[0] : 0), 1e-18);
            assert_true(o.told == o.steps && o.next >= o.steps && o.late != was.late);
            if (burst == 2) { /* taken back, all of it */
                missed_crossed(&o);
                for (int i = 0; i < n; i++) assert_true(o.position[i] == position[i] && o.velocity[i] == velocity[i]);
                assert_true(o.signed_position == was.signed_position && o.signed_velocity == was.signed_velocity);
                assert_true(o.late == was.late && o.told == was.told && o.next == was.next);
                o.steps = was.steps;
            }
        }
        const long told = o.told;
        o.steps++;
        o.seen = 1;
        was = o;
        missed_crossed(&o); /* its burst had ended a step ago */
        assert_true(o.seen == 0 && o.told == told && o.position[0] == was.position[0] && o.late == was.late);
        o.steps = o.next + 33;
        o.seen = 1;
        missed_crossed(&o); /* long overdue: edges at every step must not put it off for ever */
        assert_int_equal(o.seen, 1);
    }
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vibration),
        cmocka_unit_test(test_bursts),
        cmocka_unit_test(test_late),
        cmocka_unit_test(test_crossed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
