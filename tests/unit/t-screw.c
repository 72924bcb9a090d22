/* t-screw.c -- screw joints, in the tree and closing loops: against closed forms, and against a cylindrical joint whose
 * coordinates a rack ties.  t-spatial, t-flex-spatial, t-linkage and t-drive have them in random mechanisms. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/rides.h"

#include <cmocka.h>

static const double TURN = 6.283185307179586;

static void open_ride(struct ride *r, const char *text)
{
    ride_open(r, text);
    if (r->status != OK) fail_msg("%s", r->report.text);
}

static void near_to(double a, double b, double within)
{
    if (!(fabs(a - b) <= within)) fail_msg("%.15g should be %.15g within %g", a, b, within);
}

/* --- a nut on a fixed screw ----------------------------------------------------------------------- */

/* With p in m/rad, e along the axis: (I + m p^2) theta'' = m p g.e; the thread bears e.F = m (p theta'' - g.e) and the
 * moment I theta''.  Exact under midpoint, where theta'' is constant. */
static void a_nut_falls_along_its_screw(void **state)
{
    static const struct {
        double e[3], pitch;
    } cases[] = {{{0, 0, 1}, .02}, {{0, 0, 1}, -.3}, {{.6, 0, .8}, .15}, {{.48, -.6, -.64}, 1e-3}};
    const double m = 2, I = 3e-3, g = 9.81, t = .5;
    char text[1000];
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double *e = cases[i].e, pitch = cases[i].pitch, p = pitch / TURN, along = -g * e[2];
        const double al = m * p * along / (I + m * p * p), force = m * (p * al - along);
        struct ride r;
        snprintf(text, sizeof text,
                 "fmdsub: 1\n"
                 "gravity: [0, 0, -%.17g]\n"
                 "bodies: {nut: {mass: 2, inertia: [%.17g, %.17g, %.17g], at: [1, 2, 3]}}\n"
                 "constraints: {thread: {screw: [ground, nut], at: [1, 2, 3], axis: [%.17g, %.17g, %.17g], pitch: "
                 "%.17g}}\n"
                 "integrate: {scheme: midpoint, step: 0.01, until: 0.5}\n"
                 "output: {every: 0.5, columns: ['thread.*', nut.x, nut.z, energy.residual]}\n",
                 g, I, I, I, e[0], e[1], e[2], pitch);
        open_ride(&r, text);
        near_to(ride_last(&r, "thread.angle"), al * t * t / 2, 1e-12 * fabs(al));
        near_to(ride_last(&r, "thread.angle_rate"), al * t, 1e-12 * fabs(al));
        near_to(ride_last(&r, "thread.angle_accel"), al, 1e-12 * fabs(al));
        near_to(ride_last(&r, "nut.x"), 1 + e[0] * p * al * t * t / 2, 1e-12);
        near_to(ride_last(&r, "nut.z"), 3 + e[2] * p * al * t * t / 2, 1e-12);
        double f[3], n[3];
        for (int k = 0; k < 3; k++) {
            f[k] = ride_last(&r, (const char *[]){"thread.fx", "thread.fy", "thread.fz"}[k]);
            n[k] = ride_last(&r, (const char *[]){"thread.mx", "thread.my", "thread.mz"}[k]);
        }
        const double fe = f[0] * e[0] + f[1] * e[1] + f[2] * e[2];
        near_to(fe, force, 1e-11);
        for (int k = 0; k < 3; k++) {
            near_to(f[k] - fe * e[k], (k == 2 ? m * g : 0) - m * g * e[2] * e[k], 1e-11); /* across the axis */
            near_to(n[k], I * al * e[k], 1e-12);
            near_to(n[k], -p * fe * e[k], 1e-12); /* the thread does no work */
        }
        near_to(ride_last(&r, "energy.residual"), 0, 1e-12);
        ride_close(&r);
    }
}

/* --- a nut on a swinging arm ----------------------------------------------------------------------- */

/* The arm swings about a slanting axis; the nut's centre is off the screw's, whose pitch is 1.5 m. */
static void open_arm(struct ride *r, const char *thread, const char *columns)
{
    char text[2000];
    snprintf(text, sizeof text,
             "fmdsub: 1\n"
             "gravity: [0, 0, -9.81]\n"
             "bodies:\n"
             "  arm: {mass: 3, inertia: [0.1, 0.2, 0.15], at: [0.4, 0, 0]}\n"
             "  nut: {mass: 1, inertia: [0.01, 0.02, 0.03], at: [0.5, 0.1, 0.05]}\n"
             "constraints:\n"
             "  pin: {revolute: [ground, arm], at: [0, 0, 0], axis: [0.2, 1, 0.1]}\n"
             "%s"
             "integrate: {scheme: dopri5, tolerance: 1.0e-11, until: 1.5}\n"
             "output: {every: 0.5, columns: [pin.angle, nut.x, nut.y, nut.z, 'nut.v*', 'nut.w*', 'nut.a*', "
             "%s]}\n",
             thread, columns);
    open_ride(r, text);
}

static const char at_and_axis[] = "at: [0.45, 0, 0], axis: [0.7, 0.1, 0.4]";

static const char *threaded(char *to, const char *words, const char *rest)
{
    sprintf(to, "  thread: {%s, %s%s}\n", words, at_and_axis, rest);
    return to;
}

/* All that the nut does, and more. */
static void same_motion(const struct ride *a, const struct ride *b, double within)
{
    assert_int_equal(a->n, 4);
    assert_int_equal(b->n, 4);
    for (int i = 0; i < a->n; i++)
        for (int k = 1; k < a->sim.chosen.n; k++) {
            const char *name = a->sim.columns[k].name;
            if (strncmp(name, "nut.", 4) != 0 && strncmp(name, "pin.", 4) != 0) continue;
            const double x = ride_at(a, i, name), y = ride_at(b, i, name);
            if (!(fabs(x - y) <= within * (1 + fabs(x)))) fail_msg("%s: %.15g and %.15g", name, x, y);
        }
}

/* Either body may come first. */
static void a_rack_on_a_cylinder_is_a_screw(void **state)
{
    static const char *const screws[] = {"screw: [arm, nut]", "screw: [nut, arm]"}, *const cylinders[] = {
                                                                                        "cylindrical: [arm, nut]",
                                                                                        "cylindrical: [nut, arm]"};
    char text[2][400];
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct ride one, other;
        open_arm(&one, threaded(text[0], screws[i], ", pitch: 1.5"), "thread.angle, thread.angle_accel");
        threaded(text[1], cylinders[i], "");
        strcat(text[1], "  tie: {rack: [thread.angle, thread.displacement], radius: 1.5/(2*pi)}\n");
        open_arm(&other, text[1], "thread.angle, thread.angle_accel, thread.displacement");
        same_motion(&one, &other, 1e-9);
        for (int k = 0; k < 4; k++) {
            near_to(ride_at(&one, k, "thread.angle"), ride_at(&other, k, "thread.angle"), 1e-9);
            near_to(ride_at(&one, k, "thread.angle_accel"), ride_at(&other, k, "thread.angle_accel"), 1e-7);
            near_to(ride_at(&one, k, "thread.angle") * 1.5 / TURN, ride_at(&other, k, "thread.displacement"), 1e-9);
        }
        assert_true(fabs(ride_last(&one, "thread.angle")) > 3); /* it did turn */
        ride_close(&one);
        ride_close(&other);
    }
}

/* The same thread as equations, beside a joint that gives the nut all freedoms: motion and what the thread bears.
 * Moments are about the point on the body farther from the ground in the tree, on the second one in a loop. */
static void the_thread_closes_a_loop(void **state)
{
    static const char *const parts[] = {"thread.fx", "thread.fy", "thread.fz", "thread.mx", "thread.my", "thread.mz"};
    static const char *const screws[] = {"screw: [arm, nut]", "screw: [nut, arm]"};
    char text[2][400];
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct ride tree, loop;
        open_arm(&tree, threaded(text[0], screws[i], ", pitch: 1.5"), "'thread.*'");
        threaded(text[1], screws[i], ", pitch: 1.5, loop: true");
        strcat(text[1], "  fly: {free: [ground, nut]}\n");
        open_arm(&loop, text[1], "'thread.*'");
        assert_int_equal(loop.sim.model->nloop, 1);
        assert_int_equal(loop.sim.stepper.ode->n, 2);
        same_motion(&tree, &loop, 1e-8);
        for (int k = 0; k < 4; k++)
            for (int c = 0; c < (i ? 3 : 6); c++)
                near_to(ride_at(&tree, k, parts[c]), ride_at(&loop, k, parts[c]), 1e-6);
        ride_close(&tree);
        ride_close(&loop);
    }
}

/* --- many turns -------------------------------------------------------------------------------------- */

/* A spindle in its bearing, a nut in its guide, and the thread between them closes the loop: hundreds of turns, more
 * than two of them in a step, and the nut stands where the angle has it. */
static void no_turn_is_lost(void **state)
{
    static const char *const schemes[] = {"midpoint", "newmark", "rk4"};
    const double lead = .01, p = lead / TURN, J = 8e-4, m = 20, g = 9.81, t = 2;
    const double al = m * g * p / (J + m * p * p);
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct ride r;
        char text[1000];
        snprintf(text, sizeof text,
                 "fmdsub: 1\n"
                 "gravity: [0, 0, -9.81]\n"
                 "bodies:\n"
                 "  spindle: {mass: 1.5, inertia: [0.01, 0.01, 8.0e-4], at: [0.1, 0.2, 0.5]}\n"
                 "  nut: {mass: 20, inertia: [0.1, 0.1, 0.1], at: [0.15, 0.2, 0.5]}\n"
                 "constraints:\n"
                 "  bearing: {revolute: [ground, spindle], at: [0.1, 0.2, 0.1], axis: [0, 0, 1]}\n"
                 "  guide: {prismatic: [ground, nut], axis: [0, 0, 1]}\n"
                 "  thread: {screw: [spindle, nut], at: [0.1, 0.2, 0.5], axis: [0, 0, 1], pitch: 0.01}\n"
                 "integrate: {scheme: %s, step: 0.02, until: 2}\n"
                 "output: {every: 0.5, columns: [bearing.angle, guide.displacement]}\n",
                 schemes[i]);
        open_ride(&r, text);
        assert_int_equal(r.sim.stepper.ode->n, 1);
        near_to(ride_last(&r, "bearing.angle"), al * t * t / 2, 1e-9 * al);
        for (int k = 0; k < r.n; k++)
            near_to(ride_at(&r, k, "guide.displacement"), -p * ride_at(&r, k, "bearing.angle"), 1e-10);
        ride_close(&r);
    }
}

/* What the start tells of a screw's turns, in and beyond the first, holds: by its angle, by its displacement, by both; and
 * an assembly keeps to the thread that they mean. */
static void turns_at_the_start(void **state)
{
    static const double p = .01 / TURN;
    static const struct {
        const char *initial;
        double angle; /* NAN: between what is given and what it means for the other */
    } starts[] = {{"r.angle: 0.5", .5},
                  {"r.angle: 20", 20},
                  {"r.angle: -2*pi", -TURN},
                  {"r.angle: 2000", 2000},
                  {"p.displacement: 0.05", -5 * TURN},
                  {"p.displacement: -0.003", .3 * TURN},
                  {"r.angle: 4*pi, p.displacement: -0.02", 2 * TURN},
                  {"r.angle: 20, assemble: true", NAN},
                  {"r.angle: 100, assemble: true", NAN}};
    (void)state;
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        struct ride r;
        char text[1000];
        snprintf(text, sizeof text,
                 "fmdsub: 1\n"
                 "bodies:\n"
                 "  spindle: {mass: 1.5, inertia: [0.01, 0.01, 8.0e-4], at: [0.1, 0.2, 0.5]}\n"
                 "  nut: {mass: 20, inertia: [0.1, 0.1, 0.1], at: [0.15, 0.2, 0.5]}\n"
                 "constraints:\n"
                 "  r: {revolute: [ground, spindle], at: [0.1, 0.2, 0.1], axis: [0, 0, 1]}\n"
                 "  p: {prismatic: [ground, nut], axis: [0, 0, 1]}\n"
                 "  s: {screw: [spindle, nut], at: [0.1, 0.2, 0.5], axis: [0, 0, 1], pitch: 0.01, loop: true}\n"
                 "initial: {%s}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.01}\n"
                 "output: {every: 0.01, columns: [r.angle, p.displacement, s.angle]}\n",
                 starts[i].initial);
        open_ride(&r, text);
        const double angle = ride_at(&r, 0, "r.angle"), want = starts[i].angle;
        near_to(ride_at(&r, 0, "s.angle"), -angle, 1e-9 * fmax(1, fabs(angle)));
        near_to(ride_at(&r, 0, "p.displacement"), -p * angle, 1e-12 * fmax(1, fabs(angle)));
        if (!isnan(want)) near_to(angle, want, 1e-9 * fmax(1, fabs(want)));
        if (isnan(want)) assert_true(angle > 18);
        ride_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_nut_falls_along_its_screw), cmocka_unit_test(a_rack_on_a_cylinder_is_a_screw),
        cmocka_unit_test(the_thread_closes_a_loop),    cmocka_unit_test(no_turn_is_lost),
        cmocka_unit_test(turns_at_the_start),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
