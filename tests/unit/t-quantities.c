/* t-quantities.c -- columns that are made of the motion, each against another way to it */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "la/rot.h"
#include "la/vec3.h"
#include "unit/rides.h"
#include "unit/turn.h"

#include <cmocka.h>

static void ride(struct ride *r, const char *text)
{
    ride_open(r, text);
    if (r->status != OK) fail_msg("%s", r->report.text);
    assert_true(r->n > 2);
}

static void near(double x, double want, double within, const char *what, int row)
{
    if (!(fabs(x - want) <= within))
        fail_msg("%s, record %d: %.12g, should be %.12g within %g", what, row, x, want, within);
}

static double component(const struct ride *r, int i, const char *body, const char *quantity, int k)
{
    char name[60];
    snprintf(name, sizeof name, "%s.%s%c", body, quantity, 'x' + k);
    return ride_at(r, i, name);
}

/* The body's orientation, from the quaternion of record i. */
static void orientation(double *R, const struct ride *r, int i, const char *body)
{
    char name[60];
    double q[4];
    snprintf(name, sizeof name, "%s.qw", body);
    q[0] = ride_at(r, i, name);
    for (int k = 0; k < 3; k++) q[1 + k] = component(r, i, body, "q", k);
    quat_matrix(R, q);
}

/* A chain of two bodies in space, by a ball and a universal joint. */
static const char chain[] = "fmdsub: 1\n"
                            "gravity: [0, 0, -9.81]\n"
                            "bodies:\n"
                            "  top: {mass: 2, at: [0.3, 0, 0], inertia: [0.02, 0.05, 0.04]}\n"
                            "  tail: {mass: 1, at: [0.8, 0, 0.1], inertia: [0.01, 0.02, 0.025, 0.003, 0, 0.001]}\n"
                            "constraints:\n"
                            "  ball: {spherical: [ground, top], at: [0, 0, 0]}\n"
                            "  cross: {universal: [top, tail], at: [0.6, 0, 0], axis: [0, 1, 0], axis2: [0, 0, 1]}\n"
                            "initial: {ball.omega: [9, -2, 4], cross.angle1_rate: -3}\n"
                            "integrate: {scheme: dopri5, tolerance: 1.0e-12, until: 0.2}\n";

/* With R1 = exp(phi) R0 phi'' is the angular acceleration, and phi' the angular velocity. */
static void angular_acceleration_is_the_second_difference_of_rotations(void **state)
{
    static const char *const bodies[] = {"top", "tail"};
    const double h = 1e-3;
    struct ride r;
    char text[2000];
    (void)state;
    snprintf(text, sizeof text, "%soutput: {every: 1.0e-3, columns: [top.q*, top.al*, tail.q*, tail.al*]}\n", chain);
    ride(&r, text);
    for (int b = 0; b < 2; b++)
        for (int i = 1; i + 1 < r.n; i++) {
            double R[3][9], turn[9], phi[2][3];
            for (int k = 0; k < 3; k++) orientation(R[k], &r, i - 1 + k, bodies[b]);
            for (int side = 0; side < 2; side++) {
                m3_mulmt(turn, R[2 * side], R[1]);
                vector_of_matrix(phi[side], turn);
            }
            for (int k = 0; k < 3; k++)
                near(component(&r, i, bodies[b], "al", k), (phi[0][k] + phi[1][k]) / (h * h), 1e-3, bodies[b], i);
        }
    ride_close(&r);
}

/* In the plane it is the slope of wz, and of a pin on the ground its coordinate's acceleration. */
static void angular_acceleration_in_the_plane(void **state)
{
    struct ride r;
    (void)state;
    ride(&r,
         "fmdsub: 1\ngravity: [0, -9.81]\n"
         "bodies:\n"
         "  upper: {mass: 1, inertia: 0.1, at: [0.5, 0]}\n"
         "  lower: {mass: 1, inertia: 0.1, at: [1.5, 0]}\n"
         "constraints:\n"
         "  pin: {revolute: [ground, upper], at: [0, 0]}\n"
         "  elbow: {revolute: [upper, lower], at: [1, 0]}\n"
         "integrate: {scheme: dopri5, tolerance: 1.0e-12, until: 0.5}\n"
         "output: {every: 1.0e-3, columns: [upper.alz, lower.alz, lower.wz, pin.angle_accel, elbow.angle_accel]}\n");
    for (int i = 1; i + 1 < r.n; i++) {
        const double slope = (ride_at(&r, i + 1, "lower.wz") - ride_at(&r, i - 1, "lower.wz")) / 2e-3;
        near(ride_at(&r, i, "lower.alz"), slope, 1e-3, "lower", i);
        assert_true(ride_at(&r, i, "upper.alz") == ride_at(&r, i, "pin.angle_accel"));
    }
    ride_close(&r);
}

/* z, then y, then x of the body; z, then x, then z. */
static void angles_make_up_the_orientation(void **state)
{
    static const char *const names[2][3] = {{"tail.yaw", "tail.pitch", "tail.roll"},
                                            {"tail.euler1", "tail.euler2", "tail.euler3"}};
    static const int axis[2][3] = {{2, 1, 0}, {2, 0, 2}};
    struct ride r;
    char text[2000];
    (void)state;
    snprintf(text, sizeof text,
             "%soutput: {every: 1.0e-3, columns: [tail.q*, tail.yaw, tail.pitch, tail.roll, tail.euler*]}\n", chain);
    ride(&r, text);
    for (int i = 0; i < r.n; i++)
        for (int sort = 0; sort < 2; sort++) {
            double R[9], made[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
            orientation(R, &r, i, "tail");
            for (int k = 0; k < 3; k++) {
                double phi[3] = {0}, A[9], B[9];
                phi[axis[sort][k]] = ride_at(&r, i, names[sort][k]);
                turn_matrix(A, phi);
                m3_mulm(B, made, A);
                memcpy(made, B, sizeof B);
            }
            for (int k = 0; k < 9; k++) near(made[k], R[k], 1e-14, names[sort][0], i);
        }
    ride_close(&r);
}

/* A cantilever at rest: F L^2/(2 E I) about the axes across, M L/(G J) along. */
static void rotation_of_a_point_of_a_beam_at_rest(void **state)
{
    const double L = 1, E = 200e9, nu = .3, c = .01, I = 3.14159265358979 * c * c * c * c / 4;
    const double Fy = .02, Fz = .03, M = .01;
    struct ride r;
    char text[2000];
    (void)state;
    snprintf(text, sizeof text,
             "fmdsub: 1\n"
             "bodies:\n"
             "  arm:\n"
             "    beam: {from: [0, 0, 0], to: [%g, 0, 0], elements: 4}\n"
             "    section: {circle: %g}\n"
             "    material: {E: %g, nu: %g, density: 7800}\n"
             "    modes: 1\n"
             "    points: {tip: {station: 1, static: true}}\n"
             "constraints: {clamp: {fixed: [ground, arm], at: [0, 0, 0]}}\n"
             "forces:\n"
             "  pull: {force: arm.tip, value: [0, %g, %g]}\n"
             "  twist: {torque: arm.tip, value: [%g, 0, 0]}\n"
             "initial: {static: true}\n"
             "integrate: {scheme: midpoint, step: 1.0e-5, until: 3.0e-5}\n"
             "output: {every: {steps: 1}, columns: [arm.tip.rx, arm.tip.ry, arm.tip.rz]}\n",
             L, c, E, nu, Fy, Fz, M);
    ride(&r, text);
    near(ride_at(&r, 0, "arm.tip.rx"), M * L * 2 * (1 + nu) / (E * 2 * I), 1e-9, "rx", 0);
    near(ride_at(&r, 0, "arm.tip.ry"), -Fz * L * L / (2 * E * I), 1e-9, "ry", 0);
    near(ride_at(&r, 0, "arm.tip.rz"), Fy * L * L / (2 * E * I), 1e-9, "rz", 0);
    ride_close(&r);
}

/* A plate welded to the end of a turning beam turns with that point. */
static void rotation_of_a_point_is_that_of_what_is_fixed_there(void **state)
{
    struct ride r;
    double most = 0;
    (void)state;
    ride(&r, "fmdsub: 1\ngravity: [0, 0, -9.81]\n"
             "bodies:\n"
             "  arm:\n"
             "    beam: {from: [0, 0, 0], to: [0, 1, 0], elements: 4}\n"
             "    section: {rectangle: [0.01, 0.003]}\n"
             "    material: steel\n"
             "    modes: 4\n"
             "    points: {tip: {station: 1}}\n"
             "  plate: {mass: 0.3, inertia: [0.001, 0.001, 0.002], at: [0.1, 1, 0]}\n"
             "constraints:\n"
             "  hinge: {revolute: [ground, arm], at: [0, 0, 0], axis: [1, 0, 0.5]}\n"
             "  weld: {fixed: [arm, plate], at: [0, 1, 0]}\n"
             "initial: {hinge.angle_rate: 4}\n"
             "integrate: {scheme: midpoint, step: 1.0e-4, until: 0.2}\n"
             "output: {every: 2.0e-3, columns: [arm.q*, plate.q*, arm.tip.r?]}\n");
    double drawn[9];
    orientation(drawn, &r, 0, "arm"); /* undeformed at the start; the plate's axes are the world's */
    for (int i = 0; i < r.n; i++) {
        double A[9], B[9], made[9], turn[9], phi[3];
        orientation(A, &r, i, "arm");
        orientation(B, &r, i, "plate");
        m3_mulm(made, B, drawn);
        m3_tmulm(turn, A, made);
        vector_of_matrix(phi, turn);
        for (int k = 0; k < 3; k++) near(component(&r, i, "arm.tip", "r", k), phi[k], 1e-13, "tip", i);
        most = fmax(most, v3_norm(phi));
    }
    assert_true(most > .05);
    ride_close(&r);
}

/* Of columns that are written and of others, of time, of parameters, of expressions before them. */
static void an_expression_says_what_its_columns_say(void **state)
{
    struct ride r;
    (void)state;
    ride(&r, "fmdsub: 1\ngravity: [0, -9.81]\nparameters: {half: 0.5}\n"
             "bodies: {ball: {mass: 2, inertia: 0.1, at: [1, 0]}}\n"
             "constraints: {pin: {revolute: [ground, ball], at: [0, 0]}}\n"
             "forces: {stay: {spring: pin, stiffness: 3}}\n"
             "integrate: {scheme: midpoint, step: 1.0e-2, until: 0.2}\n"
             "output:\n"
             "  columns:\n"
             "    - stay.force\n"
             "    - {speed: \"hypot(ball.vx, ball.vy)\", work: half*2*speed^2 - t}\n"
             "    - pin.f?\n"
             "    - pull: stay.force + stay.elongation*3\n"
             "    - ball.v?\n"
             "    - {force: \"sqrt(pin.fx^2 + pin.fy^2)\", residual: energy.residual}\n"
             "    - energy.residual\n");
    static const char *const order[] = {"t",    "stay.force", "speed",   "work",  "pin.fx",   "pin.fy",
                                        "pull", "ball.vx",    "ball.vy", "force", "residual", "energy.residual"};
    assert_int_equal(r.sim.chosen.n, 12);
    for (int i = 0; i < 12; i++) assert_string_equal(r.sim.columns[i].name, order[i]);
    for (int i = 0; i < r.n; i++) {
        const double speed = hypot(ride_at(&r, i, "ball.vx"), ride_at(&r, i, "ball.vy"));
        const double fx = ride_at(&r, i, "pin.fx"), fy = ride_at(&r, i, "pin.fy");
        assert_true(ride_at(&r, i, "speed") == speed);
        near(ride_at(&r, i, "work"), speed * speed - ride_at(&r, i, "t"), 1e-15, "work", i);
        assert_true(ride_at(&r, i, "pull") == 0);
        near(ride_at(&r, i, "force"), hypot(fx, fy), 1e-13, "force", i);
        assert_true(ride_at(&r, i, "residual") == ride_at(&r, i, "energy.residual"));
    }
    assert_true(ride_last(&r, "speed") > 1 && r.sim.columns[2].unit == NULL);
    ride_close(&r);
}

/* It alone: what it reads is found out for it. */
static void an_expression_needs_what_its_columns_need(void **state)
{
    static const struct {
        const char *of;
        unsigned needs;
    } tries[] = {{"2*pin.angle", EVALUATE_NOTHING},
                 {"ball.x + t", EVALUATE_MOTION},
                 {"ball.ax", EVALUATE_ACCELERATION},
                 {"pin.fx*ball.x", EVALUATE_REACTION | EVALUATE_MOTION}};
    (void)state;
    for (size_t k = 0; k < sizeof tries / sizeof *tries; k++) {
        struct ride r;
        char text[600];
        snprintf(text, sizeof text,
                 "fmdsub: 1\ngravity: [0, -9.81]\n"
                 "bodies: {ball: {mass: 2, inertia: 0.1, at: [1, 0]}}\n"
                 "constraints: {pin: {revolute: [ground, ball], at: [0, 0]}}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-2, until: 0.2}\n"
                 "output: {columns: [{it: %s, twice: 2*it}]}\n",
                 tries[k].of);
        ride(&r, text);
        assert_int_equal(r.sim.needs, tries[k].needs);
        ride_close(&r);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(angular_acceleration_is_the_second_difference_of_rotations),
        cmocka_unit_test(angular_acceleration_in_the_plane),
        cmocka_unit_test(angles_make_up_the_orientation),
        cmocka_unit_test(rotation_of_a_point_of_a_beam_at_rest),
        cmocka_unit_test(rotation_of_a_point_is_that_of_what_is_fixed_there),
        cmocka_unit_test(an_expression_says_what_its_columns_say),
        cmocka_unit_test(an_expression_needs_what_its_columns_need),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
