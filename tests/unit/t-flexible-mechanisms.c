/* t-flexible-mechanisms.c -- flexible bodies among others: sub-cycling of their coordinates, loops through them, beams
 * in segments, bodies from files */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "flex/file.h"
#include "unit/opened.h"

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
    const double L = 2, E = 2e11;
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

/* A loop between two nodes of one flexible body, whose modes are on both of its ways; cut at either end of a strut. */
static void test_two_nodes(void **state)
{
    static const char bodies[] = "gravity: [0, -9.81]\n"
                                 "bodies:\n"
                                 "  stem:\n"
                                 "    beam: {from: [0, 0], to: [1, 0], elements: 4}\n"
                                 "    section: {rectangle: [0.01, 0.004]}\n"
                                 "    material: aluminium\n"
                                 "    modes: 3\n"
                                 "    points: {near: {station: 0.25}, tip: {station: 1}}\n"
                                 "  left: {mass: 0.2, inertia: 0.01, at: [0.35, 0.3]}\n"
                                 "  right: {mass: 0.3, inertia: 0.01, at: [0.75, 0.3], points: {eye: [0, 0.1]}}\n"
                                 "constraints:\n"
                                 "  foot: {revolute: [ground, stem], at: [0, 0]}\n"
                                 "  a: {revolute: [stem, left], at: [0.25, 0]}\n";
    static const char *const ends[2] = {"  b: {revolute: [stem, right], at: [1, 0]}\n",
                                        "  top: {revolute: [left, right], at: [0.5, 0.6]}\n"};
    static const char *const columns[] = {"foot.angle", "stem.mode1", "stem.tip.dy", "right.eye.x", "a.angle_rate"};
    struct opened cut[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        char text[2000];
        snprintf(text, sizeof text, "%s%s%sintegrate: {scheme: midpoint, step: 2.5e-5, until: 0.05}\n", bodies, ends[i],
                 ends[1 - i]);
        open_deck(&cut[i], text);
        run(&cut[i]);
        assert_true(cut[i].sim.ledger.worst < 1e-6 * value(&cut[i], "energy.elastic"));
    }
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++) {
        const double x = value(&cut[0], columns[i]);
        assert_true(x != 0);
        near(value(&cut[1], columns[i]), x, 1e-5 * fabs(x));
    }
    for (int i = 0; i < 2; i++) arena_close(cut[i].life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rates), cmocka_unit_test(test_cut),       cmocka_unit_test(test_segments),
        cmocka_unit_test(test_file),  cmocka_unit_test(test_two_nodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
