/* t-rest.c -- static starts: forces vanish there, and the posture is the stable one. */
#include <math.h>

#include "probe/modes.h"
#include "unit/decks.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* From the horizontal a double pendulum comes to hang down; from close to upright too. */
static void test_hangs(void **state)
{
    static const char *const starts[] = {"initial={static: true}", "initial={static: true, pin1.angle: 1.5}",
                                         "initial={static: true, pin1.angle: 1.5707963267948966, pin2.angle: 0.01}"};
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct opened o;
        open_path(&o, "decks/double-pendulum.yaml", 1, &starts[i]);
        assert_int_equal(o.status, OK);
        struct pose p;
        struct trouble why;
        assert_int_equal(system_evaluate(o.sim.system, o.sim.x.q, o.sim.x.v, 0, EVALUATE_MOTION, &why), OK);
        system_pose(o.sim.system, &p, 2);
        assert_true(fabs(p.r[0]) < 1e-9 && fabs(p.r[1] + 1.5) < 1e-9);
        for (int k = 0; k < 2; k++) assert_true(fabs(o.sim.x.a[k]) < 1e-9);
        shut(&o);
    }
}

/* The mass on a spring hangs at l0 + m g / k. */
static void test_spring(void **state)
{
    static const char *const set[] = {"initial={static: true}"};
    struct opened o;
    (void)state;
    open_path(&o, "decks/spring-pendulum.yaml", 1, set);
    assert_int_equal(o.status, OK);
    struct pose p;
    struct trouble why;
    int ball = o.sim.model->nbody - 1;
    assert_int_equal(system_evaluate(o.sim.system, o.sim.x.q, o.sim.x.v, 0, EVALUATE_MOTION, &why), OK);
    system_pose(o.sim.system, &p, ball);
    assert_true(fabs(p.r[0]) < 1e-9 && fabs(p.r[1] + 1 + 9.81 / 1e4) < 1e-9);
    shut(&o);
}

/* Rates of the deck stay. */
static void test_rates_stay(void **state)
{
    static const char *const set[] = {"initial={static: true, pin1.angle_rate: 2}"};
    struct opened o;
    (void)state;
    open_path(&o, "decks/double-pendulum.yaml", 1, set);
    assert_int_equal(o.status, OK);
    double sum = 0;
    for (int k = 0; k < 2; k++) sum += fabs(o.sim.x.v[k]);
    assert_true(sum == 2);
    shut(&o);
}

/* What nothing holds has no equilibrium: refused, not approximated. */
static void test_nothing_holds(void **state)
{
    static const char *const set[] = {"initial={static: true}"};
    struct opened o;
    (void)state;
    open_path(&o, "decks/free-fall.yaml", 1, set);
    assert_int_equal(o.status, E_MODEL);
    shut(&o);
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
