/* t-rubbing.c -- friction in joints, against closed forms, an event-driven solution of a pendulum and, for a four-bar,
 * differential-algebraic equations in all coordinates of its bodies (DOP853 at 1e-11 from reversal to reversal). */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/touch.h"
#include "unit/trees.h"

#include <cmocka.h>

#include "unit/opened.h"

#define PIN                                                                                                            \
    "gravity: [0, -9.81]\n"                                                                                            \
    "bodies: {b: {mass: 1, inertia: 1/12, at: [0.5*sin(2), -0.5*cos(2)]}}\n"                                           \
    "constraints: {pin: {revolute: [%s], at: [0, 0], friction: {coefficient: 0.3, radius: 0.02}}}\n"                   \
    "integrate: {step: %g, until: %g}\n"

/* Released at 2 rad; second order through the turning points at 1.073, 2.117, ... s; rests at 47.05 s. */
static void a_pendulum(void **state)
{
    static const struct {
        double t, angle;
    } at[] = {{.25, 1.5731653546171485}, {1, -1.8712781848008744}, {2, 1.7265677087245304}};
    (void)state;
    for (int i = 0; i < 3; i++) {
        double off[2];
        for (int k = 0; k < 2; k++) {
            struct opened o;
            char text[600];
            snprintf(text, sizeof text, PIN, k ? "b, ground" : "ground, b", k ? 5e-3 : 1e-2, at[i].t);
            open_deck(&o, text);
            run(&o);
            off[k] = (k ? -1 : 1) * value(&o, "pin.angle") + 2 - at[i].angle;
            arena_close(o.life);
        }
        assert_true(fabs(off[0]) < 5.5e-3 && fabs(off[1]) < .27 * fabs(off[0]));
    }
    struct opened o;
    char text[600];
    snprintf(text, sizeof text, PIN, "ground, b", 1e-2, 100.);
    open_deck(&o, text);
    run(&o);
    near(value(&o, "pin.angle") + 2, -.0014881653959126914, 2e-4);
    assert_true(value(&o, "pin.angle_rate") == 0 && value(&o, "pin.friction_state") == TOUCH_STICKS);
    arena_close(o.life);
}

/* Up a slope, back down, closed form; a guide of some length whose ends bear a moment that the acceleration makes:
 * to and fro between force and friction alone would not settle. */
static void slides(void **state)
{
    (void)state;
    struct opened o;
    open_deck(&o, "gravity: [0, -9.81]\nbodies: {b: {mass: 2, inertia: 1, at: [0, 0]}}\n"
                  "constraints: {s: {prismatic: [ground, b], axis: [cos(0.3), sin(0.3)], friction: 0.2}}\n"
                  "initial: {s.displacement_rate: 3}\nintegrate: {step: 1.0e-2, until: 2}\n");
    run(&o);
    near(value(&o, "s.displacement"), -.021029478690649417, 1e-13);
    near(value(&o, "s.displacement_rate"), -1.4053735240459109, 1e-13);
    near(o.sim.ledger.worst, 0, 1e-12);
    arena_close(o.life);
    open_deck(&o, "gravity: [0, -9.81]\nbodies: {b: {mass: 2, inertia: 1, at: [1.5, 0]}}\n"
                  "constraints: {s: {prismatic: [ground, b], at: [0, 0], axis: [0, 1], friction: {coefficient: 0.2, "
                  "length: 0.5}}}\n"
                  "forces: {f: {force: s, value: 2*9.81 + 5}, p: {force: b, value: [0, 20]}}\n"
                  "integrate: {step: 1.0e-3, until: 1}\n");
    run(&o);
    near(value(&o, "s.displacement"), .5 * (25 + .4 * 1.14) / 4.4, 1e-12);
    arena_close(o.life);
}

/* 0.9 and 1.1 of what holds: not a bit of creep, and the right acceleration. */
static void sticks(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[600];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 1, at: [0, 0]}}\n"
                 "constraints: {s: {prismatic: [ground, b], axis: [1, 0], friction: {static: 0.5, kinetic: 0.3}}}\n"
                 "forces: {f: {force: s, value: %g*0.5*9.81}}\nintegrate: {step: 1.0e-2, until: 10}\n",
                 k ? 1.1 : .9);
        open_deck(&o, text);
        run(&o);
        if (k == 0)
            assert_true(value(&o, "s.displacement") == 0);
        else
            near(value(&o, "s.displacement"), .5 * 100 * 9.81 * (.55 - .3), 1e-10);
        arena_close(o.life);
    }
}

#define LINKS                                                                                                          \
    "gravity: [0, -9.81]\nparameters: {mu: 0.3, r: 0.03, x: 0.8177582689611357, y: 0.675860896537119}\nbodies:\n"      \
    "  crank: {mass: 1, inertia: 0.3^2/12, at: [0, 0.15]}\n"                                                           \
    "  coupler: {mass: 2, inertia: 2*0.9^2/12, at: [x/2, (0.3 + y)/2]}\n"                                              \
    "  rocker: {mass: 1.5, inertia: 1.5*0.7^2/12, at: [(1 + x)/2, y/2]}\nconstraints:\n"                               \
    "  a: {revolute: [ground, crank], at: [0, 0], friction: {coefficient: mu, radius: r}%s}\n"                         \
    "  b: {revolute: [crank, coupler], at: [0, 0.3], friction: {coefficient: mu, radius: r}}\n"                        \
    "  c: {revolute: [coupler, rocker], at: [x, y], friction: {coefficient: mu, radius: r}}\n"                         \
    "  d: {revolute: [rocker, ground], at: [1, 0], friction: {coefficient: mu, radius: r}%s}\n"                        \
    "initial: {a.angle_rate: 15}\nintegrate: {step: %g, until: 0.4}\n"

/* Two of its joints turn round twice; whichever of them closes the loop. */
static void a_four_bar(void **state)
{
    (void)state;
    for (int loop = 0; loop < 2; loop++) {
        double off[2];
        for (int k = 0; k < 2; k++) {
            struct opened o;
            char text[1600];
            snprintf(text, sizeof text, LINKS, "", loop ? ", loop: true" : "", k ? 1e-3 : 2e-3);
            open_deck(&o, text);
            run(&o);
            off[k] = value(&o, "a.angle") - 6.106218185419315;
            assert_true(value(&o, "energy.friction") < -15);
            near(o.sim.ledger.worst, 0, k ? 4e-3 : 1.6e-2);
            arena_close(o.life);
        }
        assert_true(fabs(off[1]) < 6e-5 && fabs(off[1]) < .27 * fabs(off[0]));
    }
}

/* Coarse steps through postures in which it could be wedged at rest, by forces without bounds, which is no motion. */
static void a_crank(void **state)
{
    (void)state;
    double off[2];
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[1600];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nbodies:\n  c: {mass: 1, inertia: 0.01, at: [0.1, 0]}\n"
                 "  r: {mass: 0.7, inertia: 0.02, at: [0.4, 0.05]}\n  s: {mass: 2, inertia: 0.01, at: [0.6, 0.1]}\n"
                 "constraints:\n  A: {revolute: [ground, c], at: [0, 0], friction: {coefficient: 0.2, radius: 0.01}}\n"
                 "  B: {revolute: [c, r], at: [0.2, 0], friction: {coefficient: 0.3, radius: 0.02}}\n"
                 "  C: {revolute: [r, s], at: [0.6, 0.1], friction: {coefficient: 0.3, radius: 0.02}}\n"
                 "  D: {prismatic: [ground, s], at: [0.6, 0.1], axis: [1, 0], friction: {coefficient: 0.15, length: "
                 "0.1}}\nmeasures: {M: {angle: [ground, c]}}\nforces: {m: {torque: M, value: \"if(t < 1, 6, 0)\"}}\n"
                 "integrate: {step: %g, until: 1}\n",
                 k ? 1e-3 : 2e-3);
        open_deck(&o, text);
        run(&o);
        off[k] = value(&o, "M") - 22.26432; /* at 1e-4; one that is wedged ends at 20.45 */
        near(value(&o, "energy.friction"), -89.531, .1);
        arena_close(o.life);
    }
    assert_true(fabs(off[0]) < 1.5e-2 && fabs(off[1]) < 3e-3);
}

/* A drive moves a pin that rubs: its torque and its work tell. */
static void driven(void **state)
{
    (void)state;
    struct opened o;
    open_deck(&o, "bodies: {b: {mass: 1, inertia: 1, at: [0, 0]}, c: {mass: 1, inertia: 1, at: [1, 0]}}\n"
                  "constraints: {pin: {revolute: [ground, b], at: [0, 0], friction: {torque: 2}}, s: {prismatic: "
                  "[ground, c], axis: [1, 0]}}\n"
                  "drives: {d: {drive: pin.angle, value: \"3*t\"}}\nintegrate: {step: 1.0e-2, until: 1}\n");
    run(&o);
    near(value(&o, "d.force"), 2, 1e-12);
    near(value(&o, "energy.friction"), -6, 1e-12);
    near(value(&o, "energy.drive"), 6, 1e-12);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_pendulum), cmocka_unit_test(slides),
                                       cmocka_unit_test(sticks),     cmocka_unit_test(a_four_bar),
                                       cmocka_unit_test(a_crank),    cmocka_unit_test(driven)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
