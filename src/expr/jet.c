/* jet.c -- the machine once more: value, first and second derivative along one slot, by Taylor arithmetic. */
#include <assert.h>
#include <math.h>

#include "expr/code.h"
#include "expr/expr.h"

struct jet {
    double x, d, dd; /* value, first and second derivative */
};

/* x := f(x); where x stands still, f may be as steep as it likes. */
static void chain(struct jet *x, double f, double f1, double f2)
{
    double d = x->d, dd = x->dd;
    x->x = f;
    x->d = d == 0 ? 0 : f1 * d;
    x->dd = (dd == 0 ? 0 : f1 * dd) + (d == 0 ? 0 : f2 * d * d);
}

static bool still(const struct jet *x)
{
    return x->d == 0 && x->dd == 0;
}

static void multiply(struct jet *x, const struct jet *y)
{
    *x = (struct jet){x->x * y->x, x->d * y->x + x->x * y->d, x->dd * y->x + 2 * x->d * y->d + x->x * y->dd};
}

static void divide(struct jet *x, struct jet y)
{
    chain(&y, 1 / y.x, -1 / (y.x * y.x), 2 / (y.x * y.x * y.x));
    multiply(x, &y);
}

/* x^y: a fixed exponent by itself, else exp(y log x). */
static void power(struct jet *x, struct jet y)
{
    double a = x->x, b = y.x, f = pow(a, b);
    if (still(&y)) {
        chain(x, f, b == 0 ? 0 : b * pow(a, b - 1), b == 0 || b == 1 ? 0 : b * (b - 1) * pow(a, b - 2));
        return;
    }
    chain(x, log(a), 1 / a, -1 / (a * a));
    multiply(x, &y);
    chain(x, f, f, f);
}

static void root(struct jet *x)
{
    double f = sqrt(x->x);
    chain(x, f, .5 / f, -.25 / (f * x->x));
}

static void radius(struct jet *x, struct jet y)
{
    struct jet y2 = y;
    multiply(&y2, &y);
    y = *x;
    multiply(x, &y);
    *x = (struct jet){x->x + y2.x, x->d + y2.d, x->dd + y2.dd};
    root(x);
}

/* The angle of (x, y) for the arguments y, x of atan2: a' = (x y' - y x')/r^2, a'' = ((x y'' - y x'') - a' (r^2)')/r^2.
 */
static void angle(struct jet *y, const struct jet *x)
{
    double r2 = x->x * x->x + y->x * y->x, r2d = 2 * (x->x * x->d + y->x * y->d);
    double d = (x->x * y->d - y->x * x->d) / r2, dd = (x->x * y->dd - y->x * x->dd - d * r2d) / r2;
    *y = (struct jet){atan2(y->x, x->x), still(x) && still(y) ? 0 : d, still(x) && still(y) ? 0 : dd};
}

static struct jet constant(double value)
{
    return (struct jet){.x = value};
}

/* clang-format off */
static void two(enum op op, struct jet *x, const struct jet *y)
{
    double a = x->x, b = y->x;
    switch (op) {
    case OP_ADD: *x = (struct jet){a + b, x->d + y->d, x->dd + y->dd}; break;
    case OP_SUB: *x = (struct jet){a - b, x->d - y->d, x->dd - y->dd}; break;
    case OP_MUL: multiply(x, y); break;
    case OP_DIV: divide(x, *y); x->x = a / b; break;
    case OP_POW: power(x, *y); break;
    case OP_MOD: {
        double whole = floor(a / b);
        *x = (struct jet){a - b * whole, x->d - y->d * whole, x->dd - y->dd * whole};
        break;
    }
    case OP_MIN: if (a > b || b != b) *x = *y; break;
    case OP_MAX: if (a < b || b != b) *x = *y; break;
    case OP_ATAN2: angle(x, y); break;
    case OP_HYPOT: radius(x, *y); break;
    case OP_LT: *x = constant(a < b); break;
    case OP_LE: *x = constant(a <= b); break;
    case OP_GT: *x = constant(a > b); break;
    case OP_GE: *x = constant(a >= b); break;
    case OP_EQ: *x = constant(a == b); break;
    case OP_NE: *x = constant(a != b); break;
    case OP_AND: *x = constant(a != 0 && b != 0); break;
    case OP_OR: *x = constant(a != 0 || b != 0); break;
    default:
        assert(0);
    }
}

static void one(enum op op, struct jet *x)
{
    double a = x->x, f, g;
    switch (op) {
    case OP_NEG: chain(x, -a, -1, 0); break;
    case OP_NOT: *x = constant(a == 0); break;
    case OP_SQUARE: chain(x, a * a, 2 * a, 2); break;
    case OP_CUBE: chain(x, a * a * a, 3 * a * a, 6 * a); break;
    case OP_SIN: f = sin(a), chain(x, f, cos(a), -f); break;
    case OP_COS: f = cos(a), chain(x, f, -sin(a), -f); break;
    case OP_TAN: f = tan(a), g = 1 + f * f, chain(x, f, g, 2 * f * g); break;
    case OP_ASIN: g = 1 / sqrt((1 - a) * (1 + a)), chain(x, asin(a), g, a * g * g * g); break;
    case OP_ACOS: g = 1 / sqrt((1 - a) * (1 + a)), chain(x, acos(a), -g, -a * g * g * g); break;
    case OP_ATAN: g = 1 / (1 + a * a), chain(x, atan(a), g, -2 * a * g * g); break;
    case OP_SINH: f = sinh(a), chain(x, f, cosh(a), f); break;
    case OP_COSH: f = cosh(a), chain(x, f, sinh(a), f); break;
    case OP_TANH: f = tanh(a), g = cosh(a), chain(x, f, 1 / g / g, -2 * f / g / g); break;
    case OP_EXP: f = exp(a), chain(x, f, f, f); break;
    case OP_LOG: chain(x, log(a), 1 / a, -1 / (a * a)); break;
    case OP_LOG10: g = 2.302585092994045684, chain(x, log10(a), 1 / (a * g), -1 / (a * a * g)); break;
    case OP_SQRT: root(x); break;
    case OP_ABS: chain(x, fabs(a), (double)((a > 0) - (a < 0)), 0); break;
    case OP_SIGN: *x = constant((double)((a > 0) - (a < 0))); break;
    case OP_FLOOR: *x = constant(floor(a)); break;
    case OP_CEIL: *x = constant(ceil(a)); break;
    default:
        assert(0);
    }
}
/* clang-format on */

static struct jet variable(const double *slot, int index, int which)
{
    return (struct jet){slot[index], index == which, 0};
}

double expr_jet(const struct expr *e, double *d, double *dd, const double *slot, int which)
{
    struct jet stack[EXPR_STACK + 1], *s = stack, y; /* s: the first free place */
    stack[0] = constant(0);
    for (const struct instruction *x = e->code; x->op != OP_END; x++) {
        if (x->op == OP_CONST) {
            *s++ = constant(x->value);
        } else if (x->op == OP_SLOT) {
            *s++ = variable(slot, x->index, which);
        } else if (x->op <= OP_OR) {
            s--, two(x->op, s - 1, s);
        } else if (x->op <= OP_DIV_CONST) {
            y = constant(x->value);
            two(x->op - OP_ADD_CONST + OP_ADD, s - 1, &y);
        } else if (x->op <= OP_DIV_SLOT) {
            y = variable(slot, x->index, which);
            two(x->op - OP_ADD_SLOT + OP_ADD, s - 1, &y);
        } else if (x->op == OP_UNLESS) {
            if ((--s)->x == 0) x += x->index;
        } else if (x->op == OP_SKIP) {
            x += x->index;
        } else {
            one(x->op, s - 1);
        }
    }
    *d = stack[0].d;
    *dd = stack[0].dd;
    return stack[0].x;
}
