/* t-driven.c -- runs with drives, in every scheme: impulses of corners, orders, work, mechanisms without a freedom.
 *
 * A trolley is driven along x(t) and a load swings on it; with J the load's inertia about its pin,
 *
 *     J angle'' = -m l (g sin(angle) + x'' cos(angle)),
 *
 * integrated here by Runge and Kutta's method; a jump dV of x' changes angle' by -m l cos(angle) dV / J at once. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/rides.h"

#include <cmocka.h>

static const double mass = 2, arm = .8, J = .3 + 2 * .8 * .8, start = .4, trolley = 3;

static const char *const schemes[] = {"newmark", "midpoint", "subcycle", "miao", "rk4", "dopri5"};

enum { SCHEMES = 6 };

/* A run of the crane; ratio 1 for schemes of one rate. */
static void crane(struct ride *r, const char *scheme, double h, int ratio, double until, double g, const char *value)
{
    char text[2000], how[100];
    bool adaptive = strcmp(scheme, "dopri5") == 0;
    snprintf(how, sizeof how, adaptive ? "tolerance: 1.0e-11" : "step: %.17g, ratio: %d, newton_tolerance: 1.0e-13", h,
             ratio);
    snprintf(text, sizeof text,
             "fmdsub: 1\n"
             "gravity: [0, %.17g]\n"
             "bodies:\n"
             "  trolley: {mass: 3, inertia: 1, at: [0, 0]}\n"
             "  load: {mass: 2, inertia: 0.3, at: [0.8*sin(0.4), -0.8*cos(0.4)]}\n"
             "constraints:\n"
             "  rail: {prismatic: [ground, trolley], at: [0, 0], axis: [1, 0]}\n"
             "  pin: {revolute: [trolley, load], at: [0, 0]}\n"
             "drives: {move: {drive: rail, value: %s}}\n"
             "partition: {fast: [pin]}\n"
             "energy: {delta: 1}\n"
             "integrate: {scheme: %s, %s, until: %.17g}\n"
             "output:\n  every: %.17g\n  columns: [pin.angle, pin.angle_rate, pin.angle_accel, rail.displacement, "
             "rail.displacement_rate, move.force, move.power, energy.drive, energy.kinetic, energy.residual]\n",
             -g, value, scheme, how, until, until / 10);
    ride_open(r, text);
    if (r->status != OK) fail_msg("%s: %s", scheme, r->report.text);
}

/* Without gravity the load turns evenly behind the corner. */
static void test_corner(void **state)
{
    (void)state;
    static const double T = .5, V = 1;
    struct ride r;
    char value[100];
    for (int way = 0; way < 8; way++) {
        const bool words = way > 1, before = way > 3; /* as a table; in words; behind it at the corner itself, */
        const bool inside = way % 2 || before;        /* or half so: in the step that ends there */
        double tc = way % 2 ? .1037 : .1, rate = -mass * arm * cos(start) * V / J;
        static const char *const values[] = {"{table: [[0, 0], [%g, 0], [%g, 1]]}", "\"if(t <= %g, 0, t - %g)\"",
                                             "\"if(t < %g, 0, t - %g)\"", "\"(abs(t - %g) + t - %g)/2\""};
        snprintf(value, sizeof value, values[way / 2], tc, words ? tc : 1 + tc);
        for (int i = 0; i < SCHEMES; i++) {
            const char *s = schemes[i];
            bool means = strcmp(s, "midpoint") == 0 || strcmp(s, "subcycle") == 0, exact = strcmp(s, "dopri5") == 0;
            bool early = inside && !exact; /* up to a step; a little turned meanwhile */
            crane(&r, s, 1e-3, 1, T, 0, value);
            double spin = ride_last(&r, "pin.angle_rate"),
                   slack = inside && (means || (before && !exact)) ? 1e-3 : 1e-9;
            if (!(fabs(spin - rate) < slack)) print_error("%s: rate %.12g, expected %.12g\n", s, spin, rate);
            assert_true(fabs(spin - rate) < slack);
            assert_true(fabs(ride_last(&r, "pin.angle") - rate * (T - tc)) < (early ? 1e-3 : 1e-9));
            double a = start + ride_last(&r, "pin.angle");
            double kinetic = .5 * (trolley + mass) * V * V + mass * arm * cos(a) * V * rate + .5 * J * rate * rate;
            double work = ride_last(&r, "energy.drive");
            if (!(fabs(work - kinetic) < (early ? 2e-3 : 1e-6)))
                print_error("%s: work %.12g, expected %.12g\n", s, work, kinetic);
            assert_true(fabs(work - kinetic) < (early ? 2e-3 : 1e-6));
            ride_close(&r);
        }
    }
}

/* A corner in the very middle of a step, where the rate has a value of its own. */
static void test_middle(void **state)
{
    (void)state;
    const double rate = -mass * arm * cos(start) / J;
    struct ride r;
    crane(&r, "rk4", .125, 1, 1.25, 0, "\"(abs(t - 0.4375) + t - 0.4375)/2\"");
    assert_true(fabs(ride_last(&r, "pin.angle_rate") - rate) < 1e-3);
    ride_close(&r);
}

/* --- orders ------------------------------------------------------------------------------------------- */

struct way { /* where the trolley is told to be: amplitude, circular frequency; or one corner at tc */
    double A, w, tc, V;
};

static double pull(const struct way *o, double t)
{
    return -o->A * o->w * o->w * sin(o->w * t);
}

/* Angle and its rate from t0 to t1 in 4000 steps. */
static void swing(double *y, const struct way *o, double g, double t0, double t1)
{
    enum { STEPS = 4000 };
    static const double at[4] = {0, .5, .5, 1}, weight[4] = {1. / 6, 1. / 3, 1. / 3, 1. / 6};
    double h = (t1 - t0) / STEPS;
    for (int i = 0; i < STEPS; i++) {
        double k[2] = {0}, sum[2] = {0};
        for (int s = 0; s < 4; s++) {
            double x[2] = {y[0] + at[s] * h * k[0], y[1] + at[s] * h * k[1]}, t = t0 + (i + at[s]) * h;
            k[0] = x[1];
            k[1] = -mass * arm / J * (g * sin(start + x[0]) + pull(o, t) * cos(start + x[0]));
            for (int c = 0; c < 2; c++) sum[c] += weight[s] * k[c];
        }
        for (int c = 0; c < 2; c++) y[c] += h * sum[c];
    }
}

/* Errors of angle and rate at T at steps h, h/2, ... */
static double slope_of(const char *scheme, int ratio, const char *value, const double *y, double h, double T,
                       double *last)
{
    enum { HALVINGS = 5 };
    double e[HALVINGS];
    for (int k = 0; k < HALVINGS; k++) {
        struct ride r;
        crane(&r, scheme, h / pow(2, k), ratio, T, 9.81, value);
        e[k] = hypot(ride_last(&r, "pin.angle") - y[0], ride_last(&r, "pin.angle_rate") - y[1]);
        ride_close(&r);
    }
    *last = e[HALVINGS - 1];
    return log2(e[HALVINGS - 4] / e[HALVINGS - 1]) / 3;
}

static void test_order(void **state)
{
    (void)state;
    static const struct {
        const char *scheme;
        int ratio;
        double h, order, band;
    } of[] = {{"newmark", 1, .01, 2, .1},   {"midpoint", 1, .01, 2, .1},   {"subcycle", 1, .01, 2, .1},
              {"subcycle", 2, .005, 2, .1}, {"subcycle", 5, .005, 2, .15}, {"subcycle", 10, .0025, 2, .2},
              {"miao", 1, .01, 2, .1},      {"rk4", 1, .02, 4, .3}};
    static const struct way smooth = {.A = .3, .w = 3};
    const double T = 1;
    double y[2] = {0}, last;
    swing(y, &smooth, 9.81, 0, T);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        double order = slope_of(of[i].scheme, of[i].ratio, "0.3*sin(3*t)", y, of[i].h, T, &last);
        print_message("%s n = %d: order %.3f, error %.2g\n", of[i].scheme, of[i].ratio, order, last);
        assert_true(fabs(order - of[i].order) < of[i].band);
        assert_true(last < 1e-4);
    }
    struct ride r;
    crane(&r, "dopri5", 0, 1, T, 9.81, "0.3*sin(3*t)");
    assert_true(fabs(ride_last(&r, "pin.angle") - y[0]) < 1e-9);
    ride_close(&r);
}

/* A corner at the end of steps costs nothing; inside one the order is at least one. */
static void test_order_with_corner(void **state)
{
    (void)state;
    static const struct way still = {0};
    static const struct {
        const char *scheme;
        int ratio;
    } of[] = {{"newmark", 1}, {"midpoint", 1}, {"subcycle", 1}, {"subcycle", 5}, {"miao", 1}};
    for (int inside = 0; inside < 2; inside++) {
        char value[100];
        double tc = inside ? .4 + .1 / 3 : .4, V = .7, T = 1, y[2] = {0}, last;
        snprintf(value, sizeof value, "{table: [[0, 0], [%.17g, 0], [%.17g, 1.4]]}", tc, tc + 2);
        swing(y, &still, 9.81, 0, tc);
        y[1] -= mass * arm * cos(start + y[0]) * V / J;
        swing(y, &still, 9.81, tc, T);
        for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
            double order = slope_of(of[i].scheme, of[i].ratio, value, y, of[i].ratio == 1 ? .01 : .004, T, &last);
            print_message("%s n = %d, corner %s a step: order %.3f, error %.2g\n", of[i].scheme, of[i].ratio,
                          inside ? "inside" : "at the end of", order, last);
            assert_true(inside ? order > .85 : order > 1.9);
            assert_true(last < (inside ? 3e-3 : 1e-3));
        }
    }
}

/* --- work --------------------------------------------------------------------------------------------- */

/* x'' and angle'' give the force, and the force along x' the work, by Simpson's rule on the reference. */
static double work_of(const struct way *o, double g, double T)
{
    enum { N = 400 };
    double y[2] = {0}, sum = 0, h = T / N;
    for (int i = 0; i <= N; i++) {
        double t = i * h, a = start + y[0], xx = pull(o, t);
        double aa = -mass * arm / J * (g * sin(a) + xx * cos(a));
        double force = (trolley + mass) * xx + mass * arm * (cos(a) * aa - sin(a) * y[1] * y[1]);
        sum += (i == 0 || i == N ? 1 : i % 2 ? 4 : 2) * force * o->A * o->w * cos(o->w * t);
        if (i < N) swing(y, o, g, t, t + h);
    }
    return sum * h / 3;
}

static void test_work(void **state)
{
    (void)state;
    static const struct way smooth = {.A = .3, .w = 3};
    static const struct {
        const char *scheme;
        int ratio;
    } of[] = {{"midpoint", 1}, {"subcycle", 5}, {"newmark", 1}};
    const double T = 1, work = work_of(&smooth, 9.81, T);
    for (size_t k = 0; k < 3; k++) {
        double residual[4], error[4];
        for (int i = 0; i < 4; i++) {
            struct ride r;
            crane(&r, of[k].scheme, .004 / (1 << i), of[k].ratio, T, 9.81, "0.3*sin(3*t)");
            residual[i] = error[i] = 0;
            for (int n = 0; n < r.n; n++) residual[i] = fmax(residual[i], fabs(ride_at(&r, n, "energy.residual")));
            error[i] = fabs(ride_last(&r, "energy.drive") - work);
            ride_close(&r);
        }
        double falls = log2(residual[1] / residual[3]) / 2, nears = log2(error[1] / error[3]) / 2;
        print_message("%s n = %d: residual %.2g falls with h^%.2f; work off %.2g falls with h^%.2f\n", of[k].scheme,
                      of[k].ratio, residual[3], falls, error[3], nears);
        const double least = k < 2 ? 1.9 : 1.5; /* newmark: powers are those of the last iterate looked at */
        assert_true(falls > least);
        assert_true(nears > least);
    }
    struct ride r;
    crane(&r, "dopri5", 0, 1, T, 9.81, "0.3*sin(3*t)");
    assert_true(fabs(ride_last(&r, "energy.drive") - work) < 1e-8);
    ride_close(&r);
}

/* --- no freedom --------------------------------------------------------------------------------------- */

struct slider {
    double x, v, a, phi, w, al; /* slider along x; rod: its angle below the x axis */
};

/* Crank angle c with rate and acceleration; r sin(c) = l sin(phi), x = r cos(c) + l cos(phi). */
static struct slider slider_at(double r, double l, double c, double w, double al)
{
    struct slider o;
    o.phi = asin(r * sin(c) / l);
    o.w = r * cos(c) * w / (l * cos(o.phi));
    o.al = (r * (cos(c) * al - sin(c) * w * w) + l * sin(o.phi) * o.w * o.w) / (l * cos(o.phi));
    o.x = r * cos(c) + l * cos(o.phi);
    o.v = -r * sin(c) * w - l * sin(o.phi) * o.w;
    o.a = -r * (sin(c) * al + cos(c) * w * w) - l * (sin(o.phi) * o.al + cos(o.phi) * o.w * o.w);
    return o;
}

/* The mechanism at its own dynamics: wrist and elbow forces and the crank's torque in closed form. */
static void test_slider_crank(void **state)
{
    (void)state;
    static const double r = .15, l = .35, mc = .5, mr = .8, ms = 1.2, g = 9.81, Jc = .5 * .15 * .15 / 12,
                        Jr = .8 * .35 * .35 / 12;
    static const char *const how[] = {"scheme: newmark, step: 1.0e-3", "scheme: midpoint, step: 1.0e-3",
                                      "scheme: subcycle, step: 1.0e-3, ratio: 5", "scheme: rk4, step: 1.0e-3",
                                      "scheme: dopri5, tolerance: 1.0e-8"};
    for (int k = 0; k < 5; k++) {
        char text[2000];
        struct ride o;
        snprintf(text, sizeof text,
                 "fmdsub: 1\ngravity: [0, -9.81]\n"
                 "parameters: {r: 0.15, l: 0.35, c: 0.5, p: asin(0.15*sin(0.5)/0.35), x: r*cos(c) + l*cos(p)}\n"
                 "bodies:\n"
                 "  crank: {mass: 0.5, inertia: 0.5*r^2/12, at: [r/2*cos(c), r/2*sin(c)]}\n"
                 "  rod: {mass: 0.8, inertia: 0.8*l^2/12, at: [x - l/2*cos(p), l/2*sin(p)]}\n"
                 "  slider: {mass: 1.2, at: [x, 0]}\n"
                 "constraints:\n"
                 "  shaft: {revolute: [ground, crank], at: [0, 0]}\n"
                 "  elbow: {revolute: [crank, rod], at: [r*cos(c), r*sin(c)]}\n"
                 "  wrist: {revolute: [rod, slider], at: [x, 0]}\n"
                 "  rail: {prismatic: [ground, slider], at: [x, 0], axis: [1, 0]}\n"
                 "drives: {motor: {drive: shaft, value: 20*t + 3*t^2}}\n"
                 "integrate: {%s, until: 0.5}\n"
                 "output: {every: 0.05, columns: [shaft.angle, slider.x, slider.vx, slider.ax, wrist.f*, elbow.f*, "
                 "shaft.f*, rail.f*, motor.force, motor.power, energy.drive, energy.residual]}\n",
                 how[k]);
        ride_open(&o, text);
        if (o.status != OK) fail_msg("%s", o.report.text);
        assert_int_equal(o.sim.stepper.ode->n, 0);
        assert_int_equal(o.n, 11);
        for (int i = 0; i < o.n; i++) {
            double t = ride_at(&o, i, "t"), c = .5 + 20 * t + 3 * t * t, w = 20 + 6 * t, al = 6;
            struct slider s = slider_at(r, l, c, w, al);
            /* the rod's centre at (-dx, dy) from the wrist; on the rod: W at the wrist, E at the elbow; with its
             * angle -phi, -Jr al = dx Wy + dy Wx - dx Ey - dy Ex */
            double dx = l / 2 * cos(s.phi), dy = l / 2 * sin(s.phi);
            double ax = s.a + dy * s.al + dx * s.w * s.w, ay = dx * s.al - dy * s.w * s.w;
            double Wx = -ms * s.a, Ex = mr * ax - Wx, F = mr * (ay + g);
            double Wy = (-Jr * s.al + dx * F + dy * Ex - dy * Wx) / (2 * dx), Ey = F - Wy;
            double ex = r * cos(c), ey = r * sin(c);
            double M = (Jc + mc * r * r / 4) * al + mc * g * ex / 2 + ex * Ey - ey * Ex;
            double top = 1e-9 * (1 + fabs(M) + fabs(Ex) + fabs(Wy));
            assert_true(fabs(ride_at(&o, i, "shaft.angle") - (c - .5)) < 1e-11);
            assert_true(fabs(ride_at(&o, i, "slider.x") - s.x) < 1e-11);
            assert_true(fabs(ride_at(&o, i, "slider.vx") - s.v) < 1e-10);
            assert_true(fabs(ride_at(&o, i, "slider.ax") - s.a) < 1e-8);
            assert_true(fabs(ride_at(&o, i, "wrist.fx") + Wx) < top * 10);
            assert_true(fabs(ride_at(&o, i, "wrist.fy") + Wy) < top * 10);
            assert_true(fabs(ride_at(&o, i, "elbow.fx") - Ex) < top * 10);
            assert_true(fabs(ride_at(&o, i, "elbow.fy") - Ey) < top * 10);
            assert_true(fabs(ride_at(&o, i, "rail.fy") - ms * g - Wy) < top * 10);
            assert_true(fabs(ride_at(&o, i, "motor.force") - M) < top * 10);
            assert_true(fabs(ride_at(&o, i, "motor.power") - M * w) < top * 10 * w);
        }
        double residual = fabs(ride_last(&o, "energy.residual")), work = ride_last(&o, "energy.drive");
        print_message("%s: residual %.2g of %.3g J\n", how[k], residual, work);
        assert_true(residual < 1e-3 * fabs(work));
        ride_close(&o);
    }
}

/* A comb of sliders, all driven but the first: so few freedoms among so many coordinates that M^ is found column by
 * column.  Slider k follows k z: what the drives do is what all the others gain, and the first recoils from them. */
static void test_few(void **state)
{
    (void)state;
    enum { TEETH = 220, PER = 200 };
    char *text = malloc((TEETH + 20) * 3 * PER);
    int at = sprintf(text, "fmdsub: 1\nbodies:\n  base: {mass: 50, inertia: 1, at: [0, 0]}\n");
    for (int k = 1; k <= TEETH; k++) at += sprintf(text + at, "  t%d: {mass: 1, inertia: 1, at: [0, %d]}\n", k, k);
    at += sprintf(text + at, "constraints:\n  rail: {prismatic: [ground, base], at: [0, 0], axis: [1, 0]}\n");
    for (int k = 1; k <= TEETH; k++)
        at += sprintf(text + at, "  s%d: {prismatic: [base, t%d], at: [0, %d], axis: [1, 0]}\n", k, k, k);
    at += sprintf(text + at, "forces: {spring: {spring: rail, stiffness: 1.0e+4}}\ndrives:\n");
    for (int k = 1; k <= TEETH; k++)
        at += sprintf(text + at, "  d%d: {drive: s%d, value: %g*sin(7*t)}\n", k, k, 1e-3 * k);
    sprintf(text + at, "energy: {delta: 1}\nintegrate: {scheme: dopri5, tolerance: 1.0e-10, until: 0.1}\n"
                       "output: {every: 0.1, columns: [rail.displacement, rail.displacement_rate, energy.drive, "
                       "energy.residual]}\n");
    struct ride r;
    ride_open(&r, text);
    if (r.status != OK) fail_msg("%s", r.report.text);
    const double x = ride_last(&r, "rail.displacement"), v = ride_last(&r, "rail.displacement_rate");
    double expected = (.5 * 50 * v * v + .5 * 1e4 * x * x);
    for (int k = 1; k <= TEETH; k++) expected += .5 * pow(v + 1e-3 * k * 7 * cos(.7), 2) - .5 * pow(1e-3 * k * 7, 2);
    print_message("work %.12g, expected %.12g\n", ride_last(&r, "energy.drive"), expected);
    assert_true(fabs(ride_last(&r, "energy.drive") - expected) < 1e-7 * fabs(expected));
    assert_true(fabs(ride_last(&r, "energy.residual")) < 1e-7 * fabs(expected));
    ride_close(&r);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_corner), cmocka_unit_test(test_middle),
                                       cmocka_unit_test(test_order),  cmocka_unit_test(test_order_with_corner),
                                       cmocka_unit_test(test_work),   cmocka_unit_test(test_slider_crank),
                                       cmocka_unit_test(test_few)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
