/* t-damped-mode.c -- eigenvalues of p'' + D p' + K p = 0 that are known: oscillators of all dampings, what runs away, what is
 * free, a pendulum on a turning table, flutter. */
#include "probe/damped_mode.h"

#include <math.h>

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double x, double expected)
{
    if (!(fabs(x - expected) <= 1e-12 * fmax(1, fabs(expected)))) fail_msg("%.17g, expected %.17g", x, expected);
}

static void test_one(void **state)
{
    (void)state;
    static const double cases[][4] = {
        /* K, D, omega, damping */
        {4, 0, 2, 0},
        {4, .4, 2, .1},
        {4, -.4, 2, -.1},
        {.09, .3, .3, .5},
        {2, 3, 1.4142135623730951, 1.0606601717798212}, /* s = -1, -2 */
        {1e6, 1e-4, 1000, 5e-8},
        {0, 0, 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct arena *life = arena_open();
        struct damped_mode o[1];
        assert_true(damped_modes_find(o, &cases[i][0], &cases[i][1], 1, life));
        near(o->omega, cases[i][2]);
        near(o->damping, cases[i][3]);
        arena_close(life);
    }
}

/* s = 2 and -2; s = 1 and -4; s = 0 and -3. */
static void test_real(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct damped_mode o[1];
    const double K[] = {-4, -4, 0}, D[] = {0, 3, 3};
    assert_true(damped_modes_find(o, &K[0], &D[0], 1, life));
    near(o->omega, -2);
    assert_true(damped_modes_find(o, &K[1], &D[1], 1, life));
    near(o->omega, -1);
    assert_true(damped_modes_find(o, &K[2], &D[2], 1, life));
    near(o->omega, 0);
    near(o->damping, 0);
    arena_close(life);
}

/* Foucault's pendulum on a table that turns at W: roots w -+ W with w^2 = K + W^2, on circles. */
static void test_table(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    const double W = .75, K[] = {1, 0, 0, 1}, D[] = {0, 2 * W, -2 * W, 0};
    struct damped_mode o[2];
    assert_true(damped_modes_find(o, K, D, 2, life));
    near(o[0].omega, .5);
    near(o[1].omega, 2);
    near(o[0].damping, 0);
    near(o[1].damping, 0);
    for (int i = 0; i < 2; i++) {
        const double *re = o[i].p, *im = o[i].p + 2, sign = i ? -1 : 1;
        near(re[1] - sign * im[0], 0); /* with s = i omega: s^2 p1 - 2 W s p2 + p1 = 0: p2 = -+ i p1 */
        near(im[1] + sign * re[0], 0);
        assert_true(hypot(re[0], im[0]) > 1e-3);
    }
    arena_close(life);
}

/* K = [1 -a; a 1]: s^2 = -1 -+ i a, one pair grows as the other dies away. */
static void test_flutter(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    const double a = 24. / 7, K[] = {1, a, -a, 1},
                 D[] = {0, 0, 0, 0}; /* |s|^2 = 25/7; s^2 = -1 + 24/7 i: s = (9 + ...) */
    struct damped_mode o[2];
    assert_true(damped_modes_find(o, K, D, 2, life));
    const double size = sqrt(25. / 7), part = sqrt((25. / 7 - 1) / 2) / size;
    near(o[0].omega, size);
    near(o[1].omega, size);
    near(fabs(o[0].damping), part);
    near(o[0].damping + o[1].damping, 0);
    arena_close(life);
}

/* Four that do not know of each other: in order, real ones in pairs of their own coordinates where they stand alone. */
static void test_order(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    double K[16] = {0}, D[16] = {0};
    const double k[] = {100, -4, 25, 0}, d[] = {2, 0, 0, 0}, omega[] = {-2, 0, 5, 10}, damping[] = {0, 0, 0, .1};
    struct damped_mode o[4];
    for (int i = 0; i < 4; i++) K[5 * i] = k[i], D[5 * i] = d[i];
    assert_true(damped_modes_find(o, K, D, 4, life));
    for (int i = 0; i < 4; i++) {
        if (fabs(o[i].omega - omega[i]) > 1e-6) fail_msg("mode %d: %.17g, expected %g", i, o[i].omega, omega[i]);
        if (omega[i] >= 0) near(o[i].damping, damping[i]);
    }
    assert_true(hypot(o[2].p[2], o[2].p[6]) > 1e-3 && hypot(o[2].p[0], o[2].p[4]) < 1e-9);
    assert_true(hypot(o[3].p[0], o[3].p[4]) > 1e-3 && hypot(o[3].p[2], o[3].p[6]) < 1e-9);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_one), cmocka_unit_test(test_real),
                                       cmocka_unit_test(test_table), cmocka_unit_test(test_flutter),
                                       cmocka_unit_test(test_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
