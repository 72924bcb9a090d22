/* t-overdamped.c -- a damper with a time constant of 1e-4 s under steps of 0.02 s: velocities alternate, the posture is right,
 * and the ledger is not taken in by the powers at the ends of the steps. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "sim/parts.h"

#include <cmocka.h>

#include "unit/opened.h"

#define DECK                                                                                                           \
    "gravity: [0, -9.81]\n"                                                                                            \
    "bodies: {a: {mass: 1, inertia: 0.1, at: [0.5, 0]}, b: {mass: 1, inertia: 0.1, at: [0.5, 0.2]}}\n"                 \
    "constraints: {p: {revolute: [ground, a], at: [0, 0]}, e: {revolute: [a, b], at: [0.5, 0.2]}}\n"                   \
    "forces: {d: {damper: p, damping: 3500}, s: {spring: p, stiffness: 100}, d2: {damper: e, damping: 2}}\n"           \
    "initial: {p.angle_rate: 2}\n"

static void balance_is_kept(void **state)
{
    static const char *const schemes[] = {"newmark", "midpoint", "generalized-alpha, rho_infinity: 1", "miao"};
    struct opened fine, o;
    char text[800];
    (void)state;
    open_deck(&fine, DECK "integrate: {scheme: midpoint, step: 5.0e-5, until: 10}\n");
    run(&fine);
    for (int k = 0; k < 4; k++) {
        snprintf(text, sizeof text, DECK "integrate: {scheme: %s, step: 0.02, until: 10}\n", schemes[k]);
        open_deck(&o, text);
        run(&o);
        near(value(&o, "p.angle"), value(&fine, "p.angle"), 2e-6);
        /* what midpoint books is the exact balance of this motion, which is the same in all of them */
        near(value(&o, "energy.damper"), -2, .6);
        assert_true(o.sim.ledger.worst < 5e-3 * o.sim.ledger.norm);
        arena_close(o.life);
    }
    arena_close(fine.life);
}

/* Schemes with damping of their own swing over where they start into such a damper: what dampers take is booked along the
 * way that the step went, so that all that is missing is what the scheme has put in; and that is told.  From rest, where
 * nothing swings over, the balance is kept. */
static void what_swings_over_is_told(void **state)
{
    static const char *const schemes[] = {"hht", "generalized-alpha, rho_infinity: 0.5", "hht, alpha: -0.3"};
    (void)state;
    for (int k = 0; k < 6; k++) {
        struct opened o;
        char text[800];
        snprintf(text, sizeof text,
                 "gravity: [0, 0]\n"
                 "bodies: {m: {mass: 1, inertia: 0.1, at: [0, 0]}}\n"
                 "constraints: {s: {prismatic: [ground, m], at: [0, 0], axis: [1, 0]}}\n"
                 "forces: {k: {spring: s, stiffness: 100, damping: 1.0e+4}}\n"
                 "initial: {%s}\n"
                 "integrate: {scheme: %s, step: 0.02, until: 1}\n",
                 k < 3 ? "s.displacement_rate: 1" : "s.displacement: 0.1", schemes[k % 3]);
        open_deck(&o, text);
        const enum status status = sim_run(&o.sim, NULL, &o.report);
        assert_int_equal(status, k < 3 ? E_VERDICT : OK);
        assert_true(o.sim.ledger.worst < 5e-3 * o.sim.ledger.norm);
        if (k < 3) assert_non_null(strstr(o.report.text, "the scheme's own damping"));
        if (k < 3) assert_true(value(&o, "s.displacement") > 5e-4); /* a tenth of a millimetre, were it right */
        if (k >= 3) near(value(&o, "s.displacement"), 0.1 * exp(-.01), 2e-4);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(balance_is_kept), cmocka_unit_test(what_swings_over_is_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
