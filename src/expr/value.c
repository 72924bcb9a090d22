/* value.c -- the machine: values, and slopes by forward differentiation. */
#include <assert.h>
#include <math.h>
#include <string.h>

#include "expr/code.h"
#include "expr/expr.h"

static double signum(double x)
{
    return (double)((x > 0) - (x < 0));
}

static double modulo(double x, double y)
{
    return x - y * floor(x / y);
}

/* clang-format off */
/* top is the uppermost operand, kept out of the stack; s is the first free place, above those below top. */
double expr_value(const struct expr *e, const double *slot)
{
    double stack[EXPR_STACK + 1], *s = stack, top = 0;
    for (const struct instruction *x = e->code;; x++) {
        switch (x->op) {
        case OP_CONST: *s++ = top, top = x->value; break;
        case OP_SLOT: *s++ = top, top = slot[x->index]; break;
        case OP_ADD: top = *--s + top; break;
        case OP_SUB: top = *--s - top; break;
        case OP_MUL: top = *--s * top; break;
        case OP_DIV: top = *--s / top; break;
        case OP_POW: top = pow(*--s, top); break;
        case OP_MOD: top = modulo(*--s, top); break;
        case OP_MIN: --s, top = *s > top || top != top ? top : *s; break;
        case OP_MAX: --s, top = *s < top || top != top ? top : *s; break;
        case OP_ATAN2: top = atan2(*--s, top); break;
        case OP_HYPOT: top = hypot(*--s, top); break;
        case OP_LT: top = *--s < top; break;
        case OP_LE: top = *--s <= top; break;
        case OP_GT: top = *--s > top; break;
        case OP_GE: top = *--s >= top; break;
        case OP_EQ: top = *--s == top; break;
        case OP_NE: top = *--s != top; break;
        case OP_AND: --s, top = *s != 0 && top != 0; break;
        case OP_OR: --s, top = *s != 0 || top != 0; break;
        case OP_ADD_CONST: top += x->value; break;
        case OP_SUB_CONST: top -= x->value; break;
        case OP_MUL_CONST: top *= x->value; break;
        case OP_DIV_CONST: top /= x->value; break;
        case OP_ADD_SLOT: top += slot[x->index]; break;
        case OP_SUB_SLOT: top -= slot[x->index]; break;
        case OP_MUL_SLOT: top *= slot[x->index]; break;
        case OP_DIV_SLOT: top /= slot[x->index]; break;
        case OP_NEG: top = -top; break;
        case OP_NOT: top = top == 0; break;
        case OP_SQUARE: top = top * top; break;
        case OP_CUBE: top = top * top * top; break;
        case OP_SIN: top = sin(top); break;
        case OP_COS: top = cos(top); break;
        case OP_TAN: top = tan(top); break;
        case OP_ASIN: top = asin(top); break;
        case OP_ACOS: top = acos(top); break;
        case OP_ATAN: top = atan(top); break;
        case OP_SINH: top = sinh(top); break;
        case OP_COSH: top = cosh(top); break;
        case OP_TANH: top = tanh(top); break;
        case OP_EXP: top = exp(top); break;
        case OP_LOG: top = log(top); break;
        case OP_LOG10: top = log10(top); break;
        case OP_SQRT: top = sqrt(top); break;
        case OP_ABS: top = fabs(top); break;
        case OP_SIGN: top = signum(top); break;
        case OP_FLOOR: top = floor(top); break;
        case OP_CEIL: top = ceil(top); break;
        case OP_UNLESS:
            if (top == 0) x += x->index;
            top = *--s;
            break;
        case OP_SKIP: x += x->index; break;
        case OP_END:
            return top;
        }
    }
}
/* clang-format on */

/* ---- slopes ---- */

/* A value and its slopes in WIDE directions at a time. */
enum { WIDE = 4 };
struct dual {
    double v, d[WIDE];
};

/* x := f(x) with the slope df; where x does not move, f may be as steep as it likes. */
static void chain(struct dual *x, double f, double df)
{
    x->v = f;
    for (int i = 0; i < WIDE; i++) x->d[i] = x->d[i] == 0 ? 0 : df * x->d[i];
}

/* x := f(x, y) with the slopes fx, fy. */
static void chain2(struct dual *x, const struct dual *y, double f, double fx, double fy)
{
    x->v = f;
    for (int i = 0; i < WIDE; i++) x->d[i] = (x->d[i] == 0 ? 0 : fx * x->d[i]) + (y->d[i] == 0 ? 0 : fy * y->d[i]);
}

static bool still(const struct dual *x)
{
    for (int i = 0; i < WIDE; i++)
        if (x->d[i] != 0) return false;
    return true;
}

/* x^y: y x^(y-1) in x, x^y log x in y; at x = 0 the latter is 0 for y > 0. */
static void power(struct dual *x, const struct dual *y)
{
    double f = pow(x->v, y->v), fx = y->v == 0 ? 0 : y->v * pow(x->v, y->v - 1), fy = 0;
    if (!still(y)) fy = x->v == 0 && y->v > 0 ? 0 : f * log(x->v);
    chain2(x, y, f, fx, fy);
}

static void radius(struct dual *x, const struct dual *y)
{
    double r = hypot(x->v, y->v);
    chain2(x, y, r, r > 0 ? x->v / r : 0, r > 0 ? y->v / r : 0);
}

/* Of min and max: a NaN stays one. */
static void choose(struct dual *x, const struct dual *y, bool second)
{
    if (second) *x = *y;
}

/* The angle of (x, y) for the arguments y, x of atan2: (x dy - y dx)/r^2, without overflow. */
static void angle(struct dual *y, const struct dual *x)
{
    double r = hypot(x->v, y->v);
    chain2(y, x, atan2(y->v, x->v), x->v / r / r, -(y->v / r / r));
}

/* clang-format off */
static void two(enum op op, struct dual *x, const struct dual *y)
{
    double a = x->v, b = y->v;
    switch (op) {
    case OP_ADD: chain2(x, y, a + b, 1, 1); break;
    case OP_SUB: chain2(x, y, a - b, 1, -1); break;
    case OP_MUL: chain2(x, y, a * b, b, a); break;
    case OP_DIV: chain2(x, y, a / b, 1 / b, -(a / b) / b); break;
    case OP_POW: power(x, y); break;
    case OP_MOD: chain2(x, y, modulo(a, b), 1, -floor(a / b)); break;
    case OP_MIN: choose(x, y, a > b || b != b); break;
    case OP_MAX: choose(x, y, a < b || b != b); break;
    case OP_ATAN2: angle(x, y); break;
    case OP_HYPOT: radius(x, y); break;
    case OP_LT: chain2(x, y, a < b, 0, 0); break;
    case OP_LE: chain2(x, y, a <= b, 0, 0); break;
    case OP_GT: chain2(x, y, a > b, 0, 0); break;
    case OP_GE: chain2(x, y, a >= b, 0, 0); break;
    case OP_EQ: chain2(x, y, a == b, 0, 0); break;
    case OP_NE: chain2(x, y, a != b, 0, 0); break;
    case OP_AND: chain2(x, y, a != 0 && b != 0, 0, 0); break;
    case OP_OR: chain2(x, y, a != 0 || b != 0, 0, 0); break;
    default:
        assert(0);
    }
}
/* clang-format on */

/* clang-format off */
static void one(enum op op, struct dual *x)
{
    double a = x->v, f;
    switch (op) {
    case OP_NEG: chain(x, -a, -1); break;
    case OP_NOT: chain(x, a == 0, 0); break;
    case OP_SQUARE: chain(x, a * a, 2 * a); break;
    case OP_CUBE: chain(x, a * a * a, 3 * a * a); break;
    case OP_SIN: chain(x, sin(a), cos(a)); break;
    case OP_COS: chain(x, cos(a), -sin(a)); break;
    case OP_TAN: f = tan(a), chain(x, f, 1 + f * f); break;
    case OP_ASIN: chain(x, asin(a), 1 / sqrt((1 - a) * (1 + a))); break;
    case OP_ACOS: chain(x, acos(a), -1 / sqrt((1 - a) * (1 + a))); break;
    case OP_ATAN: chain(x, atan(a), 1 / (1 + a * a)); break;
    case OP_SINH: chain(x, sinh(a), cosh(a)); break;
    case OP_COSH: chain(x, cosh(a), sinh(a)); break;
    case OP_TANH: f = cosh(a), chain(x, tanh(a), 1 / f / f); break;
    case OP_EXP: f = exp(a), chain(x, f, f); break;
    case OP_LOG: chain(x, log(a), 1 / a); break;
    case OP_LOG10: chain(x, log10(a), 1 / (a * 2.302585092994045684)); break;
    case OP_SQRT: f = sqrt(a), chain(x, f, .5 / f); break;
    case OP_ABS: chain(x, fabs(a), signum(a)); break;
    case OP_SIGN: chain(x, signum(a), 0); break;
    case OP_FLOOR: chain(x, floor(a), 0); break;
    case OP_CEIL: chain(x, ceil(a), 0); break;
    default:
        assert(0);
    }
}
/* clang-format on */

static struct dual constant(double value)
{
    return (struct dual){.v = value};
}

static struct dual variable(const double *slot, int index, const int *which, int n)
{
    struct dual x = {.v = slot[index]};
    for (int i = 0; i < n; i++) x.d[i] = which[i] == index;
    return x;
}

/* One pass over the code for at most WIDE directions. */
static double pass(const struct expr *e, double *d, const double *slot, const int *which, int n)
{
    struct dual stack[EXPR_STACK + 1], *s = stack, y; /* s: the first free place */
    for (const struct instruction *x = e->code; x->op != OP_END; x++) {
        if (x->op == OP_CONST) {
            *s++ = constant(x->value);
        } else if (x->op == OP_SLOT) {
            *s++ = variable(slot, x->index, which, n);
        } else if (x->op <= OP_OR) {
            s--, two(x->op, s - 1, s);
        } else if (x->op <= OP_DIV_CONST) {
            y = constant(x->value);
            two(x->op - OP_ADD_CONST + OP_ADD, s - 1, &y);
        } else if (x->op <= OP_DIV_SLOT) {
            y = variable(slot, x->index, which, n);
            two(x->op - OP_ADD_SLOT + OP_ADD, s - 1, &y);
        } else if (x->op == OP_UNLESS) {
            if ((--s)->v == 0) x += x->index;
        } else if (x->op == OP_SKIP) {
            x += x->index;
        } else {
            one(x->op, s - 1);
        }
    }
    memcpy(d, stack[0].d, (size_t)n * sizeof *d);
    return stack[0].v;
}

double expr_slopes(const struct expr *e, double *d, const double *slot, const int *which, int n)
{
    if (n == 0) return expr_value(e, slot);
    double value = 0;
    for (int i = 0; i < n; i += WIDE) value = pass(e, d + i, slot, which + i, n - i < WIDE ? n - i : WIDE);
    return value;
}

/* ---- about an expression ---- */

static bool reads(const struct instruction *x)
{
    return x->op == OP_SLOT || (x->op >= OP_ADD_SLOT && x->op <= OP_DIV_SLOT);
}

/* The least slot above `above` that is read; -1: none. */
static int next_slot(const struct expr *e, int above)
{
    int least = -1;
    for (int i = 0; i < e->n; i++) {
        int index = e->code[i].index;
        if (reads(&e->code[i]) && index > above && (least < 0 || index < least)) least = index;
    }
    return least;
}

int expr_reads(const struct expr *e, int *slots, int max)
{
    int n = 0;
    for (int slot = next_slot(e, -1); slot >= 0; slot = next_slot(e, slot), n++)
        if (n < max) slots[n] = slot;
    return n;
}

bool expr_is_constant(const struct expr *e)
{
    return next_slot(e, -1) < 0;
}

/* Roots and radii bend where they are 0, quotients where their divisor is. */
static bool is_smooth(enum op op)
{
    switch (op) {
    case OP_CONST:
    case OP_SLOT:
    case OP_ADD:
    case OP_SUB:
    case OP_MUL:
    case OP_ADD_CONST:
    case OP_SUB_CONST:
    case OP_MUL_CONST:
    case OP_DIV_CONST:
    case OP_ADD_SLOT:
    case OP_SUB_SLOT:
    case OP_MUL_SLOT:
    case OP_NEG:
    case OP_SQUARE:
    case OP_CUBE:
    case OP_SIN:
    case OP_COS:
    case OP_ATAN:
    case OP_SINH:
    case OP_COSH:
    case OP_TANH:
    case OP_EXP:
    case OP_END:
        return true;
    default:
        return false;
    }
}

bool expr_is_smooth(const struct expr *e)
{
    for (int i = 0; i < e->n; i++)
        if (!is_smooth(e->code[i].op)) return false;
    return true;
}

int expr_length(const struct expr *e)
{
    return e->n - 1;
}
