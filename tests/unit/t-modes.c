/* t-modes.c -- frequencies of small motions against closed forms. */
#include "probe/modes.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "sim/load.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

struct opened {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
    struct modes modes;
};

static void find(struct opened *o, const char *path, int nset, const char *const *set)
{
    struct report report = {0};
    const struct deck_options options = {.nset = nset, .set = set};
    const struct sim_options quiet = {.version = "test"};
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    assert_int_equal(sim_load(&o->scene, path, &options, diags, o->life, &report), OK);
    assert_int_equal(sim_open(&o->sim, o->scene, &o->scene->integrate, &quiet, diags, o->life, &report), OK);
    assert_int_equal(modes_find(&o->modes, &o->sim, o->life, &report), OK);
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
    (void)state;
    find(&o, "decks/bar-slider.yaml", 0, NULL);
    assert_int_equal(o.modes.n, 2);
    near(o.modes.mode[1].omega, sqrt(1000. / 5), 1e-6);
    assert_true(o.modes.mode[0].omega < 1e-3);
    near(o.modes.mode[1].fast, 1, 1e-6);
    near(o.modes.fast_top, sqrt(1000. / 5), 1e-6);
    arena_close(o.life);
}

/* Two equal uniform rods hanging: with lambda = w^2 L / g, 7 lambda^2 - 42 lambda + 27 = 0, that is
 * lambda = 3 +- 6 / sqrt(7) (m, L of the rods cancel). */
static void test_double_pendulum(void **state)
{
    static const char *const hanging[] = {"initial={pin1.angle: -1.5707963267948966}"};
    struct opened o;
    (void)state;
    find(&o, "decks/double-pendulum.yaml", 1, hanging);
    near(o.modes.mode[0].omega, sqrt(9.81 * (3 - 6 / sqrt(7))), 1e-6);
    near(o.modes.mode[1].omega, sqrt(9.81 * (3 + 6 / sqrt(7))), 1e-6);
    arena_close(o.life);
}

/* Upright it is unstable both ways: growth rates. */
static void test_upright(void **state)
{
    static const char *const upright[] = {"initial={pin1.angle: 1.5707963267948966}"};
    struct opened o;
    (void)state;
    find(&o, "decks/double-pendulum.yaml", 1, upright);
    near(o.modes.mode[0].omega, -sqrt(9.81 * (3 + 6 / sqrt(7))), 1e-6);
    near(o.modes.mode[1].omega, -sqrt(9.81 * (3 - 6 / sqrt(7))), 1e-6);
    arena_close(o.life);
}

/* The suggestion resolves what it names. */
static void test_suggestion(void **state)
{
    struct opened o;
    double h;
    int ratio;
    (void)state;
    find(&o, "decks/stiff-leaf-chain.yaml", 0, NULL);
    modes_suggest(&h, &ratio, &o.modes, &o.sim);
    assert_true(h * o.modes.fast_top <= 0.1 && h * o.modes.fast_top >= 0.04);
    assert_true(ratio > 1 && h * ratio * o.modes.slow_top <= 0.1 + 1e-12);
    arena_close(o.life);
}

/* A carriage of mass m1 on a spring along x of a disk that turns at W, on it a bob of mass m2 on a spring and a damper
 * along y.  With a = m1 + m2, k1 and k2 less a W^2 and m2 W^2:
 *
 *     (k1 - a w^2)(k2 - m2 w^2) = 4 W^2 m2^2 w^2,
 *
 * and by the derivative of the characteristic polynomial, to first order in the damper c, the rate of decay
 *
 *     s = c (k1 - a w^2) / (2 a (k2 - m2 w^2) + 2 m2 (k1 - a w^2) + 8 W^2 m2^2). */
static void on_disk(struct opened *o, const char *speed)
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
    find(o, path, 1, &speed);
    unlink(path);
}

static void test_gyroscopic(void **state)
{
    (void)state;
    const double W = 7, a = 5, m = 3, k1 = 500 - a * W * W, k2 = 700 - m * W * W, c = 0.4;
    struct opened o;
    double p = k1 / a, q = k2 / m, sum = p + q + 4 * W * W * m / a, root = sqrt(sum * sum - 4 * p * q);
    on_disk(&o, "parameters.W=7");
    assert_int_equal(o.modes.n, 2);
    for (int i = 0; i < 2; i++) {
        double w2 = (sum + (i ? root : -root)) / 2, x = k1 - a * w2, y = k2 - m * w2;
        double decay = c * x / (2 * a * y + 2 * m * x + 8 * W * W * m * m);
        near(o.modes.mode[i].omega, sqrt(w2), 1e-7);
        near(o.modes.mode[i].damping, decay / sqrt(w2), 1e-6);
        near(o.modes.mode[i].share[0] + o.modes.mode[i].share[1], 1, 1e-9);
    }
    assert_false(o.modes.gyroscopic_left_out);
    arena_close(o.life);
}

/* Faster than the weaker spring can hold it: without gyroscopic terms unstable, and it says so. */
static void test_left_out(void **state)
{
    (void)state;
    struct opened o;
    on_disk(&o, "parameters.W=12");
    near(o.modes.mode[0].omega, -sqrt(144 - 500. / 5), 1e-6);
    near(o.modes.mode[1].omega, sqrt(700. / 3 - 144), 1e-6);
    assert_true(o.modes.gyroscopic_left_out);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slider),     cmocka_unit_test(test_double_pendulum), cmocka_unit_test(test_upright),
        cmocka_unit_test(test_suggestion), cmocka_unit_test(test_gyroscopic),      cmocka_unit_test(test_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
