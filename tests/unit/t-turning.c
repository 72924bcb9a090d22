/* t-turning.c -- bodies that turn freely, far in a step: the implicit schemes
 * of high order against closed forms.  Where accelerations do not depend on the
 * orientation, nothing but the rotation itself is to be found. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/opened.h"

#include <cmocka.h>

struct outcome {
    double error; /* of the angle, or of half of it [rad] */
    double steps;
};

/* A ball thrown in gravity that spins w about a skew axis, after 1 s: qw =
 * cos(w t/2). */
static struct outcome throw_ball(const char *scheme, double tolerance, double w)
{
    char text[600];
    struct opened o;
    struct outcome out;
    const double c = w / hypot(hypot(6, 10), 15);
    snprintf(text, sizeof text,
             "gravity: [0, 0, -9.81]\n"
             "bodies: {ball: {mass: 0.145, shape: {sphere: 0.037}, at: [0, 0, 0]}}\n"
             "constraints: {fly: {free: [ground, ball]}}\n"
             "initial: {fly.x_rate: 30, fly.z_rate: 10, fly.omega: [%.17g, %.17g, "
             "%.17g]}\n"
             "integrate: {scheme: %s, tolerance: %.1e, until: 1}\n"
             "output: {every: 0.5}\n",
             6 * c, 10 * c, 15 * c, scheme, tolerance);
    open_deck(&o, text);
    run(&o);
    const double size = hypot(hypot(value(&o, "ball.qx"), value(&o, "ball.qy")), value(&o, "ball.qz"));
    out.error = hypot(fabs(value(&o, "ball.qw")) - fabs(cos(w / 2)), size - fabs(sin(w / 2)));
    out.steps = (double)o.sim.stepper.effort.minors;
    arena_close(o.life);
    return out;
}

static const struct {
    const char *name;
    double order;
} schemes[] = {{"radau5", 5}, {"radau9", 9}};

static void test_spins(void **state)
{
    static const double speed[] = {3, 60, 190, 700, 2000}, tolerance[] = {1e-4, 1e-6, 1e-8, 1e-10};
    (void)state;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 5; i++)
            for (int j = 0; j < 4; j++) {
                const struct outcome x = throw_ball(schemes[k].name, tolerance[j], speed[i]);
                const double limit = 30 * tolerance[j] * (1 + speed[i] / 2);
                if (!(x.error < limit))
                    fail_msg("%s at %g, %g rad/s: off by %g", schemes[k].name, tolerance[j], speed[i], x.error);
            }
}

static void test_order(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct outcome last = throw_ball(schemes[k].name, 1e-4, 190);
        for (double tolerance = 1e-6; tolerance > 1e-9; tolerance /= 100) {
            const struct outcome x = throw_ball(schemes[k].name, tolerance, 190);
            const double order = log(last.error / x.error) / log(x.steps / last.steps);
            if (!(order > schemes[k].order - .5)) fail_msg("%s at %g: order %g", schemes[k].name, tolerance, order);
            last = x;
        }
    }
}

/* A rotor under a constant torque: 300 t + 10 t^2. */
static void test_torque(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        char text[600];
        struct opened o;
        snprintf(text, sizeof text,
                 "bodies: {rotor: {mass: 1, inertia: [0.005, 0.005, 0.01], at: [0, "
                 "0, 0]}}\n"
                 "constraints: {r: {spherical: [ground, rotor], at: [0, 0, 0]}}\n"
                 "forces: {spin: {torque: rotor, value: [0, 0, 0.2]}}\n"
                 "initial: {r.omega: [0, 0, 300]}\n"
                 "integrate: {scheme: %s, tolerance: 1.0e-8, until: 1}\n"
                 "output: {every: 0.5}\n",
                 schemes[k].name);
        open_deck(&o, text);
        run(&o);
        near(remainder(2 * atan2(value(&o, "r.qz"), value(&o, "r.qw")) - 310, 4 * acos(0)), 0, 1e-5);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spins),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_torque),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
