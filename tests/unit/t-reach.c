/* t-reach.c -- gaps within reach are told as they are, all others as farther, whatever was asked before. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit/opened.h"

#include <cmocka.h>

enum { POINTS = 40 };

static double drawn(void)
{
    static uint32_t x = 2463534242u;
    x ^= x << 13;
    x ^= x >> 17;
    x ^= x << 5;
    return x / 4294967296. * 2 - 1;
}

/* POINTS of a body that flies over a body on a pin, with its plane or ball, in the plane or in space. */
static void open_scene(struct opened *o, int space, const char *surface)
{
    static char text[16000];
    int n = snprintf(text, sizeof text, "bodies:\n  slab: {mass: 1, inertia: %s, at: [0, 0%s]}\n",
                     space == 2 ? "1" : "[1, 1, 1]", space == 2 ? "" : ", 0");
    n += snprintf(text + n, sizeof text - (size_t)n, "  b: {mass: 1, inertia: %s, at: [0, 3%s], points: {",
                  space == 2 ? "1" : "[1, 1, 1]", space == 2 ? "" : ", 0");
    for (int i = 0; i < POINTS; i++) {
        n += snprintf(text + n, sizeof text - (size_t)n, "%sP%d: [%.3f, %.3f", i ? ", " : "", i, drawn(), 3 + drawn());
        n += space == 2 ? snprintf(text + n, sizeof text - (size_t)n, "]")
                        : snprintf(text + n, sizeof text - (size_t)n, ", %.3f]", drawn());
    }
    n += snprintf(
        text + n, sizeof text - (size_t)n,
        "}}\nconstraints: {f: {free: [ground, b]}, p: {revolute: [ground, slab], at: [0, 0%s]%s}}\nsurfaces:\n  "
        "s: %s\n",
        space == 2 ? "" : ", 0", space == 2 ? "" : ", axis: [0, 0, 1]", surface);
    for (int i = 0; i < POINTS; i++) n += snprintf(text + n, sizeof text - (size_t)n, "  p%d: {point: b.P%d}\n", i, i);
    n += snprintf(text + n, sizeof text - (size_t)n, "contacts:\n");
    for (int i = 0; i < POINTS; i++)
        n += snprintf(text + n, sizeof text - (size_t)n, "  c%d: {between: [p%d, s]}\n", i, i);
    n += snprintf(text + n, sizeof text - (size_t)n, "integrate: {step: 1.0e-3, until: 1}\n");
    assert_true(n < (int)sizeof text);
    open_deck(o, text);
}

static void test_reach(void **state)
{
    static const struct {
        int space;
        const char *surface;
    } scene[] = {{2, "{plane: slab, at: [0, 0], normal: [0, 1]}"},
                 {2, "{sphere: slab, radius: 1.5}"},
                 {3, "{plane: slab, at: [0, 0, 0], normal: [0, 1, 0]}"},
                 {3, "{sphere: slab, radius: 1.5}"}};
    (void)state;
    for (int k = 0; k < 4; k++) {
        struct opened o;
        open_scene(&o, scene[k].space, scene[k].surface);
        struct ode2 *ode = o.sim.stepper.ode;
        const struct ode2_contact *c = ode->contact;
        struct trouble why;
        struct nearby g, exact;
        double dx[16];
        double q[16];
        int within = 0, beyond = 0;
        assert_int_equal(c->m, POINTS);
        nearby_open(&g, POINTS, o.life);
        nearby_open(&exact, POINTS, o.life);
        assert_true(ode->nq <= 16);
        for (int step = 0; step < 6000; step++) { /* to and fro in small moves, now and then a large one */
            const double reach = step % 7 ? .05 : .4, at = step + 300 * (step / 500);
            for (int i = 0; i < ode->n; i++) dx[i] = (i == 1 ? -1.5 : 0) + 1.2 * sin((.003 + .001 * i) * at + 4 * i);
            if (ode->move)
                ode->move->point(ode, q, o.sim.x.q, dx, 1, 0);
            else
                for (int i = 0; i < ode->n; i++) q[i] = o.sim.x.q[i] + dx[i];
            assert_int_equal(c->gap(c, &g, reach, q, 0, &why), OK);
            assert_int_equal(c->gap(c, &exact, INFINITY, q, 0, &why), OK);
            assert_int_equal(exact.n, POINTS);
            for (int i = 0, seen = 0; i < POINTS; i++) {
                const bool is = exact.gap[i] <= reach;
                assert_true(isfinite(exact.gap[i]));
                assert_true(is ? g.gap[i] == exact.gap[i] : g.gap[i] == INFINITY);
                if (is) assert_int_equal(g.which[seen++], i);
                within += is;
                beyond += !is;
            }
            assert_true(g.n <= POINTS && (g.n == 0 || g.gap[g.which[g.n - 1]] <= reach));
        }
        if (within < 50 || beyond < 50) fail_msg("%d within, %d beyond", within, beyond);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_reach)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
