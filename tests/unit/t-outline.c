/* t-outline.c -- curves that others touch: nearest points beside a search, circles, continuous slopes, hollows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "kind/outline.h"

static const double TURN = 2 * 3.14159265358979323846;

static double x_of[400], y_of[400];

static void near(double x, double want, double within)
{
    if (!(fabs(x - want) <= within)) fail_msg("%.17g, should be %.17g within %g", x, want, within);
}

/* A waved profile, or a lobed cam. */
static const struct outline *waves(bool closed, int n, struct arena *life)
{
    for (int i = 0; i < n; i++) {
        x_of[i] = closed ? TURN * i / n - 1 : 4.0 * i / (n - 1) - 2;
        y_of[i] = closed ? 1 + .2 * cos(2 * x_of[i]) + .1 * sin(3 * x_of[i]) : .3 * sin(2 * x_of[i]) + .1 * x_of[i];
    }
    return outline_make(&(struct points){n, x_of, y_of}, closed, life);
}

/* The least distance of the points of the curve at many u from p. */
static double searched(const struct outline *o, const double *p)
{
    enum { MANY = 40000 };
    const double lo = o->closed ? o->x[0] : -6, hi = o->closed ? o->x[0] + TURN : 6;
    double least = INFINITY, c[2];
    for (int i = 0; i <= MANY; i++) {
        outline_point(o, c, lo + (hi - lo) * i / MANY);
        least = fmin(least, hypot(c[0] - p[0], c[1] - p[1]));
    }
    return least;
}

/* Nothing on the curve is nearer, and the way there is along the normal. */
static void test_nearest(void **state)
{
    struct arena *life = *state;
    srand(7);
    for (int k = 0; k < 60; k++) {
        const struct outline *o = waves(k % 2, 5 + k, life);
        const double p[2] = {3.0 * rand() / RAND_MAX - 1.5, 3.0 * rand() / RAND_MAX - 1.5};
        double c[2], n[2];
        if (hypot(p[0], p[1]) < .2) continue;
        outline_nearest(o, c, n, p);
        const double d = hypot(c[0] - p[0], c[1] - p[1]), least = searched(o, p);
        if (!(d <= least + 1e-12)) fail_msg("curve %d: %.12g m away, %.12g m searched", k, d, least);
        near(d, least, 1e-6);
        near(fabs(n[0] * (p[0] - c[0]) + n[1] * (p[1] - c[1])), d, 1e-12);
        near(hypot(n[0], n[1]), 1, 1e-15);
    }
}

/* A cam of one radius is a circle, whatever its points; free is outside, also for who is inside. */
static void test_circle(void **state)
{
    const double x[] = {-.3, .4, 1.5, 3, 4, 5.5}, y[] = {.7, .7, .7, .7, .7, .7};
    const struct outline *o = outline_make(&(struct points){6, x, y}, true, *state);
    for (int k = 0; k < 12; k++) {
        const double far = k % 2 ? .69 : 2, phi = .7 * k - 3, p[2] = {far * cos(phi), far * sin(phi)};
        double c[2], n[2];
        outline_nearest(o, c, n, p);
        near(n[0], cos(phi), 1e-12);
        near(n[1], sin(phi), 1e-12);
        near(c[0], .7 * cos(phi), 1e-12);
        near(c[1], .7 * sin(phi), 1e-12);
    }
    double where;
    near(outline_hollow(o, &where), 0, 0);
    near(outline_least(o), .7, 1e-15);
}

/* An eccentric disc as a cam: distances from its centre, to what the spline of 90 points leaves. */
static void test_eccentric(void **state)
{
    enum { N = 90 };
    double x[N], y[N];
    for (int i = 0; i < N; i++) {
        x[i] = TURN * i / N;
        y[i] = .2 * cos(x[i]) + sqrt(1 - .04 * sin(x[i]) * sin(x[i]));
    }
    const struct outline *o = outline_make(&(struct points){N, x, y}, true, *state);
    for (int k = 0; k < 40; k++) {
        const double phi = .31 * k, p[2] = {.2 + 1.3 * cos(phi), 1.3 * sin(phi)};
        double c[2], n[2];
        outline_nearest(o, c, n, p);
        near(hypot(p[0] - c[0], p[1] - c[1]), .3, 3e-8);
        near(n[0], cos(phi), 3e-6);
        near(n[1], sin(phi), 3e-6);
    }
}

/* Slopes and curvatures go on through the points of the table, also where a turn ends; beyond its ends a profile is straight. */
static void test_smooth(void **state)
{
    const double h = 1e-4;
    for (int closed = 0; closed < 2; closed++) {
        const struct outline *o = waves(closed, 14, *state);
        for (int i = 0; i < o->n; i++) {
            double c[5][2];
            for (int k = 0; k < 5; k++) outline_point(o, c[k], o->x[i] + (k - 2) * h);
            for (int k = 0; k < 2; k++) {
                const double before = (c[2][k] - 2 * c[1][k] + c[0][k]) / (h * h),
                             behind = (c[4][k] - 2 * c[3][k] + c[2][k]) / (h * h);
                near(before, behind, 2e-2);
            }
        }
        if (closed) continue;
        double a[2], b[2], c[2];
        outline_point(o, a, 2), outline_point(o, b, 3), outline_point(o, c, 5);
        near((c[1] - b[1]) / 2, b[1] - a[1], 1e-12);
    }
}

/* A parabola's bottom: the curvature of its hollow is 2 a there. */
static void test_hollow(void **state)
{
    enum { N = 81 };
    double x[N], y[N], where = NAN;
    for (int i = 0; i < N; i++) {
        x[i] = .05 * (i - 40);
        y[i] = 1.5 * x[i] * x[i];
    }
    const struct outline *bowl = outline_make(&(struct points){N, x, y}, false, *state);
    near(outline_hollow(bowl, &where), 3, 1e-2);
    near(where, 0, 1e-2);
    for (int i = 0; i < N; i++) y[i] = -y[i];
    const struct outline *hill = outline_make(&(struct points){N, x, y}, false, *state);
    assert_true(outline_hollow(hill, &where) < 1.5); /* natural ends leave some */
}

static int make_life(void **state)
{
    *state = arena_open();
    return 0;
}

static int drop_life(void **state)
{
    arena_close(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_nearest, make_life, drop_life),
        cmocka_unit_test_setup_teardown(test_circle, make_life, drop_life),
        cmocka_unit_test_setup_teardown(test_eccentric, make_life, drop_life),
        cmocka_unit_test_setup_teardown(test_smooth, make_life, drop_life),
        cmocka_unit_test_setup_teardown(test_hollow, make_life, drop_life),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
