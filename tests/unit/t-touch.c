/* t-touch.c -- rigid stops and contacts: impacts against closed forms, rest, energy, loops, restart, refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/touch.h"
#include "unit/trees.h"

#include <cmocka.h>

#include "unit/opened.h"

/* ---- a ball on a floor, e = 1/2: the impacts are at known times, and their sum is finite ---- */

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
    "constraints: {y: {prismatic: [ground, b], axis: [0, 1], range: {lower: 0, hold: {restitution: %s}}}}\n"           \
    "initial: {y.displacement: 1}\nintegrate: {scheme: midpoint, step: %s, until: %g}\n"

static void a_ball_comes_to_rest(void **state)
{
    static const char *const step[] = {"1.0e-2", "1.0e-3"};
    static const double at[] = {.1, .46, .9, 1, 1.15, 1.25, 1.32, 1.36, 1.6};
    (void)state;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 9; i++) {
            struct opened o;
            char text[600];
            snprintf(text, sizeof text, BALL, "0.5", step[k], at[i]);
            open_deck(&o, text);
            run(&o);
            near(value(&o, "y.displacement"), bounced(at[i]), 1e-10);
            near(o.sim.ledger.residual, 0, 1e-13);
            if (at[i] == 1.6) {
                assert_true(value(&o, "y.displacement_rate") == 0 && value(&o, "y.displacement_accel") == 0);
                near(value(&o, "energy.impact"), 9.81, 1e-13);
                near(value(&o, "y.lower.normal"), 9.81, 1e-12);
                assert_true(value(&o, "y.lower.impacts") < 12);
            }
            arena_close(o.life);
        }
}

/* e = 1: thousands of bounces without loss, and in phase. */
static void without_loss(void **state)
{
    (void)state;
    struct opened o;
    char text[600];
    snprintf(text, sizeof text, BALL, "1", "1.0e-2", 1000.);
    open_deck(&o, text);
    run(&o);
    const double T = 2 * sqrt(2 / 9.81), t = 1000 - T * floor(1000 / T + .5);
    near(value(&o, "y.displacement"), 1 - 9.81 / 2 * t * t, 1e-6);
    near(o.sim.ledger.worst, 0, 1e-9 * 9.81);
    assert_true(value(&o, "y.lower.impacts") == round(1000 / T));
    arena_close(o.life);
}

/* ---- a free mass between two stops, e = .8: straight lines ---- */

static double between_stops(double t)
{
    double x = 0, v = 1;
    for (;;) {
        const double need = (v > 0 ? .3 - x : -.2 - x) / v;
        if (t < need) return x + v * t;
        x = v > 0 ? .3 : -.2;
        t -= need;
        v *= -.8;
    }
}

static void two_stops(void **state)
{
    (void)state;
    for (double t = .5; t < 6.1; t += .5) {
        struct opened o;
        char text[600];
        snprintf(text, sizeof text,
                 "bodies: {b: {mass: 2, inertia: 0.1, at: [0, 0]}}\n"
                 "constraints: {y: {prismatic: [ground, b], axis: [0, 1],\n"
                 "  range: {lower: -0.2, upper: 0.3, hold: {restitution: 0.8}}}}\n"
                 "initial: {y.displacement_rate: 1}\nintegrate: {scheme: midpoint, step: 1.0e-2, until: %g}\n",
                 t);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "y.displacement"), between_stops(t), 2e-10);
        near(o.sim.ledger.worst, 0, 1e-13);
        arena_close(o.life);
    }
}

/* ---- a loop, and springs: a rocker that strikes a stop gains nothing ---- */

#define FOUR_BAR                                                                                                       \
    "gravity: [0, -9.81]\n"                                                                                            \
    "bodies: {a: {mass: 1, inertia: 0.1, at: [0, 0.5]}, b: {mass: 2, inertia: 0.5, at: [1, 1]},\n"                     \
    "         c: {mass: 1.5, inertia: 0.2, at: [2, 0.5]}}\n"                                                           \
    "constraints: {p: {revolute: [ground, a], at: [0, 0], range: {lower: -0.4, upper: 0.5, hold: {restitution: "       \
    "%s}}},\n"                                                                                                         \
    "  q: {revolute: [a, b], at: [0, 1]}, r: {revolute: [b, c], at: [2, 1]}, s: {revolute: [ground, c], at: [2, "      \
    "0]}}\n"                                                                                                           \
    "initial: {p.angle_rate: 2}\nintegrate: {scheme: midpoint, step: %g, until: 2}\n"

static void in_a_loop(void **state)
{
    static const char *const e[] = {"0", "0.5", "1"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        double end[3];
        for (int k = 0; k < 3; k++) {
            struct opened o;
            char text[900];
            snprintf(text, sizeof text, FOUR_BAR, e[i], 4e-3 / (1 << k));
            open_deck(&o, text);
            run(&o);
            end[k] = value(&o, "p.angle");
            assert_true(end[k] > -.4 - 1e-11 && end[k] < .5 + 1e-11);
            near(o.sim.ledger.worst / o.sim.ledger.norm, 0, 3e-4 / (1 << 2 * k));
            assert_true(touch_impacts(o.sim.stepper.touch) > 0);
            arena_close(o.life);
        }
        const double ratio = (end[0] - end[1]) / (end[1] - end[2]);
        if (fabs(end[1] - end[2]) > 1e-9) near(ratio, 4, 1.5);
    }
}

/* ---- reactions and accelerations know of the push ---- */

static void reactions(void **state)
{
    (void)state;
    struct opened o;
    open_deck(&o, "gravity: [0, -9.81]\nbodies: {a: {mass: 1, inertia: 0.1, at: [0.5, 0]}}\n"
                  "constraints: {p: {revolute: [ground, a], at: [0, 0], range: {lower: 0, hold: rigid}}}\n"
                  "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}\n");
    run(&o);
    near(value(&o, "p.angle"), 0, 1e-15);
    near(value(&o, "p.angle_accel"), 0, 1e-12);
    near(value(&o, "p.fy"), 9.81, 1e-11);
    near(value(&o, "p.lower.normal"), 4.905, 1e-11);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_ball_comes_to_rest), cmocka_unit_test(without_loss),
                                       cmocka_unit_test(two_stops), cmocka_unit_test(in_a_loop),
                                       cmocka_unit_test(reactions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
