/* t-works.c -- works of drives, loads and dampers are held by the tolerance where the motion asks for no small steps. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/opened.h"

#include <cmocka.h>

static const char *const schemes[] = {"dopri5", "dop853", "radau5", "radau9"};
enum { SCHEMES = sizeof schemes / sizeof *schemes };

/* A wheel that is driven, and a ball that sets the steps; what acts on both, and the drive. */
static void run_wheel(struct opened *o, const char *rest, const char *scheme, double tolerance)
{
    char text[1000];
    snprintf(text, sizeof text,
             "bodies:\n"
             "  wheel: {mass: 1, inertia: 0.1, at: [0, 0]}\n"
             "  ball: {mass: 1, at: [2, 0], inertia: 0.1}\n"
             "constraints:\n"
             "  shaft: {revolute: [ground, wheel], at: [0, 0]}\n"
             "  slide: {prismatic: [ground, ball], axis: [0, 1]}\n"
             "%s"
             "integrate: {scheme: %s, tolerance: %.1e, until: 5}\n"
             "output: {every: 1}\n",
             rest, scheme, tolerance);
    open_deck(o, text);
    run(o);
}

static const double tolerances[] = {1e-4, 1e-7}; /* of every step: hundreds of these add up */

/* -5 sin^2(100 t) on a wheel that turns with 10 rad/s. */
static void test_load(void **state)
{
    const double exact = -50 * (2.5 - sin(1000) / 400);
    (void)state;
    for (int k = 0; k < 2 * SCHEMES; k++) {
        struct opened o;
        const double within = 300 * tolerances[k % 2] * fabs(exact);
        run_wheel(&o,
                  "gravity: [0, -9.81]\n"
                  "drives: {spin: {drive: shaft, value: 10*t}}\n"
                  "forces: {load: {torque: wheel, value: \"-5*sin(100*t)^2\"}}\n",
                  schemes[k / 2], tolerances[k % 2]);
        near(value(&o, "energy.external"), exact, within);
        near(value(&o, "energy.drive"), -exact, within);
        arena_close(o.life);
    }
}

/* A damper on a wheel that is driven to and fro. */
static void test_damper(void **state)
{
    const double exact = -18 * (2.5 + sin(600) / 240);
    (void)state;
    for (int k = 0; k < 2 * SCHEMES; k++) {
        struct opened o;
        run_wheel(&o,
                  "drives: {spin: {drive: shaft, value: \"0.1*sin(60*t)\"}}\n"
                  "forces: {brake: {damper: shaft, damping: 0.5}, s: {spring: slide, stiffness: 1}}\n"
                  "initial: {slide.displacement: 1}\n",
                  schemes[k / 2], tolerances[k % 2]);
        near(value(&o, "energy.damper"), exact, 30 * tolerances[k % 2] * fabs(exact));
        assert_true(o.sim.ledger.worst < 100 * tolerances[k % 2] * o.sim.ledger.norm);
        arena_close(o.life);
    }
}

/* Works that are round-off ask for no steps: a wheel that turns with a constant speed. */
static void test_round_off(void **state)
{
    (void)state;
    for (int k = 0; k < 2 * SCHEMES; k++) {
        struct opened o;
        run_wheel(&o, "drives: {spin: {drive: shaft, value: 31.7*t}}\n", schemes[k / 2], tolerances[k % 2] * 1e-3);
        assert_true(o.sim.stepper.effort.minors + o.sim.stepper.effort.rejected < 40);
        arena_close(o.life);
    }
}

/* Van der Pol: within a hundredth of a second from record to record 36 kJ come and go.  The balance is measured against
 * them, whether a scheme steps onto records or over them. */
static void test_swing(void **state)
{
    const double jump = pow(4. / 3 * 200, 2) / 2; /* of the velocity that the force's impulse gives, [J] */
    (void)state;
    for (int k = 0; k < 2 * SCHEMES; k++) {
        struct opened o;
        char text[600];
        snprintf(text, sizeof text,
                 "bodies: {m: {mass: 1, inertia: 0, at: [0, 0]}}\n"
                 "constraints: {s: {prismatic: [ground, m], axis: [1, 0]}}\n"
                 "forces: {v: {force: s, value: \"200*(1-s.displacement^2)*s.displacement_rate - s.displacement\"}}\n"
                 "initial: {s.displacement: 2}\n"
                 "integrate: {scheme: %s, tolerance: %g, until: 170}\n"
                 "output: {every: 1}\n",
                 schemes[k / 2], k % 2 ? 1e-3 : 1e-5);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "s.displacement"), -1.9729, 1e-3);
        assert_true(o.sim.ledger.norm > .8 * jump && o.sim.ledger.norm < 2.2 * jump);
        assert_true(ledger_share(&o.sim.ledger) < 1e-4);
        arena_close(o.life);
    }
}

/* Forces so small that the squares of their works are 0: next to nothing, and a spring's bump far away. */
static void test_tiny(void **state)
{
    static const char *const force[] = {"1.0e-170*sin(10*t)", "-3000*exp(-((slide.displacement - 1)/0.05)^2)"};
    (void)state;
    for (int k = 0; k < 2 * SCHEMES; k++) {
        struct opened o;
        char rest[300];
        snprintf(rest, sizeof rest,
                 "forces: {f: {force: slide, value: \"%s\"}}\ninitial: {slide.displacement_rate: 0.01}\n",
                 force[k % 2]);
        run_wheel(&o, rest, schemes[k / 2], 1e-6);
        near(value(&o, "slide.displacement"), .05, 1e-12);
        arena_close(o.life);
    }
}

/* A ball that comes to rest on a compliant floor with a damper: all that it had, but for what it rests on.  The damper takes
 * its share with a jump where they touch, and a corner where they part, of which the motion knows nothing; trials from high
 * above end with hundreds of metres a second. */
static void test_touch(void **state)
{
    static const double each[] = {1e-4, 1e-6, 1e-8};
    const double depth = 9.81e-5, exact = -9.81 * (.95 + depth / 2);
    (void)state;
    for (int k = 0; k < 3 * SCHEMES; k++) {
        struct opened o;
        char text[800];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\n"
                 "bodies: {ball: {mass: 1, inertia: 0.004, at: [0, 1]}}\n"
                 "constraints: {fall: {prismatic: [ground, ball], axis: [0, 1]}}\n"
                 "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, skin: {sphere: ball, radius: 0.05}}\n"
                 "contacts: {hit: {between: [skin, floor], stiffness: 1.0e+5, damping: 100}}\n"
                 "integrate: {scheme: %s, tolerance: %.1e, until: 3}\n"
                 "output: {every: 3}\n",
                 schemes[k / 3], each[k % 3]);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "energy.damper"), exact, 100 * each[k % 3] * 9.81);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_load),  cmocka_unit_test(test_damper), cmocka_unit_test(test_round_off),
        cmocka_unit_test(test_swing), cmocka_unit_test(test_tiny),   cmocka_unit_test(test_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
