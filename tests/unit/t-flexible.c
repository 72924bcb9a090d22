/* t-flexible.c -- flexible bodies from the deck to the records, against closed forms and conservation: static
 * deflection and stress, frequencies, the centre of mass of a free body, the plane against space, feedback */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "probe/modes.h"
#include "unit/opened.h"

static const double L = 2, E = 2e11, A = 6e-4, I = 2e-8, rho = 8000;

#define BEAM                                                                                                           \
    "    beam: {from: [0, 0], to: [2, 0], elements: 12, rotary: false}\n"                                              \
    "    section: {area: 6.0e-4, Iz: 2.0e-8, y: 0.01}\n"                                                               \
    "    material: {E: 2.0e+11, density: 8000}\n"

/* int v'^2 ds/2 with E I v' = F (L s - s^2/2) + M s, by Simpson's rule, which is exact to s^3 and nearly so here. */
static double shortening(double F, double M)
{
    enum { N = 100 };
    double sum = 0;
    for (int i = 0; i <= N; i++) {
        double s = L * i / N, slope = (F * (L * s - s * s / 2) + M * s) / (E * I);
        sum += slope * slope / 2 * (i == 0 || i == N ? 1 : i % 2 ? 4 : 2);
    }
    return sum * L / N / 3;
}

/* A load on a body at the tip: the constraint modes of the joint hold the static shape, so that it is exact. */
static void test_static(void **state)
{
    struct opened o;
    double F = 0.1, M = 0.05, N = 20;
    (void)state;
    open_deck(&o, "bodies:\n"
                  "  arm:\n" BEAM "    modes: 3\n"
                  "    points: {tip: {station: 1}, mid: {station: 0.5}, high: {station: 1, offset: [0, 0.3]}}\n"
                  "    stress: {top: {station: 0, corner: top}, low: {station: 0.5, corner: bottom}}\n"
                  "  load: {mass: 1, at: [2, 0], inertia: 0.1}\n"
                  "constraints:\n"
                  "  clamp: {fixed: [ground, arm], at: [0, 0]}\n"
                  "  grip: {fixed: [arm, load], at: [2, 0]}\n"
                  "forces:\n"
                  "  pull: {force: load, value: [20, 0.1]}\n"
                  "  turn: {torque: load, value: 0.05}\n"
                  "initial: {static: true}\n"
                  "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n");
    double v = F * L * L * L / (3 * E * I) + M * L * L / (2 * E * I), turn = F * L * L / (2 * E * I) + M * L / (E * I);
    /* second order: the tension stiffens by about 2 N L^2/(5 E I) */
    double stiffer = 2 * N * L * L / (5 * E * I);
    near(value(&o, "arm.tip.dy"), v, 1.2 * stiffer * v);
    assert_true(value(&o, "arm.tip.dy") < v && value(&o, "arm.tip.dy") > v * (1 - 1.2 * stiffer));
    near(value(&o, "load.angle"), turn, 1.2 * stiffer * turn);
    near(value(&o, "arm.high.dx"), value(&o, "arm.tip.dx") - .3 * sin(turn), .3 * 2 * stiffer * turn);
    near(value(&o, "arm.tip.dx"), N * L / (E * A) - shortening(F, M), 2e-4 * N * L / (E * A));
    near(value(&o, "clamp.fx"), -N, 1e-9 * N);
    near(value(&o, "clamp.fy"), -F, 1e-9);
    double root = F * L + M - N * value(&o, "arm.tip.dy");
    near(value(&o, "clamp.mz"), -root, 1e-6);
    near(value(&o, "arm.top.axial"), N / A, 1e-6 * N / A);
    near(value(&o, "arm.top.bending"), -root * .01 / I, 2e-3 * root * .01 / I);
    double half = F * L / 2 + M - N * (value(&o, "arm.tip.dy") - value(&o, "arm.mid.dy"));
    near(value(&o, "arm.low.bending"), half * .01 / I, 2e-3 * half * .01 / I);
    near(value(&o, "arm.top.von_mises"), fabs(value(&o, "arm.top.axial") + value(&o, "arm.top.bending")), 1e-3);
    arena_close(o.life);
}

static void test_frequencies(void **state)
{
    static const double root[] = {1.87510406871, 4.69409113297, 7.85475743824};
    struct opened o;
    struct modes modes;
    (void)state;
    open_deck(&o, "bodies:\n"
                  "  arm:\n" BEAM "    modes: 6\n"
                  "    damping: {alpha: 2, beta: 1.0e-4}\n"
                  "constraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}\n"
                  "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n");
    assert_int_equal(modes_find(&modes, &o.sim, o.life, &o.report), OK);
    assert_int_equal(modes.n, 6);
    for (int i = 0; i < 3; i++) {
        double omega = pow(root[i] / L, 2) * sqrt(E * I / (rho * A));
        near(modes.mode[i].omega, omega, (i < 2 ? 5e-5 : 2e-4) * omega);
        near(modes.mode[i].damping, 1 / omega + 1e-4 * omega / 2, 2e-4);
    }
    arena_close(o.life);
}

/* Nothing acts on it: its centre of mass moves straight and evenly, whatever the frame does that bends with it. */
static void test_free_flight(void **state)
{
    static const char *const decks[] = {
        "bodies:\n"
        "  arm:\n" BEAM "    modes: 4\n"
        "    points: {end: {station: 0}}\n"
        "constraints: {go: {free: [ground, arm], at: [0, 0]}}\n"
        "initial: {arm.mode1: 0.05, arm.mode2_rate: 2, go.angle_rate: 3, go.x_rate: 0.5, go.y_rate: -0.2}\n"
        "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.3}\nenergy: {delta: 0.1}\n",
        "bodies:\n"
        "  arm:\n"
        "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 6}\n"
        "    sections: [{station: 0, rectangle: [0.03, 0.02]}, {station: 1, rectangle: [0.02, 0.01], twist: 0.5}]\n"
        "    material: steel\n"
        "    modes: 5\n"
        "    masses: {ring: {station: 0.3, mass: 2, inertia: [0.01, 0.005, 0.005]}}\n"
        "    points: {end: {station: 0}}\n"
        "constraints: {go: {free: [ground, arm], at: [0, 0, 0]}}\n"
        "initial: {arm.mode1: 0.03, arm.mode2_rate: 2, arm.mode3_rate: -1, go.omega: [5, -2, 3], go.x_rate: 0.5}\n"
        "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.3}\nenergy: {delta: 0.1}\n"};
    (void)state;
    for (int space = 2; space <= 3; space++) {
        static const char *const x[] = {"arm.x", "arm.y", "arm.z"}, *const v[] = {"arm.vx", "arm.vy", "arm.vz"},
                                 *const a[] = {"arm.ax", "arm.ay", "arm.az"};
        struct opened o;
        double x0[3], v0[3];
        open_deck(&o, decks[space - 2]);
        for (int i = 0; i < space; i++) {
            x0[i] = value(&o, x[i]);
            v0[i] = value(&o, v[i]);
            near(value(&o, a[i]), 0, 1e-9 * 1e4);
        }
        assert_true(fabs(value(&o, "arm.end.ax")) > 1);
        run(&o);
        for (int i = 0; i < space; i++) {
            near(value(&o, v[i]), v0[i], 2e-3);
            near(value(&o, x[i]), x0[i] + .3 * v0[i], 1e-3);
            near(value(&o, a[i]), 0, 1e-9 * 1e4);
        }
        arena_close(o.life);
    }
}

/* A pendulum that bends, its load on a bearing at the end: the same in a planar deck and in the plane of a spatial. */
static void test_plane_in_space(void **state)
{
    struct opened plane, space;
    (void)state;
    open_deck(&plane, "gravity: [0, -9.81]\n"
                      "bodies:\n"
                      "  arm:\n"
                      "    beam: {from: [0, 0], to: [2, 0], elements: 5}\n"
                      "    section: {rectangle: [0.03, 0.03]}\n"
                      "    material: aluminium\n"
                      "    modes: 4\n"
                      "    points: {mid: {station: 0.4}}\n"
                      "  bob: {mass: 0.3, at: [2, -0.1], inertia: 0.002}\n"
                      "constraints:\n"
                      "  pin: {revolute: [ground, arm], at: [0, 0]}\n"
                      "  end: {revolute: [arm, bob], at: [2, 0]}\n"
                      "forces: {stay: {spring: [[0, 1], arm.mid], stiffness: 200, damping: 1}}\n"
                      "initial: {end.angle: 0.4}\n"
                      "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.5, newton_tolerance: 1.0e-12}\n");
    open_deck(&space, "gravity: [0, 0, -9.81]\n"
                      "bodies:\n"
                      "  arm:\n"
                      "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 5}\n"
                      "    section: {rectangle: [0.03, 0.03]}\n"
                      "    material: aluminium\n"
                      "    modes: 9\n"
                      "    points: {mid: {station: 0.4}}\n"
                      "  bob: {mass: 0.3, at: [2, 0, -0.1], inertia: [0.002, 0.002, 0.002]}\n"
                      "constraints:\n"
                      "  pin: {revolute: [ground, arm], at: [0, 0, 0], axis: [0, -1, 0]}\n"
                      "  end: {revolute: [arm, bob], at: [2, 0, 0], axis: [0, -1, 0]}\n"
                      "forces: {stay: {spring: [[0, 0, 1], arm.mid], stiffness: 200, damping: 1}}\n"
                      "initial: {end.angle: 0.4}\n"
                      "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.5, newton_tolerance: 1.0e-12}\n");
    run(&plane);
    run(&space);
    near(value(&space, "pin.angle"), value(&plane, "pin.angle"), 1e-4);
    near(value(&space, "end.angle"), value(&plane, "end.angle"), 1e-3);
    near(value(&space, "arm.mid.dz"), value(&plane, "arm.mid.dy"), 1e-5);
    near(value(&space, "bob.z"), value(&plane, "bob.y"), 1e-4);
    near(value(&space, "arm.z"), value(&plane, "arm.y"), 1e-4);
    near(value(&space, "arm.mid.dy"), 0, 1e-12);
    arena_close(plane.life);
    arena_close(space.life);
}

/* One mode, damped by a force at the tip that reads its rate, q'' + phi c q' + omega^2 q = 0; the run ends when q
 * changes sign, after (pi/2 + asin z)/(omega sqrt(1 - z^2)) with z = phi c/(2 omega). */
static void test_feedback(void **state)
{
    struct opened o;
    struct modes modes;
    (void)state;
    open_deck(&o, "parameters: {c: 4}\n"
                  "bodies:\n"
                  "  arm:\n" BEAM "    modes: 1\n"
                  "    stiffening: false\n"
                  "    points: {tip: {station: 1}}\n"
                  "constraints: {clamp: {fixed: [ground, arm], at: [0, 0]}}\n"
                  "forces: {calm: {force: arm.tip, value: [0, -c*arm.mode1_rate]}}\n"
                  "initial: {arm.mode1: 0.01}\n"
                  "integrate: {scheme: midpoint, step: 1.0e-5, until: {when: \"arm.mode1 < 0\", latest: 1}}\n");
    double phi = value(&o, "arm.tip.dy") / .01, omega = pow(1.87510406871 / L, 2) * sqrt(E * I / (rho * A));
    double z = phi * 4 / (2 * omega);
    near(phi, 2 / sqrt(rho * A * L), 1e-4 * phi); /* a clamped-free mode of mass 1 has 2 at its end */
    assert_int_equal(modes_find(&modes, &o.sim, o.life, &o.report), OK);
    near(modes.mode[0].damping, z, 1e-4 * z);
    run(&o);
    near(o.sim.x.t, (M_PI / 2 + asin(z)) / (omega * sqrt(1 - z * z)), 2e-5 + 1e-4 * o.sim.x.t);
    arena_close(o.life);
}

/* Mass and inertia of a beam as it is drawn, about its centre, body axes: m (h^2 + w^2)/12 and m (L^2 + h^2)/12 of a box,
 * and a disk's own at its centre; the same whether its inertia turns with it or keeps the axes of the frame. */
static void test_weight(void **state)
{
    (void)state;
    for (int stiffening = 0; stiffening < 2; stiffening++) {
        struct opened o;
        char text[800];
        snprintf(
            text, sizeof text,
            "space: 3d\nbodies:\n  arm:\n"
            "    beam: {from: [0, 0, 0], to: [2, 0, 0], elements: 4}\n"
            "    section: {rectangle: [0.2, 0.1]}\n    material: {E: 2.0e+11, nu: 0.3, density: 1000}\n    modes: 2\n"
            "    masses: {disk: {station: 0.5, mass: 4, inertia: [2, 3, 4, 0.1, 0.2, 0.3]}}\n"
            "    stiffening: %s\n"
            "constraints: {clamp: {fixed: [ground, arm], at: [0, 0, 0]}}\n"
            "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n",
            stiffening ? "true" : "false");
        open_deck(&o, text);
        const struct scene_body *arm = &o.scene->body[o.scene->nbody - 1];
        const double m = 40, yy = 0.01, zz = 0.04, is[6] = {yy + zz, 4 + yy, 4 + zz, 0, 0, 0},
                     disk[6] = {2, 3, 4, 0.1, 0.2, 0.3};
        near(arm->mass, m + 4, 1e-12 * m);
        for (int i = 0; i < 6; i++) near(arm->inertia[i], m / 12 * is[i] + disk[i], 1e-9 * m);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_static),         cmocka_unit_test(test_frequencies), cmocka_unit_test(test_free_flight),
        cmocka_unit_test(test_plane_in_space), cmocka_unit_test(test_feedback),    cmocka_unit_test(test_weight),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
