/* t-fourth.c -- order 4 by composition: midpoint and subcycle, at several ratios */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

static int is_fourth(const char *what, const char *scheme, struct ode2 *ode, const double *q, const double *v, int n,
                     int majors)
{
    struct step_options o = step_defaults;
    o.newton_tolerance = 1e-14;
    o.order = 4;
    const double order = run_order(scheme, ode, &o, q, v, 1, n, majors);
    const int good = order > 3.8 && order < 4.2;
    print_message("%s %s, n = %d: order %g error %g\n", what, scheme, n, order,
                  run_error(scheme, ode, &o, q, v, 1, n, majors));
    return good;
}

static void test_order(void **state)
{
    (void)state;
    static const int ratios[] = {1, 5, 10};
    int good = 1;
    for (int k = 0; k < 3; k++) {
        struct linear s;
        struct chain chain;
        struct carrier slide;
        linear_both(&s);
        good &= is_fourth("both", k ? "subcycle" : "midpoint", &s.ode, both_q, both_v, ratios[k], 40);
        memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
        s.M[0][3] = 1, s.M[1][3] = 1, s.K[0][3] = 10, s.K[1][3] = 14, s.C[1][3] = 1;
        s.f[0] = 5, s.f[1] = -3, s.w = 4;
        good &= is_fourth("slow bodies, dampers, load", "subcycle", &s.ode, both_q, both_v, ratios[k], 40);
        chain_open(&chain, 30, 2, 9.81);
        good &= is_fourth("chain", k ? "subcycle" : "midpoint", &chain.ode, (double[]){.3, 1}, (double[]){0, .5},
                          ratios[k], 40);
        carrier_open(&slide, 1);
        good &= is_fourth("rotation", "subcycle", &slide.ode, carrier_q, carrier_v, ratios[k], 40);
    }
    assert_true(good);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
