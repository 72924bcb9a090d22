/* t-spin.c -- the speed from which linear elasticity gives way: against frequencies of beams in closed form, against
 * the equations of motion, and over many axes. */
#include "flex/spin.h"

#include <math.h>
#include <string.h>

#include "flex/motion.h"
#include "la/eigen.h"
#include "la/vec3.h"
#include "unit/rods.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void near(double a, double b, double relative)
{
    if (!(fabs(a - b) <= relative * fabs(b))) fail_msg("%.15g is not %.15g to %g", a, b, relative);
}

static const double Z_AXIS[3] = {0, 0, 1};

/* The beams of Simo & Vu-Quoc and of Kane, Ryan & Banerjee: the first frequency, 3.5160152685 sqrt(EI/(rA L^4)). */
static void test_known_beams(void **state)
{
    static const double L[] = {10, 8}, EI[] = {1.4e4, 566.7095928}, rA[] = {1.2, 0.20187837656};
    static const double wanted[] = {3.797730541, 2.910758394};
    struct arena *life = arena_open();
    (void)state;
    for (int k = 0; k < 2; k++) {
        double at[3], e[3];
        const struct flex_section c = {.A = 1e-3, .Iz = 1e-8};
        struct flex_beam beam = bar(2, L[k], 8, 4, &c, 1, ROOT_ONLY);
        beam.E = EI[k] / c.Iz;
        beam.density = rA[k] / c.A;
        const struct flex_body *o = made(&beam, at, life);
        near(flex_spin_worst(e, o, 2, life), wanted[k], 1e-5);
        near(flex_spin_limit(o, Z_AXIS, life), wanted[k], 1e-5);
        assert_true(e[0] == 0 && e[1] == 0 && e[2] == 1);
    }
    arena_close(life);
}

/* Turned about its weak direction a flat blade gives way by its strong bending only; the other axes find the weak. */
static void test_flat_blade(void **state)
{
    static const double across[] = {0, 1, 0};
    struct arena *life = arena_open();
    const struct flex_section c = rectangle(0, 0.005, 0.05); /* weak along z */
    struct flex_beam beam = bar(3, 1, 8, 6, &c, 1, ROOT_ONLY);
    double at[3], e[3], unit = 3.5160152685 * sqrt(beam.E / (beam.density * c.A));
    (void)state;
    const struct flex_body *o = made(&beam, at, life);
    near(flex_spin_limit(o, Z_AXIS, life), unit * sqrt(c.Iz), 1e-4);
    near(flex_spin_limit(o, across, life), unit * sqrt(c.Iy), 1e-4);
    near(flex_spin_worst(e, o, 3, life), unit * sqrt(c.Iy), 1e-4);
    assert_true(fabs(e[2]) < 1e-6);
    arena_close(life);
}

static const struct flex_body *crooked(struct arena *life)
{
    static struct flex_section c[2];
    double at[3];
    struct flex_beam beam = bar(3, 1, 8, 6, tapered(c, 0.9), 2, BOTH);
    beam.nsection = 2;
    return made(&beam, at, life);
}

/* dQ/dq of the equations of motion at the turn W e, symmetric part: at the limit its least eigenvalue is 0. */
static void softened(double *A, const struct flex_body *o, const double *e, double W, struct arena *life)
{
    const double step = 1e-3, zero[3] = {0, 0, 0};
    const int n = o->n;
    struct flex_kernel *kernel = flex_kernel_build(o, life);
    struct flex_shape shape;
    double F[3], N[3], w[3], q[MOST] = {0}, still[MOST] = {0}, side[2][MOST];
    flex_shape_take(&shape, kernel, life);
    v3_scale(w, W, e);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < 2; k++) {
            q[j] = k ? step : -step;
            flex_shape_at(&shape, kernel, q);
            flex_inertia(F, N, side[k], kernel, &shape, zero, w, zero, q, still, NULL, true);
        }
        q[j] = 0;
        for (int i = 0; i < n; i++) A[i + n * j] = (side[1][i] - side[0][i]) / (2 * step);
    }
}

static void test_equations_of_motion(void **state)
{
    struct arena *life = arena_open();
    const struct flex_body *o = crooked(life);
    (void)state;
    for (int k = 0; k < 20; k++) {
        double e[3] = {sin(1 + 2.0 * k), cos(3.0 * k), sin(5.0 * k)}, A[MOST * MOST], X[MOST * MOST], l[MOST];
        v3_scale(e, 1 / v3_norm(e), e);
        double limit = flex_spin_limit(o, e, life);
        for (int side = 0; side < 2; side++) {
            softened(A, o, e, limit * (side ? 1 + 1e-6 : 1 - 1e-6), life);
            eigen_symmetric(l, X, A, o->n);
            assert_true(side ? l[0] < 0 : l[0] > 0);
        }
    }
    arena_close(life);
}

/* No axis of a fine grid has a lower one, and the axis told has it. */
static void test_worst_axis(void **state)
{
    enum { N = 40 };
    struct arena *life = arena_open();
    const struct flex_body *o = crooked(life);
    double e[3], worst = flex_spin_worst(e, o, 3, life), least = INFINITY, pi = acos(-1);
    (void)state;
    near(flex_spin_limit(o, e, life), worst, 1e-6);
    near(v3_norm(e), 1, 1e-12);
    for (int i = 0; i <= N; i++)
        for (int j = 0; j < N; j++) {
            double a = pi * i / N, b = pi * j / N, axis[3] = {sin(a) * cos(b), sin(a) * sin(b), cos(a)};
            least = fmin(least, flex_spin_limit(o, axis, life));
        }
    assert_true(worst <= least * (1 + 1e-6));
    assert_true(worst > 0.99 * least);
    arena_close(life);
}

/* A body that cannot deflect across the axis has no such speed. */
static void test_none(void **state)
{
    struct arena *life = arena_open();
    struct flex_body *o = flex_body_take(1, 1, 0, false, life);
    (void)state;
    o->K[0] = 5;
    o->ff[8] = 2; /* moves along z alone */
    assert_true(isinf(flex_spin_limit(o, Z_AXIS, life)));
    near(flex_spin_limit(o, (const double[]){1, 0, 0}, life), sqrt(2.5), 1e-12);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_beams),
        cmocka_unit_test(test_flat_blade),
        cmocka_unit_test(test_equations_of_motion),
        cmocka_unit_test(test_worst_axis),
        cmocka_unit_test(test_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
