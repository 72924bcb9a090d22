/* t-plan.c -- what a deck's integrate and output come to: scheme, tolerance, steps, records; and what is refused. */
#include <math.h>
#include <stdio.h>

#include "sim/parts.h"
#include "unit/decks.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

/* Two links, the outer one on a stiff spring: one fast coordinate. */
static void open_plan(struct opened *o, const char *integrate, const char *output)
{
    char text[1200];
    snprintf(text, sizeof text,
             "fmdsub: 1\n"
             "bodies:\n"
             "  a: {mass: 2, inertia: 0.3, at: [0.5, 0]}\n"
             "  b: {mass: 0.3, inertia: 0.01, at: [1.2, 0]}\n"
             "constraints:\n"
             "  p: {revolute: [ground, a], at: [0, 0]}\n"
             "  e: {revolute: [a, b], at: [1, 0]}\n"
             "forces: {s: {spring: e, stiffness: 60}}\n"
             "partition: {fast: [e]}\n"
             "integrate: {%s}\n"
             "output: {%s}\n",
             integrate, output);
    open_text(o, text);
}

/* Schemes as they run: their name, whether they have steps of their own, to which tolerance, and minor step and ratio. */
static void schemes(void **state)
{
    static const struct {
        const char *integrate, *name;
        int own;
        double tolerance, step;
        int ratio;
    } plans[] = {
        {"until: 1", "dopri5", 1, 1e-4, .1, 1},
        {"until: 1, tolerance: 1.0e-3", "dopri5", 1, 1e-3, .1, 1},
        {"until: 1, step: 1.0e-2", "midpoint", 0, 0, 1e-2, 1},
        {"until: 1, step: 1.0e-2, ratio: 5", "subcycle", 0, 0, 1e-2, 5},
        {"until: 1, scheme: newmark", "newmark", 1, 1e-4, .1, 1},
        {"until: 1, scheme: newmark, step: 1.0e-2", "newmark", 0, 0, 1e-2, 1},
        {"until: 1, scheme: newmark, step: 1.0e-2, tolerance: 1.0e-5", "newmark", 1, 1e-5, .1, 1},
        {"until: 1, scheme: newmark, tolerance: 1.0e-5", "newmark", 1, 1e-5, .1, 1},
        {"until: 1, scheme: rk4, step: 1.0e-2", "rk4", 0, 0, 1e-2, 1},
        {"until: 1, scheme: dop853", "dop853", 1, 1e-4, .1, 1},
        {"until: 1, scheme: radau5, tolerance: 1.0e-7", "radau5", 1, 1e-7, .1, 1},
        {"until: 1, scheme: subcycle, step: 1.0e-2, ratio: 1", "midpoint", 0, 0, 1e-2, 1},
        {"until: 1, scheme: subcycle, step: 1.0e-2, ratio: 2", "subcycle", 0, 0, 1e-2, 2},
        {"until: 1, scheme: subcycle, step: 1.0e-2, ratio: 2, tolerance: 1.0e-3", "subcycle", 1, 1e-3, .1, 1},
        {"until: 1, scheme: daniel, step: 1.0e-2, ratio: 2", "daniel", 0, 0, 1e-2, 2},
        {"until: 1, scheme: auto, step: 1.0e-2", "midpoint", 0, 0, 1e-2, 1},
        {"until: 1, scheme: auto, tolerance: 1.0e-3", "dopri5", 1, 1e-3, .1, 1},
        {"until: 1, scheme: auto", "dopri5", 1, 1e-4, .1, 1},
    };
    (void)state;
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        struct opened o;
        open_plan(&o, plans[i].integrate, "every: 0.1");
        print_wrong(&o);
        assert_int_equal(o.status, OK);
        const struct sim *s = &o.sim;
        const struct step_options *how = s->plan.options;
        if (strcmp(s->stepper.kind->name, plans[i].name) != 0 || s->stepper.kind->adaptive != plans[i].own ||
            (plans[i].own && how->tolerance != plans[i].tolerance) || fabs(s->plan.step - plans[i].step) > 1e-15 ||
            s->plan.ratio != plans[i].ratio)
            fail_msg("%s: %s, own steps %d, tolerance %g, step %g, ratio %d", plans[i].integrate, s->stepper.kind->name,
                     s->stepper.kind->adaptive, how->tolerance, s->plan.step, s->plan.ratio);
        shut(&o);
    }
}

/* Major steps, and of these from record to record. */
static void steps(void **state)
{
    static const struct {
        const char *integrate, *output;
        long majors, every;
    } plans[] = {
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 0.1", 100, 10},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 0.01", 100, 1},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 1", 100, 100},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 7", 100, 100},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: {steps: 7}", 100, 7},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "", 100, 1},
        {"until: 1.001, step: 1.0e-2, scheme: midpoint", "every: 0.1", 101, 10},
        {"until: 1.00000000001, step: 1.0e-2, scheme: midpoint", "every: 0.1", 100, 10},
        {"until: 1, step: 1.0e-2, ratio: 5, scheme: subcycle", "every: 0.1", 20, 2},
        {"until: 1, step: 3.0e-2, scheme: midpoint", "every: 0.09", 34, 3},
        {"until: 1, scheme: dopri5, tolerance: 1.0e-4", "every: 0.3", 4, 1},
        {"until: 1, scheme: dopri5, tolerance: 1.0e-4", "", 100, 1},
        {"until: 1, scheme: dopri5, tolerance: 1.0e-4", "every: {steps: 5}", 100, 5},
    };
    (void)state;
    for (size_t i = 0; i < sizeof plans / sizeof *plans; i++) {
        struct opened o;
        open_plan(&o, plans[i].integrate, plans[i].output);
        print_wrong(&o);
        assert_int_equal(o.status, OK);
        if (o.sim.majors != plans[i].majors || o.sim.every != plans[i].every || o.sim.before != 0)
            fail_msg("%s; %s: %ld major steps, a record every %ld, %ld before", plans[i].integrate, plans[i].output,
                     o.sim.majors, o.sim.every, o.sim.before);
        shut(&o);
    }
}

static void refused(void **state)
{
    static const struct {
        const char *integrate, *output;
        enum status status;
        const char *said;
    } wrong[] = {
        {"until: 1, scheme: newmrk, step: 1.0e-2", "", E_DECK, "did you mean 'newmark'?"},
        {"until: 1, scheme: xyzzyplugh, step: 1.0e-2", "", E_DECK, "`fmdsub list schemes` shows them"},
        {"until: 1, scheme: daniel", "", E_DECK, "scheme daniel needs a 'step' [E-missing-key]"},
        {"until: 1, scheme: daniel, tolerance: 1.0e-3", "", E_DECK,
         "'tolerance' is for schemes that choose their steps"},
        {"step: 1.0e-2", "", E_DECK, "'until'"},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 0.015", E_DECK,
         "every 0.015 s is not a multiple of the major step 0.01 s; the nearest are 0.01 and 0.02 [E-every]"},
        {"until: 1, step: 1.0e-2, ratio: 3, scheme: subcycle", "every: 0.1", E_DECK,
         "every 0.1 s is not a multiple of the major step 0.03 s; the nearest are 0.09 and 0.12 [E-every]"},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 0.001", E_DECK,
         "every 0.001 s is shorter than the major step, 0.01 s [E-every]"},
        {"until: 1, step: 1.0e-2, scheme: midpoint", "every: 0.01000001", E_DECK,
         "is not a multiple of the major step 0.01 s; the nearest are 0.01 and 0.02 [E-every]"},
        {"until: 1.0e+6, step: 9.0e-7, scheme: midpoint", "every: {steps: 9}", E_LIMIT,
         "1.11e+12 major steps to t = 1e+06 s: the limit is 1e+12"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct opened o;
        char *said;
        size_t n;
        open_plan(&o, wrong[i].integrate, wrong[i].output);
        FILE *to = open_memstream(&said, &n);
        assert_non_null(to);
        diags_print(to, o.diags, false);
        fputs(o.report.text, to);
        fclose(to);
        if (o.status != wrong[i].status || !strstr(said, wrong[i].said))
            fail_msg("%s; %s: status %d, %s", wrong[i].integrate, wrong[i].output, o.status, said);
        free(said);
        shut(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(schemes),
        cmocka_unit_test(steps),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests_name("plan", tests, NULL, NULL);
}
