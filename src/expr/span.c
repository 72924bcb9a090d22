/* span.c -- the machine over intervals: where an expression's value can be, while its slots go from lo to hi, and
 * whether it is smooth there.
 *
 * It is smooth where every decision falls one way in the inside of the box (if, abs, min, max, sign, floor, mod) and
 * where no function leaves its domain: no divisor, root or logarithm meets 0.  A decision that is open ends the pass.
 * Bounds count what an operand is, not where it comes from (x - x is anywhere in [lo - hi, hi - lo]), so that "not
 * smooth" may be said in vain of a wide box, and is right of a narrow one.  They are not rounded outwards. */
#include <math.h>

#include "expr/code.h"
#include "expr/expr.h"

struct number {
    double lo, hi;
    int degree; /* as a polynomial of what moves */
};

static const struct number anywhere = {-INFINITY, INFINITY, EXPR_NO_POLYNOMIAL};

static struct number point(double x)
{
    return (struct number){x, x, 0};
}

static bool still(const struct number *x)
{
    return x->lo == x->hi;
}

static int capped(int degree)
{
    return degree < EXPR_NO_POLYNOMIAL ? degree : EXPR_NO_POLYNOMIAL;
}

static struct number between(double x, double y, int degree)
{
    return (struct number){fmin(x, y), fmax(x, y), capped(degree)};
}

/* All values of what is monotone in both: at two corners of four. */
static struct number of_corners(double a, double b, double c, double d, int degree)
{
    return (struct number){fmin(fmin(a, b), fmin(c, d)), fmax(fmax(a, b), fmax(c, d)), capped(degree)};
}

/* Does it reach 0, or but for its ends? */
static bool meets_zero(const struct number *x)
{
    return x->lo <= 0 && x->hi >= 0;
}

static bool crosses_zero(const struct number *x)
{
    return x->lo < 0 && x->hi > 0;
}

/* ---- of one operand ---- */

/* |x - m| <= w gives |f(x) - f(m)| <= w for sine and cosine. */
static struct number wave(double (*f)(double), const struct number *x)
{
    const double w = (x->hi - x->lo) / 2, at = f(x->lo + w);
    return (struct number){fmax(-1, at - w), fmin(1, at + w), EXPR_NO_POLYNOMIAL};
}

static bool monotone(struct number *x, double (*f)(double))
{
    *x = between(f(x->lo), f(x->hi), EXPR_NO_POLYNOMIAL);
    return true;
}

/* |x|, and what of it is even and grows with it. */
static struct number size_of(const struct number *x, int degree)
{
    const double a = fabs(x->lo), b = fabs(x->hi);
    return (struct number){meets_zero(x) ? 0 : fmin(a, b), fmax(a, b), capped(degree)};
}

static bool steps(struct number *x, double least, double most)
{
    *x = point(least);
    return least == most;
}

/* What rises from 0 at 0 to 1 at 1 and is constant beyond, a polynomial of this degree between. */
static bool rises(struct number *x, enum op op, int degree)
{
    const struct instruction lo[] = {{OP_CONST, 0, x->lo}, {op, 0, 0}, {OP_END, 0, 0}};
    const struct instruction hi[] = {{OP_CONST, 0, x->hi}, {op, 0, 0}, {OP_END, 0, 0}};
    const bool moves = x->lo >= 0 && x->hi <= 1, outside = x->hi <= 0 || x->lo >= 1;
    *x = between(expr_value(&(struct expr){3, lo}, NULL), expr_value(&(struct expr){3, hi}, NULL),
                 outside ? 0 : degree * x->degree);
    return moves || outside;
}

/* Is the piece inside [0, 1] or outside? */
static bool pulse(struct number *x)
{
    const bool in = x->lo >= 0 && x->hi <= 1, out = x->hi <= 0 || x->lo >= 1;
    *x = point(in);
    return in || out;
}

static double cosine(double x)
{
    return cos(x);
}

static bool even_power(struct number *x)
{
    const struct number a = size_of(x, 2 * x->degree);
    *x = (struct number){a.lo * a.lo, a.hi * a.hi, a.degree};
    return true;
}

static bool tangent(struct number *x)
{
    static const double HALF = 1.5707963267948966, PI = 3.141592653589793;
    return floor((x->lo + HALF) / PI) == floor((x->hi + HALF) / PI) && monotone(x, tan);
}

/* clang-format off */
/* Is f smooth over x?  *x becomes f there. */
static bool one(enum op op, struct number *x)
{
    if (still(x) && isfinite(x->lo)) {
        const struct instruction code[] = {{OP_CONST, 0, x->lo}, {op, 0, 0}, {OP_END, 0, 0}};
        *x = point(expr_value(&(struct expr){3, code}, NULL));
        return isfinite(x->lo);
    }
    switch ((int)op) {
    case OP_NEG: *x = between(-x->hi, -x->lo, x->degree); return true;
    case OP_SQUARE: return even_power(x);
    case OP_CUBE: *x = between(x->lo * x->lo * x->lo, x->hi * x->hi * x->hi, 3 * x->degree); return true;
    case OP_SIN: *x = wave(sin, x); return true;
    case OP_COS: *x = wave(cosine, x); return true;
    case OP_TAN: return tangent(x);
    case OP_ASIN: return x->lo >= -1 && x->hi <= 1 && monotone(x, asin);
    case OP_ACOS: return x->lo >= -1 && x->hi <= 1 && monotone(x, acos);
    case OP_ATAN: return monotone(x, atan);
    case OP_SINH: return monotone(x, sinh);
    case OP_COSH: *x = size_of(x, EXPR_NO_POLYNOMIAL); return monotone(x, cosh);
    case OP_TANH: return monotone(x, tanh);
    case OP_EXP: return monotone(x, exp);
    case OP_LOG: return x->lo > 0 && monotone(x, log);
    case OP_LOG10: return x->lo > 0 && monotone(x, log10);
    case OP_SQRT: return x->lo >= 0 && monotone(x, sqrt);
    case OP_ABS: return !crosses_zero(x) && (*x = size_of(x, x->degree), true);
    case OP_NOT: return steps(x, x->lo == 0 && x->hi == 0, x->lo == 0 || x->hi == 0);
    case OP_SIGN: return steps(x, x->lo < 0 ? -1 : 1, x->hi > 0 ? 1 : -1);
    case OP_FLOOR: return steps(x, floor(x->lo), ceil(x->hi) - 1);
    case OP_CEIL: return steps(x, floor(x->lo) + 1, ceil(x->hi));
    case OP_RAMP: return rises(x, op, 1);
    case OP_SMOOTH: return rises(x, op, 5);
    case OP_SINCE: return steps(x, x->lo >= 0, x->hi > 0);
    case OP_PULSE: return pulse(x);
    default: return false;
    }
}
/* clang-format on */

/* ---- of two ---- */

static struct number product(const struct number *a, const struct number *b)
{
    return of_corners(a->lo * b->lo, a->lo * b->hi, a->hi * b->lo, a->hi * b->hi, a->degree + b->degree);
}

static bool quotient(struct number *a, const struct number *b)
{
    if (meets_zero(b)) return false;
    const struct number per = between(1 / b->lo, 1 / b->hi, still(b) ? 0 : EXPR_NO_POLYNOMIAL);
    *a = product(a, &per);
    return true;
}

static bool power(struct number *a, const struct number *b)
{
    const double n = b->lo;
    const bool whole = still(b) && n == floor(n) && fabs(n) < EXPR_NO_POLYNOMIAL;
    if (!whole && !(a->lo > 0 || (a->lo == 0 && b->lo > 0))) return false;
    if (whole && n < 0 && meets_zero(a)) return false;
    const int degree = whole && n >= 0 ? a->degree * (int)n : EXPR_NO_POLYNOMIAL;
    if (whole && fmod(n, 2) == 0) *a = size_of(a, a->degree);
    *a = of_corners(pow(a->lo, b->lo), pow(a->lo, b->hi), pow(a->hi, b->lo), pow(a->hi, b->hi), degree);
    return true;
}

static bool remainder_of(struct number *a, const struct number *b)
{
    if (!still(b) || b->lo == 0) return false;
    const double x = a->lo / b->lo, y = a->hi / b->lo, whole = floor(fmin(x, y));
    if (whole != ceil(fmax(x, y)) - 1) return false;
    *a = between(a->lo - b->lo * whole, a->hi - b->lo * whole, a->degree);
    return true;
}

static bool direction(struct number *y, const struct number *x)
{
    if (meets_zero(y) && x->lo <= 0) return false;
    *y = of_corners(atan2(y->lo, x->lo), atan2(y->lo, x->hi), atan2(y->hi, x->lo), atan2(y->hi, x->hi),
                    EXPR_NO_POLYNOMIAL);
    return true;
}

static bool radius(struct number *a, const struct number *b)
{
    const struct number x = size_of(a, 0), y = size_of(b, 0);
    if (meets_zero(a) && meets_zero(b)) return false;
    *a = between(hypot(x.lo, y.lo), hypot(x.hi, y.hi), EXPR_NO_POLYNOMIAL);
    return true;
}

/* The larger (or lesser) of two: one of them all the way. */
static bool choice(struct number *a, const struct number *b, bool larger)
{
    const bool below = a->hi <= b->lo, above = a->lo >= b->hi;
    if (below == larger) *a = below || above ? *b : *a;
    return below || above;
}

/* clang-format off */
/* a < b in the inside: 1, 0; both: open.  A truth that is open is none yet to end the pass: nobody may ask. */
static struct number truth(bool may, bool must)
{
    return (struct number){must, may, 0};
}

static struct number relation(enum op op, const struct number *a, const struct number *b)
{
    const bool below = a->hi <= b->lo, above = a->lo >= b->hi, apart = a->hi < b->lo || a->lo > b->hi;
    switch ((int)op) {
    case OP_LT:
    case OP_LE: return truth(!above, below);
    case OP_GT:
    case OP_GE: return truth(!below, above);
    case OP_EQ: return truth(!(below || above), false);
    case OP_NE: return truth(true, apart || below || above);
    case OP_AND: return truth(a->hi != 0 && b->hi != 0, a->lo != 0 && b->lo != 0);
    default: return truth(a->hi != 0 || b->hi != 0, a->lo != 0 || b->lo != 0);
    }
}

/* Is f smooth over a, b?  *a becomes f there. */
static bool two(enum op op, struct number *a, const struct number *b)
{
    if (still(a) && still(b)) {
        const struct instruction code[] = {{OP_CONST, 0, a->lo}, {OP_CONST, 0, b->lo}, {op, 0, 0}, {OP_END, 0, 0}};
        *a = point(expr_value(&(struct expr){4, code}, NULL));
        return isfinite(a->lo);
    }
    switch ((int)op) {
    case OP_ADD: *a = between(a->lo + b->lo, a->hi + b->hi, a->degree > b->degree ? a->degree : b->degree); return true;
    case OP_SUB: *a = between(a->lo - b->hi, a->hi - b->lo, a->degree > b->degree ? a->degree : b->degree); return true;
    case OP_MUL: *a = product(a, b); return true;
    case OP_DIV: return quotient(a, b);
    case OP_POW: return power(a, b);
    case OP_MOD: return remainder_of(a, b);
    case OP_ATAN2: return direction(a, b);
    case OP_HYPOT: return radius(a, b);
    case OP_MIN: return choice(a, b, false);
    case OP_MAX: return choice(a, b, true);
    default: *a = relation(op, a, b); return true;
    }
}
/* clang-format on */

/* ---- the machine ---- */

static struct number slot_of(int index, const double *lo, const double *hi)
{
    const double a = fmin(lo[index], hi[index]), b = fmax(lo[index], hi[index]);
    return (struct number){a, b, a < b};
}

static bool pass(struct number *stack, const struct expr *e, const double *lo, const double *hi)
{
    struct number *s = stack, y; /* s: the first free place */
    bool smooth = true;
    for (const struct instruction *x = e->code; x->op != OP_END && smooth; x++) {
        if (x->op == OP_CONST) {
            *s++ = point(x->value);
        } else if (x->op == OP_SLOT) {
            *s++ = slot_of(x->index, lo, hi);
        } else if (x->op < OP_ADD_CONST) {
            s--;
            smooth = two(x->op, s - 1, s);
        } else if (x->op <= OP_DIV_CONST) {
            y = point(x->value);
            smooth = two(x->op - OP_ADD_CONST + OP_ADD, s - 1, &y);
        } else if (x->op <= OP_DIV_SLOT) {
            y = slot_of(x->index, lo, hi);
            smooth = two(x->op - OP_ADD_SLOT + OP_ADD, s - 1, &y);
        } else if (x->op == OP_UNLESS) {
            s--;
            smooth = s->lo == s->hi;
            if (s->lo == 0) x += x->index;
        } else if (x->op == OP_SKIP) {
            x += x->index;
        } else {
            smooth = one(x->op, s - 1);
        }
    }
    return smooth;
}

bool expr_span(struct expr_span *o, const struct expr *e, const double *lo, const double *hi)
{
    struct number stack[EXPR_STACK + 1] = {anywhere};
    const bool smooth = pass(stack, e, lo, hi) && isfinite(stack[0].lo) && isfinite(stack[0].hi);
    if (!smooth) stack[0] = anywhere;
    *o = (struct expr_span){stack[0].lo, stack[0].hi, stack[0].degree};
    return smooth;
}
