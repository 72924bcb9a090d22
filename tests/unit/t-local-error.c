/* t-local-error.c -- what a step is off by, from velocities alone: the formulas of its header, by hand. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/local_error.h"

#include <cmocka.h>

static void same(double x, double want)
{
    if (!(fabs(x - want) <= 1e-14 * fabs(want))) fail_msg("%.17g is not %.17g", x, want);
}

/* Three steps of lengths 0.1, 0.3, 0.2, of two coordinates. */
static const double h[3] = {.1, .3, .2}, dv[3][2] = {{.2, -1}, {.9, 2}, {-.5, .1}}, a0[2] = {1.5, -4};

static void steps(struct local_error *o)
{
    const double c = 1. / 12;
    for (int k = 0; k < 3; k++) {
        local_error_try(o, dv[k], a0, h[k], c);
        for (int i = 0; i < 2; i++) {
            const double A0 = dv[0][i] / .1, A1 = dv[1][i] / .3, A2 = dv[2][i] / .2;
            const double j0 = (A0 - a0[i]) / .05, j1 = (A1 - A0) / .2, j2 = (A2 - A1) / .25;
            const double j[3] = {j0, j1, j2};
            same(o->position[i], c * h[k] * h[k] * h[k] * j[k]);
            const double s[3] = {j0 / .1, (j1 - j0) / .1, (j2 - j1) / .3};
            same(o->velocity[i], c * h[k] * h[k] * h[k] * s[k]);
        }
        local_error_keep(o, h[k]);
    }
}

static void by_hand(void **state)
{
    struct arena *life = arena_open();
    struct local_error o, other;
    (void)state;
    local_error_open(&o, 2, life);
    steps(&o);
    local_error_forget(&o); /* from the start again */
    steps(&o);

    /* another goes on from there */
    local_error_open(&other, 2, life);
    local_error_copy(&other, &o);
    local_error_try(&o, (double[]){1, 2}, a0, .4, 1);
    local_error_try(&other, (double[]){1, 2}, a0, .4, 1);
    for (int i = 0; i < 2; i++) {
        const double A2 = dv[2][i] / .2, A1 = dv[1][i] / .3, A3 = (i + 1) / .4, j2 = (A2 - A1) / .25,
                     j3 = (A3 - A2) / .3;
        same(o.position[i], .064 * j3);
        same(o.velocity[i], .064 * (j3 - j2) / .2);
        assert_true(other.position[i] == o.position[i] && other.velocity[i] == o.velocity[i]);
    }
    arena_close(life);
}

/* Accelerations at the end against those that the mean leads on to, of the trial and of the step that was kept. */
static void at_the_end(void **state)
{
    struct arena *life = arena_open();
    struct local_error o;
    double apart[2], position[2] = {1e-3, -2}, velocity[2] = {-5, 1e-4};
    const double a[2] = {3, 7};
    (void)state;
    local_error_open(&o, 2, life);
    local_error_try(&o, dv[0], a0, .1, 1);
    local_error_end(&o, apart, false, a, .1);
    for (int i = 0; i < 2; i++) same(apart[i], a[i] - dv[0][i] / .1 - .05 * (dv[0][i] / .1 - a0[i]) / .05);
    local_error_keep(&o, .1);
    local_error_try(&o, dv[1], a0, .3, 1);
    local_error_end(&o, apart, true, a, .1);
    for (int i = 0; i < 2; i++) same(apart[i], a[i] - dv[0][i] / .1 - .05 * (dv[0][i] / .1 - a0[i]) / .05);
    local_error_end(&o, apart, false, a, .3);
    for (int i = 0; i < 2; i++) same(apart[i], a[i] - dv[1][i] / .3 - .15 * (dv[1][i] / .3 - dv[0][i] / .1) / .2);

    /* h/6 of it in velocities, h^2/12 in positions, where that is more */
    local_error_apart(position, velocity, (double[]){-6, 12}, .5, 2);
    same(velocity[0], 5);
    same(velocity[1], 1);
    same(position[0], .125);
    same(position[1], 2);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(by_hand), cmocka_unit_test(at_the_end)};
    return cmocka_run_group_tests_name("local-error", tests, NULL, NULL);
}
