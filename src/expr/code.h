/* code.h -- the machine behind an expression: private to this folder.
 *
 * A stack of doubles.  Jumps are relative to the next operation, so that a block of code can move. */
#ifndef FMDSUB_EXPR_CODE_H
#define FMDSUB_EXPR_CODE_H

#include <stddef.h>

#include "expr/expr.h"

enum op {
    /* one more operand */
    OP_CONST,
    OP_SLOT,
    /* two operands become one */
    OP_ADD,
    OP_SUB,
    OP_MUL,
    OP_DIV,
    OP_POW,
    OP_MOD,
    OP_MIN,
    OP_MAX,
    OP_ATAN2,
    OP_HYPOT,
    OP_LT,
    OP_LE,
    OP_GT,
    OP_GE,
    OP_EQ,
    OP_NE,
    OP_AND,
    OP_OR,
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
    OP_NEG,
    OP_NOT,
    OP_SQUARE,
    OP_CUBE,
    OP_SIN,
    OP_COS,
    OP_TAN,
    OP_ASIN,
    OP_ACOS,
    OP_ATAN,
    OP_SINH,
    OP_COSH,
    OP_TANH,
    OP_EXP,
    OP_LOG,
    OP_LOG10,
    OP_SQRT,
    OP_ABS,
    OP_SIGN,
    OP_FLOOR,
    OP_CEIL,
    /* flow */
    OP_UNLESS, /* takes one; if it is 0, skips `index` operations */
    OP_SKIP,   /* skips `index` operations */
    OP_END
};

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
