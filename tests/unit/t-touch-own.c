/* t-touch-own.c -- rigid contacts in steps by tolerance, and accelerations where something pushes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/touch.h"

#include <cmocka.h>

#include "unit/opened.h"

/* ---- a body turns on a point of it that slides along a plane without friction ---- */

/* With W = 1/m + (r x n) . J^-1 (r x n) the push is N = -a/W, a what the point does without it: a = -g + (J^-1 (Jw x
 * w)) x r . n + (w (w . r) - r w.w) . n; r = (.5, .5, -.1), w = (s, s, 1). */
static void on_its_point(void **state)
{
    static const double speed[] = {.7, 5};
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[800];
        const double s = speed[k], free = -9.81 - s + (s - .1) + .1 * (2 * s * s + 1), N = -free / 6;
        snprintf(text, sizeof text,
                 "space: 3d\ngravity: [0, 0, -9.81]\n"
                 "bodies: {b: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0.1], "
                 "points: {p: [0.5, 0.5, -0.1]}}}\n"
                 "constraints: {f: {free: [ground, b]}}\n"
                 "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, "
                 "1]}, foot: {point: b.p}}\n"
                 "contacts: {c: {between: [foot, floor]}}\n"
                 "initial: {f.z_rate: 0, f.omega: [%g, %g, 1]}\nintegrate: {step: "
                 "1.0e-5, until: 1.0e-5}\n",
                 s, s);
        open_deck(&o, text);
        near(value(&o, "b.az"), N > 0 ? N - 9.81 : -9.81, 1e-6);
        run(&o);
        near(value(&o, "c.normal"), N > 0 ? N : 0, 1e-3);
        arena_close(o.life);
    }
}

/* ---- decks that name no step ---- */

static double bounced(double t)
{
    const double g = 9.81;
    double v = sqrt(2 * g), from = sqrt(2 / g);
    if (t < from) return 1 - g / 2 * t * t;
    for (int i = 0; i < 60; i++) {
        const double last = 2 * (v /= 2) / g;
        if (t < from + last) return (t - from) * (v - g / 2 * (t - from));
        from += last;
    }
    return 0;
}

#define BALL                                                                                                           \
    "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: [0, 0]}}\n"                                          \
    "constraints: {y: {prismatic: [ground, b], axis: [0, 1], range: {lower: 0, "                                       \
    "hold: {restitution: 0.5}}}}\n"                                                                                    \
    "initial: {y.displacement: 1}\nintegrate: {%suntil: %g}\n"

/* Flights are parabolas, which the steps follow exactly: what is off is where bouncing ends. */
static void a_ball(void **state)
{
    static const char *const integrate[] = {"", "tolerance: 1.0e-2, ", "tolerance: 1.0e-7, "};
    static const double at[] = {.46, 1, 1.32, 1.36, 1.6}, within[] = {1e-5, 1e-3, 1e-8};
    (void)state;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 5; i++) {
            struct opened o;
            char text[600];
            snprintf(text, sizeof text, BALL, integrate[k], at[i]);
            open_deck(&o, text);
            assert_string_equal(o.sim.stepper.kind->name, "midpoint");
            run(&o);
            near(value(&o, "y.displacement"), bounced(at[i]), within[k]);
            near(o.sim.ledger.worst, 0, 1e-11);
            if (at[i] == 1.6) {
                assert_true(value(&o, "y.displacement_rate") == 0 && value(&o, "y.displacement_accel") == 0);
                near(value(&o, "energy.impact"), 9.81, 1e-11);
                near(value(&o, "y.lower.normal"), 9.81, 1e-9);
                assert_true(value(&o, "y.lower.impacts") < 40);
            }
            arena_close(o.life);
        }
}

/* A point in a bore without friction is a pendulum: 7.0 s of it, with another scheme's own steps as the reference. */
static void in_a_bore(void **state)
{
    static const double tolerance[] = {1e-3, 1e-4, 1e-5};
    struct opened o;
    (void)state;
    open_deck(&o, "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0, at: "
                  "[0.6, -0.8]}}\n"
                  "constraints: {j: {revolute: [ground, b], at: [0, 0]}}\n"
                  "integrate: {scheme: radau9, tolerance: 1.0e-11, until: 7}\n");
    run(&o);
    const double x = value(&o, "b.x"), y = value(&o, "b.y");
    arena_close(o.life);
    for (int k = 0; k < 3; k++) {
        char text[600];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: "
                 "[0.6, -0.8]}}\n"
                 "constraints: {f: {planar: [ground, b], at: [0, 0]}}\n"
                 "surfaces: {bore: {hole: ground, at: [0, 0], radius: 1}, toe: "
                 "{point: b}}\n"
                 "contacts: {c: {between: [toe, bore]}}\nintegrate: {tolerance: "
                 "%g, until: 7}\n",
                 tolerance[k]);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "b.x"), x, 4 * tolerance[k]);
        near(value(&o, "b.y"), y, 4 * tolerance[k]);
        near(value(&o, "c.gap"), 0, 1e-11);
        near(o.sim.ledger.worst, 0, 1e-11);
        assert_true(o.sim.stepper.effort.slow < 400 / sqrt(tolerance[k]));
        arena_close(o.life);
    }
}

/* A block on a belt, static above kinetic: x'' = -k x + mu_k g sticks where x' is the belt's speed v, lets go where
 * k x is mu_s g, and so on: a cycle in closed form. */
static void stick_slip(void **state)
{
    static const double tolerance[] = {1e-3, 1e-4, 1e-6}, k = 50, v = .2;
    const double g = 9.81, w = sqrt(k), go = .5 * g / k, mid = .3 * g / k;
    (void)state;
    /* from rest at x = 0 it slides: x = mid (1 - cos w t) until x' = v; then it sticks until x = go; then it slides
     * about mid from (go, v) until x' = v again, at the mirrored place, and sticks on to go. */
    const double t1 = asin(v / (w * mid)) / w, x1 = mid * (1 - cos(w * t1)), t2 = t1 + (go - x1) / v;
    const double slide =
        2 * (acos(-1) - atan2(v / w, go - mid) + 0) / w; /* twice from (go, v) to x' = -... by symmetry */
    for (int i = 0; i < 3; i++) {
        const double t = t2 + .7 * slide, amp = hypot(go - mid, v / w), phase = atan2(v / w, go - mid);
        struct opened o;
        char text[700];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: [0, "
                 "0]}}\n"
                 "constraints: {f: {planar: [ground, b]}}\n"
                 "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, "
                 "toe: {point: b}}\n"
                 "contacts: {c: {between: [toe, floor], friction: {static: 0.5, "
                 "kinetic: 0.3}, speed: 0.2}}\n"
                 "forces: {s: {spring: f.x, stiffness: 50}}\nintegrate: "
                 "{tolerance: %g, until: %.17g}\n",
                 tolerance[i], t);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "b.x"), mid + amp * cos(w * (t - t2) - phase), .3 * tolerance[i]);
        near(o.sim.ledger.worst, 0, 1e-11);
        assert_true(value(&o, "c.state") == TOUCH_SLIDES);
        arena_close(o.life);
    }
}

/* A plate on four points comes down tilted, rattles and slides to rest: where steps of 1e-5 s leave it. */
static void a_plate_rattles(void **state)
{
    static const double tolerance[] = {1e-3, 1e-4, 1e-5};
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct opened o;
        char text[900];
        snprintf(text, sizeof text,
                 "space: 3d\ngravity: [0, 0, -9.81]\n"
                 "bodies: {b: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0.3], "
                 "points: {a: [0.5, 0.5, -0.1], b: "
                 "[-0.5, 0.5, -0.1], c: [0.5, -0.5, -0.1], d: [-0.5, -0.5, -0.1]}}}\n"
                 "constraints: {f: {free: [ground, b]}}\n"
                 "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, 1]}, "
                 "feet: {points: [b.a, b.b, b.c, "
                 "b.d]}}\ncontacts: {c: {between: [feet, floor], restitution: 0.3, "
                 "friction: 0.3}}\n"
                 "initial: {f.x_rate: 1, f.omega: [0.5, 0.25, 1]}\nintegrate: "
                 "{tolerance: %g, until: 0.5}\n",
                 tolerance[i]);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "b.x"), .2472549731, tolerance[i]);
        near(value(&o, "b.y"), -.0001507982, tolerance[i]);
        near(value(&o, "b.z"), .1, 1e-11);
        near(value(&o, "b.vx"), 0, 1e-12);
        near(o.sim.ledger.worst, 0, 1e-10);
        assert_true(o.sim.stepper.effort.slow < 20000);
        arena_close(o.life);
    }
}

/* A pendulum on a pin that rubs, which turns back 15 times: as the midpoint rule has it at 0.2 ms. */
static void on_a_pin(void **state)
{
    static const double tolerance[] = {1e-3, 1e-4};
    (void)state;
    for (int i = 0; i < 3; i++) {
        static double angle[2];
        struct opened o;
        char text[600], integrate[60];
        snprintf(integrate, sizeof integrate, i ? "tolerance: %g" : "scheme: midpoint, step: %g",
                 i ? tolerance[i - 1] : 2e-4);
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: [1, 0]}}\n"
                 "constraints: {j: {revolute: [ground, b], at: [0, 0], friction: {coefficient: 0.3, radius: 0.05}}}\n"
                 "integrate: {%s, until: 16}\n",
                 integrate);
        open_deck(&o, text);
        run(&o);
        angle[i > 0] = value(&o, "j.angle");
        if (i) {
            near(angle[1], angle[0], 10 * tolerance[i - 1]);
            near(o.sim.ledger.worst, 0, 40 * tolerance[i - 1]);
        }
        arena_close(o.life);
    }
}

/* ---- two rates ---- */

/* A mass on a soft one that is dropped: the same as by the midpoint rule at the minor step, as all is linear between impacts;
 * far from the floor the slow one is asked once a major step. */
static void of_two_rates(void **state)
{
    double y[2], slow[2];
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[900];
        snprintf(
            text, sizeof text,
            "gravity: [0, -9.81]\nbodies: {a: {mass: 1, inertia: 0.1, at: [0, 1]}, b: {mass: 0.1, inertia: 0.01, at: "
            "[0, 0.5]}}\nconstraints: {f: {prismatic: [ground, a], at: [0, 0], axis: [0, 1]}, g: {prismatic: [a, b], "
            "axis: [0, 1]}}\nforces: {s: {spring: g.displacement, stiffness: 4000, damping: 0.1}}\n"
            "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b}}\n"
            "contacts: {c: {between: [toe, floor], restitution: 0.5}}\npartition: {fast: [g]}\n"
            "integrate: {%s, step: 1.0e-4, until: 1}\n",
            k ? "scheme: subcycle, ratio: 10" : "scheme: midpoint");
        open_deck(&o, text);
        run(&o);
        y[k] = value(&o, "b.y");
        slow[k] = (double)o.sim.stepper.effort.slow;
        assert_true(value(&o, "c.impacts") == 14);
        near(o.sim.ledger.worst, 0, 1e-8);
        if (k) assert_true(o.sim.stepper.plainly > 10 && o.sim.stepper.plainly < 700);
        arena_close(o.life);
    }
    near(y[1], y[0], 1e-11);
    assert_true(slow[1] < .55 * slow[0]);
}

/* What flies by at 1000 m/s touches within a major step of 0.5 m, in which neither end is near. */
static void not_passed_by(void **state)
{
    struct opened o;
    (void)state;
    open_deck(&o, "bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0]}, b: {mass: 1, inertia: 0.1, at: [0, 1]}}\n"
                  "constraints: {f: {prismatic: [ground, a], axis: [1, 0], range: {lower: -10, upper: 3.3333, hold: "
                  "{restitution: 1}}}, g: {prismatic: [a, b], axis: [0, 1]}}\n"
                  "forces: {s: {spring: g.displacement, stiffness: 100}}\ninitial: {f.displacement_rate: 1000}\n"
                  "partition: {fast: [g]}\nintegrate: {scheme: subcycle, step: 1.0e-4, ratio: 5, until: 0.01}\n");
    run(&o);
    near(value(&o, "a.x"), 2 * 3.3333 - 10, 1e-9);
    assert_true(value(&o, "f.upper.impacts") == 1);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(on_its_point),    cmocka_unit_test(a_ball),
                                       cmocka_unit_test(in_a_bore),       cmocka_unit_test(stick_slip),
                                       cmocka_unit_test(a_plate_rattles), cmocka_unit_test(on_a_pin),
                                       cmocka_unit_test(of_two_rates),    cmocka_unit_test(not_passed_by)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
