/* t-expr.c -- expressions against trees of their own: a random tree is written as text and, apart from that,
 * evaluated in long double; its slopes are central differences of the tree. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

#include "base/arena.h"
#include "expr/code.h"
#include "expr/expr.h"

enum { SLOTS = 6 };
static const char *const slot_names[SLOTS] = {"t", "x", "hub.angle", "hub.angle_rate", "arm.tip.x", "u2"};

static int find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self;
    for (int i = 0; i < SLOTS; i++)
        if (!strcmp(name, slot_names[i])) return *slot = i, 0;
    *slot = -1;
    if (!strcmp(name, "five")) return *value = 5, 0;
    if (!strcmp(name, "fife")) snprintf(error->hint, sizeof error->hint, "did you mean 'five'?");
    return 1;
}

static const struct expr_names names = {.find = find, .self = NULL};

/* ---- random trees ---- */

struct tree {
    char kind; /* n number, s slot, + - * / ^ m(neg) f(unary function) g(binary function) i(if) */
    double number;
    int index;
    struct tree *a, *b, *c;
};

static uint64_t seed;

static double uniform(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

static int dice(int n)
{
    return (int)(uniform() * n);
}

static const char *const unary[] = {"sin",  "cos", "atan", "tanh", "exp",   "sqrt",  "log",  "abs", "sinh",
                                    "cosh", "tan", "asin", "acos", "log10", "floor", "ceil", "sign"};
static const char *const binary[] = {"atan2", "min", "max", "hypot", "pow", "mod"};

static struct tree *grow(struct arena *arena, int depth)
{
    struct tree *x = TAKE(arena, struct tree, 1);
    x->kind = depth == 0 ? "nss"[dice(3)] : "+-*/^mfgins++**"[dice(15)];
    x->number = dice(2) ? dice(20) / 4. : uniform() * 3;
    x->index = x->kind == 's' ? dice(SLOTS) : x->kind == 'f' ? dice(17) : dice(6);
    if (strchr("+-*/^mfgi", x->kind)) x->a = grow(arena, depth - 1);
    if (strchr("+-*/gi", x->kind)) x->b = grow(arena, depth - 1);
    if (x->kind == 'i') x->c = grow(arena, depth - 1);
    if (x->kind == '^') x->number = dice(4) + 1;
    return x;
}

static long double call1(int i, long double a)
{
    long double (*const f[])(long double) = {sinl,  cosl,  atanl, tanhl, expl,  sqrtl,  logl,   fabsl,
                                             sinhl, coshl, tanl,  asinl, acosl, log10l, floorl, ceill};
    return i < 16 ? f[i](a) : a != a ? a : (a > 0) - (a < 0);
}

static long double call2(int i, long double a, long double b)
{
    switch (i) {
    case 0:
        return atan2l(a, b);
    case 1:
        return a > b || b != b ? b : a;
    case 2:
        return a < b || b != b ? b : a;
    case 3:
        return hypotl(a, b);
    case 4:
        return powl(a, b);
    default:
        return a - b * floorl(a / b);
    }
}

static long double exact(const struct tree *x, const long double *slot);

/* The largest number met on the way says how much round-off to expect. */
static long double largest(const struct tree *x, const long double *slot)
{
    if (!x) return 0;
    long double here = fabsl(exact(x, slot)), a = largest(x->a, slot), b = largest(x->b, slot), c = largest(x->c, slot);
    return fmaxl(fmaxl(here, a), fmaxl(b, c));
}

static long double exact(const struct tree *x, const long double *slot)
{
    long double a = x->a ? exact(x->a, slot) : 0, b = x->b ? exact(x->b, slot) : 0;
    switch (x->kind) {
    case 'n':
        return x->number;
    case 's':
        return slot[x->index];
    case '+':
        return a + b;
    case '-':
        return a - b;
    case '*':
        return a * b;
    case '/':
        return a / b;
    case '^':
        return powl(a, x->number);
    case 'm':
        return -a;
    case 'f':
        return call1(x->index, a);
    case 'g':
        return call2(x->index, a, b);
    default:
        return a != a ? a : a < 1 ? b : exact(x->c, slot);
    }
}

static int rank(const struct tree *x)
{
    return strchr("+-", x->kind) ? 1 : strchr("*/", x->kind) ? 2 : x->kind == 'm' ? 3 : x->kind == '^' ? 4 : 5;
}

/* As little parentheses as the grammar allows, so that it is the grammar that is tested. */
static void write(FILE *to, const struct tree *x, int least)
{
    int r = rank(x);
    if (r < least) fputc('(', to);
    switch (x->kind) {
    case 'n':
        fprintf(to, "%.17g", x->number);
        break;
    case 's':
        fputs(slot_names[x->index], to);
        break;
    case 'm':
        fputs("- ", to), write(to, x->a, 3);
        break;
    case '^':
        write(to, x->a, 5), fprintf(to, "^%g", x->number);
        break;
    case 'f':
        fprintf(to, "%s(", unary[x->index]), write(to, x->a, 0), fputc(')', to);
        break;
    case 'g':
        fprintf(to, "%s (", binary[x->index]), write(to, x->a, 0), fputc(',', to), write(to, x->b, 0), fputc(')', to);
        break;
    case 'i':
        fputs("if(", to), write(to, x->a, 0), fputs(" < 1, ", to), write(to, x->b, 0), fputs(", ", to);
        write(to, x->c, 0), fputc(')', to);
        break;
    default:
        write(to, x->a, r), fprintf(to, " %c ", x->kind), write(to, x->b, r + 1);
    }
    if (r < least) fputc(')', to);
}

/* The slope by central differences at two widths, and how far one can trust it: NAN where the tree has a corner or
 * is not finite near slot. */
static long double difference(const struct tree *x, const double *slot, int i, long double *trust)
{
    long double at[SLOTS], d[2], f[2][2];
    for (int k = 0; k < 2; k++) {
        long double h = k ? 1e-6L : 2e-6L;
        for (int side = 0; side < 2; side++) {
            for (int j = 0; j < SLOTS; j++) at[j] = slot[j];
            at[i] += side ? h : -h;
            f[k][side] = exact(x, at);
        }
        d[k] = (f[k][1] - f[k][0]) / (2 * h);
    }
    for (int j = 0; j < SLOTS; j++) at[j] = slot[j];
    long double here = exact(x, at), bend = f[1][1] - 2 * here + f[1][0];
    *trust = fabsl(d[1] - d[0]) + fabsl(bend) / 1e-6L * 1e-3L + fabsl(here) * 1e-12L + fabsl(d[1]) * 1e-9L + 1e-11L;
    return d[1];
}

static char *text_of(const struct tree *x, struct arena *arena)
{
    enum { LONGEST = 20000 };
    char *text = TAKE(arena, char, LONGEST);
    FILE *to = fmemopen(text, LONGEST, "w");
    write(to, x, 0);
    fclose(to);
    return text;
}

/* Values to round-off, times what the tree can magnify (judged by the slopes themselves). */
static void random_trees(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    long values = 0, slopes = 0;
    seed = 1;
    for (int trial = 0; trial < 20000; trial++) {
        struct arena_mark mark = arena_mark(arena);
        struct tree *x = grow(arena, 1 + dice(5));
        char *text = text_of(x, arena);
        struct expr *e;
        struct expr_error error;
        if (expr_parse(&e, text, strlen(text), &names, arena, &error)) {
            assert_non_null(strstr(error.text, "zero") ? error.text : strstr(error.text, "no finite number"));
            arena_rewind(arena, mark);
            continue;
        }
        double slot[SLOTS], d[SLOTS];
        long double lslot[SLOTS];
        for (int i = 0; i < SLOTS; i++) lslot[i] = slot[i] = uniform() * 4 - 1;
        int which[SLOTS] = {0, 1, 2, 3, 4, 5};
        long double want = exact(x, lslot);
        double got = expr_value(e, slot), again = expr_slopes(e, d, slot, which, SLOTS);
        assert_true(got == again || (got != got && again != again));
        bool trusted = isfinite((double)want) && largest(x, lslot) < 1e4L;
        long double sum = 0;
        for (int i = 0; i < SLOTS && trusted; i++) {
            long double trust, slope = difference(x, slot, i, &trust);
            trusted = isfinite((double)trust) && isfinite((double)slope) && trust < 1e-4L * (1 + fabsl(slope));
            if (!trusted) break;
            sum += fabsl(slope);
            if (fabsl(d[i] - slope) > 10 * trust + 1e-6L)
                fail_msg("%s: d/d%s %g, not %Lg", text, slot_names[i], d[i], slope);
            slopes++;
        }
        if (trusted) {
            if (fabsl(got - want) > 1e-10L * (1 + fabsl(want) + sum))
                fail_msg("%s: %.17g, not %.17Lg", text, got, want);
            values++;
        }
        arena_rewind(arena, mark);
    }
    print_message("%ld values, %ld slopes compared\n", values, slopes);
    assert_true(values > 8000);
    assert_true(slopes > 60000);
    arena_close(arena);
}

/* In a box where a tree is said to be smooth its values stay between the bounds. */
static void spans(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    long smooth = 0, rough = 0;
    seed = 7;
    for (int trial = 0; trial < 20000; trial++) {
        struct arena_mark mark = arena_mark(arena);
        struct tree *x = grow(arena, 1 + dice(4));
        char *text = text_of(x, arena);
        struct expr *e;
        struct expr_error error;
        struct expr_span span;
        double a[SLOTS], b[SLOTS], slot[SLOTS];
        const double width = pow(10, -3 * uniform());
        for (int i = 0; i < SLOTS; i++) {
            a[i] = uniform() * 4 - 2;
            b[i] = dice(3) ? a[i] + (dice(2) ? width : -width) : a[i];
        }
        if (expr_parse(&e, text, strlen(text), &names, arena, &error)) {
            arena_rewind(arena, mark);
            continue;
        }
        const bool is = expr_span(&span, e, a, b);
        long double most = 0, lslot[SLOTS];
        for (int k = 0; k < 40 && is; k++) {
            for (int i = 0; i < SLOTS; i++) lslot[i] = slot[i] = a[i] + uniform() * (b[i] - a[i]);
            most = fmaxl(most, largest(x, lslot));
            const double f = expr_value(e, slot), room = 1e-12 * (1 + (double)most);
            if (!(f >= span.lo - room && f <= span.hi + room))
                fail_msg("%s: %.17g, outside of [%.17g, %.17g]", text, f, span.lo, span.hi);
        }
        smooth += is;
        rough += !is;
        arena_rewind(arena, mark);
    }
    print_message("%ld smooth, %ld not\n", smooth, rough);
    assert_true(smooth > 8000 && rough > 1000);
    arena_close(arena);
}

/* ---- single facts ---- */

static struct expr *parsed(struct arena *arena, const char *text)
{
    struct expr *e;
    struct expr_error error;
    if (expr_parse(&e, text, strlen(text), &names, arena, &error)) fail_msg("'%s': %s", text, error.text);
    return e;
}

static void values(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } list[] = {
        {"1", 1},
        {"-2^2", -4},
        {"2^-1", .5},
        {"2^3^2", 512},
        {"2*-3", -6},
        {"--3", 3},
        {"+3 - +2", 1},
        {"7 - 2 - 1", 4},
        {"24/4/2", 3},
        {".5e1 + 5.", 10},
        {"1.5e-2", .015},
        {"2 ^ 0.5", 1.4142135623730951},
        {"sin(pi/2)", 1},
        {"min(3, 1, 2)", 1},
        {"max(3, five, 2)", 5},
        {"mod(-1, 3)", 2},
        {"mod(7, -3)", -2},
        {"hypot(3, 4)", 5},
        {"sign(-2) + sign(0) + 10*sign(3)", 9},
        {"floor(-1.5) + ceil(1.2)", 0},
        {"atan2(1, -1)", 2.356194490192345},
        {"if(1 < 2, 10, 20)", 10},
        {"if(1 >= 2, 10, 20)", 20},
        {"if(1 == 1 and not 2 < 1, 1, 0)", 1},
        {"if(1 == 2 or 2 != 3 and 3 <= 3, 1, 0)", 1},
        {"if((1 < 2 or 1 < 0) and (3 > 4), 1, 0)", 0},
        {"if(not (1 < 2), 1, 0)", 0},
        {"if((1 + 1)*2 == 4, if(0 > 1, 1, 2), 3)", 2},
        {"if(1 < 0, 1/0, 7)", 7},
        {"if(1 < 2, 1, 2) + if(2 < 1, 1, 2)*10", 21},
        {"abs(-2)^3", 8},
        {" ( 1 ) ", 1},
        {"log10(1000)", 3},
    };
    struct arena *arena = arena_open();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct expr *e = parsed(arena, list[i].text);
        if (fabs(expr_value(e, NULL) - list[i].value) > 1e-15 * fabs(list[i].value))
            fail_msg("%s = %.17g, not %g", list[i].text, expr_value(e, NULL), list[i].value);
        assert_true(e->n == 2 && e->code[0].op == OP_CONST && e->code[1].op == OP_END); /* folded */
    }
    arena_close(arena);
}

static void errors(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int offset;
        const char *message, *hint;
    } list[] = {
        {"", 0, "expected a number or a name, found the end", ""},
        {"(1 + 2", 6, "expected ')', found the end", "'(' at character 1 is not closed"},
        {"1 + ", 4, "expected a number or a name, found the end", ""},
        {"sine(t)", 0, "unknown function 'sine'", "did you mean 'sin'?"},
        {"foo(t)", 0, "unknown function 'foo'", ""},
        {"2*fife", 2, "unknown name 'fife'", "did you mean 'five'?"},
        {"1 2", 2, "expected an operator, found '2'", ""},
        {"2t", 1, "a number cannot be followed by 't'",
         "write the product with '*'; numbers have no unit words, decks are in SI units"},
        {"1,5", 1, "expected an operator, found ','", "a decimal point is '.'"},
        {"t < 1", 2, "a comparison belongs into the condition of if(c, a, b)", ""},
        {"(t < 1)", 3, "a comparison belongs into the condition of if(c, a, b)", ""},
        {"t ? 1 : 2", 2, "expected an operator, found '?'", "write if(c, a, b)"},
        {"t**2", 2, "expected a number or a name, found '*'", "a power is written '^'"},
        {"if(t, 1, 2)", 3, "expected a condition such as 't < 1'", ""},
        {"if(0 < t < 1, 1, 2)", 9, "two comparisons are joined by 'and' or 'or'", ""},
        {"if(t < 1 and 2, 1, 2)", 9, "'and' is for conditions", ""},
        {"if(not t, 1, 2)", 3, "'not' is for conditions", ""},
        {"if(t < 1, 1)", 11, "expected ',', found ')'", ""},
        {"if(-(t < 1) < 2, 1, 2)", 4, "a comparison is not a number", ""},
        {"if(2^(t < 1) < 2, 1, 2)", 5, "a comparison is not a number", ""},
        {"if((t < 1)^2 < 2, 1, 2)", 3, "a comparison is not a number", ""},
        {"if(2 + t*(t < 1) < 2, 1, 2)", 9, "a comparison is not a number", ""},
        {"if(3 - 2/t + (t < 1) < 2, 1, 2)", 13, "a comparison is not a number", ""},
        {"if((t < 1) - 3 < 2, 1, 2)", 3, "a comparison is not a number", ""},
        {"if(1 + 2^ (t < 1) < 2, 1, 2)", 10, "a comparison is not a number", ""},
        {"if(- (t < 1) < 2, 1, 2)", 5, "a comparison is not a number", ""},
        {"sin(1, 2)", 0, "'sin' takes 1 argument, found 2", ""},
        {"atan2(1)", 0, "'atan2' takes 2 arguments, found 1", ""},
        {"min(1)", 0, "'min' takes 2 or more arguments, found 1", ""},
        {"sin()", 0, "'sin' takes 1 argument, found 0", ""},
        {"2*sin", 2, "'sin' cannot stand here by itself", ""},
        {"1/0", 1, "division by zero", ""},
        {"t + 1/(2 - 2)", 5, "division by zero", ""},
        {"log(0)*t", 0, "'log' gives no finite number here", ""},
        {"sqrt(-1)", 0, "'sqrt' gives no finite number here", ""},
        {"010", 0, "a number does not begin with 0", ""},
        {"1 + 0x10", 4, "only decimal numbers are read", ""},
        {"1e400", 0, "out of range: the largest number is 1.8e308", ""},
        {"1e-400", 0, "out of range: the smallest number is 4.9e-324", ""},
        {"1.5e", 0, "the exponent has no digits", ""},
        {"1.2.3", 3, "a number cannot be followed by '.'",
         "write the product with '*'; numbers have no unit words, decks are in SI units"},
        {"step(t)", 0, "'step' takes 2 arguments, found 1", ""},
        {"step(t, 1, 2)", 0, "'step' takes 2 arguments, found 3", ""},
        {"ramp()", 0, "'ramp' takes 3 arguments, found 0", ""},
        {"ramp(t, 1)", 0, "'ramp' takes 3 arguments, found 2", ""},
        {"smooth(t, 1, x)", 13, "'smooth' begins and ends at constants, not at what moves", ""},
        {"pulse(t, 2, 1)", 0, "'pulse' ends at 1, which is not behind 2", ""},
        {"2*ramp", 2, "unknown name 'ramp'", ""},
        {"t + \xc3\xa9", 4, "expected a number or a name, found '\xc3\xa9'", ""},
    };
    struct arena *arena = arena_open();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct expr *e;
        struct expr_error error;
        if (!expr_parse(&e, list[i].text, strlen(list[i].text), &names, arena, &error))
            fail_msg("'%s' passed", list[i].text);
        assert_string_equal(error.text, list[i].message);
        assert_string_equal(error.hint, list[i].hint);
        assert_int_equal(error.offset, list[i].offset);
        assert_true(error.length >= 1);
        assert_null(e);
    }
    struct expr *e;
    struct expr_error error;
    assert_int_equal(expr_parse(&e, "1\0002", 3, &names, arena, &error), 1);
    arena_close(arena);
}

/* One below, on, and above each limit. */
static void limits(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    struct expr *e;
    struct expr_error error;
    static char text[3 * EXPR_LENGTH];
    const int deep[] = {EXPR_STACK - 2, EXPR_DEPTH, EXPR_DEPTH + 1, 60000};
    for (int i = 0; i < 4; i++) {
        int n = deep[i];
        memset(text, '(', (size_t)n), text[n] = '1', memset(text + n + 1, ')', (size_t)n);
        assert_int_equal(expr_parse(&e, text, 2 * (size_t)n + 1, &names, arena, &error), n > EXPR_DEPTH);
        assert_int_equal(error.limit, n > EXPR_DEPTH);
        memset(text, '-', (size_t)n), text[n] = '1';
        assert_int_equal(expr_parse(&e, text, (size_t)n + 1, &names, arena, &error), n > EXPR_DEPTH);
        for (int k = 0; k < n; k++) memcpy(text + 2 * k, "2^", 2);
        text[2 * n] = 't';
        assert_int_equal(expr_parse(&e, text, 2 * (size_t)n + 1, &names, arena, &error), n > EXPR_STACK - 2);
    }
    for (size_t n = EXPR_LENGTH - 1; n <= EXPR_LENGTH + 1; n += 2) {
        for (size_t i = 0; i < n; i++) text[i] = i % 2 ? '+' : 't';
        assert_int_equal(expr_parse(&e, text, n, &names, arena, &error), n > EXPR_LENGTH);
        assert_int_equal(error.limit, n > EXPR_LENGTH);
    }
    /* t + (t + (t + ...)): operands pile up. */
    for (int n = EXPR_STACK - 4; n < EXPR_STACK + 2; n++) {
        for (int k = 0; k < n; k++) memcpy(text + 3 * k, "t+(", 3);
        text[3 * n] = 'x', memset(text + 3 * n + 1, ')', (size_t)n);
        int bad = expr_parse(&e, text, 4 * (size_t)n + 1, &names, arena, &error);
        assert_int_equal(bad, n + 1 > EXPR_STACK - 1);
        double slot[SLOTS] = {1, 3}, d[2];
        const int which[] = {0, 1};
        if (bad) continue;
        assert_float_equal(expr_value(e, slot), n + 3, 0);
        assert_float_equal(expr_slopes(e, d, slot, which, 2), n + 3, 0);
        assert_true(d[0] == n && d[1] == 1);
    }
    arena_close(arena);
}

static void corners(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double x, value, slope;
    } list[] = {
        {"abs(x)", 0, 0, 0},        {"sqrt(x)^2", 4, 4, 1},
        {"x^0", 0, 1, 0},           {"x^1.5", 0, 0, 0},
        {"0^x", 2, 0, 0},           {"hypot(x, 0)", 0, 0, 0},
        {"sqrt(x^2)", 0, 0, 0},     {"if(x > 0, x^.5, 0)", -1, 0, 0},
        {"mod(x, 2)", 5.5, 1.5, 1}, {"x^3", -2, -8, 12},
        {"(-x)^3", 2, -8, -12},     {"max(x, 0)*x", -1, 0, 0},
        {"min(x, 1)", 2, 1, 0},     {"x/x", 3, 1, 0},
        {"tanh(x)", 800, 1, 0},     {"atan2(x, 1e200)", 1e200, 0.78539816339744828, 5e-201},
    };
    struct arena *arena = arena_open();
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct expr *e = parsed(arena, list[i].text);
        double slot[SLOTS] = {0, list[i].x}, d;
        const int which = 1;
        double value = expr_slopes(e, &d, slot, &which, 1);
        if (fabs(value - list[i].value) > 1e-15 || fabs(d - list[i].slope) > 1e-14 * fabs(list[i].slope))
            fail_msg("%s: %g %g", list[i].text, value, d);
    }
    struct expr *e = parsed(arena, "min(max(t, x), 1)");
    assert_true(isnan(expr_value(e, (double[SLOTS]){NAN, 0})));
    assert_true(isnan(expr_value(e, (double[SLOTS]){0, NAN})));
    arena_close(arena);
}

/* Where a function may bend or jump at times that are not listed, the list must say so. */
static void all_corners(void **state)
{
    static const char *const all[] = {"sin(3*t)*t^2",
                                      "if(t < 2, t^2/2 + cos(t), 3*t - 1)",
                                      "if(t > 1 and t < 2 or not(t < 5), 1, exp(t))",
                                      "mod(t, 2)",
                                      "floor(3*t)*sin(t)",
                                      "max(t, 1) + abs(2*t - 3)",
                                      "smooth(t, 0, 1)*ramp(t, 1, 2) + step(t, 4)*pulse(t, 1, 2)",
                                      "if(2 > 1, t, 0)"};
    static const char *const some[] = {"abs(sin(t))",
                                       "if(sin(t) > 0, 1, 0)",
                                       "1/t",
                                       "sqrt(t)",
                                       "t^1.5",
                                       "max(t, t^2)",
                                       "mod(t^2, 1)",
                                       "floor(t^2)",
                                       "if(t == 1, 2, 0)",
                                       "mod(mod(t, 3), 2)",
                                       "abs(if(t < 1, t - .5, 1))",
                                       "hypot(t, 1 - t)",
                                       "tan(t)",
                                       "log(t)",
                                       "atan2(t, 1)",
                                       "abs(x)",
                                       "1/(t - 1)",
                                       "min(x, t)",
                                       "smooth(t^2, 0, 1)"};
    (void)state;
    struct arena *arena = arena_open();
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (!expr_corners_are_all(parsed(arena, all[i]), 0)) fail_msg("%s", all[i]);
    for (size_t i = 0; i < sizeof some / sizeof *some; i++)
        if (expr_corners_are_all(parsed(arena, some[i]), 0)) fail_msg("%s", some[i]);
    arena_close(arena);
}

static void slots(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    int slot[3];
    assert_int_equal(expr_reads(parsed(arena, "u2*t + x*u2 - five + hub.angle*hub.angle_rate"), slot, 3), 5);
    assert_true(slot[0] == 0 && slot[1] == 1 && slot[2] == 2);
    assert_int_equal(expr_reads(parsed(arena, "if(1 < 2, x, t)"), slot, 3), 1);
    assert_int_equal(slot[0], 1);
    assert_int_equal(expr_reads(parsed(arena, "0*t"), slot, 3), 1);
    double d[SLOTS + 2], at[SLOTS] = {2, 3, 5, 7, 11, 13};
    const int which[] = {5, 0, 1, 2, 5, 3, 4, 0};
    expr_slopes(parsed(arena, "t*x + 2*u2"), d, at, which, 8);
    const double want[] = {2, 3, 2, 0, 2, 0, 0, 3};
    assert_memory_equal(d, want, sizeof want);
    assert_true(expr_is_word("if") && expr_is_word("sin") && expr_is_word("pi") && !expr_is_word("t"));
    arena_close(arena);
}

/* Times vary: the bound only catches a machine that became slow by a wrong turn. */
static void speed(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    struct expr *e =
        parsed(arena, "x*x*(3 - 2*x) + t*(hub.angle - 0.5)*u2 - 4*(x + t)/(1 + t*t) + sin(2*pi*t)*exp(-x) + "
                      "sqrt(1 + x*x) - hub.angle_rate*(t - 2)");
    double slot[SLOTS] = {.3, .7, .1, 2, 3, 4}, sum = 0, best = 1e9, d[4];
    const int which[] = {0, 1, 2, 3}, n = 20000;
    double best_slopes = 1e9;
    for (int batch = 0; batch < 20; batch++) {
        struct timespec a, b, c;
        clock_gettime(CLOCK_MONOTONIC, &a);
        for (int i = 0; i < n; i++) slot[0] += 1e-9, sum += expr_value(e, slot);
        clock_gettime(CLOCK_MONOTONIC, &b);
        for (int i = 0; i < n; i++) slot[0] += 1e-9, sum += expr_slopes(e, d, slot, which, 4);
        clock_gettime(CLOCK_MONOTONIC, &c);
        double first = ((double)(b.tv_sec - a.tv_sec) * 1e9 + (double)(b.tv_nsec - a.tv_nsec)) / n;
        double second = ((double)(c.tv_sec - b.tv_sec) * 1e9 + (double)(c.tv_nsec - b.tv_nsec)) / n;
        if (first < best) best = first;
        if (second < best_slopes) best_slopes = second;
    }
    assert_true(isfinite(sum));
    print_message("%d operations: value %.0f ns, value and 4 slopes %.0f ns\n", e->n - 1, best, best_slopes);
    assert_true(best < 20000);
    arena_close(arena);
}

/* Value and first derivative are those of the slopes, the second their central difference. */
static void jets(void **state)
{
    static const char *const texts[] = {"t*t*t - 2*t",
                                        "sin(3*t)*cos(t)",
                                        "tan(t/3)",
                                        "exp(-t)*log(2 + t)",
                                        "sqrt(1 + t^2)",
                                        "(1 + t)^2.5",
                                        "(2 + t)^t",
                                        "asin(t/4) + acos(t/5) + atan(2*t)",
                                        "sinh(t)*cosh(t) - tanh(2*t)",
                                        "atan2(1 + t, 2 - t^2)",
                                        "hypot(t, 1 + 2*t)",
                                        "1/(1 + t*t)",
                                        "log10(3 + t)",
                                        "abs(t - 0.3)*t",
                                        "min(t^2, 0.4*t)",
                                        "max(t^3, x*t)",
                                        "mod(t, 0.37)*t",
                                        "if(t < 0.5, t^2, 1 - t^3)",
                                        "x*t^2 + u2/(t + 2)",
                                        "floor(t) + sign(t)*t^4",
                                        "sin(2*t)/(1 + t*t)",
                                        "(2 + sin(t))^cos(2*t)",
                                        "atan2(sin(t), exp(t))",
                                        "hypot(sin(3*t), x - t*t)",
                                        "(1 + t)^-2 + pow(t, 3)"};
    static const int which = 0;
    struct arena *arena = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct expr *e = parsed(arena, texts[i]);
        for (int k = 0; k < 20; k++) {
            double slot[SLOTS], d, dd, up, down, first, h = 1e-5;
            for (int s = 0; s < SLOTS; s++) slot[s] = uniform() + .01;
            double value = expr_jet(e, &d, &dd, slot, 0), t = slot[0];
            assert_float_equal(value, expr_slopes(e, &first, slot, &which, 1), 0);
            assert_float_equal(d, first, 1e-12 * (1 + fabs(first)));
            slot[0] = t + h, expr_slopes(e, &up, slot, &which, 1);
            slot[0] = t - h, expr_slopes(e, &down, slot, &which, 1);
            if (fabs(up - 2 * first + down) > 1e-3) continue; /* a corner between */
            assert_float_equal(dd, (up - down) / (2 * h), 2e-7 * (1 + fabs(dd)));
        }
    }
    arena_close(arena);
}

/* Smooth is what has nothing in it that may bend. */
static void smooth(void **state)
{
    static const char *const can_bend[] = {"abs(t)", "t + min(t, 1)", "if(t < 1, t, 1)", "sqrt(t)", "hypot(t, x)",
                                           "1/t",    "mod(t, 2)",     "floor(t)",        "t^x",     "sin(sign(t))"};
    static const char *const cannot[] = {"2", "t", "3*t - x^2", "sin(2*pi*t)*exp(-t/3)", "tanh(t)^3 + atan(x)"};
    struct arena *arena = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof can_bend / sizeof *can_bend; i++)
        assert_false(expr_is_smooth(parsed(arena, can_bend[i])));
    for (size_t i = 0; i < sizeof cannot / sizeof *cannot; i++) assert_true(expr_is_smooth(parsed(arena, cannot[i])));
    arena_close(arena);
}

/* Of what is not a number nothing is known, unless the other side of and, or decides. */
static void unknown_truths(void **state)
{
    static const struct {
        const char *text;
        double value; /* at t = -1, x = NaN */
    } list[] = {{"sqrt(t) > 1", NAN},
                {"sqrt(t) <= 1", NAN},
                {"not sqrt(t) > 1", NAN},
                {"sqrt(t) != sqrt(t)", NAN},
                {"x == 1", NAN},
                {"t > 0 and sqrt(t) > 1", 0},
                {"sqrt(t) > 1 and t > 0", 0},
                {"t < 0 and sqrt(t) > 1", NAN},
                {"t < 0 or sqrt(t) > 1", 1},
                {"sqrt(t) > 1 or t < 0", 1},
                {"t > 0 or x < 2", NAN},
                {"sign(x) == 0", NAN},
                {"if(x > 0, 2, 3) > 1", NAN},
                {"if(t > 0, x, 3) > 1", 1},
                {"if(t < 0, 5, x) > 1", 1},
                {"2 + if(x < 1, 2, 3) > 1", NAN}};
    struct arena *arena = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct expr *e;
        struct expr_error error;
        const double slot[SLOTS] = {-1, NAN}, want = list[i].value;
        const int which = 0;
        double d, value[3];
        assert_int_equal(expr_parse_truth(&e, list[i].text, strlen(list[i].text), &names, arena, &error), 0);
        value[0] = expr_value(e, slot);
        value[1] = expr_slopes(e, &d, slot, &which, 1);
        value[2] = expr_jet(e, &d, &d, slot, which);
        for (int k = 0; k < 3; k++)
            if (isnan(want) ? !isnan(value[k]) : value[k] != want) fail_msg("%s: %g", list[i].text, value[k]);
    }
    arena_close(arena);
}

/* A truth by itself is what it is as the condition of if. */
static void truths(void **state)
{
    static const char *const texts[] = {"t < 1",
                                        "x >= 0 and not hub.angle > 0.5",
                                        "t < 1 or x < 0 and u2 > 0",
                                        "(t < x or 1 > 2)",
                                        "not (not t < 1)",
                                        "sin(t) != x*(1 + t)"};
    static const char *const wrongs[] = {"t", "t + (x)", "", "t < 1 2", "t < 1)", "not t", "1 < t < 2"};
    struct arena *arena = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        struct expr *alone, *within;
        struct expr_error error;
        const char *text = arena_print(arena, "if(%s, 1, 0)", texts[i]);
        assert_int_equal(expr_parse_truth(&alone, texts[i], strlen(texts[i]), &names, arena, &error), 0);
        assert_int_equal(expr_parse(&within, text, strlen(text), &names, arena, &error), 0);
        int met = 0;
        for (int k = 0; k < 200; k++) {
            double slot[SLOTS];
            for (int s = 0; s < SLOTS; s++) slot[s] = 4 * uniform() - 2;
            assert_true(expr_value(alone, slot) == expr_value(within, slot));
            met += expr_value(alone, slot) != 0;
        }
        assert_true(met > 0);
    }
    for (size_t i = 0; i < sizeof wrongs / sizeof *wrongs; i++) {
        struct expr *e;
        struct expr_error error;
        assert_int_equal(expr_parse_truth(&e, wrongs[i], strlen(wrongs[i]), &names, arena, &error), 1);
        assert_true(error.text[0] != 0);
    }
    arena_close(arena);
}

/* step, ramp, smooth and pulse beside what they are short for: values, slopes, second derivatives, bounds, corners. */
static void helpers(void **state)
{
    static const struct {
        const char *text, *same;
        int corners;
        double first, last;
    } list[] = {
        {"step(t, 0.5)", "if(t < 0.5, 0, 1)", 1, .5, .5},
        {"x*step(2*t, 0.5)", "if(t < 0.25, 0, x)", 1, .25, .25},
        {"pulse(t, 0.5, 0.75)", "if(t < 0.5, 0, if(t < 0.75, 1, 0))", 2, .5, .75},
        {"ramp(t, -1, five)", "if(t < -1, 0, if(t < 5, (t + 1)/6, 1))", 2, -1, 5},
        {"ramp(t, 0.25, 1)*x", "if(t < 0.25, 0, if(t < 1, x*(t - 0.25)/0.75, x))", 2, .25, 1},
        {"x*smooth(t, 0.25, 1.25)",
         "if(t < 0.25, 0, if(t < 1.25, x*(t - 0.25)^3*(10 - 15*(t - 0.25) + 6*(t - 0.25)^2), "
         "x))",
         2, .25, 1.25},
        {"smooth(sin(t), 0, 1)", "if(sin(t) < 0, 0, sin(t)^3*(10 - 15*sin(t) + 6*sin(t)^2))", 0, 0, 0},
    };
    struct arena *arena = arena_open();
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct expr *e = parsed(arena, list[i].text), *same = parsed(arena, list[i].same);
        struct expr_corner corner[4];
        const int which[] = {0, 1}, n = expr_corners(NULL, e, 0);
        assert_int_equal(n, list[i].corners);
        assert_int_equal(expr_corners(corner, e, 0), n);
        for (int k = 0; k < n; k++) assert_float_equal(corner[k].at, k ? list[i].last : list[i].first, 1e-15);
        for (int k = 0; k < 400; k++) {
            double slot[SLOTS] = {uniform() * 8 - 2, uniform() * 4 - 2}, d[2], ds[2], dd, dds, first, firsts;
            assert_float_equal(expr_slopes(e, d, slot, which, 2), expr_slopes(same, ds, slot, which, 2), 1e-14);
            for (int j = 0; j < 2; j++) assert_float_equal(d[j], ds[j], 1e-12);
            expr_jet(e, &first, &dd, slot, 0), expr_jet(same, &firsts, &dds, slot, 0);
            assert_float_equal(first, firsts, 1e-12), assert_float_equal(dd, dds, 1e-11);
            double to[SLOTS] = {slot[0] + uniform() * uniform(), slot[1]}, slope, slopes;
            struct expr_span span;
            if (expr_span(&span, e, slot, to))
                for (int m = 0; m <= 20; m++) {
                    const double at[SLOTS] = {slot[0] + m / 20. * (to[0] - slot[0]), slot[1]}, f = expr_value(e, at);
                    assert_true(f >= span.lo - 1e-13 && f <= span.hi + 1e-13);
                }
            else
                assert_true(expr_bends(&(struct expr_way){e, slot, to, SLOTS}));
            const double mean = expr_mean(&slope, &(struct expr_way){e, slot, to, SLOTS}, 0);
            assert_float_equal(mean, expr_mean(&slopes, &(struct expr_way){same, slot, to, SLOTS}, 0), 1e-9);
        }
    }
    assert_true(!expr_is_word("ramp") && isnan(expr_value(parsed(arena, "pulse(t, 0, 1)"), (double[SLOTS]){NAN})));
    assert_float_equal(
        expr_value(parsed(arena, "ramp(0.5, 0, 2) + smooth(1, 0, 2) + step(1, 1) + pulse(2, 1, 2)"), NULL), 1.75,
        1e-15);
    arena_close(arena);
}

/* A text that stands for a name is as if it stood there in brackets. */
static bool stand_in(struct expr_stand_in *o, void *self, const char *name)
{
    static const struct expr_names inner = {.find = find, .stand_in = stand_in};
    (void)self;
    const char *text = !strcmp(name, "twice") ? "2*x + t" : !strcmp(name, "four") ? "twice*twice" : NULL;
    if (!strcmp(name, "round")) text = "1 + round";
    *o = (struct expr_stand_in){text, &inner};
    return text;
}

static void stand_ins(void **state)
{
    static const struct expr_names with = {.find = find, .stand_in = stand_in};
    struct arena *arena = arena_open();
    struct expr *e;
    struct expr_error error;
    (void)state;
    const char *text = "3 - four*(if(t < 1, twice, 0))";
    assert_int_equal(expr_parse(&e, text, strlen(text), &with, arena, &error), 0);
    const double slot[SLOTS] = {.5, 2};
    const int which = 1;
    double d;
    assert_float_equal(expr_slopes(e, &d, slot, &which, 1), 3 - pow(4.5, 3), 1e-13);
    assert_float_equal(d, -6 * 4.5 * 4.5, 1e-12);
    assert_int_equal(expr_parse(&e, "2*round", 7, &with, arena, &error), 1);
    assert_true(error.limit && error.offset == 2);
    arena_close(arena);
}

/* Do all sides that are known at both stand as they stood, and are the same ones known? */
static bool same_sides(const double *a, const double *b, int n)
{
    for (int i = 0; i < n; i++)
        if (isnan(a[i]) != isnan(b[i]) || (a[i] > 0) != (b[i] > 0)) return false;
    return true;
}

/* In small steps of x across everything: where the value or its slope jumps a side changes, and where nothing does none does. */
static void sides(void **state)
{
    static const struct {
        const char *text;
        int changes; /* from x = -2 to 2 at t = .3, hub.angle = .4 */
        bool all;    /* does it bend or jump at each? */
    } list[] = {
        {"if(x > 0.05, -3*(x - 0.05), if(x < -0.05, -3*(x + 0.05), 0))", 2, true},
        {"abs(x - 1)", 1, true},
        {"abs(x)*x", 1, false},
        {"max(x, hub.angle, -1) + min(2*x, 3)", 2, true},
        {"5*sign(x - 0.3) + step(x, -1)", 2, true},
        {"ramp(x, -1, 1) + pulse(x, 0.2, 0.4)", 4, true},
        {"floor(x + 0.1) + ceil(2*x + 0.3)", 12, true},
        {"mod(x + 0.01, 0.5)", 8, true},
        {"atan2(x - 0.1, -1) + atan2(x, 1)", 1, true},
        {"if(x > 0 and x < 1 or x > 1.5, 3, 1)", 3, true},
        {"if(not x*x > hub.angle, 2, 0)", 2, true},
        {"if(t > 1, abs(x), x)", 0, true},
        {"x*if(t > 0.2, max(x, 0.1), 0)", 1, true},
        {"min(if(x > 0, x, 0), 1) + sin(x)", 2, true},
    };
    struct arena *arena = arena_open();
    (void)state;
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        struct expr *e;
        struct expr_error error;
        enum { MOST = 12, STEPS = 4001 };
        double side[2][MOST], d0 = 0, f0 = 0;
        const double h = 4. / STEPS;
        const int which = 1;
        assert_int_equal(expr_parse(&e, list[k].text, strlen(list[k].text), &names, arena, &error), 0);
        const int n = expr_sides(NULL, e, NULL);
        int changes = 0;
        assert_in_range(n, 0, MOST);
        for (int i = 0; i < STEPS; i++) {
            const double slot[SLOTS] = {.3, -2 + h * (i + .37), .4};
            double d;
            const double f = expr_slopes(e, &d, slot, &which, 1);
            if (n > 0) assert_int_equal(expr_sides(side[1], e, slot), n);
            if (i > 0) {
                const bool bends = fabs(f - f0 - h * (d + d0) / 2) > 1e-4 || fabs(d - d0) > 1e-2;
                const bool same = n == 0 || same_sides(side[0], side[1], n);
                if (bends && same) fail_msg("'%s' bends at x = %g unsaid", list[k].text, slot[1]);
                if (!bends && !same && list[k].all) fail_msg("'%s' is said to bend at x = %g", list[k].text, slot[1]);
                changes += !same;
            }
            d0 = d;
            f0 = f;
            memcpy(side[0], side[1], sizeof side[0]);
        }
        if (changes != list[k].changes) fail_msg("'%s': %d changes", list[k].text, changes);
    }
    static const char *const none[] = {"if(t > 1, 3, 0)*x", "x^2 + sin(hub.angle)", "max(t, 1)*hub.angle_rate",
                                       "if(x == 1, 2, 3)", "smooth(x, 0, 1)"};
    for (size_t k = 0; k < sizeof none / sizeof *none; k++) {
        struct expr *e;
        struct expr_error error;
        assert_int_equal(expr_parse(&e, none[k], strlen(none[k]), &names, arena, &error), 0);
        assert_int_equal(expr_sides(NULL, e, NULL), 0);
    }
    arena_close(arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values),         cmocka_unit_test(errors),       cmocka_unit_test(limits),
        cmocka_unit_test(corners),        cmocka_unit_test(all_corners),  cmocka_unit_test(slots),
        cmocka_unit_test(speed),          cmocka_unit_test(random_trees), cmocka_unit_test(truths),
        cmocka_unit_test(jets),           cmocka_unit_test(smooth),       cmocka_unit_test(spans),
        cmocka_unit_test(unknown_truths), cmocka_unit_test(helpers),      cmocka_unit_test(stand_ins),
        cmocka_unit_test(sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
