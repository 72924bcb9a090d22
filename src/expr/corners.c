/* corners.c -- the times at which an expression is known to bend or jump, before any is met.
 *
 * The program is passed once over numbers that are linear in one slot, the time, or such a number wrapped by mod():
 *
 *     x = slope t + start,   or   gain mod(slope t + start, wrap) + offset
 *
 * Where two of these are compared, or one is given to abs, min, max, sign, floor, ceil, mod, step, ramp, smooth or pulse, their difference changes
 * sides at times that follow.  What else there may be is not known. */
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "expr/code.h"
#include "expr/expr.h"

struct number {
    bool known;
    double slope, start;
    double size;               /* largest term of start so far: its round-off */
    double wrap, gain, offset; /* wrap 0: none */
    bool truth;                /* not known, but constant from one corner to the next */
};

/* The list that is made; NULL: counted only. */
struct found {
    struct expr_corner *corner;
    int n;
    bool all; /* nothing bends or jumps elsewhere */
};

/* What two branches leave is not one number: where they meet. */
struct joins {
    const struct instruction *at[EXPR_DEPTH];
    int n;
};

static const struct number unknown, truth = {.truth = true};

static struct number constant(double x)
{
    return (struct number){.known = true, .start = x, .size = fabs(x), .gain = 1};
}

static bool is_constant(const struct number *x)
{
    return x->known && x->slope == 0 && x->wrap == 0;
}

static struct number times(struct number x, double by)
{
    if (x.wrap != 0) {
        x.gain *= by;
        x.offset *= by;
    } else {
        x.slope *= by;
        x.start *= by;
        x.size *= fabs(by);
    }
    return x;
}

/* x + y; of wrapped numbers only with a constant. */
static struct number plus(struct number x, struct number y)
{
    if (x.wrap == 0 && y.wrap != 0) return plus(y, x);
    if (!x.known || !y.known || (x.wrap != 0 && !is_constant(&y))) return unknown;
    if (x.wrap != 0) {
        x.offset += y.start;
        return x;
    }
    x.slope += y.slope;
    x.start += y.start;
    x.size = fmax(fmax(x.size, y.size), fabs(x.start));
    return x;
}

static void note(struct found *o, double at, double period, double width)
{
    if (!isfinite(at) || !isfinite(period)) {
        o->all = false;
        return;
    }
    if (o->corner) o->corner[o->n] = (struct expr_corner){at, period, width};
    o->n++;
}

/* Where x changes sides. */
static void crossing(struct found *o, struct number x)
{
    if (!x.known) o->all = false;
    if (!x.known || x.slope == 0) return;
    const double width = x.size / fabs(x.slope);
    if (x.wrap == 0) {
        note(o, -x.start / x.slope, 0, width);
        return;
    }
    const double phase = -x.offset / x.gain;
    if (phase / x.wrap >= 0 && phase / x.wrap <= 1) note(o, (phase - x.start) / x.slope, fabs(x.wrap / x.slope), width);
}

/* Where it passes the multiples of `every`. */
static void crossings(struct found *o, struct number x, double every)
{
    if (!x.known || x.wrap != 0) o->all = false;
    if (x.known && x.slope != 0 && x.wrap == 0)
        note(o, -x.start / x.slope, fabs(every / x.slope), x.size / fabs(x.slope));
}

static struct number wrapped(struct found *o, struct number x, struct number by)
{
    if (!x.known || x.wrap != 0 || !is_constant(&by) || by.start == 0) {
        o->all = false;
        return unknown;
    }
    crossings(o, x, by.start);
    x.wrap = by.start;
    return x;
}

static struct number two(struct found *o, enum op op, struct number x, struct number y)
{
    switch ((int)op) {
    case OP_ADD:
        return plus(x, y);
    case OP_SUB:
        return plus(x, times(y, -1));
    case OP_MUL:
        return is_constant(&y) && x.known   ? times(x, y.start)
               : is_constant(&x) && y.known ? times(y, x.start)
                                            : unknown;
    case OP_DIV:
        o->all &= is_constant(&y);
        return is_constant(&y) && x.known ? times(x, 1 / y.start) : unknown;
    case OP_MOD:
        return wrapped(o, x, y);
    case OP_AND:
    case OP_OR:
        return x.truth && y.truth ? truth : unknown;
    case OP_MIN:
    case OP_MAX:
        crossing(o, plus(x, times(y, -1)));
        break;
    case OP_LT:
    case OP_LE:
    case OP_GT:
    case OP_GE:
        crossing(o, plus(x, times(y, -1)));
        return truth;
    default:
        o->all &= op_is_smooth(op);
        break;
    }
    return unknown;
}

static struct number one(struct found *o, enum op op, struct number x)
{
    switch ((int)op) {
    case OP_NEG:
        return times(x, -1);
    case OP_NOT:
        return x.truth ? truth : unknown;
    case OP_ABS:
    case OP_SIGN:
        crossing(o, x);
        break;
    case OP_SINCE:
        crossing(o, x);
        return truth;
    case OP_RAMP:
    case OP_SMOOTH:
    case OP_PULSE:
        crossing(o, x);
        crossing(o, plus(x, constant(-1)));
        break;
    case OP_FLOOR:
    case OP_CEIL:
        crossings(o, x, 1);
        break;
    default:
        o->all &= op_is_smooth(op);
        break;
    }
    return unknown;
}

static struct number variable(int index, int slot)
{
    return index == slot ? (struct number){.known = true, .slope = 1, .gain = 1} : unknown;
}

/* One instruction; s: the first free place of the stack. */
static struct number *step(struct found *o, struct joins *joins, struct number *s, const struct instruction *x,
                           int slot)
{
    if (x->op == OP_CONST) {
        *s++ = constant(x->value);
    } else if (x->op == OP_SLOT) {
        *s++ = variable(x->index, slot);
    } else if (x->op < OP_ADD_CONST) {
        s--;
        s[-1] = two(o, x->op, s[-1], s[0]);
    } else if (x->op <= OP_DIV_CONST) {
        s[-1] = two(o, x->op - OP_ADD_CONST + OP_ADD, s[-1], constant(x->value));
    } else if (x->op <= OP_DIV_SLOT) {
        s[-1] = two(o, x->op - OP_ADD_SLOT + OP_ADD, s[-1], variable(x->index, slot));
    } else if (x->op == OP_UNLESS) {
        s--;
        o->all &= s->truth || is_constant(s);
    } else if (x->op == OP_SKIP) {
        s--; /* the other branch puts it there once more */
        joins->at[joins->n++] = x + x->index + 1;
    } else {
        s[-1] = one(o, x->op, s[-1]);
    }
    return s;
}

static struct found look(struct expr_corner *corner, const struct expr *e, int slot)
{
    struct number stack[EXPR_STACK + 1], *s = stack;
    struct found o = {.corner = corner, .all = true};
    struct joins joins = {.n = 0};
    for (const struct instruction *x = e->code; x->op != OP_END; x++) {
        for (; joins.n > 0 && joins.at[joins.n - 1] == x; joins.n--) s[-1] = unknown;
        s = step(&o, &joins, s, x, slot);
    }
    return o;
}

int expr_corners(struct expr_corner *corner, const struct expr *e, int slot)
{
    return look(corner, e, slot).n;
}

bool expr_corners_are_all(const struct expr *e, int slot)
{
    return look(NULL, e, slot).all;
}

/* ---- in time ---- */

/* That of the corner's times which is nearest to t. */
static double nearest(const struct expr_corner *c, double t)
{
    return c->period > 0 && isfinite(t) ? c->at + round((t - c->at) / c->period) * c->period : c->at;
}

double expr_corner_next(const struct expr_corner *c, double t)
{
    double at = nearest(c, t);
    if (c->period == 0) return at > t ? at : INFINITY;
    while (at <= t) {
        const double last = at;
        at += c->period;
        if (at == last) return INFINITY; /* finer than t is known */
    }
    return at;
}

bool expr_corner_meets(double *before, const struct expr_corner *c, double t)
{
    static const double SAME = 4 * DBL_EPSILON;
    const double at = nearest(c, t), width = SAME * larger(fabs(at), c->width);
    if (!(fabs(t - at) <= width)) return false; /* nearly all times */
    *before = fmin(at - width, nextafter(at, -INFINITY));
    return true;
}
