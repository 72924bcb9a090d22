/* t-strikes.c -- strikes unlike the last few count, those of a motion that repeats itself do not, nor long pushes. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/strikes.h"
#include "unit/opened.h"

#include <cmocka.h>

/* n strikes that begin at t with velocities v, take `takes` and turn them by e. */
static struct strikes struck(struct arena *life, const double *v, const double *t, int n, double takes, double e)
{
    struct strikes o;
    strikes_open(&o, 1, life);
    for (int i = 0; i < n; i++) {
        const double back = -e * v[i];
        strikes_note(&o, &v[i], t[i]);
        strikes_note(&o, &back, t[i] + takes);
    }
    return o;
}

/* Two stops in turn, a stronger blow first: of each stop the first blow but the very first, behind which no time between two is
 * known yet. */
static void strikes_cycle(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    double v[40], t[40];
    for (int i = 0; i < 40; i++) {
        v[i] = i == 0 ? 3 : i % 2 ? -2 : 1.5;
        t[i] = i;
    }
    struct strikes o = struck(life, v, t, 40, .1, .9);
    assert_int_equal(o.seen, 80);
    assert_int_equal(o.unlike, 2);
    o = struck(life, v, t, 40, .5, .9); /* they lie on the stops for half of the time */
    assert_int_equal(o.unlike, 0);
    o = struck(life, v, t, 40, .1, -.9); /* nothing turns */
    assert_int_equal(o.unlike, 0);
    arena_close(life);
}

/* A ball that comes to rest, each bounce 0.7 of the one before: what is left at last is little beside the first. */
static void strikes_rest(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    double v[40], t[40], speed = 1, time = 0;
    for (int i = 0; i < 40; i++, speed *= .7, time += speed) v[i] = -speed, t[i] = time;
    const struct strikes o = struck(life, v, t, 40, 1e-8, .7);
    assert_in_range(o.unlike, 1, 6);
    arena_close(life);
}

/* x -> 1 - 2 x^2 is never the same for long. */
static void strikes_stray(void **unused)
{
    (void)unused;
    struct arena *life = arena_open();
    double v[40], t[40], x = .3, time = 0;
    for (int i = 0; i < 40; i++, x = 1 - 2 * x * x, time += 2 + x) v[i] = -1.5 - x, t[i] = time;
    const struct strikes o = struck(life, v, t, 40, .1, .9);
    assert_in_range(o.unlike, 12, 40);
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
        assert_int_equal(o.sim.stepper.strikes->unlike, 2);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(strikes_cycle), cmocka_unit_test(strikes_rest),
                                       cmocka_unit_test(strikes_stray), cmocka_unit_test(strikes_run)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
