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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(balance_is_kept)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
