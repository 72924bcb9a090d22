/* t-known.c -- drives of coordinates that no other row of the loops reads: motion that is known, not solved for. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/rides.h"

#include <cmocka.h>

static const char *const schemes[] = {"newmark", "midpoint", "subcycle", "miao", "rk4", "dopri5"};
enum { SCHEMES = sizeof schemes / sizeof *schemes };

static const char *const columns[] = {"rail.displacement",
                                      "rail.displacement_rate",
                                      "rail.displacement_accel",
                                      "hub.angle",
                                      "hub.angle_rate",
                                      "hub.angle_accel",
                                      "pin.angle",
                                      "pin.angle_accel",
                                      "move.force",
                                      "move.power",
                                      "spin.force",
                                      "energy.drive",
                                      "energy.residual"};
enum { COLUMNS = sizeof columns / sizeof *columns };

/* A trolley, an arm on it, both driven, a load on the arm; beside them, or not, an idle four-bar. */
static void crane(struct ride *r, const char *scheme, bool adaptive, bool beside)
{
    char text[4000];
    int at = snprintf(text, sizeof text,
                      "fmdsub: 1\ngravity: [0, -9.81]\nbodies:\n"
                      "  trolley: {mass: 3, inertia: 1, at: [0, 0]}\n"
                      "  arm: {mass: 2, inertia: 0.3, at: [0, -0.5]}\n"
                      "  load: {mass: 1, inertia: 0.1, at: [0, -1.5]}\n%s"
                      "constraints:\n"
                      "  rail: {prismatic: [ground, trolley], at: [0, 0], axis: [1, 0]}\n"
                      "  hub: {revolute: [trolley, arm], at: [0, 0]}\n"
                      "  pin: {revolute: [arm, load], at: [0, -1]}\n%s"
                      "drives:\n  move: {drive: rail, value: 0.3*sin(2*t)}\n  spin: {drive: hub, value: t^2}\n"
                      "partition: {fast: [pin]}\nenergy: {delta: 1}\n"
                      "integrate: {scheme: %s, %s, until: 1}\n"
                      "output:\n  every: 0.1\n  columns: [",
                      beside ? "  b1: {mass: 1, inertia: 1, at: [10, 0]}\n  b2: {mass: 1, inertia: 1, at: [11, 1]}\n"
                               "  b3: {mass: 1, inertia: 1, at: [12, 0]}\n"
                             : "",
                      beside ? "  k1: {revolute: [ground, b1], at: [10, 0]}\n  k2: {revolute: [b1, b2], at: [10, 1]}\n"
                               "  k3: {revolute: [b2, b3], at: [12, 1]}\n  k4: {revolute: [b3, ground], at: [12, 0]}\n"
                             : "",
                      scheme, adaptive ? "tolerance: 1.0e-11" : "step: 1.0e-2, newton_tolerance: 1.0e-13");
    for (int c = 0; c < COLUMNS; c++)
        at += snprintf(text + at, sizeof text - (size_t)at, "%s%s", columns[c], c + 1 < COLUMNS ? ", " : "]\n");
    ride_open(r, text);
    if (r->status != OK) fail_msg("%s: %s", scheme, r->report.text);
}

/* They are where their drives are, to the last bit of these, and the same but for round-off where an idle four-bar beside
 * them has the equations of all loops solved; of what they act with, too. */
static void test_known(void **state)
{
    (void)state;
    for (int s = 0; s < SCHEMES; s++) {
        struct ride alone, beside;
        const bool adaptive = strcmp(schemes[s], "dopri5") == 0;
        crane(&alone, schemes[s], adaptive, false);
        crane(&beside, schemes[s], adaptive, true);
        assert_int_equal(alone.n, 11);
        assert_int_equal(beside.n, 11);
        for (int i = 0; i < alone.n; i++) {
            const double t = .1 * i;
            assert_true(fabs(ride_at(&alone, i, "hub.angle") - t * t) <= 2.3e-16);
            assert_true(fabs(ride_at(&alone, i, "rail.displacement") - .3 * sin(2 * t)) <= 1.2e-16);
            assert_true(fabs(ride_at(&alone, i, "rail.displacement_rate") - .6 * cos(2 * t)) <= 2.3e-16);
            assert_true(fabs(ride_at(&alone, i, "hub.angle_accel") - 2) <= 1e-14);
            for (int c = 0; c < COLUMNS; c++) {
                const double a = ride_at(&alone, i, columns[c]), b = ride_at(&beside, i, columns[c]);
                if (!(fabs(a - b) <= (adaptive ? 1e-7 : 1e-9) * (1 + fabs(a))))
                    fail_msg("%s: %s at %g: %.17g, %.17g", schemes[s], columns[c], t, a, b);
            }
        }
        ride_close(&alone);
        ride_close(&beside);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_known)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
