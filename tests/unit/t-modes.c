/* t-modes.c -- frequencies of small motions against closed forms. */
#include "probe/modes.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "unit/decks.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static void find(struct opened *o, struct modes *m, const char *path, int nset, const char *const *set)
{
    open_path(o, path, nset, set);
    print_wrong(o);
    assert_int_equal(o->status, OK);
    assert_int_equal(modes_find(m, &o->sim, o->life, &o->report), OK);
}

static void near(double x, double wanted, double relative)
{
    if (!(fabs(x - wanted) <= relative * fabs(wanted))) print_error("%.12g, wanted %.12g\n", x, wanted);
    assert_true(fabs(x - wanted) <= relative * fabs(wanted));
}

/* sqrt(k / m) along the rod; the rod turns freely. */
static void test_slider(void **state)
{
    struct opened o;
    struct modes found;
    (void)state;
    find(&o, &found, "decks/bar-slider.yaml", 0, NULL);
    assert_int_equal(found.n, 2);
    near(found.mode[1].omega, sqrt(1000. / 5), 1e-6);
    assert_true(found.mode[0].omega < 1e-3);
    near(found.mode[1].fast, 1, 1e-6);
    near(found.fast_top, sqrt(1000. / 5), 1e-6);
    shut(&o);
}

/* Two equal uniform rods hanging: with lambda = w^2 L / g, 7 lambda^2 - 42 lambda + 27 = 0, that is
 * lambda = 3 +- 6 / sqrt(7) (m, L of the rods cancel). */
static void test_double_pendulum(void **state)
{
    static const char *const hanging[] = {"initial={pin1.angle: -1.5707963267948966}"};
    struct opened o;
    struct modes found;
    (void)state;
    find(&o, &found, "decks/double-pendulum.yaml", 1, hanging);
    near(found.mode[0].omega, sqrt(9.81 * (3 - 6 / sqrt(7))), 1e-6);
    near(found.mode[1].omega, sqrt(9.81 * (3 + 6 / sqrt(7))), 1e-6);
    shut(&o);
}

/* Upright it is unstable both ways: growth rates. */
static void test_upright(void **state)
{
    static const char *const upright[] = {"initial={pin1.angle: 1.5707963267948966}"};
    struct opened o;
    struct modes found;
    (void)state;
    find(&o, &found, "decks/double-pendulum.yaml", 1, upright);
    near(found.mode[0].omega, -sqrt(9.81 * (3 + 6 / sqrt(7))), 1e-6);
    near(found.mode[1].omega, -sqrt(9.81 * (3 - 6 / sqrt(7))), 1e-6);
    shut(&o);
}

/* The suggestion resolves what it names. */
static void test_suggestion(void **state)
{
    struct opened o;
    struct modes found;
    double h;
    int ratio;
    (void)state;
    find(&o, &found, "decks/stiff-leaf-chain.yaml", 0, NULL);
    modes_suggest(&h, &ratio, &found, &o.sim);
    assert_true(h * found.fast_top <= 0.1 && h * found.fast_top >= 0.04);
    assert_true(ratio > 1 && h * ratio * found.slow_top <= 0.1 + 1e-12);
    shut(&o);
}

/* A carriage of mass m1 on a spring along x of a disk that turns at W, on it a bob of mass m2 on a spring and a damper
 * along y.  With a = m1 + m2, k1 and k2 less a W^2 and m2 W^2:
 *
 *     (k1 - a w^2)(k2 - m2 w^2) = 4 W^2 m2^2 w^2,
 *
 * and by the derivative of the characteristic polynomial, to first order in the damper c, the rate of decay
 *
 *     s = c (k1 - a w^2) / (2 a (k2 - m2 w^2) + 2 m2 (k1 - a w^2) + 8 W^2 m2^2). */
static void on_disk(struct opened *o, struct modes *m, const char *speed)
{
    static const char deck[] = "fmdsub: 1\n"
                               "parameters: {W: 0}\n"
                               "bodies:\n"
                               "  disk: {mass: 1, inertia: 1, at: [0, 0]}\n"
                               "  carriage: {mass: 2, inertia: 1, at: [0, 0]}\n"
                               "  bob: {mass: 3, inertia: 1, at: [0, 0]}\n"
                               "constraints:\n"
                               "  shaft: {revolute: [ground, disk], at: [0, 0]}\n"
                               "  along: {prismatic: [disk, carriage], at: [0, 0], axis: [1, 0]}\n"
                               "  across: {prismatic: [carriage, bob], at: [0, 0], axis: [0, 1]}\n"
                               "forces:\n"
                               "  one: {spring: along, stiffness: 500}\n"
                               "  two: {spring: across, stiffness: 700, damping: 0.4}\n"
                               "drives: {spin: {drive: shaft.angle, value: W*t}}\n"
                               "integrate: {scheme: midpoint, step: 1.0e-3, until: 1}\n";
    char path[] = "/tmp/t-modes-XXXXXX.yaml";
    int file = mkstemps(path, 5);
    assert_true(file >= 0);
    assert_int_equal(write(file, deck, sizeof deck - 1), sizeof deck - 1);
    close(file);
    find(o, m, path, 1, &speed);
    unlink(path);
}

static void test_gyroscopic(void **state)
{
    (void)state;
    const double W = 7, a = 5, m = 3, k1 = 500 - a * W * W, k2 = 700 - m * W * W, c = 0.4;
    struct opened o;
    struct modes found;
    double p = k1 / a, q = k2 / m, sum = p + q + 4 * W * W * m / a, root = sqrt(sum * sum - 4 * p * q);
    on_disk(&o, &found, "parameters.W=7");
    assert_int_equal(found.n, 2);
    for (int i = 0; i < 2; i++) {
        double w2 = (sum + (i ? root : -root)) / 2, x = k1 - a * w2, y = k2 - m * w2;
        double decay = c * x / (2 * a * y + 2 * m * x + 8 * W * W * m * m);
        near(found.mode[i].omega, sqrt(w2), 1e-7);
        near(found.mode[i].damping, decay / sqrt(w2), 1e-6);
        near(found.mode[i].share[0] + found.mode[i].share[1], 1, 1e-9);
    }
    assert_false(found.gyroscopic_left_out);
    shut(&o);
}

/* Faster than the weaker spring can hold it: without gyroscopic terms unstable, and it says so. */
static void test_left_out(void **state)
{
    (void)state;
    struct opened o;
    struct modes found;
    on_disk(&o, &found, "parameters.W=12");
    near(found.mode[0].omega, -sqrt(144 - 500. / 5), 1e-6);
    near(found.mode[1].omega, sqrt(700. / 3 - 144), 1e-6);
    assert_true(found.gyroscopic_left_out);
    shut(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slider),     cmocka_unit_test(test_double_pendulum), cmocka_unit_test(test_upright),
        cmocka_unit_test(test_suggestion), cmocka_unit_test(test_gyroscopic),      cmocka_unit_test(test_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
