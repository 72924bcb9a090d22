/* t-way.c -- expressions along a way: means against closed forms, their slopes against differences, corners and poles;
 * what a force keeps that is an expression of its own measure. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "expr/expr.h"
#include "sim/parts.h"

#include <cmocka.h>

#include "unit/opened.h"

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)error;
    *value = 0;
    *slot = strcmp(name, "x") == 0;
    return strcmp(name, "x") != 0 && strcmp(name, "y") != 0;
}

static struct expr *parsed(struct arena *arena, const char *text)
{
    const struct expr_names names = {.find = find, .self = NULL};
    struct expr_error error;
    struct expr *e;
    if (expr_parse(&e, text, strlen(text), &names, arena, &error)) fail_msg("'%s': %s", text, error.text);
    return e;
}

static double mean(double *slope, const struct expr *e, double a, double b)
{
    const double from[2] = {0, a}, to[2] = {0, b};
    return expr_mean(slope, &(struct expr_way){e, from, to, 2}, 1);
}

/* ---- integrals, each from 0 ---- */

static double stop(double x)
{
    return x < 0 ? -500 * x * x : 0;
}
static double line(double x)
{
    return x * x - 3 * x;
}
static double step_up(double x)
{
    return x < .25 ? 2 * x : .5 + 5 * (x - .25);
}
static double size(double x)
{
    return fabs(x) * x / 2;
}
static double side(double x)
{
    return fabs(x);
}
static double stairs(double x)
{
    return floor(x) * (x - floor(x)) + floor(x) * (floor(x) - 1) / 2;
}
static double hertz(double x)
{
    return x > 0 ? .4 * pow(x, 2.5) : 0;
}
static double sine(double x)
{
    return (1 - cos(40 * x)) / 40;
}
static double inverse(double x)
{
    return log(x + 5);
}
static double root(double x)
{
    return copysign(2 * sqrt(fabs(x)), x);
}
static double logarithm(double x)
{
    return x == 0 ? 0 : x * (log(fabs(x)) - 1);
}
static double saw(double x)
{
    const double n = floor(x / .3), r = x - .3 * n;
    return n * .045 + r * r / 2;
}
static double steep(double x)
{
    return log(cosh(200 * x)) / 200;
}
static double ninth(double x)
{
    return pow(x, 10) / 10;
}

static const struct {
    const char *text;
    double (*integral)(double x);
    double scale;
} list[] = {
    {"if(x < 0, -1000*x, 0)", stop, 1000},
    {"max(-1000*x, 0)", stop, 1000},
    {"2*x - 3", line, 10},
    {"if(x >= 0.25, 5, 2)", step_up, 10},
    {"abs(x)", size, 3},
    {"sign(x)", side, 1},
    {"floor(x)", stairs, 3},
    {"max(x, 0)^1.5", hertz, 6},
    {"sin(40*x)", sine, 1},
    {"1/(x + 5)", inverse, 1},
    {"1/sqrt(abs(x))", root, 100},
    {"log(abs(x))", logarithm, 100},
    {"mod(x, 0.3)", saw, 1},
    {"tanh(200*x)", steep, 1},
    {"x^9", ninth, 3e4},
};
enum { LIST = sizeof list / sizeof *list };

/* A way through 0, 0.25 and several stairs, short and long ones, forth and back; and such as begin or end at corners. */
static void means(void **state)
{
    static const double ends[] = {-3, -1, -.7, -1e-3, -1e-9, 0, 1e-6, .25, .3, .6, 1, 1.7, 3.1};
    enum { ENDS = sizeof ends / sizeof *ends };
    struct arena *arena = arena_open();
    (void)state;
    for (int k = 0; k < LIST; k++) {
        const struct expr *e = parsed(arena, list[k].text);
        const bool sharp = k == 10 || k == 11; /* with an infinite value on the way */
        for (int i = 0; i < ENDS; i++)
            for (int j = 0; j < ENDS; j++) {
                const double a = ends[i], b = ends[j], from = list[k].integral(a), to = list[k].integral(b);
                double slope;
                if (i == j) continue;
                const double got = mean(&slope, e, a, b) * (b - a);
                const double room = (sharp ? 1e-7 : 4e-15) * list[k].scale * fmax(fmax(fabs(a), fabs(b)), 1e-3) + 4e-16;
                if (!(fabs(got - (to - from)) <= room))
                    fail_msg("%s over [%g, %g]: %.17g, not %.17g", list[k].text, a, b, got, to - from);
            }
    }
    arena_close(arena);
}

/* d mean/db by differences, over corners and jumps; of a point: half the slope. */
static void slopes(void **state)
{
    struct arena *arena = arena_open();
    (void)state;
    for (int k = 0; k < LIST; k++) {
        const struct expr *e = parsed(arena, list[k].text);
        if (k == 10 || k == 11) continue;
        for (double a = -1.03; a < 1.2; a += .17)
            for (double b = -1.05; b < 1.2; b += .19) {
                double slope, none;
                const double h = 1e-6;
                mean(&slope, e, a, b);
                const double want = (mean(&none, e, a, b + h) - mean(&none, e, a, b - h)) / (2 * h);
                if (!(fabs(slope - want) < 1e-6 * list[k].scale))
                    fail_msg("%s over [%g, %g]: slope %.12g, by differences %.12g", list[k].text, a, b, slope, want);
            }
        double slope, none, d;
        const double x = .1234, slot[2] = {0, x};
        const int which = 1;
        near(mean(&slope, e, x, x), expr_slopes(e, &d, slot, &which, 1), 0);
        near(slope, d / 2, 0);
        near(mean(&none, e, x, x + 1e-9), mean(&slope, e, x, x), 1e-6);
    }
    arena_close(arena);
}

static void poles(void **state)
{
    static const struct {
        const char *text;
        int is;
        double at;
    } poles[] = {
        {"-1/(1 + x)", 1, -1},
        {"1/x^2", 1, 0},
        {"if(x > 0.5, 1/(x - 0.5), 0)", 1, .5},
        {"if(x < 0.5, 1/(x - 0.5)^3, 0)", 1, .5},
        {"tan(2*x)", 1, -.78539816339744831},
        {"x^-3", 1, 0},
        {"log(abs(x))", 0, 0},
        {"abs(x)^-0.9", 0, 0},
        {"sin(x)/x", 0, 0},
        {"(x^2 - 1)/(x - 1)", 0, 0},
        {"if(x < 0, 1e6*x, 0)", 0, 0},
        {"floor(7*x)", 0, 0},
        {"x/max(abs(x), 0.01)", 0, 0},
        {"1/(x^2 + 1e-6)", 0, 0},
        {"sqrt(abs(x))", 0, 0},
        {"max(x, x)", 0, 0},
    };
    struct arena *arena = arena_open();
    const double a[2] = {.3, -1.4}, b[2] = {.3, 1.3};
    (void)state;
    for (size_t k = 0; k < sizeof poles / sizeof *poles; k++) {
        const struct expr_way forth = {parsed(arena, poles[k].text), a, b, 2}, back = {forth.e, b, a, 2};
        double at, slope;
        if (expr_pole(&at, &forth) != poles[k].is) fail_msg("%s: %d", poles[k].text, !poles[k].is);
        if (poles[k].is) near(-1.4 + 2.7 * at, poles[k].at, 1e-14);
        assert_int_equal(expr_pole(&at, &back), poles[k].is);
        if (poles[k].is) assert_true(isinf(expr_mean(&slope, &forth, 1)));
    }
    /* of two that move */
    const double from[2] = {1, -1}, to[2] = {-1, .5};
    double at;
    assert_true(expr_pole(&at, &(struct expr_way){parsed(arena, "1/(x - y)"), from, to, 2}));
    near(at, 2 / 3.5, 1e-14);
    /* on ways of which round-off of what moves is a part */
    for (double d = 1e-3; d > 1e-12; d /= 10) {
        const double here[2] = {0, 1.3 - d}, there[2] = {0, 1.3 + .7 * d};
        static const char *const texts[] = {"1/(1.3 - x)", "1/(1.3 - x)^2", "tan(x*1.2083048667653051)"};
        for (int k = 0; k < 3; k++)
            if (!expr_pole(&at, &(struct expr_way){parsed(arena, texts[k]), here, there, 2}))
                fail_msg("%s: not found on a way of %g", texts[k], d);
        assert_false(expr_pole(&at, &(struct expr_way){parsed(arena, "1/sqrt(abs(1.3 - x))"), here, there, 2}));
        assert_false(expr_pole(&at, &(struct expr_way){parsed(arena, "(1.3 - x)/abs(1.3 - x)"), here, there, 2}));
    }
    arena_close(arena);
}

static void corners(void **state)
{
    struct arena *arena = arena_open();
    const struct expr *e = parsed(arena, "if(x < 0.5, -x, abs(y))");
    const double a[2] = {-1, 0}, b[2] = {-1, .5}, c[2] = {1, .5}, d[2] = {1, .500001};
    (void)state;
    assert_false(expr_bends(&(struct expr_way){e, a, b, 2}));
    assert_false(expr_bends(&(struct expr_way){e, a, c, 2}));
    assert_true(expr_bends(&(struct expr_way){e, a, d, 2}));
    assert_true(expr_bends(&(struct expr_way){e, d, a, 2}));
    arena_close(arena);
}

/* ---- forces ---- */

#define BALL                                                                                                           \
    "gravity: [0, -9.81]\n"                                                                                            \
    "bodies: {b: {mass: 1, at: [0, 1]}}\n"                                                                             \
    "constraints: {p: {prismatic: [ground, b], axis: [0, 1]}}\n"                                                       \
    "measures: {h: {displacement: [[0, 0], b], axis: [0, 1]}}\n"

static double energy(struct opened *o)
{
    return value(o, "energy.kinetic") + value(o, "energy.elastic") + value(o, "energy.gravity");
}

/* Ten bounces of a ball that falls 1 m, on stops from soft to far stiffer than the step resolves (h omega up to 10):
 * nothing is gained, nothing booked as work, and what is lost is what Newton leaves over, or a scheme of points at
 * corners that it has met to 2^-10 of the step. */
static void bounces(void **state)
{
    static const char *const schemes[] = {"midpoint", "subcycle", "newmark", "dopri5"};
    static const double stiff[] = {1e4, 1e6, 1e8}, steps[] = {1e-3, 1e-4}, room[] = {2e-6, 2e-6, 1e-3, 1e-3};
    char text[1000];
    (void)state;
    for (int s = 0; s < 4; s++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < (s == 3 ? 1 : 2); i++) {
                struct opened o;
                snprintf(text, sizeof text,
                         BALL "forces: {stop: {force: h, value: \"if(h < 0, -%g*h, 0)\"}}\n"
                              "integrate: {scheme: %s, %s: %g, until: 9.2}\n%s",
                         stiff[k], schemes[s], s == 3 ? "tolerance" : "step", s == 3 ? 1e-8 : steps[i],
                         s == 3 ? "output: {every: 0.02}\n" : "");
                open_deck(&o, text);
                const double before = energy(&o);
                run(&o);
                near(energy(&o), before, room[s]);
                assert_true(value(&o, "energy.external") == 0 && value(&o, "h") < 1 + 1e-6);
                assert_false(ledger_broken(&o.sim.ledger));
                arena_close(o.life);
            }
}

/* A stop in the part that takes minor steps, on a part that takes major ones: both discrete gradients in one step. */
static void bounces_below(void **state)
{
    struct opened o;
    (void)state;
    open_deck(&o, "gravity: [0, -9.81]\n"
                  "bodies: {a: {mass: 2, at: [0, 1]}, b: {mass: 0.3, at: [0, 0.5]}}\n"
                  "constraints: {p: {prismatic: [ground, a], axis: [0, 1]}, s: {prismatic: [a, b], axis: [0, 1]}}\n"
                  "measures: {h: {displacement: [[0, 0], b], axis: [0, 1]}}\n"
                  "forces: {k: {spring: s, stiffness: 2000}, stop: {force: h, value: \"if(h < 0, -1e6*h, 0)\"},\n"
                  "         soft: {force: p.displacement, value: \"-30*max(p.displacement + 0.2, 0)^1.5 - 2\"}}\n"
                  "partition: {fast: [s]}\n"
                  "integrate: {scheme: subcycle, step: 1.0e-3, ratio: 10, until: 4}\n");
    const double before = energy(&o);
    run(&o);
    near(energy(&o), before, 1e-5);
    assert_true(value(&o, "energy.external") == 0);
    arena_close(o.life);
}

/* The same force as a spring and as an expression, along a coordinate and along a distance in space: the same motion,
 * and the same energy but for its zero. */
static void as_a_spring(void **state)
{
    static const char *const along[] = {"p", "d"};
    static const char *const schemes[] = {"midpoint", "newmark", "dopri5"};
    (void)state;
    for (int m = 0; m < 2; m++)
        for (int s = 0; s < 3; s++) {
            struct opened o[2];
            char text[1000];
            double V[2][2];
            for (int k = 0; k < 2; k++) {
                snprintf(text, sizeof text,
                         "gravity: [0, -9.81, 0]\n"
                         "bodies: {b: {mass: 2, inertia: [1, 2, 1.5], at: [0.4, 0, 0.3]}}\n"
                         "constraints: {p: {revolute: [ground, b], at: [0, 0, 0], axis: [0, 0, 1]}}\n"
                         "measures: {d: {distance: [[1, 1, 0], b]}}\n"
                         "forces: {f: {%s}}\n"
                         "integrate: {scheme: %s, %s, until: 0.7}\noutput: {every: 0.1}\n",
                         k == 0 ? (m ? "spring: d, stiffness: 80, rest: 0, preload: 3, cubic: 50"
                                     : "spring: p, stiffness: 80, rest: 0, preload: 3, cubic: 50")
                         : m    ? "force: d, value: \"3 - 80*d - 50*d^3\""
                                : "torque: p, value: \"3 - 80*p.angle - 50*p.angle^3\"",
                         schemes[s], s == 2 ? "tolerance: 1.0e-9" : "step: 1.0e-3");
                open_deck(&o[k], text);
                V[k][0] = value(&o[k], "energy.elastic");
                run(&o[k]);
                V[k][1] = value(&o[k], "energy.elastic");
            }
            near(value(&o[1], "p.angle"), value(&o[0], "p.angle"), 1e-9);
            near(V[1][0], V[0][0], 1e-12);
            near(V[1][1], V[0][1], 1e-7);
            assert_true(value(&o[1], "energy.external") == 0);
            for (int k = 0; k < 2; k++) arena_close(o[k].life);
            (void)along;
        }
}

/* What reads t, a rate or another quantity besides is work, as before; so is what acts along one and reads another. */
static void other_forces_are_work(void **state)
{
    static const char *const values[] = {"-80*h - 0*t", "-80*h - 0.1*h_rate", "-80*p.displacement", "3"};
    (void)state;
    for (int k = 0; k < 4; k++) {
        struct opened o;
        char text[600];
        snprintf(text, sizeof text,
                 BALL
                 "forces: {f: {force: h, value: \"%s\"}}\nintegrate: {scheme: midpoint, step: 1.0e-3, until: 0.3}\n",
                 values[k]);
        open_deck(&o, text);
        run(&o);
        assert_true(value(&o, "energy.external") != 0 && value(&o, "energy.elastic") == 0);
        arena_close(o.life);
    }
}

/* A pole is not stepped over: of what has an energy, and of what has none. */
static void stops_at_poles(void **state)
{
    static const char *const schemes[] = {"midpoint", "newmark", "subcycle", "rk4", "hht"};
    static const char *const values[] = {"-1/(1 + p.displacement)",
                                         "-1/(1 + p.displacement) - 0.01*p.displacement_rate",
                                         "-(1 + p.displacement)^-1 + 0*t"};
    (void)state;
    for (int s = 0; s < 5; s++)
        for (int k = 0; k < (s == 3 ? 1 : 3); k++) {
            struct opened o;
            char text[600];
            snprintf(text, sizeof text,
                     "bodies: {b: {mass: 1, at: [0, 0]}}\n"
                     "constraints: {p: {prismatic: [ground, b], axis: [1, 0]}}\n"
                     "forces: {f: {force: p, value: \"%s\"}}\nintegrate: {scheme: %s, step: 1.0e-3, until: 3}\n",
                     values[k], schemes[s]);
            open_deck(&o, text);
            assert_int_equal(sim_run(&o.sim, NULL, &o.report), E_NUMERIC);
            near(o.sim.x.t, k == 1 ? 1.2554 : 1.2533, 2e-4);
            if (k == 0 && s < 4) assert_non_null(strstr(o.report.text, "force 'f' grows without bound"));
            arena_close(o.life);
        }
}

/* Nor by schemes with steps of their own, whether these end on records or not: balances stay numbers.  One that comes out on the
 * side where it was has broken its own. */
static void stops_at_poles_by_tolerance(void **state)
{
    static const char *const schemes[] = {"dopri5", "dop853", "radau5", "radau9", "rk4", "midpoint"};
    static const char *const values[] = {"-1/(1 + p.displacement)", "-1/(1 + p.displacement) + 0*p.displacement_rate"};
    static const double tolerances[] = {1e-3, 1e-6, 1e-8};
    int stopped = 0;
    (void)state;
    for (int s = 0; s < 6; s++)
        for (int k = 0; k < 6; k++)
            for (int v = 0; v < 3; v++) {
                const double rate = -.5 * v, T = v == 0 ? 1.2533 : v == 1 ? .8763 : .6557;
                struct opened o;
                char text[600];
                snprintf(
                    text, sizeof text,
                    "bodies: {b: {mass: 1, at: [0, 0]}}\n"
                    "constraints: {p: {prismatic: [ground, b], axis: [1, 0]}}\ninitial: {p.displacement_rate: %g}\n"
                    "forces: {f: {force: p, value: \"%s\"}}\nintegrate: {scheme: %s, tolerance: %.1e, until: 3}\n"
                    "output: {every: 0.05}\n",
                    rate, values[k % 2], schemes[s], tolerances[k / 2]);
                open_deck(&o, text);
                const enum status status = sim_run(&o.sim, NULL, &o.report);
                if (status != E_NUMERIC && status != E_VERDICT)
                    fail_msg("%s, %s, %g, %g: %d at %g", schemes[s], values[k % 2], tolerances[k / 2], rate, status,
                             o.sim.x.t);
                if (status == E_NUMERIC) near(o.sim.x.t, T, .05);
                stopped += status == E_NUMERIC;
                assert_true(isfinite(o.sim.ledger.worst) && isfinite(o.sim.ledger.norm));
                arena_close(o.life);
            }
    assert_in_range(stopped, 100, 108);
}

/* Dry friction as everybody writes it, at rest: the force is named with its cure, and steps of their own have an end. */
static void friction_is_named(void **state)
{
    static const char *const plans[] = {"midpoint, step: 1.0e-3", "midpoint, step: 1.0e-5", "newmark, step: 1.0e-3",
                                        "dopri5, tolerance: 1.0e-6"};
    (void)state;
    for (int k = 0; k < 4; k++) {
        struct opened o;
        char text[1200];
        snprintf(text, sizeof text,
                 "gravity: [0, -9.81]\n"
                 "bodies: {a: {mass: 2, inertia: 0.3, at: [0.5, 0]}, b: {mass: 1, inertia: 0.1, at: [1.4, 0]}}\n"
                 "constraints: {p: {revolute: [ground, a], at: [0, 0]}, e: {revolute: [a, b], at: [1, 0]}}\n"
                 "forces:\n  pd1: {torque: p, value: \"200*(0.5*sin(t) - p.angle) - 20*p.angle_rate\"}\n"
                 "  limit: {torque: p, value: \"min(3*abs(p.angle), 4) + 0*t\"}\n"
                 "  fric: {torque: e, value: \"-2*sign(e.angle_rate)\"}\n"
                 "  pd2: {torque: e, value: \"50*(0.3*cos(t) - e.angle) - 5*e.angle_rate\"}\n"
                 "integrate: {scheme: %s, until: 1}\noutput: {every: 0.1}\n",
                 plans[k]);
        open_deck(&o, text);
        assert_int_equal(sim_run(&o.sim, NULL, &o.report), k == 3 ? E_LIMIT : E_NUMERIC);
        assert_non_null(strstr(o.report.text, "force 'fric' jumps near here, between"));
        assert_true(o.sim.stepper.effort.rejected < 110000);
        arena_close(o.life);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means),
        cmocka_unit_test(slopes),
        cmocka_unit_test(poles),
        cmocka_unit_test(corners),
        cmocka_unit_test(bounces),
        cmocka_unit_test(bounces_below),
        cmocka_unit_test(as_a_spring),
        cmocka_unit_test(other_forces_are_work),
        cmocka_unit_test(stops_at_poles),
        cmocka_unit_test(stops_at_poles_by_tolerance),
        cmocka_unit_test(friction_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
