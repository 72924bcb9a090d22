/* t-rest.c -- static starts: forces vanish there, and the posture is the stable one. */
#include <math.h>

#include "probe/modes.h"
#include "sim/load.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

struct opened {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
};

static enum status open_deck(struct opened *o, const char *path, int nset, const char *const *set)
{
    struct report report = {0};
    const struct deck_options options = {.nset = nset, .set = set};
    const struct sim_options quiet = {.version = "test"};
    o->life = arena_open();
    struct diags *diags = diags_open(o->life);
    assert_int_equal(sim_load(&o->scene, path, &options, diags, o->life, &report), OK);
    return sim_open(&o->sim, o->scene, &o->scene->integrate, &quiet, diags, o->life, &report);
}

/* From the horizontal a double pendulum comes to hang down; from close to upright too. */
static void test_hangs(void **state)
{
    static const char *const starts[] = {"initial={static: true}", "initial={static: true, pin1.angle: 1.5}",
                                         "initial={static: true, pin1.angle: 1.5707963267948966, pin2.angle: 0.01}"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct opened o;
        assert_int_equal(open_deck(&o, "decks/double-pendulum.yaml", 1, &starts[i]), OK);
        struct pose p;
        struct trouble why;
        assert_int_equal(system_see(o.sim.system, o.sim.x.q, o.sim.x.v, 0, SEE_MOTION, &why), OK);
        system_pose(o.sim.system, &p, 2);
        assert_true(fabs(p.r[0]) < 1e-9 && fabs(p.r[1] + 1.5) < 1e-9);
        for (int k = 0; k < 2; k++) assert_true(fabs(o.sim.x.a[k]) < 1e-9);
        arena_close(o.life);
    }
}

/* The mass on a spring hangs at l0 + m g / k. */
static void test_spring(void **state)
{
    static const char *const set[] = {"initial={static: true}"};
    struct opened o;
    (void)state;
    assert_int_equal(open_deck(&o, "decks/spring-pendulum.yaml", 1, set), OK);
    struct pose p;
    struct trouble why;
    int ball = o.sim.model->nbody - 1;
    assert_int_equal(system_see(o.sim.system, o.sim.x.q, o.sim.x.v, 0, SEE_MOTION, &why), OK);
    system_pose(o.sim.system, &p, ball);
    assert_true(fabs(p.r[0]) < 1e-9 && fabs(p.r[1] + 1 + 9.81 / 1e4) < 1e-9);
    arena_close(o.life);
}

/* Rates of the deck stay. */
static void test_rates_stay(void **state)
{
    static const char *const set[] = {"initial={static: true, pin1.angle_rate: 2}"};
    struct opened o;
    (void)state;
    assert_int_equal(open_deck(&o, "decks/double-pendulum.yaml", 1, set), OK);
    double sum = 0;
    for (int k = 0; k < 2; k++) sum += fabs(o.sim.x.v[k]);
    assert_true(sum == 2);
    arena_close(o.life);
}

/* What nothing holds has no equilibrium: refused, not approximated. */
static void test_nothing_holds(void **state)
{
    static const char *const set[] = {"initial={static: true}"};
    struct opened o;
    (void)state;
    assert_int_equal(open_deck(&o, "decks/free-fall.yaml", 1, set), E_MODEL);
    arena_close(o.life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hangs),
        cmocka_unit_test(test_spring),
        cmocka_unit_test(test_rates_stay),
        cmocka_unit_test(test_nothing_holds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
