/* t-span.c -- bounds of an expression over a box: by hand on both sides of every limit, and values inside on a grid. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "base/arena.h"
#include "expr/expr.h"

#include <cmocka.h>

enum { NO = EXPR_NO_POLYNOMIAL };

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)error;
    *value = 0;
    *slot = strcmp(name, "y") == 0;
    return 0;
}

static struct expr *parsed(struct arena *arena, const char *text)
{
    const struct expr_names names = {.find = find, .self = NULL};
    struct expr_error error;
    struct expr *e;
    if (expr_parse(&e, text, strlen(text), &names, arena, &error)) fail_msg("'%s': %s", text, error.text);
    return e;
}

static bool same(double a, double b)
{
    return a == b || fabs(a - b) <= 4e-15 * (1 + fabs(a));
}

/* x from a to b, y from c to d: the bounds and the degree; or it is not smooth there. */
struct smooth {
    const char *text;
    double a, b, c, d, lo, hi;
    int degree;
};
struct rough {
    const char *text;
    double a, b, c, d;
};

static const struct smooth smooth[] = {
    /* numbers and slots */
    {"7", 0, 1, 0, 1, 7, 7, 0},
    {"x", 2, 3, 0, 0, 2, 3, 1},
    {"x", 3, 2, 0, 0, 2, 3, 1},
    {"x", 2, 2, 0, 0, 2, 2, 0},
    {"y", 2, 2, -1, 4, -1, 4, 1},
    /* sums, differences, products, quotients: degrees add up or the larger counts */
    {"x + y", 1, 2, 10, 20, 11, 22, 1},
    {"x^2 + y", 1, 2, 10, 20, 11, 24, 2},
    {"y + x^2", 1, 2, 10, 20, 11, 24, 2},
    {"x - y", 1, 2, 10, 20, -19, -8, 1},
    {"x^2 - y", 1, 2, 10, 20, -19, -6, 2},
    {"y - x^2", 1, 2, 10, 20, 6, 19, 2},
    {"x - 3", 1, 2, 0, 0, -2, -1, 1},
    {"3 - x", 1, 2, 0, 0, 1, 2, 1},
    {"x*y", -1, 2, -3, 5, -6, 10, 2},
    {"x*y", -4, 2, -3, -1, -6, 12, 2},
    {"x*y^2", 1, 2, -3, 5, 0, 50, 3},
    {"x*5", -1, 2, 0, 0, -5, 10, 1},
    {"x/4", -1, 2, 0, 0, -.25, .5, 1},
    {"x/y", -1, 2, 4, 8, -.25, .5, NO},
    {"x/y", -1, 2, -8, -4, -.5, .25, NO},
    {"x/y", -1, 2, 4, 4, -.25, .5, 1},
    {"(x + 1)/(y + 1)", 0, 1, 0, 1, .5, 2, NO},
    {"-x", -1, 2, 0, 0, -2, 1, 1},
    {"-(x^2)", 1, 2, 0, 0, -4, -1, 2},
    /* powers */
    {"x^2", -1, 3, 0, 0, 0, 9, 2},
    {"x^2", -3, -2, 0, 0, 4, 9, 2},
    {"x^2", 0, 2, 0, 0, 0, 4, 2},
    {"x^3", -1, 3, 0, 0, -1, 27, 3},
    {"x^4", -2, 1, 0, 0, 0, 16, 4},
    {"x^5", -2, 1, 0, 0, -32, 1, 5},
    {"(x*y)^2", 1, 2, 1, 3, 1, 36, 4},
    {"x^98", 0, 1, 0, 0, 0, 1, 98},
    {"x^99", .5, 1, 0, 0, 0x1p-99, 1, NO},
    {"(x^50)*(x^48)", 1, 2, 0, 0, 1, 0x1p98, 98},
    {"(x^50)*(x^50)", 1, 2, 0, 0, 1, 0x1p100, NO},
    {"x^-1", 1, 2, 0, 0, .5, 1, NO},
    {"x^-2", -2, -1, 0, 0, .25, 1, NO},
    {"x^0.5", 0, 4, 0, 0, 0, 2, NO},
    {"x^2.5", 1, 4, 0, 0, 1, 32, NO},
    {"x^y", 2, 3, 1, 2, 2, 9, NO},
    {"x^y", .5, 2, -1, 2, .25, 4, NO},
    {"x^y", 0, 3, 1, 2, 0, 9, NO},
    {"x^0", -1, 2, 0, 0, 1, 1, 0},
    /* functions */
    {"atan(x)", -1, 1, 0, 0, -M_PI_4, M_PI_4, NO},
    {"tan(x)", -M_PI_4, M_PI_4, 0, 0, -1, 1, NO},
    {"tan(x)", M_PI - M_PI_4, M_PI + M_PI_4, 0, 0, -1, 1, NO},
    {"asin(x)", -1, 1, 0, 0, -M_PI_2, M_PI_2, NO},
    {"acos(x)", -1, 1, 0, 0, 0, M_PI, NO},
    {"sinh(x)", -1, 2, 0, 0, -1.1752011936438014, 3.626860407847019, NO},
    {"cosh(x)", -1, 2, 0, 0, 1, 3.7621956910836314, NO},
    {"cosh(x)", -2, -1, 0, 0, 1.5430806348152437, 3.7621956910836314, NO},
    {"tanh(x)", -1, 2, 0, 0, -.7615941559557649, .9640275800758169, NO},
    {"exp(x)", 0, 1, 0, 0, 1, M_E, NO},
    {"log(x)", 1, M_E, 0, 0, 0, 1, NO},
    {"log10(x)", .01, 1000, 0, 0, -2, 3, NO},
    {"sqrt(x)", 0, 9, 0, 0, 0, 3, NO},
    {"sin(x)", -.25, .25, 0, 0, -.25, .25, NO},
    {"cos(x)", -.25, .25, 0, 0, .75, 1, NO},
    {"sin(x)", -3, 3, 0, 0, -1, 1, NO},
    {"cos(x)", M_PI - .5, M_PI + .5, 0, 0, -1, -.5, NO},
    {"hypot(x, y)", -3, 1, 2, 4, 2, 5, NO},
    {"hypot(x, y)", 3, 6, -8, 4, 3, 10, NO},
    {"atan2(y, x)", 1, 2, -1, 1, -M_PI_4, M_PI_4, NO},
    {"atan2(y, x)", -1, 1, 1, 2, M_PI_4, 3 * M_PI_4, NO},
    {"atan2(y, x)", -1, 1, -2, -1, -3 * M_PI_4, -M_PI_4, NO},
    {"mod(x, 2)", 4.5, 5.5, 0, 0, .5, 1.5, 1},
    {"mod(x, 2)", 4, 6, 0, 0, 0, 2, 1},
    {"mod(x, 2)", -1.5, -.5, 0, 0, .5, 1.5, 1},
    {"mod(x, -2)", 4.5, 5.5, 0, 0, -1.5, -.5, 1},
    /* decisions: one side all the way, up to its end */
    {"abs(x)", 0, 2, 0, 0, 0, 2, 1},
    {"abs(x)", -2, 0, 0, 0, 0, 2, 1},
    {"abs(x^3)", -2, -1, 0, 0, 1, 8, 3},
    {"sign(x)", 0, 2, 0, 0, 1, 1, 0},
    {"sign(x)", -2, 0, 0, 0, -1, -1, 0},
    {"floor(x)", 2, 3, 0, 0, 2, 2, 0},
    {"floor(x)", -1, -.5, 0, 0, -1, -1, 0},
    {"ceil(x)", 2, 3, 0, 0, 3, 3, 0},
    {"ceil(x)", -.5, 0, 0, 0, 0, 0, 0},
    {"step(x, 1)", 1, 2, 0, 0, 1, 1, 0},
    {"step(x, 1)", -1, 1, 0, 0, 0, 0, 0},
    {"pulse(x, 1, 3)", 1, 3, 0, 0, 1, 1, 0},
    {"pulse(x, 1, 3)", 0, 1, 0, 0, 0, 0, 0},
    {"pulse(x, 1, 3)", 3, 4, 0, 0, 0, 0, 0},
    {"ramp(x, 1, 3)", 1, 3, 0, 0, 0, 1, 1},
    {"ramp(x, 1, 3)", 1.5, 2, 0, 0, .25, .5, 1},
    {"ramp(x, 1, 3)", 0, 1, 0, 0, 0, 0, 0},
    {"ramp(x, 1, 3)", 3, 4, 0, 0, 1, 1, 0},
    {"smooth(x, 1, 3)", 1, 3, 0, 0, 0, 1, 5},
    {"smooth(x, 1, 3)", 1.5, 2, 0, 0, .103515625, .5, 5},
    {"smooth(x^2, 1, 4)", 1, 2, 0, 0, 0, 1, 10},
    {"smooth(x, 1, 3)", 0, 1, 0, 0, 0, 0, 0},
    {"smooth(x, 1, 3)", 3, 4, 0, 0, 1, 1, 0},
    {"min(x, y)", 0, 2, 2, 5, 0, 2, 1},
    {"min(x, y)", 2, 5, 0, 2, 0, 2, 1},
    {"max(x, y)", 0, 2, 2, 5, 2, 5, 1},
    {"max(x, y)", 2, 5, 0, 2, 2, 5, 1},
    {"min(x, y^2)", 5, 6, 1, 2, 1, 4, 2},
    {"max(x, 1)", 2, 3, 0, 0, 2, 3, 1},
    {"max(x, 3)", 2, 3, 0, 0, 3, 3, 0},
    /* conditions that hold, or do not, in the inside of the box */
    {"if(x < y, 2*x, 7)", 0, 1, 1, 2, 0, 2, 1},
    {"if(x < y, 2*x, 7)", 2, 3, 1, 2, 7, 7, 0},
    {"if(x <= y, 2*x, 7)", 0, 1, 1, 2, 0, 2, 1},
    {"if(x <= y, 2*x, 7)", 2, 3, 1, 2, 7, 7, 0},
    {"if(x > y, 2*x, 7)", 2, 3, 1, 2, 4, 6, 1},
    {"if(x > y, 2*x, 7)", 0, 1, 1, 2, 7, 7, 0},
    {"if(x >= y, 2*x, 7)", 2, 3, 1, 2, 4, 6, 1},
    {"if(x >= y, 2*x, 7)", 0, 1, 1, 2, 7, 7, 0},
    {"if(x == y, 2*x, 7)", 0, 1, 1, 2, 7, 7, 0},
    {"if(x == y, 2*x, 7)", 2, 3, 1, 2, 7, 7, 0},
    {"if(x != y, 2*x, 7)", 0, 1, 1, 2, 0, 2, 1},
    {"if(x != y, 2*x, 7)", 2, 3, 1, 2, 4, 6, 1},
    {"if(x != y, 2*x, 7)", 0, 1, 2, 3, 0, 2, 1},
    {"if(x > 0 and y > 0, x, 9)", 0, 1, 0, 1, 0, 1, 1},
    {"if(x > 0 and y > 0, x, 9)", -1, 0, -1, 1, 9, 9, 0},
    {"if(x > 0 and y > 0, x, 9)", -1, 1, -1, 0, 9, 9, 0},
    {"if(x > 0 or y > 0, x, 9)", 0, 1, -1, 1, 0, 1, 1},
    {"if(x > 0 or y > 0, x, 9)", -1, 1, 0, 1, -1, 1, 1},
    {"if(x > 0 or y > 0, x, 9)", -1, 0, -1, 0, 9, 9, 0},
    {"if(not(x > 0), x, 9)", -1, 0, 0, 0, -1, 0, 1},
    {"if(not(x > 0), x, 9)", 0, 1, 0, 0, 9, 9, 0},
    {"if(x > 0, if(y > 0, x*y, x), y)", 0, 1, 0, 2, 0, 2, 2},
    {"if(x > 0, if(y > 0, x*y, x), y)", 0, 1, -2, 0, 0, 1, 1},
    {"if(x > 0, if(y > 0, x*y, x), y)", -1, 0, -2, 2, -2, 2, 1},
    {"3 + if(x > 0, x, -x)*2", -1, 0, 0, 0, 3, 5, 1},
    {"if(x > 0, 1/x, 0)", -1, 0, 0, 0, 0, 0, 0}, /* the branch that is not taken has its pole */
    /* what stands still is a number */
    {"abs(x)*y", -2, -2, 0, 1, 0, 2, 1},
    {"floor(x)", 2.5, 2.5, 0, 0, 2, 2, 0},
    {"mod(x, y)", 5, 5, 3, 3, 2, 2, 0},
    {"if(x == y, x, 7)", 2, 2, 2, 2, 2, 2, 0},
};

/* Each crosses where it bends, jumps or has no value. */
static const struct rough rough[] = {
    {"x/y", 1, 2, -1, 1},
    {"x/y", 1, 2, 0, 1},
    {"x/y", 1, 2, -1, 0},
    {"1/x", 0, 0, 0, 0},
    {"x^-1", -1, 1, 0, 0},
    {"x^-1", 0, 1, 0, 0},
    {"x^0.5", -.1, 1, 0, 0},
    {"x^y", 0, 1, -1, 1},
    {"x^y", 0, 1, 0, 1},
    {"x^y", -1, 1, 2, 3},
    {"tan(x)", 1, 2, 0, 0},
    {"tan(x)", -2, -1, 0, 0},
    {"tan(x)", 0, 4, 0, 0},
    {"asin(x)", -1.01, 0, 0, 0},
    {"asin(x)", 0, 1.01, 0, 0},
    {"acos(x)", -1.01, 0, 0, 0},
    {"acos(x)", 0, 1.01, 0, 0},
    {"asin(x)", 1.5, 1.5, 0, 0},
    {"log(x)", 0, 1, 0, 0},
    {"log(x)", -1, 1, 0, 0},
    {"log10(x)", 0, 1, 0, 0},
    {"sqrt(x)", -.01, 1, 0, 0},
    {"hypot(x, y)", -1, 1, -1, 1},
    {"atan2(y, x)", -2, -1, -1, 1},
    {"atan2(y, x)", -1, 1, -1, 1},
    {"atan2(y, x)", 0, 1, -1, 1},
    {"mod(x, 2)", 3.5, 4.5, 0, 0},
    {"mod(x, 2)", 4, 6.5, 0, 0},
    {"mod(x, 2)", 3.9, 6, 0, 0},
    {"mod(x, y)", 1, 1.5, 2, 3},
    {"mod(x, y)", 1, 2, 0, 0},
    {"abs(x)", -1, 1, 0, 0},
    {"sign(x)", -1, 1, 0, 0},
    {"floor(x)", 1.5, 2.5, 0, 0},
    {"floor(x)", 2, 3.5, 0, 0},
    {"ceil(x)", 1.5, 2.5, 0, 0},
    {"ceil(x)", 1.5, 3, 0, 0},
    {"step(x, 1)", .5, 1.5, 0, 0},
    {"pulse(x, 1, 3)", .5, 2, 0, 0},
    {"pulse(x, 1, 3)", 2, 3.5, 0, 0},
    {"pulse(x, 1, 3)", 0, 4, 0, 0},
    {"ramp(x, 1, 3)", .5, 2, 0, 0},
    {"ramp(x, 1, 3)", 2, 3.5, 0, 0},
    {"smooth(x, 1, 3)", .5, 2, 0, 0},
    {"smooth(x, 1, 3)", 2, 3.5, 0, 0},
    {"min(x, y)", 0, 2, 1, 3},
    {"max(x, y)", 0, 2, 1, 3},
    {"max(x, 2)", 1, 3, 0, 0},
    {"if(x < y, 2*x, 7)", 0, 2, 1, 3},
    {"if(x <= y, 2*x, 7)", 0, 2, 1, 3},
    {"if(x > y, 2*x, 7)", 0, 2, 1, 3},
    {"if(x >= y, 2*x, 7)", 0, 2, 1, 3},
    {"if(x == y, 2*x, 7)", 0, 2, 1, 3},
    {"if(x != y, 2*x, 7)", 0, 2, 1, 3},
    {"if(x > 0 and y > 0, x, 9)", -1, 1, 0, 1},
    {"if(x > 0 and y > 0, x, 9)", 0, 1, -1, 1},
    {"if(x > 0 or y > 0, x, 9)", -1, 1, -1, 0},
    {"if(x > 0 or y > 0, x, 9)", -1, 0, -1, 1},
    {"if(not(x > 0), x, 9)", -1, 1, 0, 0},
    {"exp(x)", 0, 1000, 0, 0},
    {"x*y", 0, 1e200, 0, 1e200},
};

static void bounds_by_hand(void **state)
{
    struct arena *life = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof smooth / sizeof *smooth; i++) {
        const struct smooth *s = &smooth[i];
        for (int back = 0; back < 2; back++) {
            const double from[] = {s->a, s->c}, to[] = {s->b, s->d};
            struct expr_span o;
            const bool fine = expr_span(&o, parsed(life, s->text), back ? to : from, back ? from : to);
            if (!fine || !same(o.lo, s->lo) || !same(o.hi, s->hi) || o.degree != s->degree)
                fail_msg("%s on [%g, %g] x [%g, %g]: %d, [%.17g, %.17g], degree %d", s->text, s->a, s->b, s->c, s->d,
                         fine, o.lo, o.hi, o.degree);
        }
    }
    arena_close(life);
}

static void not_smooth(void **state)
{
    struct arena *life = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof rough / sizeof *rough; i++) {
        const struct rough *s = &rough[i];
        struct expr_span o;
        if (expr_span(&o, parsed(life, s->text), (double[]){s->a, s->c}, (double[]){s->b, s->d}))
            fail_msg("%s on [%g, %g] x [%g, %g] is smooth: [%g, %g]", s->text, s->a, s->b, s->c, s->d, o.lo, o.hi);
        assert_true(o.lo == -INFINITY && o.hi == INFINITY);
        assert_int_equal(o.degree, NO);
    }
    arena_close(life);
}

/* On boxes of many places and sizes: where it is said to be smooth, values are in the bounds. */
static void values_are_inside(void **state)
{
    enum { GRID = 8 };
    struct arena *life = arena_open();
    int met = 0;
    (void)state;
    for (size_t i = 0; i < sizeof smooth / sizeof *smooth; i++) {
        const struct expr *e = parsed(life, smooth[i].text);
        for (int box = 0; box < 120; box++) {
            const double x = -3 + .61 * (box % 11), y = -2.6 + .53 * (box % 13), w = .07 * (1 + box % 17);
            const double lo[] = {x, y}, hi[] = {x + w, y + w * (1 + box % 3)};
            struct expr_span o;
            if (!expr_span(&o, e, lo, hi)) continue;
            met++;
            for (int k = 1; k < GRID * GRID; k++) { /* ends may belong to the other side */
                const double u = (k % GRID + .5) / GRID, v = (k / GRID + .5) / GRID;
                const double f = expr_value(e, (double[]){x + u * w, y + v * (hi[1] - y)});
                const double slack = 1e-14 * (1 + fabs(o.lo) + fabs(o.hi));
                if (!(f >= o.lo - slack && f <= o.hi + slack))
                    fail_msg("%s on [%g, %g] x [%g, %g]: %.17g is not in [%.17g, %.17g]", smooth[i].text, lo[0], hi[0],
                             lo[1], hi[1], f, o.lo, o.hi);
            }
        }
    }
    assert_true(met > 5000);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_by_hand),
        cmocka_unit_test(not_smooth),
        cmocka_unit_test(values_are_inside),
    };
    return cmocka_run_group_tests_name("span", tests, NULL, NULL);
}
