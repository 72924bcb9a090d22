/* t-sides.c -- comparisons of the time: their corners are known, stepped onto, and seen from the side before. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "expr/expr.h"
#include "kind/force.h"
#include "unit/opened.h"

#include <cmocka.h>

/* --- which are known -------------------------------------------------------------------------------- */

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)error;
    *slot = strcmp(name, "t") == 0 ? 0 : strcmp(name, "x") == 0 ? 1 : -1;
    *value = 2.5;
    return strcmp(name, "c") != 0 && *slot < 0;
}

static struct signal signal_from(const char *text, struct arena *life)
{
    struct expr_error error;
    struct expr *e;
    if (expr_parse(&e, text, strlen(text), &(struct expr_names){.find = find, .self = NULL}, life, &error))
        fail_msg("%s", error.text);
    return signal_of(e, life);
}

/* At most four times in (0, 10]. */
static void test_known(void **state)
{
    static const struct {
        const char *text;
        double at[4];
    } of[] = {
        {"if(t < 1, 2, 3)", {1}},
        {"if(1 >= t, x, 3)", {1}},
        {"if(t > c and t <= c + 0.5, x, sin(t))", {2.5, 3}},
        {"if(not (2*t - 1 > 4) or x > 2, 1, 0)", {2.5}},
        {"if(t < 1, 1, if(t < 2, t, if(5 - t > 2, 3, 4)))", {1, 2, 3}},
        {"abs(t - 3) + max(0, t - 1)*min(4, 2*t)", {1, 2, 3}},
        {"if(x < 1, 2, 3)", {0}},
        {"if(t*x < 1, 2, t^2)", {0}},
        {"if(t < 1, 1, 2)*if(x < 3, t, 5) - 3*if(t > 4, 1, 2)", {1, 4}},
        {"if(mod(t, 4) < 1, 1, 0)", {1, 4, 5, 8}},
        {"if(mod(t - 1, 5) - 2 > 1, 1, 0)", {1, 4, 6, 9}},
        {"floor(t/3)*x", {3, 6, 9}},
        {"sign(t - 7)", {7}},
    };
    struct arena *life = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        const struct signal s = signal_from(of[i].text, life);
        double t = 0;
        for (int k = 0; k < 4; k++) {
            t = signal_next(&s, t);
            if (of[i].at[k] == 0 ? t <= 10 : fabs(t - of[i].at[k]) > 1e-14)
                fail_msg("%s: %g, should be %g", of[i].text, t, of[i].at[k]);
            if (of[i].at[k] == 0) break;
        }
    }
    arena_close(life);
}

/* The value there is that before, however it is compared, and round-off of t beside; at 0 that behind. */
static void test_side(void **state)
{
    static const char *const text[] = {"if(t < 0.3, 1, 2)",  "if(t <= 0.3, 1, 2)",       "if(0.3 > t, 1, 2)",
                                       "if(t >= 0.3, 2, 1)", "if(3*t - 1 > -0.1, 2, 1)", "if(mod(t, 1) < 0.3, 1, 2)"};
    struct arena *life = arena_open();
    (void)state;
    for (int i = 0; i < 6; i++) {
        const struct signal s = signal_from(text[i], life);
        double x[3];
        for (int k = -1; k <= 1; k++) {
            signal_motion(&s, x, .3 * (1 + k * 2.3e-16));
            assert_true(x[0] == 1 && signal_has_sides(&s, .3));
        }
        signal_motion(&s, x, .3 * (1 + 16 * 2.3e-16));
        assert_true(x[0] == 2);
    }
    const struct signal s = signal_from("if(t > 0, 2, 1)", life);
    double x[3];
    signal_motion(&s, x, 0);
    assert_true(x[0] == 2 && !signal_has_sides(&s, 0));
    arena_close(life);
}

/* --- runs --------------------------------------------------------------------------------------------- */

static const char *const integrators[] = {"scheme: rk4, step: 1.0e-2",         "scheme: newmark, step: 1.0e-2",
                                          "scheme: midpoint, step: 1.0e-2",    "scheme: dopri5, tolerance: 1.0e-9",
                                          "scheme: dop853, tolerance: 1.0e-9", "scheme: radau5, tolerance: 1.0e-9",
                                          "scheme: radau9, tolerance: 1.0e-9"};
enum { INTEGRATORS = sizeof integrators / sizeof *integrators, STEPS_OF_ITS_OWN = 3 };

static void run_driven(struct opened *o, const char *value, const char *integrate)
{
    char text[1000];
    snprintf(text, sizeof text,
             "bodies: {b: {mass: 1, at: [0, 0]}, m: {mass: 1, at: [1, 0]}}\n"
             "constraints: {g: {prismatic: [ground, b], axis: [1, 0]}, r: {prismatic: [b, m], axis: [1, 0]}}\n"
             "forces: {s: {spring: r, stiffness: 10, damping: 0.5}}\n"
             "drives: {d: {drive: g, value: %s}}\n"
             "integrate: {%s, until: 2}\n"
             "output: {every: 1}\n",
             value, integrate);
    open_deck(o, text);
    run(o);
}

/* A corner of a drive at the end of a step: by comparisons as by a table. */
static void test_drives(void **state)
{
    static const char *const value_of[] = {"\"if(t < 1, t, 0.5*(t+1))\"", "\"if(t <= 1, t, 0.5*(t+1))\"",
                                           "\"if(1 < t, 0.5*(t+1), t)\"", "\"if(t >= 1, 0.5*(t+1), t)\"",
                                           "\"min(t, 0.5*(t+1))\""};
    (void)state;
    for (int k = 0; k < INTEGRATORS; k++) {
        struct opened table;
        run_driven(&table, "{table: [[0, 0], [1, 1], [3, 2]]}", integrators[k]);
        for (int i = 0; i < 5; i++) {
            struct opened o;
            run_driven(&o, value_of[i], integrators[k]);
            near(value(&o, "m.x"), value(&table, "m.x"), 1e-9);
            near(value(&o, "m.vx"), value(&table, "m.vx"), 1e-9);
            arena_close(o.life);
        }
        arena_close(table.life);
    }
}

/* A drive whose acceleration jumps; rk4 against the finest of dop853. */
static void test_bends(void **state)
{
    static const char *const value_of[] = {"\"if(t < 1, t^2, 2*t-1)\"", "\"if(t <= 1, t^2, 2*t-1)\""};
    struct opened fine;
    (void)state;
    run_driven(&fine, value_of[1], "scheme: dop853, tolerance: 1.0e-12");
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < INTEGRATORS; k++) {
            struct opened o;
            run_driven(&o, value_of[i], integrators[k]);
            near(value(&o, "m.vx"), value(&fine, "m.vx"), k == 0 || k >= STEPS_OF_ITS_OWN ? 1e-7 : 1e-3);
            arena_close(o.life);
        }
    arena_close(fine.life);
}

static void run_pushed(struct opened *o, const char *value, const char *integrate)
{
    char text[800];
    snprintf(text, sizeof text,
             "bodies: {m: {mass: 1, at: [0, 0]}}\n"
             "constraints: {g: {prismatic: [ground, m], axis: [1, 0]}}\n"
             "forces: {f: {force: g, value: \"%s\"}}\n"
             "integrate: {%s, until: 5}\n"
             "output: {every: 1}\n",
             value, integrate);
    open_deck(o, text);
    run(o);
}

/* A force that jumps at the end of a step: motion under constant forces is exact in all schemes. */
static void test_forces(void **state)
{
    static const char *const value_of[] = {"if(t < 1, 0, 2)", "if(t <= 1, 0, 2)", "if(t > 1, 2, 0)", "if(t >= 1, 2, 0)",
                                           "1 + sign(t - 1)"};
    (void)state;
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < INTEGRATORS; k++) {
            struct opened o;
            run_pushed(&o, value_of[i], integrators[k]);
            near(value(&o, "g.displacement"), 16, 1e-9);
            near(value(&o, "g.displacement_rate"), 8, 1e-9);
            near(value(&o, "energy.external"), 32, 1e-8);
            arena_close(o.life);
        }
}

/* Short pulses, one and one each second, are not stepped over. */
static void test_pulses(void **state)
{
    (void)state;
    for (int k = STEPS_OF_ITS_OWN; k < INTEGRATORS; k++) {
        struct opened o;
        run_pushed(&o, "if(t > 2.5 and t < 2.502, 500, 0)", integrators[k]);
        near(value(&o, "g.displacement_rate"), 1, 1e-9);
        near(value(&o, "g.displacement"), 2.499, 1e-9);
        arena_close(o.life);
        run_pushed(&o, "if(mod(t, 1) > 0.7 and mod(t, 1) < 0.702, 500, 0)", integrators[k]);
        near(value(&o, "g.displacement_rate"), 5, 1e-9);
        arena_close(o.life);
        run_driven(&o, "\"if(t < 1.3, 0, if(t < 1.31, 5*(1-cos((t-1.3)*2*pi/0.01)), 0))\"", integrators[k]);
        assert_true(value(&o, "energy.drive") > 24600);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known), cmocka_unit_test(test_side),   cmocka_unit_test(test_drives),
        cmocka_unit_test(test_bends), cmocka_unit_test(test_forces), cmocka_unit_test(test_pulses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
