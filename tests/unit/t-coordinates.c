/* t-coordinates.c -- coordinates of joints that close loops: as in the tree, and over whole turns */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "unit/rides.h"

#include <cmocka.h>

static void ride(struct ride *r, const char *text)
{
    ride_open(r, text);
    if (r->status != OK) fail_msg("%s\n%s", r->report.text, text);
    assert_true(r->n > 2);
}

/* Largest difference of a column in two runs, as a share of its largest value. */
static double apart(const struct ride *a, const struct ride *b, const char *name, double sign)
{
    double worst = 0, most = 1e-3;
    for (int i = 0; i < a->n; i++) {
        worst = fmax(worst, fabs(ride_at(a, i, name) - sign * ride_at(b, i, name)));
        most = fmax(most, fabs(ride_at(b, i, name)));
    }
    return worst / most;
}

/* Both runs say the same of all coordinates of joint J; quaternions have either sign. */
static void compare(const struct ride *loop, const struct ride *tree, const char *text)
{
    assert_int_equal(loop->n, tree->n);
    assert_true(loop->sim.model->joint_of[0] < 0 && tree->sim.model->joint_of[0] >= 0);
    int found = 0;
    for (int i = 1; i < loop->sim.chosen.n; i++) {
        const char *name = loop->sim.columns[i].name;
        const bool quaternion = strncmp(name, "J.q", 3) == 0;
        const double sign = quaternion && ride_last(loop, "J.qw") * ride_last(tree, "J.qw") < 0 ? -1 : 1;
        const double off = apart(loop, tree, name, sign);
        if (!(off < 2e-7)) fail_msg("%s: apart by %.2g of it\n%s", name, off, text);
        assert_string_equal(loop->sim.columns[i].unit, tree->sim.columns[i].unit);
        found++;
    }
    assert_true(found >= 3);
}

/* In space: a crank, a rod between two balls, a last body that joint J holds to the ground.  The loop is closed by J, or
 * by the second ball. */
static const char chain[] = "fmdsub: 1\n"
                            "gravity: [1, 2, -9.81]\n"
                            "bodies:\n"
                            "  last: {mass: 1, at: [1.1, 0.4, 0.2], inertia: [0.04, 0.03, 0.05]}\n"
                            "  crank: {mass: 1, at: [0.1, 0.1, 0.2], inertia: [0.02, 0.03, 0.02]}\n"
                            "  rod: {mass: 0.5, at: [0.6, 0.2, 0.5], inertia: [0.01, 0.04, 0.04]}\n"
                            "constraints:\n"
                            "  J: {%s, at: [1.3, 0.3, 0.1]%s}\n"
                            "  hub: {revolute: [ground, crank], at: [0, 0, 0], axis: [0.2, 1, 0.1]}\n"
                            "  one: {spherical: [crank, rod], at: [0.2, 0.1, 0.4]}\n"
                            "  two: {spherical: [rod, last], at: [1, 0.3, 0.6]%s}\n"
                            "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: 0.4}\n"
                            "output: {every: 0.05, columns: [%s]}\n";

static void as_in_the_tree_in_space(void **state)
{
    static const struct {
        const char *joint, *columns;
    } tries[] = {
        {"revolute: [ground, last], axis: [1, 2, 0.5]", "J.angle*"},
        {"revolute: [last, ground], axis: [1, 2, 0.5]", "J.angle*"},
        {"prismatic: [ground, last], axis: [1, 0.1, 0.5]", "J.displacement*"},
        {"prismatic: [last, ground], axis: [1, 0.1, 0.5]", "J.displacement*"},
        {"cylindrical: [ground, last], axis: [1, 1, 0.5]", "J.angle*, J.displacement*"},
        {"cylindrical: [last, ground], axis: [1, 1, 0.5]", "J.angle*, J.displacement*"},
        {"screw: [ground, last], axis: [1, 1, 0.5], pitch: 0.8", "J.angle*"},
        {"screw: [last, ground], axis: [1, 1, 0.5], pitch: -0.8", "J.angle*"},
        {"universal: [ground, last], axis: [1, 0, 1], axis2: [1, 1, -1]", "J.angle*"},
        {"universal: [last, ground], axis: [1, 0, 1], axis2: [1, 1, -1]", "J.angle*"},
        {"spherical: [ground, last]", "J.q?, J.omega*"},
        {"planar: [ground, last], axis: [0.1, 0.2, 1], axis2: [1, 0.5, -0.2]", "J.x*, J.y*, J.angle*"},
        {"free: [ground, last]", "J.x*, J.y*, J.z*, J.q?, J.omega*"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        char text[2][2000];
        struct ride loop, tree;
        for (int cut = 0; cut < 2; cut++)
            snprintf(text[cut], sizeof text[cut], chain, tries[i].joint, cut ? "" : ", loop: true",
                     cut ? ", loop: true" : "", tries[i].columns);
        ride(&loop, text[0]);
        ride(&tree, text[1]);
        compare(&loop, &tree, tries[i].joint);
        ride_close(&loop);
        ride_close(&tree);
    }
}

static void as_in_the_tree_in_the_plane(void **state)
{
    static const char deck[] = "fmdsub: 1\n"
                               "gravity: [1, -9.81]\n"
                               "bodies:\n"
                               "  last: {mass: 1, at: [1.1, 0.4], inertia: 0.04, orient: 0.3}\n"
                               "  crank: {mass: 1, at: [0.1, 0.1], inertia: 0.02}\n"
                               "  rod: {mass: 0.5, at: [0.6, 0.2], inertia: 0.04}\n"
                               "constraints:\n"
                               "  J: {%s, at: [1.3, 0.1]%s}\n"
                               "  hub: {revolute: [ground, crank], at: [0, 0]}\n"
                               "  one: {revolute: [crank, rod], at: [0.2, 0.1]}\n"
                               "  two: {revolute: [rod, last], at: [1, 0.3]%s}\n"
                               "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: 0.4}\n"
                               "output: {every: 0.05, columns: [%s]}\n";
    static const struct {
        const char *joint, *columns;
    } tries[] = {
        {"revolute: [ground, last]", "J.angle*"},
        {"revolute: [last, ground]", "J.angle*"},
        {"prismatic: [ground, last], axis: [1, 0.2]", "J.displacement*"},
        {"prismatic: [last, ground], axis: [1, 0.2]", "J.displacement*"},
        {"planar: [ground, last]", "J.x*, J.y*, J.angle*"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof tries / sizeof *tries; i++) {
        char text[2][2000];
        struct ride loop, tree;
        for (int cut = 0; cut < 2; cut++)
            snprintf(text[cut], sizeof text[cut], deck, tries[i].joint, cut ? "" : ", loop: true",
                     cut ? ", loop: true" : "", tries[i].columns);
        ride(&loop, text[0]);
        ride(&tree, text[1]);
        compare(&loop, &tree, tries[i].joint);
        ride_close(&loop);
        ride_close(&tree);
    }
}

/* Two shafts at an angle of 0.5 rad, joined by a cross: the second one's bearing closes the loop.  Its angle is
 * atan2(sin a cos 0.5, cos a), through turn after turn, whatever the scheme and however far apart the records are. */
static const char shafts[] = "fmdsub: 1\n"
                             "parameters: {b: 0.5}\n"
                             "bodies:\n"
                             "  first: {mass: 1, at: [-0.2, 0, 0], inertia: [0.01, 0.01, 0.01]}\n"
                             "  second: {mass: 1, at: [0.2*cos(b), 0.2*sin(b), 0], inertia: [0.02, 0.02, 0.02]}\n"
                             "constraints:\n"
                             "  in: {revolute: [ground, first], at: [-0.3, 0, 0], axis: [1, 0, 0]}\n"
                             "  cross: {universal: [first, second], at: [0, 0, 0], axis: [0, 0, 1],"
                             " axis2: [-sin(b), cos(b), 0]}\n"
                             "  out: {loop: true%s, %s: [ground, second], at: [0.3*cos(b), 0.3*sin(b), 0],"
                             " axis: [cos(b), sin(b), 0]}\n"
                             "drives: {motor: {drive: in.angle, value: 9*t}}\n"
                             "integrate: {%s, until: %s}\n"
                             "output: {every: %s, columns: [in.angle, \"out.angle*\", out.fx]}\n";

static double beside(double x, double y) /* the angle y, or y and whole turns, beside x */
{
    return y + 2 * M_PI * round((x - y) / (2 * M_PI));
}

static void angles_go_on_over_whole_turns(void **state)
{
    static const char *const how[][2] = {{"scheme: midpoint, step: 2.0e-3", "0.01"},
                                         {"scheme: rk4, step: 1.0e-2", "1"},
                                         {"scheme: dopri5, tolerance: 1.0e-8", "1"}};
    (void)state;
    for (int i = 0; i < 6; i++) {
        struct ride r;
        char text[2000];
        snprintf(text, sizeof text, shafts, "", i % 2 ? "cylindrical" : "revolute", how[i / 2][0], "2", how[i / 2][1]);
        ride(&r, text);
        for (int k = 0; k < r.n; k++) {
            const double a = ride_at(&r, k, "in.angle"), want = beside(a, atan2(sin(a) * cos(.5), cos(a)));
            assert_true(fabs(ride_at(&r, k, "out.angle") - want) < 1e-6);
        }
        assert_true(ride_last(&r, "out.angle") > 17);
        ride_close(&r);
    }
}

/* The end of a run and the range of a joint read them, too. */
static void conditions_and_ranges_read_them(void **state)
{
    struct ride r;
    char text[2000];
    (void)state;
    snprintf(text, sizeof text, shafts, ", range: [-1, 6]", "revolute", "scheme: midpoint, step: 1.0e-3",
             "{when: \"out.angle > 12\", latest: 2}", "0.1");
    ride(&r, text);
    assert_true(r.sim.watch.met && r.sim.watch.range[0].side == 1);
    assert_true(ride_last(&r, "out.angle") > 12 && ride_last(&r, "out.angle") < 12.02);
    ride_close(&r);
}

/* Axes that the deck gives nearly at right angles are made so: all that follows takes them for a frame. */
static void axes_stand_at_right_angles(void **state)
{
    struct ride r;
    (void)state;
    ride(&r, "fmdsub: 1\n"
             "bodies: {b: {mass: 1, inertia: [1, 1, 1], at: [0, 0, 0]}}\n"
             "constraints: {J: {universal: [ground, b], at: [0, 0, 0], axis: [1, 0, 0], axis2: [8.0e-7, 1, 0]}}\n"
             "integrate: {scheme: midpoint, step: 0.1, until: 1}\n");
    const double *E = r.sim.scene->joint[0].E;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const double dot = E[3 * i] * E[3 * j] + E[3 * i + 1] * E[3 * j + 1] + E[3 * i + 2] * E[3 * j + 2];
            assert_true(fabs(dot - (i == j)) < 1e-15);
        }
    ride_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_in_the_tree_in_space),       cmocka_unit_test(as_in_the_tree_in_the_plane),
        cmocka_unit_test(angles_go_on_over_whole_turns), cmocka_unit_test(conditions_and_ranges_read_them),
        cmocka_unit_test(axes_stand_at_right_angles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
