/* t-flexible.c -- flexible bodies from the deck to the records, against closed forms and conservation: static
 * deflection and stress, frequencies, the centre of mass of a free body, the plane against space, energy, sub-cycling
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "flex/file.h"
#include "probe/modes.h"
#include "sim/load.h"
#include "sim/parts.h"

#include <cmocka.h>

struct opened {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
    struct report report;
};

static void write_file(const char *path, const char *head, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f, "%s%s\n", head, text);
    fclose(f);
}

/* beside: the text of body.json in the deck's folder; NULL: none. */
static void open_beside(struct opened *o, const char *text, const char *beside)
{
    char folder[] = "/tmp/t-flexible-XXXXXX", path[60], file[60];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/deck.yaml", folder);
    snprintf(file, sizeof file, "%s/body.json", folder);
    write_file(path, "fmdsub: 1\n", text);
    if (beside) write_file(file, "", beside);
    const struct sim_options options = {.version = "test"};
    o->report = (struct report){0};
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    enum status status = sim_load(&o->scene, path, NULL, diags, o->life, &o->report);
    if (status == OK) status = sim_open(&o->sim, o->scene, &o->scene->integrate, &options, diags, o->life, &o->report);
    unlink(path);
    unlink(file);
    rmdir(folder);
    if (status == OK) return;
    diags_print(stderr, diags, false);
    fail_msg("%s", o->report.text);
}

static void open_deck(struct opened *o, const char *text)
{
    open_beside(o, text, NULL);
}

/* The column's value now. */
static double value(struct opened *o, const char *name)
{
    struct trouble why;
    const struct catalogue *c = &o->sim.catalogue;
    struct sim *s = &o->sim;
    assert_int_equal(system_see(s->system, s->x.q, s->x.v, s->x.t, SEE_MOTION | SEE_ACCELERATION | SEE_ENERGY, &why),
                     OK);
    for (int i = 0; i < c->n; i++)
        if (strcmp(c->column[i].name, name) == 0) return record_value(s, &c->origin[i]);
    fail_msg("no column %s", name);
    return 0;
}

static void run(struct opened *o)
{
    enum status status = sim_run(&o->sim, NULL, &o->report);
    if (status != OK) fail_msg("%s", o->report.text);
}

static void near(double x, double want, double within)
{
    if (fabs(x - want) <= within) return;
    fail_msg("%.17g, should be %.17g within %g", x, want, within);
}

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

static const char swing[] = "gravity: [0, -9.81]\n"
                            "bodies:\n"
                            "  base: {mass: 5, at: [0, 0], inertia: 0.1}\n"
                            "  arm:\n"
                            "    beam: {from: [0, 0], to: [1, 0], elements: 6}\n"
                            "    section: {rectangle: [0.02, 0.006]}\n"
                            "    material: steel\n"
                            "    modes: 3\n"
                            "constraints:\n"
                            "  track: {prismatic: [ground, base], at: [0, 0], axis: [1, 0]}\n"
                            "  pin: {revolute: [base, arm], at: [0, 0]}\n"
                            "forces: {stay: {spring: pin, stiffness: 30}}\n"
                            "initial: {arm.mode1: 0.02}\n"
                            "partition: {fast: [arm]}\n";

static double at_end(const char *integrate, const char *column, double *residual)
{
    struct opened o;
    char text[2000];
    snprintf(text, sizeof text, "%sintegrate: {%s, until: 0.05}\n", swing, integrate);
    open_deck(&o, text);
    run(&o);
    double x = value(&o, column);
    *residual = o.sim.ledger.worst / o.sim.ledger.norm;
    arena_close(o.life);
    return x;
}

/* Sub-cycling of the elastic coordinates converges to the same motion; the schemes' residuals of the balance. */
static void test_rates(void **state)
{
    static const char *const columns[] = {"arm.mode1", "pin.angle", "track.displacement"};
    static const double size[] = {.02, .02, 2e-3};
    (void)state;
    for (int i = 0; i < 3; i++) {
        double residual, explicit_one = at_end("scheme: dopri5, tolerance: 1.0e-9", columns[i], &residual);
        double error[2];
        near(residual, 0, 1e-6);
        for (int k = 0; k < 2; k++) {
            const char *text =
                k ? "scheme: subcycle, step: 2.0e-5, ratio: 5" : "scheme: subcycle, step: 4.0e-5, ratio: 5";
            error[k] = fabs(at_end(text, columns[i], &residual) - explicit_one);
            near(residual, 0, 5e-4);
        }
        assert_true(error[1] < 1e-2 * size[i]);
        assert_true(error[1] < error[0] / 2.5);
        near(at_end("scheme: midpoint, step: 2.0e-5", columns[i], &residual), explicit_one, 1e-2 * size[i]);
        near(residual, 0, 1e-5);
    }
}

/* A flexible coupler: wherever its loop is cut, the same motion. */
static void test_cut(void **state)
{
    static const char deck[] = "gravity: [0, -9.81]\n"
                               "bodies:\n"
                               "  crank: {mass: 1, inertia: 0.1, at: [0, 0.25]}\n"
                               "  rod:\n"
                               "    beam: {from: [0, 0.5], to: [2, 1], elements: 6}\n"
                               "    section: {circle: 0.015}\n"
                               "    material: steel\n"
                               "    modes: 3\n"
                               "    points: {mid: {station: 0.5}}\n"
                               "  rocker: {mass: 1, inertia: 0.1, at: [2, 0.5]}\n"
                               "constraints:\n"
                               "  a: {revolute: [ground, crank], at: [0, 0]%s}\n"
                               "  b: {revolute: [crank, rod], at: [0, 0.5]%s}\n"
                               "  c: {revolute: [rod, rocker], at: [2, 1]%s}\n"
                               "  d: {revolute: [rocker, ground], at: [2, 0]%s}\n"
                               "forces: {push: {torque: crank, value: -3}}\n"
                               "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.4}\n";
    double x[4], y[4], f[4];
    (void)state;
    for (int cut = 0; cut < 4; cut++) {
        static const char *const words[] = {"", ", loop: true"};
        struct opened o;
        char text[2000];
        snprintf(text, sizeof text, deck, words[cut == 0], words[cut == 1], words[cut == 2], words[cut == 3]);
        open_deck(&o, text);
        assert_int_equal(o.sim.stepper.ode->n, 3 + 3 + 3 - 2);
        run(&o);
        near(o.sim.ledger.worst, 0, 1e-4 * o.sim.ledger.norm);
        assert_true(system_constraint_worst(o.sim.system) < 1e-9);
        x[cut] = value(&o, "rod.x");
        y[cut] = value(&o, "rod.mid.y");
        f[cut] = value(&o, "d.fx");
        arena_close(o.life);
    }
    for (int cut = 1; cut < 4; cut++) {
        near(x[cut], x[0], 1e-7);
        near(y[cut], y[0], 1e-7);
        near(f[cut], f[0], 1); /* the rod's 7e7 N/m make 0.7 N of 1e-8 m */
    }
}

/* A moment rolls a beam up to a circle of radius 2 L/pi: segments follow it, at second order in their length. */
static void test_segments(void **state)
{
    double error[2], radius = 2 * L / M_PI;
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct opened o;
        char text[1000];
        snprintf(text, sizeof text,
                 "parameters: {N: %d}\n"
                 "bodies:\n"
                 "  arm:\n"
                 "    beam: {from: [0, 0], to: [2, 0], elements: 2*N}\n"
                 "    section: {area: 6.0e-4, Iz: 2.0e-8, y: 0.01}\n"
                 "    material: {E: 2.0e+11, density: 8000}\n"
                 "    modes: 1\n"
                 "    segments: N\n"
                 "    points: {mid: {station: 0.5}}\n"
                 "    stress: {third: {station: 0.34, corner: bottom}}\n"
                 "  load: {mass: 0.1, inertia: 1.0e-3, at: [2, 0]}\n"
                 "constraints:\n"
                 "  clamp: {fixed: [ground, arm1], at: [0, 0]}\n"
                 "  grip: {fixed: [arm%d, load], at: [2, 0]}\n"
                 "forces: {turn: {torque: load, value: pi/2*2.0e+11*2.0e-8/2}}\n"
                 "initial: {static: true}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}\n",
                 k ? 16 : 8, k ? 16 : 8);
        open_deck(&o, text);
        error[k] = hypot(value(&o, "load.x") - radius, value(&o, "load.y") - radius);
        near(value(&o, "load.angle"), M_PI / 2, 1e-9);
        near(value(&o, "arm.mid.x"), radius * sin(M_PI / 4), error[k]);
        near(value(&o, "arm.mid.y"), radius * (1 - cos(M_PI / 4)), error[k]);
        near(value(&o, k ? "arm6.third.bending" : "arm3.third.bending"), M_PI / 2 * E / L * .01, 1e-6 * E / L);
        near(value(&o, "arm_1.mz"), value(&o, "arm_7.mz"), 1e-6 * fabs(value(&o, "arm_1.mz")));
        arena_close(o.life);
    }
    assert_true(error[0] < 1e-3 * L && error[1] < error[0] / 3.5);
}

static const char turning[] = "constraints:\n"
                              "  shaft: {revolute: [ground, hub], at: [0, 0, 0], axis: [0, 0, 1]}\n"
                              "  clamp: {fixed: [hub, arm], at: [0, 0.5, 0]}\n"
                              "  end: {spherical: [arm, bob], at: [0, 1.7, 0.9]}\n"
                              "forces: {push: {force: arm.mid, value: [5, 0, 1]}}\n"
                              "initial: {shaft.angle_rate: 2, arm.mode2: 0.001}\n"
                              "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.1}\n"
                              "energy: {delta: 0.1}\n";

/* A beam, and the same reduced body from a file: the same motion. */
static void test_file(void **state)
{
    static const char hub[] = "gravity: [0, 0, -9.81]\n"
                              "bodies:\n"
                              "  hub: {mass: 3, inertia: [0.1, 0.1, 0.1], at: [0, 0, 0]}\n"
                              "  bob: {mass: 0.5, inertia: [0.01, 0.01, 0.01], at: [0, 1.7, 0.8]}\n";
    static const char *const columns[] = {"shaft.angle", "arm.mid.x", "arm.mid.dz", "arm.root.von_mises",
                                          "bob.z",       "end.fz",    "arm.x",      "arm.qx"};
    struct opened beam, file;
    char text[3000];
    (void)state;
    snprintf(text, sizeof text,
             "%s  arm:\n"
             "    beam: {from: [0, 0.5, 0], to: [0, 1.7, 0.9]}\n"
             "    sections: [{station: 0, rectangle: [0.03, 0.02]}, {station: 1, rectangle: [0.02, 0.01]}]\n"
             "    material: aluminium\n"
             "    modes: 4\n"
             "    damping: {ratio: 0.01}\n"
             "    points: {mid: {station: 0.4}}\n"
             "    stress: {root: {station: 0, corner: top}}\n%s",
             hub, turning);
    open_deck(&beam, text);
    const struct scene_body *arm = &beam.scene->body[3];
    const double *c = arm->at, mesh[3] = {0.1, -0.2, 0.3};
    arm->flex->node[2].name = "mid"; /* behind two interfaces */
    double origin[3];
    for (int i = 0; i < 3; i++) {
        origin[i] = c[i];
        for (int k = 0; k < 3; k++) origin[i] -= arm->R[i + 3 * k] * mesh[k];
    }
    snprintf(
        text, sizeof text,
        "%s  arm: {flexible: body.json, origin: [%.17g, %.17g, %.17g], orient: {z: [%.17g, %.17g, %.17g], x: [%.17g, "
        "%.17g, %.17g]}, points: {again: mid}}\n%s",
        hub, origin[0], origin[1], origin[2], arm->R[6], arm->R[7], arm->R[8], arm->R[0], arm->R[1], arm->R[2],
        turning);
    open_beside(&file, text, flex_file_text(arm->flex, mesh, beam.life));
    run(&beam);
    run(&file);
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        double x = value(&beam, columns[i]);
        assert_true(x != 0);
        near(value(&file, columns[i]), x, 1e-7 * fabs(x));
    }
    near(value(&file, "arm.again.y"), value(&file, "arm.mid.y"), 0);
    arena_close(beam.life);
    arena_close(file.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_static),      cmocka_unit_test(test_frequencies),
        cmocka_unit_test(test_free_flight), cmocka_unit_test(test_plane_in_space),
        cmocka_unit_test(test_feedback),    cmocka_unit_test(test_rates),
        cmocka_unit_test(test_cut),         cmocka_unit_test(test_file),
        cmocka_unit_test(test_segments),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
