/* sides.c -- on which side of its corners and jumps an expression is: values that change sign where it bends or jumps.
 *
 *     a < b and the like, min, max    a - b
 *     abs, sign, step                 x
 *     ramp, pulse                     x, and x - 1, of what begins at 0 and ends at 1
 *     floor, ceil                     sin(pi x), which changes sign at all whole numbers
 *     mod(a, b)                       sin(pi a/b)
 *     atan2(a, b)                     a, where b < 0
 *
 * smooth() bends too little, and what is equal at one point only has no sides.  What is told of time alone is known
 * beforehand, see corners.c. */
#include <math.h>

#include "expr/code.h"
#include "expr/expr.h"

struct number {
    double x;
    bool moves; /* not with time alone */
};

/* What ends where two branches meet: has the choice moved, or what one of them gave? */
struct join {
    const struct instruction *at;
    bool moves;
};

#define PI 3.14159265358979323846
#define VALUE(op, f, ...)                                                                                              \
    case OP_##op:                                                                                                      \
        return f;
#define STEP(op, f) VALUE(op, f, 0)
#define CHOICE(op, second)                                                                                             \
    case OP_##op:                                                                                                      \
        return (second) ? b : a;

/* clang-format off */
static double two(enum op op, double a, double b)
{
    switch ((int)op) {
    PAIRS(VALUE)
    CHOICES(CHOICE)
    TRUTHS(STEP)
    default: return NAN;
    }
}

static double one(enum op op, double a)
{
    switch ((int)op) {
    FUNCTIONS(VALUE)
    STEPS(STEP)
    default: return NAN;
    }
}
/* clang-format on */

static int sides_of(enum op op)
{
    switch ((int)op) {
    case OP_LT:
    case OP_LE:
    case OP_GT:
    case OP_GE:
    case OP_MIN:
    case OP_MAX:
    case OP_ABS:
    case OP_SIGN:
    case OP_SINCE:
    case OP_FLOOR:
    case OP_CEIL:
    case OP_MOD:
    case OP_ATAN2:
        return 1;
    case OP_RAMP:
    case OP_PULSE:
        return 2;
    default:
        return 0;
    }
}

static double side_of(enum op op, double a, double b)
{
    switch ((int)op) {
    case OP_ABS:
    case OP_SIGN:
    case OP_SINCE:
    case OP_RAMP:
    case OP_PULSE:
        return a;
    case OP_FLOOR:
    case OP_CEIL:
        return sin(PI * a);
    case OP_MOD:
        return sin(PI * (a / b));
    case OP_ATAN2:
        return b < 0 ? a : NAN;
    default:
        return a - b;
    }
}

/* The machine, and its place in the list of sides. */
struct walk {
    const double *slot; /* NULL: both branches are gone through, for `moves` alone */
    double *side;       /* [sides] NULL: not wanted */
    int n;
    bool moves; /* does any of them? */
    struct number stack[EXPR_STACK + 1], *s;
    struct join join[EXPR_DEPTH];
    int njoin;
    const struct instruction *from; /* what is before it is skipped */
};

static void note(struct walk *o, enum op op, double a, double b, bool moves)
{
    const int n = sides_of(op);
    o->moves |= n > 0 && moves;
    for (int i = 0; i < n; i++, o->n++)
        if (o->side) o->side[o->n] = moves ? side_of(op, a, b) - i : NAN;
}

static struct number slot_of(const struct walk *o, int index)
{
    return (struct number){o->slot ? o->slot[index] : 0, index > 0};
}

static void binary(struct walk *o, enum op op, struct number b)
{
    struct number *a = o->s - 1;
    const bool moves = a->moves || b.moves;
    note(o, op, a->x, b.x, moves);
    *a = (struct number){two(op, a->x, b.x), moves};
}

/* The branch behind x, or the other. */
static void choose(struct walk *o, const struct instruction *x)
{
    const struct instruction *skip = x + x->index, *end = skip + skip->index + 1;
    const struct number truth = *--o->s;
    o->join[o->njoin++] = (struct join){end, truth.moves};
    if (!o->slot) return;
    if (truth.x != truth.x) {
        *o->s++ = (struct number){NAN, truth.moves};
        o->from = end;
    } else if (truth.x == 0) {
        o->from = skip + 1;
    }
}

static void run(struct walk *o, const struct instruction *x)
{
    if (x->op == OP_CONST) {
        *o->s++ = (struct number){x->value, false};
    } else if (x->op == OP_SLOT) {
        *o->s++ = slot_of(o, x->index);
    } else if (x->op < OP_ADD_CONST) {
        o->s--;
        binary(o, x->op, *o->s);
    } else if (x->op <= OP_DIV_CONST) {
        binary(o, x->op - OP_ADD_CONST + OP_ADD, (struct number){x->value, false});
    } else if (x->op <= OP_DIV_SLOT) {
        binary(o, x->op - OP_ADD_SLOT + OP_ADD, slot_of(o, x->index));
    } else if (x->op == OP_UNLESS) {
        choose(o, x);
    } else if (x->op == OP_SKIP) {
        o->from = o->slot ? x + x->index + 1 : o->from;
        if (!o->slot) o->join[o->njoin - 1].moves |= (--o->s)->moves;
    } else {
        note(o, x->op, o->s[-1].x, 0, o->s[-1].moves);
        o->s[-1].x = one(x->op, o->s[-1].x);
    }
}

static void walk(struct walk *o, const struct expr *e)
{
    o->s = o->stack;
    o->from = e->code;
    for (const struct instruction *x = e->code; x->op != OP_END; x++) {
        for (; o->njoin > 0 && o->join[o->njoin - 1].at == x; o->njoin--) o->s[-1].moves |= o->join[o->njoin - 1].moves;
        if (x >= o->from)
            run(o, x);
        else
            note(o, x->op, NAN, NAN, true);
    }
}

int expr_sides(double *side, const struct expr *e, const double *slot)
{
    struct walk o = {.slot = slot, .side = side};
    walk(&o, e);
    return slot || o.moves ? o.n : 0;
}
