/* t-meant.c -- times are what the deck means: i times a thousandth is the double nearest to i/1000. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "out/meant.h"

/* Both ways. */
static double times(double n, double x)
{
    const struct meant m = meant_by(x), nothing = meant_by(0);
    const double t = meant_times(n, &m);
    if (t != meant_sum(&nothing, n, &m)) fail_msg("%.17g times %.17g: %.17g by division", n, x, t);
    return t;
}

/* n/q by one division, which is exact to the last bit. */
static void whole_part(void **state)
{
    static const struct {
        double x, p, q;
    } step[] = {{1e-3, 1, 1000}, {5e-4, 1, 2000},          {2.5e-4, 1, 4000}, {1e-5, 1, 1e5},   {0.01, 1, 100},
                {0.3, 3, 10},    {1e-7, 1, 1e7},           {1.25, 5, 4},      {1. / 60, 1, 60}, {1. / 3000, 1, 3000},
                {7. / 9, 7, 9},  {0.0123457, 123457, 1e7}, {3, 3, 1},         {1e-12, 1, 1e12}, {1. / 3, 1, 3}};
    (void)state;
    for (size_t i = 0; i < sizeof step / sizeof *step; i++)
        for (double n = 1; n < 3e6; n += 1 + floor(n / 50)) {
            const double t = times(n, step[i].x);
            if (t != n * step[i].p / step[i].q) fail_msg("%.17g times %.17g: %.17g", n, step[i].x, t);
        }
}

static void long_runs(void **state)
{
    (void)state;
    assert_true(times(999999999999., 1e-3) == 999999999.999);
    assert_true(times(123456789012., 1e-5) == 1234567.89012);
    assert_true(times(9, 1e-3) == 0.009);
    assert_true(times(-9, 1e-3) == -0.009);
    assert_true(times(9, -1e-3) == -0.009);
    assert_true(times(1000, 0.123456789012345) == 123.456789012345); /* 1000 p is no double any more */
    assert_true(times(1e6, 123456.789012345) == 123456789012.345);
}

/* From a start of its own. */
static void from_a_start(void **state)
{
    const struct meant start = meant_by(1.00025), step = meant_by(1e-3);
    (void)state;
    for (int i = 0; i < 100000; i++) {
        const double t = meant_sum(&start, i, &step), right = (100025 + 100. * i) / 1e5;
        if (t != right) fail_msg("%d: %.17g, not %.17g", i, t, right);
    }
}

/* A double that stands for nothing simpler is itself. */
static void no_more_than_it_is(void **state)
{
    (void)state;
    const double x[] = {0.12345678901234567, 3.1415926535897931, 1e300, 0, 1e-30, 5e-324, sqrt(2)};
    for (size_t i = 0; i < sizeof x / sizeof *x; i++) {
        const struct meant m = meant_by(x[i]);
        assert_true(m.x == x[i] && m.rest == 0);
        assert_true(times(7, x[i]) == 7 * x[i]);
    }
    assert_true(isinf(meant_by(INFINITY).x));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(whole_part), cmocka_unit_test(long_runs),
                                       cmocka_unit_test(from_a_start), cmocka_unit_test(no_more_than_it_is)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
