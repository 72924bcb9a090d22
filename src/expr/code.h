/* code.h -- the machine behind an expression: private to this folder.
 *
 * A stack of numbers.  Jumps are relative to the next operation, so that a block of code can move.
 *
 *     operations.h  the operations: values and derivatives
 *     value.c       the machine over doubles
 *     pass.h        the same over numbers that carry derivatives:
 *     slopes.c      slopes in several directions
 *     jet.c         first and second derivative in one
 *     sides.c       on which side of corners and jumps it is
 */
#ifndef FMDSUB_EXPR_CODE_H
#define FMDSUB_EXPR_CODE_H

#include <stddef.h>

#include "expr/expr.h"
#include "expr/operations.h"

#define OP_NAME(op, ...) OP_##op,

/* clang-format off */
enum op {
    /* one more operand */
    OP_CONST,
    OP_SLOT,
    /* two operands become one */
    PAIRS(OP_NAME)
    CHOICES(OP_NAME)
    TRUTHS(OP_NAME)
    /* the same with a constant or a slot as the second operand */
    OP_ADD_CONST,
    OP_SUB_CONST,
    OP_MUL_CONST,
    OP_DIV_CONST,
    OP_ADD_SLOT,
    OP_SUB_SLOT,
    OP_MUL_SLOT,
    OP_DIV_SLOT,
    /* one operand */
    FUNCTIONS(OP_NAME)
    STEPS(OP_NAME)
    /* flow */
    OP_UNLESS, /* takes one; if it is 0, skips `index` operations; if it is NaN, stays that and skips both branches */
    OP_SKIP,   /* skips `index` operations */
    OP_END
};
/* clang-format on */

/* Of x from a constant on, or between two: step(x, a), ramp(x, a, b).  Their names may be those of other things. */
static inline bool op_is_since(int op)
{
    return op == OP_SINCE || op == OP_RAMP || op == OP_SMOOTH || op == OP_PULSE;
}

/* Has it derivatives everywhere, whatever it is given? */
bool op_is_smooth(enum op op);

struct instruction {
    enum op op;
    int index;    /* slot, or operations to skip; while parsing, of a constant: its offset in the text */
    double value; /* constant */
};

struct expr {
    int n; /* with OP_END */
    const struct instruction *code;
};

#endif
