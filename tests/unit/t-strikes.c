/* t-strikes.c -- pushes that begin and end: those unlike the last few count, those of a motion that repeats itself do not. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/strikes.h"
#include "unit/opened.h"

#include <cmocka.h>

static struct strikes struck(struct arena *life, const double *v, const double *t, int n)
{
    struct strikes o;
    strikes_open(&o, 1, life);
    for (int i = 0; i < n; i++) strikes_note(&o, &v[i], t[i], true);
    return o;
}

/* Two stops in turn, a stronger blow first: from the second round on each is like one before. */
static void strikes_cycle(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    double v[40], t[40];
    for (int i = 0; i < 40; i++) {
        v[i] = i == 0 ? 3 : i % 2 ? -2 : 1.5;
        t[i] = i / 2 + (i % 2 ? .3 : 0);
    }
    const struct strikes o = struck(life, v, t, 40);
    assert_int_equal(o.seen, 40);
    assert_int_equal(o.unlike, 3);
    arena_close(life);
}

/* A ball that comes to rest, each bounce 0.7 of the one before: what is left at last is little beside the first. */
static void strikes_rest(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    double v[40], t[40], speed = 1, time = 0;
    for (int i = 0; i < 40; i++, speed *= .7, time += speed) v[i] = speed, t[i] = time;
    const struct strikes o = struck(life, v, t, 40);
    assert_in_range(o.unlike, 6, 10);
    arena_close(life);
}

/* Edges of forces that only bend by the state: those of a drag between phases that are alike count for nothing, never alike
 * though they are; teeth that meet for a hundredth of the time and turn velocities round do. */
static void strikes_brief(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    struct strikes drag, teeth;
    double x = .3, t = 0, along = 0;
    strikes_open(&drag, 1, life);
    strikes_open(&teeth, 1, life);
    for (int i = 0; i < 40; i++, x = 1 - 2 * x * x) {
        const double turned = x < 0 ? 1 + x : 1 - x;
        strikes_note(&drag, &(double){(i % 2 ? 1 : -1) * (2 + x / 2)}, along, false);
        along += 2 + x / 2;
        strikes_note(&teeth, &turned, t, false);
        strikes_note(&teeth, &(double){-turned}, t + .01 * turned, false);
        t += 1 + turned;
    }
    assert_int_equal(drag.seen, 40);
    assert_int_equal(drag.unlike, 0);
    assert_int_equal(teeth.seen, 80);
    assert_in_range(teeth.unlike, 30, 80);
    arena_close(life);
}

/* x -> 1 - 2 x^2 is never the same for long. */
static void strikes_stray(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    double v[40], t[40], x = .3, time = 0;
    for (int i = 0; i < 40; i++, x = 1 - 2 * x * x, time += 2 + x) v[i] = x, t[i] = time;
    const struct strikes o = struck(life, v, t, 40);
    assert_in_range(o.unlike, 20, 40);
    arena_close(life);
}

/* Three blows on two stops, each of which begins and ends, by schemes that look for edges in ways of their own. */
static void strikes_run(void **unused)
{
    (void)unused;
    static const char *const scheme[] = {"scheme: dopri5, tolerance: 1.0e-4", "scheme: radau5, tolerance: 1.0e-4",
                                         "scheme: subcycle, tolerance: 1.0e-3", "scheme: rk4, step: 1.0e-3",
                                         "scheme: newmark, step: 1.0e-4"};
    for (int k = 0; k < 5; k++) {
        struct opened o;
        char text[600];
        snprintf(text, sizeof text,
                 "bodies:\n"
                 "  box: {mass: 1, at: [0, 0]}\n"
                 "constraints:\n"
                 "  s: {prismatic: [ground, box], axis: [1, 0],\n"
                 "    range: {lower: -0.5, upper: 0.5, hold: {stiffness: 1.0e+4, damping: 5}}}\n"
                 "initial: {s.displacement_rate: 2}\n"
                 "integrate: {%s, until: 1.6}\n"
                 "output: {every: 0.1}\n",
                 scheme[k]);
        open_deck(&o, text);
        run(&o);
        assert_int_equal(o.sim.stepper.strikes->seen, 6);
        assert_int_equal(o.sim.stepper.strikes->unlike, 6);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(strikes_cycle), cmocka_unit_test(strikes_rest),
                                       cmocka_unit_test(strikes_brief), cmocka_unit_test(strikes_stray),
                                       cmocka_unit_test(strikes_run)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
