/* t-mirror.c -- modes out of a scene's plane are left out where its mirror leaves the scene as it is, and only there: one thing
 * is changed at a time, and a run with these modes says whether it moves them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include "unit/decks.h"

#include <cmocka.h>

/* In the plane z = 0.3: a beam on a pin, a body on its end, which a rod holds and a spring pulls. */
static const char scene[] = "fmdsub: 1\n"
                            "gravity: [0, -9.81, 0]\n"
                            "bodies:\n"
                            "  arm:\n"
                            "    beam: {from: [0, 0, 0.3], to: [1, 0, 0.3], elements: 8}\n"
                            "    section: {rectangle: [0.02, 0.01]}\n"
                            "    material: steel\n"
                            "    modes: 6\n"
                            "    points: {middle: {station: 0.5}, tip: {station: 1}}\n"
                            "  bob:\n"
                            "    mass: 1\n"
                            "    inertia: [0.01, 0.02, 0.025, 0, 0, 0]\n"
                            "    at: [1.2, -0.1, 0.3]\n"
                            "    points: {end: [0, -0.1, 0], side: [0, -0.1, 0.05]}\n"
                            "constraints:\n"
                            "  pin: {revolute: [ground, arm], at: [0, 0, 0.3], axis: [0, 0, 1]}\n"
                            "  knee: {revolute: [arm, bob], at: [1, 0, 0.3], axis: [0, 0, 1]}\n"
                            "  rod: {distance: [[0.5, -1, 0.3], bob.end]}\n"
                            "forces:\n"
                            "  spring: {spring: [[0.3, 1, 0.3], arm.middle], stiffness: 100}\n"
                            "initial: {pin.angle: 0.1}\n"
                            "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}\n"
                            "output: {every: 0.01, columns: [pin.angle]}\n";

enum { MOST = 40 };
static bool is_odd[MOST]; /* modes of the arm */

static void open_scene(struct opened *o, const char *set, bool whole)
{
    const char *const sets[] = {set, "effects.out_of_plane=true"};
    char path[] = "/tmp/t-mirror-XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0 && write(fd, scene, sizeof scene - 1) == (ssize_t)(sizeof scene - 1));
    close(fd);
    open_path(o, path, whole ? 2 : 1, sets);
    unlink(path);
    print_wrong(o);
    assert_int_equal(o->status, OK);
}

/* How far the odd modes come in a run with all of them, over the even ones. */
static double moved(const char *set)
{
    struct opened o;
    double odd = 0, even = 0;
    open_scene(&o, set, true);
    assert_null(o.sim.whole);
    assert_int_equal(sim_run(&o.sim, NULL, &o.report), OK);
    const struct model_body *b = &o.sim.model->body[1];
    for (int k = 0; k < b->nmode; k++) {
        double *most = is_odd[k] ? &odd : &even;
        *most = fmax(*most, fabs(o.sim.x.q[b->mode_q[k]]));
    }
    shut(&o);
    assert_true(even > 1e-6);
    return odd / even;
}

static bool left_out(const char *set)
{
    struct opened o;
    open_scene(&o, set, false);
    const bool left = o.sim.whole;
    shut(&o);
    return left;
}

/* The beam bends in the plane, stretches, bends out of it and is wrung: the last two are left out. */
static void test_which(void **state)
{
    struct opened o;
    int count[2] = {0, 0};
    (void)state;
    open_scene(&o, "title=Which", false);
    assert_non_null(o.sim.whole);
    const struct model_body *b = &o.sim.whole->body[1];
    assert_true(b->nmode < MOST);
    for (int k = 0; k < b->nmode; k++) {
        double out = 0, in = 0; /* of the plane, at nodes */
        is_odd[k] = o.sim.from_whole[b->mode_v[k]] < 0;
        for (int i = 0; i < b->flex->nnode; i++) {
            const double *phi = b->flex->node[i].phi + 3 * k, *psi = b->flex->node[i].psi + 3 * k;
            out = fmax(out, fmax(fabs(phi[2]), fmax(fabs(psi[0]), fabs(psi[1]))));
            in = fmax(in, fmax(fabs(psi[2]), fmax(fabs(phi[0]), fabs(phi[1]))));
        }
        assert_true(is_odd[k] ? in < 1e-9 * out : out < 1e-9 * in);
        count[is_odd[k]]++;
    }
    assert_true(count[0] > 3 && count[1] > 3);
    assert_int_equal(o.sim.model->body[1].nmode, count[0]);
    shut(&o);
}

static void test_mirrored(void **state)
{
    static const char *const set[] = {
        "title=As it is",
        "gravity=[0.5, -9.81, 0]",
        "bodies.bob.inertia=[0.01, 0.02, 0.025, 0.004, 0, 0]",
        "constraints.rod={point-on-line: [ground, bob], at: [1.2, -0.2, 0.3], axis: [0, 1, 0]}",
        "forces.push={force: arm.tip, value: [\"1\", \"2\", \"0\"]}",
        "forces.push={force: arm.tip, value: [\"1\", \"2\", \"0\"], frame: body}",
        "forces.push={force: bob.end, value: [\"1\", \"2\", \"0\"]}",
        "forces.push={torque: arm.tip, value: [\"0\", \"0\", \"1\"]}",
        "forces.push={torque: bob, value: [\"0\", \"0\", \"1\"], frame: body}",
        "forces.push={torque: knee, value: 1}",
        "forces.push={torque: knee, value: arm.mode2}",
        "forces.push={torque: knee, value: pin.angle + knee.angle_rate}",
        "measures.up={displacement: [[0, 0, 0.3], arm.tip], axis: [0, 1, 0]}",
        "initial={pin.angle: 0.1, arm.mode2: 1.0e-3}",
    };
    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        const bool left = left_out(set[i]);
        const double odd = moved(set[i]);
        if (!left || odd > 1e-12) fail_msg("%s: left out %d, moved %g", set[i], left, odd);
    }
}

static void test_broken(void **state)
{
    static const char *const set[] = {
        "gravity=[0, -9.81, 0.1]",
        "bodies.arm.beam={from: [0, 0, 0.3], to: [1, 0, 0.3], elements: 8, up: [0, 0.2, 1]}",
        "bodies.bob.at=[1.2, -0.1, 0.31]",
        "bodies.bob.inertia=[0.01, 0.02, 0.025, 0, 0.004, 0]",
        "bodies.bob.inertia=[0.01, 0.02, 0.025, 0, 0, 0.004]",
        "constraints.rod={distance: [[0.5, -1, 0.35], bob.side]}",
        "constraints.rod={distance: [[0.5, -1, 0.3], bob.side]}",
        "forces.pull={spring: [[0.5, -1, 0.35], bob.side], stiffness: 100, rest: 0.5}",
        "forces.spring={spring: [[0.5, -1, 0.35], bob.side], stiffness: 100, rest: 0.5}",
        "forces.pull={spring: [[0.5, -1, 0.3], bob.side], stiffness: 100, rest: 0.5}",
        "forces.push={force: arm.tip, value: [\"0\", \"0\", \"1\"]}",
        "forces.push={force: arm.tip, value: [\"0\", \"0\", \"1\"], frame: body}",
        "forces.push={force: bob.side, value: [\"0\", \"1\", \"0\"]}",
        "forces.push={torque: arm.tip, value: [\"1\", \"0\", \"0\"]}",
        "forces.push={torque: bob, value: [\"0\", \"1\", \"0\"], frame: body}",
        "initial={pin.angle: 0.1, arm.mode1: 1.0e-3}",
        "initial={pin.angle: 0.1, arm.mode1_rate: 1.0e-2}",
    };
    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        const bool left = left_out(set[i]);
        const double odd = moved(set[i]);
        if (left || !(odd > 1e-7)) fail_msg("%s: left out %d, moved %g", set[i], left, odd);
    }
}

/* Nothing bends out of the plane, but a force asks for the mode, or a measure for points on both sides. */
static void test_asked_for(void **state)
{
    static const char *const set[] = {
        "forces.push={torque: knee, value: arm.mode1}",
        "forces.push={torque: knee, value: arm.mode1_rate}",
        "measures.up={displacement: [[0, 0, 0.3], bob.side], axis: [0, 1, 0]}",
        "measures.up={displacement: [[0, 0, 0.35], bob.end], axis: [0, 1, 0]}",
    };
    (void)state;
    for (size_t i = 0; i < sizeof set / sizeof *set; i++) {
        const bool left = left_out(set[i]);
        if (left) fail_msg("%s: left out", set[i]);
        assert_true(moved(set[i]) < 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_which),
        cmocka_unit_test(test_mirrored),
        cmocka_unit_test(test_broken),
        cmocka_unit_test(test_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
