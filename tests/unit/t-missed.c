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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vibration),
        cmocka_unit_test(test_bursts),
        cmocka_unit_test(test_late),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
