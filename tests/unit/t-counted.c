/* t-counted.c -- what runs of ten steps have counted: evaluations that the formulas take, no more and no less. */
#include "unit/decks.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static struct effort effort_of(const char *integrate)
{
    char text[600];
    struct opened o;
    snprintf(text, sizeof text,
             "fmdsub: 1\ngravity: [0, -9.81]\nbodies: {bob: {mass: 1, inertia: 0.1, at: [1, 0]}}\n"
             "constraints: {pin: {revolute: [ground, bob], at: [0, 0]}}\nintegrate: {%s, until: 0.1}\noutput: {every: "
             "0.1}\n",
             integrate);
    open_text(&o, text);
    print_wrong(&o);
    assert_int_equal(o.status, OK);
    assert_int_equal(sim_run(&o.sim, NULL, &o.report), OK);
    const struct effort e = o.sim.stepper.effort;
    shut(&o);
    return e;
}

/* Four a step, and the start. */
static void test_rk4(void **state)
{
    (void)state;
    const struct effort e = effort_of("scheme: rk4, step: 0.01");
    assert_int_equal(e.majors, 10);
    assert_true(e.slow == 41 && e.fast == 41);
    assert_true(e.factors == 0 && e.sweeps == 0 && e.rejected == 0);
}

/* Six a step, the seventh is the first of the next; before them the start, and two for the length of the first step. */
static void test_dopri5(void **state)
{
    (void)state;
    const struct effort e = effort_of("scheme: dopri5, tolerance: 1.0e-6");
    assert_true(e.majors > 3 && e.slow == 6 * (e.majors + e.rejected) + 3 && e.fast == e.slow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rk4), cmocka_unit_test(test_dopri5)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
