/* pass.h -- the machine over numbers that carry derivatives; included once in each file that defines such a kind:
 *
 *     struct number   with the value x
 *     constant(x), variable(slot, index, which, n)   slot[index], differentiated along the n slots `which`
 *     still(x)        does it not move?
 *     chain(x, f, f1, f2)                      x := f(x)
 *     chain2(x, y, f, fa, fb, faa, fab, fbb)   x := f(x, y)
 *
 * the last two as functions or as macros that leave out what they do not want.  Where an argument stands still, its
 * derivatives are not looked at. */
#include <assert.h>

#include "expr/code.h"

/* clang-format off */
#define PAIR(op, F, FA, FB, FAA, FAB, FBB) \
    case OP_##op: { double f = F, fa = FA, fb = FB; chain2(x, y, f, fa, fb, FAA, FAB, FBB); break; }
#define CHOICE(op, second) case OP_##op: if (second) *x = *y; break;
#define FUNCTION(op, F, F1, F2) case OP_##op: { double f = F, f1 = F1; chain(x, f, f1, F2); break; }
#define b_moves() (!still(y))
#define STEP(op, f) case OP_##op: *x = constant(f); break;

static void two(enum op op, struct number *x, const struct number *y)
{
    double a = x->x, b = y->x;
    switch ((int)op) { /* those of two operands */
    PAIRS(PAIR)
    CHOICES(CHOICE)
    TRUTHS(STEP)
    default:
        assert(0);
    }
}

static void one(enum op op, struct number *x)
{
    double a = x->x;
    switch ((int)op) { /* those of one */
    FUNCTIONS(FUNCTION)
    STEPS(STEP)
    default:
        assert(0);
    }
}
/* clang-format on */

/* stack [EXPR_STACK + 1]; the result is its first. */
static void pass(struct number *stack, const struct expr *e, const double *slot, const int *which, int n)
{
    struct number *s = stack, y; /* s: the first free place */
    stack[0] = constant(0);
    for (const struct instruction *x = e->code; x->op != OP_END; x++) {
        if (x->op == OP_CONST) {
            *s++ = constant(x->value);
        } else if (x->op == OP_SLOT) {
            *s++ = variable(slot, x->index, which, n);
        } else if (x->op < OP_ADD_CONST) {
            s--, two(x->op, s - 1, s);
        } else if (x->op <= OP_DIV_CONST) {
            y = constant(x->value);
            two(x->op - OP_ADD_CONST + OP_ADD, s - 1, &y);
        } else if (x->op <= OP_DIV_SLOT) {
            y = variable(slot, x->index, which, n);
            two(x->op - OP_ADD_SLOT + OP_ADD, s - 1, &y);
        } else if (x->op == OP_UNLESS) {
            s--;
            if (s->x != s->x) {
                *s++ = constant(NAN);
                x += x->index, x += x->index;
            } else if (s->x == 0) {
                x += x->index;
            }
        } else if (x->op == OP_SKIP) {
            x += x->index;
        } else {
            one(x->op, s - 1);
        }
    }
}
