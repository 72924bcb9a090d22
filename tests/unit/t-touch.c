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

/* ---- surfaces ---- */

#define FLOOR "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b}}\n"
#define BLOCK                                                                                                          \
    "bodies: {b: {mass: 1, inertia: 0.1, at: [0, 0]}}\nconstraints: {f: {planar: [ground, b], at: [0, 0]}}\n" FLOOR

/* mu = .5: at 0.9 of the friction angle it stays for ever, at 1.1 it slides as a point does. */
static void on_an_incline(void **state)
{
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[900];
        const double tilt = atan((k ? 1.1 : .9) * .5), g = 9.81, T = k ? 1 : 100;
        snprintf(text, sizeof text,
                 "gravity: [%.17g, %.17g]\n" BLOCK "contacts: {c: {between: [floor, toe], friction: 0.5}}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-2, until: %g}\n",
                 g * sin(tilt), -g * cos(tilt), T);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "f.x"), k ? .5 * g * (sin(tilt) - .5 * cos(tilt)) : 0, k ? 1e-13 : 0);
        assert_true(value(&o, "f.y") == 0 && value(&o, "c.state") == (k ? 1 : 2));
        near(value(&o, "f.x_accel"), k ? g * (sin(tilt) - .5 * cos(tilt)) : 0, 1e-12);
        near(o.sim.ledger.residual, 0, 1e-13);
        arena_close(o.life);
    }
}

/* A ball slides, then rolls at 5/7 of its speed; in space along (0.6, 0.8). */
static void sliding_to_rolling(void **state)
{
    static const char *const text[] = {
        "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.004, at: [0, 0.1]}}\n"
        "constraints: {f: {planar: [ground, b]}}\ninitial: {f.x_rate: 1}\n"
        "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, ball: {sphere: b, radius: 0.1}}\n",
        "gravity: [0, 0, -9.81]\nbodies: {b: {mass: 1, inertia: [0.004, 0.004, 0.004], at: [0, 0, 0.1]}}\n"
        "constraints: {f: {free: [ground, b]}}\ninitial: {f.x_rate: 0.6, f.y_rate: 0.8}\n"
        "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, 1]}, ball: {sphere: b, radius: 0.1}}\n"};
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char all[900];
        snprintf(all, sizeof all,
                 "%scontacts: {c: {between: [ball, floor], friction: 0.3}}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n",
                 text[k]);
        open_deck(&o, all);
        run(&o);
        const double slides = 2. / 7 / (.3 * 9.81),
                     x = slides - .5 * .3 * 9.81 * slides * slides + (1 - slides) * 5 / 7;
        near(value(&o, "f.x"), k ? .6 * x : x, 3e-7);
        near(value(&o, "f.x_rate"), k ? .6 * 5 / 7 : 5. / 7, 1e-13);
        near(value(&o, k ? "b.wx" : "f.angle_rate"), k ? -.8 * 50 / 7 : -50. / 7, 1e-12);
        near(value(&o, "energy.friction"), -1. / 7, 1e-13);
        near(o.sim.ledger.worst, 0, 1e-13);
        arena_close(o.life);
    }
}

/* Painleve's rod, mu = 2: sliding is not possible, it jams in the first step; at mu = 1 it slides on. */
static void a_rod_jams(void **state)
{
    static const double want[] = {.7826, .7948};
    (void)state;
    for (int mu = 1; mu <= 2; mu++)
        for (int k = 0; k < 2; k++) {
            struct opened o;
            char text[900];
            snprintf(
                text, sizeof text,
                "gravity: [0, -9.81]\nparameters: {th: 1.1}\n"
                "bodies: {b: {mass: 1, inertia: 1/12, at: [0, 0.5*sin(th)], orient: th, points: {toe: [-0.5, 0]}}}\n"
                "constraints: {f: {planar: [ground, b], at: [0, 0.5*sin(th)]}}\n"
                "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b.toe}}\n"
                "contacts: {c: {between: [toe, floor], friction: %d}}\ninitial: {f.x_rate: -3}\n"
                "integrate: {scheme: midpoint, step: %g, until: 0.05}\n",
                mu, k ? 1e-4 : 1e-3);
            open_deck(&o, text);
            const double drawn = 9.81 * .5 * sin(1.1), first = 4.5 + drawn;
            run(&o);
            const double now = value(&o, "energy.kinetic") + 9.81 * (.5 * sin(1.1) + value(&o, "f.y"));
            near(now / first, want[mu - 1], 2e-4);
            assert_true(value(&o, "c.state") == mu);
            near(o.sim.ledger.worst, 0, 1e-12);
            arena_close(o.life);
        }
}

/* A plate with five feet, thrown: more points than freedoms.  It ends flat and at rest. */
static void a_plate(void **state)
{
    (void)state;
    struct opened o;
    open_deck(
        &o,
        "gravity: [0, 0, -9.81]\nbodies: {b: {mass: 1, inertia: [0.1, 0.2, 0.3], at: [0, 0, 0.3], points: {\n"
        "  a: [0.5, 0.4, -0.1], b: [-0.5, 0.4, -0.1], c: [-0.5, -0.4, -0.1], d: [0.5, -0.4, -0.1], e: [0, 0, -0.1]}}}\n"
        "constraints: {f: {free: [ground, b]}}\ninitial: {f.x_rate: 0.6, f.y_rate: 0.8, f.omega: [0.5, 0.3, 1]}\n"
        "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, 1]}, feet: {points: [b.a, b.b, b.c, b.d, "
        "b.e]}}\n"
        "contacts: {c: {between: [feet, floor], friction: 0.3, restitution: 0.3}}\n"
        "integrate: {scheme: midpoint, step: 1.0e-3, until: 2}\n");
    run(&o);
    near(value(&o, "f.z"), -.2, 1e-12);
    near(value(&o, "f.x_rate"), 0, 1e-12);
    near(value(&o, "b.wz"), 0, 1e-12);
    near(value(&o, "c.1.gap"), 0, 1e-12);
    near(o.sim.ledger.worst / o.sim.ledger.norm, 0, 1e-5);
    arena_close(o.life);
}

/* A pin dropped in a hole bounces, is held and swings: gap 0, energy kept to the booked loss. */
static void a_pin_in_a_hole(void **state)
{
    (void)state;
    struct opened o;
    open_deck(&o, "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: [0.3, 0.2]}}\n"
                  "constraints: {f: {planar: [ground, b], at: [0, 0]}}\n"
                  "surfaces: {bore: {hole: ground, at: [0, 0], radius: 1.1}, pin: {sphere: b, radius: 0.1}}\n"
                  "contacts: {c: {between: [bore, pin], restitution: 0.3}}\n"
                  "integrate: {scheme: midpoint, step: 1.0e-2, until: 4}\n");
    run(&o);
    near(value(&o, "c.gap"), 0, 1e-15);
    near(o.sim.ledger.worst, 0, 1e-12);
    assert_true(value(&o, "c.state") == 1 && value(&o, "energy.impact") > 9);
    arena_close(o.life);
}

/* Three balls in a row, at once: Newton's law for both contacts has the answer (-1/3, 2/3, 2/3). */
static void a_cradle(void **state)
{
    (void)state;
    struct opened o;
    open_deck(
        &o,
        "bodies: {a: {mass: 1, inertia: 1, at: [0, 0]}, b: {mass: 1, inertia: 1, at: [0.2, 0]}, c: {mass: 1, inertia: "
        "1, at: [0.4, 0]}}\nconstraints: {x: {prismatic: [ground, a], axis: [1, 0]},\n"
        " y: {prismatic: [ground, b], axis: [1, 0]}, z: {prismatic: [ground, c], axis: [1, 0]}}\n"
        "surfaces: {sa: {sphere: a, radius: 0.1}, sb: {sphere: b, radius: 0.1}, sc: {sphere: c, radius: 0.1}}\n"
        "contacts: {ab: {between: [sa, sb], restitution: 1}, bc: {between: [sb, sc], restitution: 1}}\n"
        "initial: {x.displacement: -0.1, x.displacement_rate: 1}\n"
        "integrate: {scheme: midpoint, step: 1.0e-2, until: 0.5}\n");
    run(&o);
    near(value(&o, "x.displacement_rate"), -1. / 3, 1e-12);
    near(value(&o, "y.displacement_rate"), 2. / 3, 1e-12);
    near(value(&o, "z.displacement_rate"), 2. / 3, 1e-12);
    near(o.sim.ledger.worst, 0, 1e-14);
    arena_close(o.life);
}

/* A rod falls on its corner: the impulse by hand, smooth and sticking. */
static void a_rod_on_its_corner(void **state)
{
    static const double e[] = {.5, 1, 0};
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct opened o;
        char text[900];
        const double th = acos(-1) / 6, h = .2, v = sqrt(2 * 9.81 * h), c = .5 * cos(th), s = .5 * sin(th), J = 1. / 12;
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 1/12, at: [0, 0.45], orient: pi/6, points: {toe: "
                 "[-0.5, 0]}}}\nconstraints: {f: {planar: [ground, b], at: [0, 0]}}\n"
                 "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, toe: {point: b.toe}}\n"
                 "contacts: {c: {between: [toe, floor], restitution: %g%s}}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-2, until: %.17g}\n",
                 e[k], k == 2 ? ", friction: 10" : "", sqrt(2 * h / 9.81) + 1e-9);
        open_deck(&o, text);
        run(&o);
        /* toe at (-c, -s) from the centre: u = (vx + s w, vy - c w); W = [1 + s s/J, -s c/J; -s c/J, 1 + c c/J] */
        const double a = 1 + s * s / J, b = -s * c / J, d = 1 + c * c / J;
        const double p = k == 2 ? v / (d - b * b / a) : (1 + e[k]) * v / d;
        near(value(&o, "c.impulse"), p, 1e-6);
        near(value(&o, "f.y_rate"), p - v, 1e-6);
        near(value(&o, "f.angle_rate"), (-c * p + (k == 2 ? s * (-b / a * p) : 0)) / J, 1e-5);
        arena_close(o.life);
    }
}

/* In halves as in one go: all that the contacts carry is in the state. */
static void in_halves(void **state)
{
    (void)state;
    static const char *const text =
        "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.05, at: [0, 0.4], points: {p: [0.3, -0.1], q: [-0.3, "
        "-0.1]}}}\n"
        "constraints: {f: {planar: [ground, b], at: [0, 0.4]}}\ninitial: {f.x_rate: 2, f.angle_rate: 1.5}\n"
        "surfaces: {floor: {plane: ground, at: [0, 0], normal: [0, 1]}, feet: {points: [b.p, b.q]}}\n"
        "contacts: {c: {between: [feet, floor], restitution: 0.4, friction: 0.2}}\n"
        "integrate: {scheme: midpoint, step: 1.0e-3, until: %g}\n";
    for (double T = .2; T < .9; T += .1) {
        struct opened whole, half;
        struct recall kept, back;
        char all[900];
        snprintf(all, sizeof all, text, 1.);
        open_deck(&whole, all);
        run(&whole);
        snprintf(all, sizeof all, text, T);
        open_deck(&half, all);
        run(&half);
        recall_keep(&kept, half.life);
        assert_int_equal(stepper_recall(&half.sim.stepper, &kept), OK);
        snprintf(all, sizeof all, text, 1.);
        struct opened rest;
        open_deck(&rest, all);
        recall_back(&back, kept.span, kept.n);
        assert_int_equal(stepper_recall(&rest.sim.stepper, &back), OK);
        assert_true(*back.wrong == 0);
        memcpy(rest.sim.x.q, half.sim.x.q, 3 * sizeof(double));
        memcpy(rest.sim.x.v, half.sim.x.v, 3 * sizeof(double));
        memcpy(rest.sim.x.a, half.sim.x.a, 3 * sizeof(double));
        rest.sim.x.t = half.sim.x.t;
        for (long k = lround(T / 1e-3) + 1; k <= 1000; k++)
            assert_int_equal(stepper_step(&rest.sim.stepper, &rest.sim.x, 1e-3, 1, (double)k * 1e-3, &rest.sim.trouble),
                             OK);
        for (int i = 0; i < 3; i++) {
            near(rest.sim.x.q[i], whole.sim.x.q[i], 1e-11);
            near(rest.sim.x.v[i], whole.sim.x.v[i], 1e-9);
        }
        arena_close(whole.life);
        arena_close(half.life);
        arena_close(rest.life);
    }
}

/* A four-bar that is driven, with play in one joint: what strikes there the drive feels through the masses, too. */
static void a_joint_with_play(void **state)
{
    (void)state;
    static const double step[] = {1e-3, 5e-4};
    double angle[2];
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[1600];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\nparameters: {x: 0.8177582689611357, y: 0.675860896537119}\nbodies:\n"
                 "  crank: {mass: 1, inertia: 0.3^2/12, at: [0, 0.15]}\n"
                 "  coupler: {mass: 2, inertia: 2*0.9^2/12, at: [x/2, (0.3 + y)/2]}\n"
                 "  rocker: {mass: 1.5, inertia: 1.5*0.7^2/12, at: [(1 + x)/2, y/2]}\nconstraints:\n"
                 "  a: {revolute: [ground, crank], at: [0, 0]}\n  b: {revolute: [crank, coupler], at: [0, 0.3]}\n"
                 "  d: {revolute: [ground, rocker], at: [1, 0]}\nsurfaces: {pin: {sphere: coupler, at: [x, y], "
                 "radius: 0.02}, bore: {hole: rocker, at: [x, y], radius: 0.021}}\n"
                 "contacts: {play: {between: [pin, bore], restitution: 0.5, friction: 0.1}}\n"
                 "drives: {turn: {drive: a.angle, value: 10*t}}\ninitial: {a.angle_rate: 10}\n"
                 "integrate: {step: %g, until: 1}\n",
                 step[k]);
        open_deck(&o, text);
        run(&o);
        angle[k] = value(&o, "d.angle");
        assert_true(value(&o, "play.impacts") > 5 && value(&o, "energy.impact") > 30);
        near(o.sim.ledger.worst, 0, k ? 5e-5 : 2e-4);
        arena_close(o.life);
    }
    near(angle[0], angle[1], 1e-6);
}

/* In space, askew onto a belt: it slides straight against the belt until it goes along, closed form at any step. */
static void a_puck_on_a_belt(void **state)
{
    (void)state;
    static const double step[] = {4e-3, 1e-3}, at[] = {.4, 1}, x[] = {.05710258755855424, .32487658742704467},
                        y[] = {.5715896497657831, .7004936502918213};
    for (int k = 0; k < 4; k++) {
        struct opened o;
        char text[700];
        snprintf(
            text, sizeof text,
            "space: 3d\ngravity: [0, 0, -9.81]\n"
            "bodies: {p: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0]}}\nconstraints: {f: {free: [ground, p]}}\n"
            "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, 1], along: [1, 0, 0]}, foot: {point: p}}\n"
            "contacts: {c: {between: [foot, floor], friction: {static: 0.4, kinetic: 0.3}, speed: 0.5}}\n"
            "initial: {f.y_rate: 2}\nintegrate: {step: %g, until: %g}\n",
            step[k / 2], at[k % 2]);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "p.x"), x[k % 2], 1e-12);
        near(value(&o, "p.y"), y[k % 2], 1e-12);
        near(o.sim.ledger.worst, 0, 1e-12);
        assert_true(value(&o, "c.state") == (k % 2 ? TOUCH_STICKS : TOUCH_SLIDES));
        arena_close(o.life);
    }
}

/* Three feet slide askew on a floor, a rider fixed on top: decelerations of the friction, and what holds the rider. */
static void forces_of_what_slides(void **state)
{
    static const char *const scheme[] = {"scheme: midpoint, step: 1.0e-3", "scheme: midpoint, tolerance: 1.0e-4"};
    const double a = .3 * 9.81;
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[1200];
        snprintf(text, sizeof text,
                 "gravity: [0, 0, -9.81]\n"
                 "bodies:\n"
                 "  p: {mass: 2, inertia: [0.1, 0.1, 0.2], at: [0, 0, 0],\n"
                 "      points: {a: [1, 1, 0], b: [-1, 1, 0], c: [0, -2, 0]}}\n"
                 "  q: {mass: 1, inertia: [0.1, 0.1, 0.2], at: [0, 0, 1]}\n"
                 "constraints: {f: {free: [ground, p]}, w: {fixed: [p, q], at: [0, 0, 1]}}\n"
                 "surfaces: {floor: {plane: ground, at: [0, 0, 0], normal: [0, 0, 1], along: [1, 0, 0]},\n"
                 "  feet: {points: [p.a, p.b, p.c]}}\n"
                 "contacts: {s: {between: [feet, floor], friction: 0.3}}\n"
                 "initial: {f.x_rate: 3, f.y_rate: 4}\n"
                 "integrate: {%s, until: 0.5}\n",
                 scheme[k]);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "f.x_rate"), 3 - .6 * a * .5, 1e-10);
        near(value(&o, "f.y_rate"), 4 - .8 * a * .5, 1e-10);
        near(value(&o, "f.x_accel"), -.6 * a, 1e-10);
        near(value(&o, "f.y_accel"), -.8 * a, 1e-10);
        near(value(&o, "f.z_accel"), 0, 1e-10);
        near(value(&o, "w.fx"), -.6 * a, 1e-10);
        near(value(&o, "w.fy"), -.8 * a, 1e-10);
        near(value(&o, "w.fz"), 9.81, 1e-10);
        near(value(&o, "w.mx"), 0, 1e-10);
        near(value(&o, "w.my"), 0, 1e-10);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_ball_comes_to_rest),
                                       cmocka_unit_test(without_loss),
                                       cmocka_unit_test(two_stops),
                                       cmocka_unit_test(in_a_loop),
                                       cmocka_unit_test(reactions),
                                       cmocka_unit_test(on_an_incline),
                                       cmocka_unit_test(sliding_to_rolling),
                                       cmocka_unit_test(a_rod_jams),
                                       cmocka_unit_test(a_plate),
                                       cmocka_unit_test(a_pin_in_a_hole),
                                       cmocka_unit_test(a_joint_with_play),
                                       cmocka_unit_test(a_puck_on_a_belt),
                                       cmocka_unit_test(a_cradle),
                                       cmocka_unit_test(a_rod_on_its_corner),
                                       cmocka_unit_test(in_halves),
                                       cmocka_unit_test(forces_of_what_slides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
