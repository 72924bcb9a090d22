/* t-assemble.c -- `initial: {assemble: true}`: a start that does not fit, projected in the metric of the masses.
 *
 * What is least is told without the projection's own formula: against every motion T u that the loops allow,
 * T' M (v - v0) = 0 for the rates, and for positions to the second order of the shift. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "loop/condense.h"
#include "unit/rides.h"

#include <cmocka.h>

#define PLAN "integrate: {scheme: midpoint, step: 1.0e-4, until: 1.0e-3}\n"

/* A ball on a massless rod of 1 m, placed by two slides. */
#define PENDULUM(initial)                                                                                              \
    "fmdsub: 1\n"                                                                                                      \
    "bodies:\n"                                                                                                        \
    "  rod: {mass: 0, inertia: 0, at: [0.5, 0]}\n"                                                                     \
    "  carrier: {mass: 0, inertia: 0, at: [0, 0]}\n"                                                                   \
    "  ball: {mass: 2, at: [1, 0]}\n"                                                                                  \
    "constraints:\n"                                                                                                   \
    "  x: {prismatic: [ground, carrier], at: [1, 0], axis: [1, 0]}\n"                                                  \
    "  y: {prismatic: [carrier, ball], at: [1, 0], axis: [0, 1]}\n"                                                    \
    "  pin: {revolute: [ground, rod], at: [0, 0]}\n"                                                                   \
    "  end: {revolute: [rod, ball], at: [1, 0], loop: true}\n"                                                         \
    "initial: {" initial "}\n" PLAN "output: {columns: [x.displacement, y.displacement, x.displacement_rate, "         \
    "y.displacement_rate, pin.angle, pin.angle_rate]}\n"

static void near_to(double a, double b, double within)
{
    if (!(fabs(a - b) <= within)) fail_msg("%.15g should be %.15g within %g", a, b, within);
}

static void pendulum(void **state)
{
    (void)state;
    struct ride r;
    ride_open(&r, PENDULUM("assemble: true, x.displacement: 0.01, x.displacement_rate: 0.1, y.displacement_rate: -1"));
    assert_int_equal(r.status, OK);
    near_to(ride_at(&r, 0, "x.displacement"), 0, 1e-12);
    near_to(ride_at(&r, 0, "y.displacement"), 0, 1e-12);
    near_to(ride_at(&r, 0, "x.displacement_rate"), 0, 1e-12);
    near_to(ride_at(&r, 0, "y.displacement_rate"), -1, 1e-8);
    near_to(ride_at(&r, 0, "pin.angle_rate"), -1, 1e-8);
    const struct condense_start *s = condense_started(system_loops(r.sim.system));
    near_to(s->misfit, .01, 1e-12);
    near_to(s->moved, -.01, 1e-9);
    near_to(fabs(s->changed), 1, 1e-8); /* the rod's */
    ride_close(&r);
    /* off the axis: the foot of the normal, but for the square of the shift */
    ride_open(&r, PENDULUM("assemble: true, x.displacement: 0.03, y.displacement: 0.04"));
    assert_int_equal(r.status, OK);
    double angle = atan2(.04, 1.03);
    near_to(hypot(1 + ride_at(&r, 0, "x.displacement"), ride_at(&r, 0, "y.displacement")), 1, 1e-12);
    near_to(ride_at(&r, 0, "pin.angle"), angle, 2e-3);
    ride_close(&r);
}

/* H08 to the letter: 1.01 m out on a rod of 1 m, with a velocity along it. */
static void rod(void **state)
{
    (void)state;
    static const char deck[] = "fmdsub: 1\n"
                               "bodies:\n"
                               "  ball: {mass: 2, inertia: 0.1, at: [1.01, 0]}\n"
                               "constraints:\n"
                               "  place: {free: [ground, ball]}\n"
                               "  rod: {distance: [[0, 0], ball], length: 1}\n"
                               "initial: {place.x_rate: 0.1, place.y_rate: -1, assemble: %s}\n" PLAN
                               "output: {columns: [ball.x, ball.y, ball.vx, ball.vy]}\n";
    struct ride r;
    char text[1000];
    snprintf(text, sizeof text, deck, "true");
    ride_open(&r, text);
    assert_int_equal(r.status, OK);
    near_to(ride_at(&r, 0, "ball.x"), 1, 1e-12);
    near_to(ride_at(&r, 0, "ball.y"), 0, 1e-12);
    near_to(ride_at(&r, 0, "ball.vx"), 0, 1e-12);
    near_to(ride_at(&r, 0, "ball.vy"), -1, 1e-12);
    assert_true(system_constraint_worst(r.sim.system) < 1e-12);
    ride_close(&r);
    snprintf(text, sizeof text, deck, "false");
    ride_open(&r, text);
    assert_int_equal(r.status, E_MODEL);
    assert_non_null(strstr(r.report.text, "or 'initial: {assemble: true}'"));
    ride_close(&r);
}

static void without_it(void **state)
{
    (void)state;
    struct ride r;
    ride_open(&r, PENDULUM("x.displacement: 0.01, y.displacement: 0.3"));
    assert_int_equal(r.status, E_MODEL);
    assert_non_null(strstr(r.report.text, "does not fit"));
    ride_close(&r);
    ride_open(&r, PENDULUM("assemble: false, x.displacement: -0.01, y.displacement: 0.3"));
    assert_int_equal(r.status, E_MODEL);
    ride_close(&r);
}

enum { MOST = 24 };

/* T' M x over |T| |M x|, T all motions that are allowed at the start of the run; worst of them. */
static double along(struct ride *r, const double *q, const double *v, const double *x)
{
    struct model tree = *r->sim.model;
    struct condense *c = system_loops(r->sim.system);
    const int n = r->sim.stepper.ode->n, nt = tree.n;
    double M[MOST * MOST], T0[MOST], T1[MOST], u[MOST], Mx[MOST], worst = 0, size = 1e-300;
    struct trouble why;
    tree.nloop = tree.ndrive = 0;
    struct system *open = system_build(&tree, r->life);
    const struct ode2 *ode = system_ode2(open);
    assert_int_equal(ode->ops->mass(ode, M, q, 0, ALL, &why), OK);
    for (int i = 0; i < nt; i++) {
        Mx[i] = 0;
        for (int j = 0; j < nt; j++) Mx[i] += M[i + j * nt] * x[j];
        size = fmax(size, fabs(Mx[i]));
    }
    assert_int_equal(condense_rates(c, T0, NULL, q, v, NULL, 0, &why), OK);
    for (int k = 0; k < n; k++) {
        double sum = 0;
        for (int i = 0; i < n; i++) u[i] = v[i] + (i == k);
        assert_int_equal(condense_rates(c, T1, NULL, q, u, NULL, 0, &why), OK);
        for (int i = 0; i < nt; i++) sum += (T1[i] - T0[i]) * Mx[i];
        worst = fmax(worst, fabs(sum));
    }
    return worst / size;
}

/* The deck opened as it stands at t = 0, with its starting shift and change of rates looked at. */
static void is_least(const char *text, double *miss, double *least_rate, double *least_shift, double *shift)
{
    struct ride r;
    struct trouble why;
    double q[MOST + 8], v[MOST], dv[MOST], dq[MOST], full[MOST];
    struct report report;
    ride_build(&r, text); /* a run may leave the coordinates of the start */
    if (r.status != OK) fail_msg("%s", r.report.text);
    const struct model *m = r.sim.model;
    struct condense *c = system_loops(r.sim.system);
    assert_true(m->n <= MOST && m->nq <= MOST + 8);
    assert_int_equal(system_start(r.sim.system, q, v, &report), OK);
    *miss = condense_worst(c, q, 0);
    assert_int_equal(condense_rates(c, full, NULL, q, v, NULL, 0, &why), OK);
    for (int i = 0; i < m->n; i++) dv[i] = full[i] - m->v0[i], dq[i] = 0;
    *shift = 0;
    for (int i = 0; i < m->ncoordinate; i++) {
        const struct model_coordinate *k = &m->coordinate[i];
        if (k->iv >= 0) dq[k->iv] = q[k->iq] - m->q0[k->iq];
        if (k->iv >= 0) *shift = fmax(*shift, fabs(dq[k->iv]));
    }
    *least_rate = along(&r, q, v, dv);
    *least_shift = along(&r, q, v, dq);
    ride_close(&r);
}

static void four_bar(void **state)
{
    (void)state;
    double last = 0;
    for (int driven = 0; driven < 2; driven++)
        for (int k = 0; k < 3; k++) {
            char text[3000], drives[100] = "";
            double s = .04 / (1 << k), miss, least_rate, least_shift, shift;
            if (driven) snprintf(drives, sizeof drives, "drives: {motor: {drive: shaft, value: %g + 3*t}}\n", s / 2);
            snprintf(
                text, sizeof text,
                "fmdsub: 1\n"
                "parameters: {a2: 1.6871299784680975, a3: 0.9183364294768195, k: 4.0e+4}\n"
                "bodies:\n"
                "  crank:  {mass: 0.6, inertia: 0.02, at: [0.15, 0]}\n"
                "  rocker: {mass: 0.8, inertia: 0.8*0.8^2/12, at: [1 + 0.4*cos(a2), 0.4*sin(a2)]}\n"
                "  near:   {mass: 0.5, inertia: 0.5*0.5^2/12, at: [0.3 + 0.25*cos(a3), 0.25*sin(a3)]}\n"
                "  far:    {mass: 0.5, inertia: 0.5*0.5^2/12, at: [0.3 + 0.75*cos(a3), 0.75*sin(a3)]}\n"
                "constraints:\n"
                "  shaft: {revolute: [ground, crank], at: [0, 0]}\n"
                "  pivot: {revolute: [ground, rocker], at: [1, 0]}\n"
                "  elbow: {revolute: [crank, near], at: [0.3, 0]}\n"
                "  slide: {prismatic: [near, far], at: [0.3 + 0.5*cos(a3), 0.5*sin(a3)], axis: [cos(a3), sin(a3)]}\n"
                "  wrist: {revolute: [far, rocker], at: [0.3 + cos(a3), sin(a3)], loop: true}\n%s"
                "initial: {assemble: true, shaft.angle: %g, pivot.angle: %g, elbow.angle: %g, slide.displacement: %g, "
                "shaft.angle_rate: 2, pivot.angle_rate: 1, slide.displacement_rate: -0.7, elbow.angle_rate: "
                "0.3}\n" PLAN,
                drives, s, -s, s / 2, s / 3);
            is_least(text, &miss, &least_rate, &least_shift, &shift);
            print_message("driven %d, off by %g: |C| %.2g, rates least to %.2g, positions to %.2g\n", driven, s, miss,
                          least_rate, least_shift);
            assert_true(miss < 1e-12);
            assert_true(shift > s / 4);
            assert_true(least_rate < 1e-12);
            assert_true(least_shift < 5 * s); /* of the shift: second order */
            if (k) assert_true(least_shift < .7 * last);
            last = least_shift;
        }
}

/* In space, with ball joints and a redundant way round. */
static void in_space(void **state)
{
    (void)state;
    char text[6000], start[400], *at;
    double miss, least_rate, least_shift, shift;
    FILE *file = fopen("decks/axle.yaml", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 500, file)] = 0;
    fclose(file);
    at = strstr(text, "integrate:");
    assert_non_null(at);
    snprintf(
        start, sizeof start,
        "initial: {assemble: true, low1.angle: 0.03, up1.angle: -0.02, low2.angle: 0.01, rail.displacement: 0.004,\n"
        "  low1.angle_rate: 1, up2.angle_rate: -2, rail.displacement_rate: 0.3, foot1.omega: [0.1, 0.4, 1]}\n" PLAN);
    memcpy(at, start, strlen(start) + 1);
    is_least(text, &miss, &least_rate, &least_shift, &shift);
    print_message("axle: |C| %.2g, rates least to %.2g\n", miss, least_rate);
    assert_true(miss < 1e-12);
    assert_true(least_rate < 1e-10);
    assert_true(shift > 1e-3);
}

/* Drawn where branches meet, a deck names its own by coordinates a little to one side. */
static void branches(void **state)
{
    (void)state;
    for (int crossed = 0; crossed < 2; crossed++) {
        struct ride r;
        char text[2000];
        snprintf(text, sizeof text,
                 "fmdsub: 1\n"
                 "bodies:\n"
                 "  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}\n"
                 "  b: {mass: 1, inertia: 1/12, at: [2.5, 0]}\n"
                 "  bridge: {mass: 2, inertia: 2/3, at: [2, 0]}\n"
                 "constraints:\n"
                 "  left: {revolute: [ground, a], at: [0, 0]}\n"
                 "  right: {revolute: [ground, b], at: [2, 0]}\n"
                 "  up: {revolute: [a, bridge], at: [1, 0]}\n"
                 "  end: {revolute: [bridge, b], at: [3, 0], loop: true}\n"
                 "initial: {%s, left.angle_rate: 1}\n"
                 "integrate: {scheme: midpoint, step: 1.0e-3, until: 0.5}\n"
                 "output: {columns: [left.angle, right.angle]}\n",
                 crossed ? "assemble: true, left.angle: 0.01, right.angle: -0.03, up.angle: -0.03"
                         : "assemble: true, left.angle: 0.01, right.angle: 0.01, up.angle: -0.01");
        ride_open(&r, text);
        if (r.status != OK) fail_msg("%s", r.report.text);
        double left = ride_last(&r, "left.angle"), right = ride_last(&r, "right.angle");
        assert_true(fabs(left) > .05);
        if (crossed)
            assert_true(left * right < 0);
        else
            near_to(right, left, 1e-9);
        ride_close(&r);
    }
}

#define FLAT(initial)                                                                                                  \
    "fmdsub: 1\n"                                                                                                      \
    "bodies:\n"                                                                                                        \
    "  a: {mass: 1, inertia: 1/12, at: [0.5, 0]}\n"                                                                    \
    "  c: {mass: 1, inertia: 1/12, at: [1.5, 0]}\n"                                                                    \
    "  b: {mass: 1, inertia: 1/12, at: [1.5, 0]}\n"                                                                    \
    "constraints:\n"                                                                                                   \
    "  A: {revolute: [ground, a], at: [0, 0]}\n"                                                                       \
    "  B: {revolute: [a, c], at: [1, 0]}\n"                                                                            \
    "  C: {revolute: [c, b], at: [2, 0], loop: true}\n"                                                                \
    "  D: {revolute: [ground, b], at: [1, 0]}\n"                                                                       \
    "initial: {" initial "}\n" PLAN "output: {columns: [A.angle, B.angle, D.angle, A.angle_rate, D.angle_rate]}\n"

/* What the deck gives is held where the loops let it, and near where it is too much.  Without `assemble` more coordinates than
 * there are freedoms name a branch of a mechanism drawn flat, if they fit; one alone does not. */
static void what_is_given(void **state)
{
    static const struct {
        const char *deck;
        enum status status;
        double A, D, rate;
    } runs[] = {
        {FLAT("assemble: true, A.angle: 0.3"), OK, .3, .3, 0},
        {FLAT("assemble: true, A.angle: 0.3, D.angle: 0.3, D.angle_rate: 2"), OK, .3, .3, 2},
        {FLAT("assemble: true, A.angle: 0.3, B.angle: -0.3, D.angle: 0.3, A.angle_rate: 2, D.angle_rate: 2"), OK, .3,
         .3, 2},
        {FLAT("A.angle: 0.3, D.angle: 0.3, A.angle_rate: -1"), OK, .3, .3, -1},
        {FLAT("A.angle: 0.3, B.angle: -0.3, A.angle_rate: 2, D.angle_rate: 2"), OK, .3, .3, 2},
        {FLAT("A.angle: 0.3"), E_MODEL, 0, 0, 0},
        {FLAT("A.angle: 0.3, D.angle: 0.2"), E_MODEL, 0, 0, 0},
        {FLAT("A.angle: 0.3, D.angle: 0.3, A.angle_rate: 1, D.angle_rate: 2"), E_MODEL, 0, 0, 0},
    };
    struct ride r;
    (void)state;
    for (size_t i = 0; i < sizeof runs / sizeof *runs; i++) {
        ride_open(&r, runs[i].deck);
        if (r.status != runs[i].status) fail_msg("%zu: %d, %s", i, r.status, r.report.text);
        if (r.status == OK) {
            near_to(ride_at(&r, 0, "A.angle"), runs[i].A, 1e-12);
            near_to(ride_at(&r, 0, "D.angle"), runs[i].D, 1e-12);
            near_to(ride_at(&r, 0, "A.angle_rate"), runs[i].rate, 1e-12);
            near_to(ride_at(&r, 0, "D.angle_rate"), runs[i].rate, 1e-12);
            assert_true(system_constraint_worst(r.sim.system) < 1e-12);
        } else {
            assert_non_null(strstr(r.report.text, "dead point"));
        }
        ride_close(&r);
    }
    /* too much: all of it is near */
    ride_open(&r, FLAT("assemble: true, A.angle: 0.3, D.angle: 0.2"));
    assert_int_equal(r.status, OK);
    near_to(ride_at(&r, 0, "A.angle"), .25, .06);
    near_to(ride_at(&r, 0, "A.angle"), ride_at(&r, 0, "D.angle"), 1e-12);
    ride_close(&r);
}

/* Out of reach altogether. */
static void out_of_reach(void **state)
{
    (void)state;
    struct ride r;
    char text[6000], *at;
    FILE *file = fopen("decks/driven-slider-crank.yaml", "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 500, file)] = 0;
    fclose(file);
    at = strstr(text, "drives:");
    assert_non_null(at);
    snprintf(at, 300, "drives: {push: {drive: rail, value: 0.3 + t}}\ninitial: {assemble: true}\n" PLAN);
    ride_open(&r, text);
    assert_int_equal(r.status, E_MODEL);
    assert_non_null(strstr(r.report.text, "cannot be assembled"));
    ride_close(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pendulum),      cmocka_unit_test(rod),
                                       cmocka_unit_test(without_it),    cmocka_unit_test(four_bar),
                                       cmocka_unit_test(in_space),      cmocka_unit_test(branches),
                                       cmocka_unit_test(what_is_given), cmocka_unit_test(out_of_reach)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
