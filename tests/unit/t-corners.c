/* t-corners.c -- corners of drives within a major step: sub-cycling meets them at their instant and keeps the balance. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "sim/parts.h"

#include <cmocka.h>

#include "unit/opened.h"

static void open_driven(struct opened *o, double corner, const char *integrate)
{
    char text[1200];
    snprintf(text, sizeof text,
             "gravity: [0, -9.81]\n"
             "bodies:\n"
             "  a: {mass: 2, inertia: 0.3, at: [0.5, 0]}\n"
             "  b: {mass: 0.3, inertia: 0.01, at: [1.2, 0]}\n"
             "  c: {mass: 1, inertia: 0.1, at: [-0.5, 0]}\n"
             "constraints:\n"
             "  p: {revolute: [ground, a], at: [0, 0]}\n"
             "  e: {revolute: [a, b], at: [1, 0]}\n"
             "  q: {revolute: [a, c], at: [-0.2, 0]}\n"
             "forces: {s: {spring: e, stiffness: 60}, s2: {spring: q, stiffness: 20}}\n"
             "drives: {d: {drive: p.angle, value: {table: [[0, 0], [%g, 0.3], [0.7, -0.2], [2, 0.5]]}}}\n"
             "partition: {fast: [e]}\n"
             "initial: {p.angle: 0, assemble: true}\n"
             "integrate: {%s, until: 1}\n",
             corner, integrate);
    open_deck(o, text);
}

/* At an end of a minor step, inside of one, near an end of a major step. */
static void balance_and_motion(void **state)
{
    static const double corners[] = {.333, .3334, .3371, .33, .3399999};
    (void)state;
    for (int i = 0; i < 5; i++) {
        struct opened fine, o;
        open_driven(&fine, corners[i], "scheme: midpoint, step: 5.0e-5");
        run(&fine);
        for (int ratio = 10; ratio <= 20; ratio += 10) {
            char plan[80];
            snprintf(plan, sizeof plan, "scheme: subcycle, step: 1.0e-3, ratio: %d", ratio);
            open_driven(&o, corners[i], plan);
            run(&o);
            assert_true(o.sim.ledger.worst < 2e-4 * (ratio / 10) * o.sim.ledger.norm);
            near(value(&o, "q.angle"), value(&fine, "q.angle"), ratio == 10 ? 3e-3 : 1e-2);
            near(value(&o, "e.angle"), value(&fine, "e.angle"), 2e-3);
            arena_close(o.life);
        }
        arena_close(fine.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(balance_and_motion)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
