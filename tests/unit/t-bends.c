/* t-bends.c -- has the way from one step to the next gone over a corner of a force's law?  Steps of a slide, made by hand. */
#include "unit/decks.h"

#include "system/system.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* The slide steps to x. */
static bool bent_to(struct opened *o, double x)
{
    struct ode2 *ode = o->sim.stepper.ode;
    double q[] = {x}, v[] = {1}, t = 0;
    ode->chart->rechart(ode, q, v, t);
    return system_bent(o->sim.system);
}

static void with_force(struct opened *o, const char *force)
{
    char text[600];
    snprintf(text, sizeof text,
             "fmdsub: 1\nbodies: {car: {mass: 1, inertia: 1, at: [0, 0]}}\n"
             "constraints: {slide: {prismatic: [ground, car], at: [0, 0], axis: [1, 0]}}\n"
             "forces: {f: {%s}}\nintegrate: {scheme: dopri5, tolerance: 1.0e-6, until: 1}\noutput: {every: 1}\n",
             force);
    open_text(o, text);
    print_wrong(o);
    assert_int_equal(o->status, OK);
}

static void test_corners(void **state)
{
    (void)state;
    /* Each has a corner at 0.05, and none at other places of the way. */
    static const char *const forces[] = {
        "unilateral: slide, from: 0.05, stiffness: 100",
        "curve: slide, table: [[-1, 5.25], [0.05, 0], [1, -19]]",
        "force: slide, value: \"if(slide.displacement < 0.05, 0, 3*(0.05 - slide.displacement))\"",
    };
    for (size_t i = 0; i < sizeof forces / sizeof *forces; i++) {
        struct opened o;
        with_force(&o, forces[i]);
        if (bent_to(&o, .02)) fail_msg("%s: bent on the way to 0.02", forces[i]);
        if (bent_to(&o, .04)) fail_msg("%s: bent on the way to 0.04", forces[i]);
        if (!bent_to(&o, .06)) fail_msg("%s: not bent on the way to 0.06", forces[i]);
        if (bent_to(&o, .1)) fail_msg("%s: bent on the way to 0.1", forces[i]);
        if (bent_to(&o, .07)) fail_msg("%s: bent on the way back to 0.07", forces[i]);
        if (!bent_to(&o, .03)) fail_msg("%s: not bent on the way back to 0.03", forces[i]);
        shut(&o);
    }
}

/* A straight spring never: nobody follows it. */
static void test_straight(void **state)
{
    (void)state;
    struct opened o;
    with_force(&o, "spring: slide, stiffness: 7");
    assert_null(o.sim.stepper.ode->chart);
    assert_false(system_bent(o.sim.system));
    shut(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_corners), cmocka_unit_test(test_straight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
