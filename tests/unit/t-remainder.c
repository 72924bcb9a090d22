/* t-remainder.c -- what a kept matrix leaves over is taken off where one number tells it. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include "engine/remainder.h"

static const double per[2] = {1, 10};

/* A step whose second correction is alpha times its first: what is left of the root then. */
static double left_of(struct remainder *o, double alpha, int corrections)
{
    double d[2] = {1, .3}, z[2] = {1 / (1 - alpha), .3 / (1 - alpha)};
    remainder_begin(o);
    for (int k = 0; k < corrections; k++) {
        if (k == 0) remainder_first(o, d);
        if (k == 1) remainder_second(o, d, per);
        for (int i = 0; i < 2; i++) z[i] -= d[i];
        if (k < corrections - 1)
            for (int i = 0; i < 2; i++) d[i] *= alpha;
    }
    remainder_take(o, z, d);
    return fabs(z[0]) + fabs(z[1]);
}

/* In full once the second correction is there, and after one correction by alpha's line. */
static void taken_off(void **state)
{
    struct arena *arena = arena_open();
    struct remainder o;
    (void)state;
    remainder_open(&o, 2, arena);
    assert_true(left_of(&o, .01, 1) > .01); /* nothing is known */
    assert_true(left_of(&o, .01, 2) < 1e-15);
    assert_true(left_of(&o, -.02, 3) < 1e-15);
    assert_true(left_of(&o, .03, 2) < 1e-15);
    assert_true(left_of(&o, .08, 1) < 1e-15); /* 0.05 a step */
    for (int k = 0; k < 5; k++) (void)left_of(&o, .01, 1);
    assert_true(left_of(&o, .01, 1) > .01); /* long ago */
    arena_close(arena);
}

/* Corrections that turn, as of a body that spins, are told by no number. */
static void left_alone(void **state)
{
    struct arena *arena = arena_open();
    struct remainder o;
    const double first[2] = {1, .1}, turned[2] = {.01, -.001}, large[2] = {.5, .05};
    double z[2] = {0, 0};
    (void)state;
    remainder_open(&o, 2, arena);
    remainder_begin(&o);
    remainder_first(&o, first);
    remainder_second(&o, turned, per);
    remainder_take(&o, z, turned);
    remainder_second(&o, large, per);
    remainder_take(&o, z, large);
    assert_true(z[0] == 0 && z[1] == 0);
    arena_close(arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(taken_off), cmocka_unit_test(left_alone)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
