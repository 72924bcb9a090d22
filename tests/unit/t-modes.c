/* t-modes.c -- frequencies of small motions against closed forms. */
#include "probe/modes.h"

#include <math.h>

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_slider),
        cmocka_unit_test(test_double_pendulum),
        cmocka_unit_test(test_upright),
        cmocka_unit_test(test_suggestion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
