/* t-turned.c -- cosine and sine of angles against those of long numbers */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "la/turned.h"

#include <cmocka.h>

static const long double PI = 3.141592653589793238462643383279502884L;

static void test_points(void **state)
{
    (void)state;
    for (int i = 0; i < CIRCLE; i++) {
        const long double x = 2 * PI * i / CIRCLE;
        assert_true(fabsl(circle[i][0] - cosl(x)) < 0x1.01p-54L && fabsl(circle[i][1] - sinl(x)) < 0x1.01p-54L);
    }
    assert_true(fabsl(2 * PI / CIRCLE - CIRCLE_HEAD - CIRCLE_REST) < 1e-20L &&
                fabsl(CIRCLE / (2 * PI) - CIRCLE_PER) < 1e-14L);
    assert_true(ldexp(CIRCLE_HEAD, 38) == floor(ldexp(CIRCLE_HEAD, 38)));
}

static void good(double x)
{
    double s, c;
    turned(x, &s, &c);
    const double off = (double)fmaxl(fabsl(s - sinl(x)), fabsl(c - cosl(x)));
    if (!(off < 1.2e-16)) print_error("x %.17g: off by %g\n", x, off);
    assert_true(off < 1.2e-16);
}

static void test_angles(void **state)
{
    (void)state;
    uint64_t roll = 1;
    for (int i = 0; i < 2000000; i++) {
        roll = roll * 6364136223846793005u + 1442695040888963407u;
        const double u = (double)(roll >> 11) * 0x1p-53 - .5;
        good(u * ldexp(1, i % 17));
    }
    for (int k = -3000; k <= 3000; k++)
        for (int d = -1; d <= 1; d++) good((double)(PI * k / 256) + d * 1e-9);
    good(3e4), good(-1e9), good(1e300);
}

/* Small sines keep their digits, mirrored angles are mirrored. */
static void test_small(void **state)
{
    (void)state;
    double s, c, t, d;
    turned(0, &s, &c);
    assert_true(s == 0 && c == 1);
    for (double x = 1; x > 1e-300; x /= 3) {
        turned(x, &s, &c);
        turned(-x, &t, &d);
        assert_true(t == -s && d == c && fabs(s / sin(x) - 1) < 4e-16);
    }
    turned(INFINITY, &s, &c);
    turned(NAN, &t, &d);
    assert_true(isnan(s) && isnan(c) && isnan(t) && isnan(d));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_points), cmocka_unit_test(test_angles),
                                       cmocka_unit_test(test_small)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
