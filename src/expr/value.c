/* value.c -- the machine: values. */
#include <string.h>

#include "expr/code.h"
#include "expr/expr.h"

/* clang-format off */
#define ONE(op, f, ...) case OP_##op: a = top, top = (f); break;
#define TWO(op, f, ...) case OP_##op: a = *--s, b = top, top = (f); break;
#define STEP(op, f) ONE(op, f, 0)
#define TRUTH(op, f) TWO(op, f, 0)
#define CHOICE(op, second) case OP_##op: a = *--s, b = top, top = (second) ? b : a; break;

/* top is the uppermost operand, kept out of the stack; s is the first free place, above those below top. */
double expr_value(const struct expr *e, const double *slot)
{
    double stack[EXPR_STACK + 1], *s = stack, top = 0, a, b;
    for (const struct instruction *x = e->code;; x++) {
        switch (x->op) {
        case OP_CONST: *s++ = top, top = x->value; break;
        case OP_SLOT: *s++ = top, top = slot[x->index]; break;
        PAIRS(TWO)
        CHOICES(CHOICE)
        TRUTHS(TRUTH)
        case OP_ADD_CONST: top += x->value; break;
        case OP_SUB_CONST: top -= x->value; break;
        case OP_MUL_CONST: top *= x->value; break;
        case OP_DIV_CONST: top /= x->value; break;
        case OP_ADD_SLOT: top += slot[x->index]; break;
        case OP_SUB_SLOT: top -= slot[x->index]; break;
        case OP_MUL_SLOT: top *= slot[x->index]; break;
        case OP_DIV_SLOT: top /= slot[x->index]; break;
        FUNCTIONS(ONE)
        STEPS(STEP)
        case OP_UNLESS:
            if (top != top) {
                x += x->index, x += x->index;
                break;
            }
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

/* All others bend or jump somewhere: roots and radii where they are 0, quotients where their divisor is. */
static const bool smooth[OP_END + 1] = {
    [OP_CONST] = true,     [OP_SLOT] = true,      [OP_ADD] = true,       [OP_SUB] = true,       [OP_MUL] = true,
    [OP_ADD_CONST] = true, [OP_SUB_CONST] = true, [OP_MUL_CONST] = true, [OP_DIV_CONST] = true, [OP_ADD_SLOT] = true,
    [OP_SUB_SLOT] = true,  [OP_MUL_SLOT] = true,  [OP_NEG] = true,       [OP_SQUARE] = true,    [OP_CUBE] = true,
    [OP_SIN] = true,       [OP_COS] = true,       [OP_ATAN] = true,      [OP_SINH] = true,      [OP_COSH] = true,
    [OP_TANH] = true,      [OP_EXP] = true,       [OP_END] = true,
};

bool op_is_smooth(enum op op)
{
    return smooth[op];
}

bool expr_is_smooth(const struct expr *e)
{
    for (int i = 0; i < e->n; i++)
        if (!smooth[e->code[i].op]) return false;
    return true;
}

bool expr_may_have_poles(const struct expr *e)
{
    for (int i = 0; i < e->n; i++)
        if (e->code[i].op == OP_DIV || e->code[i].op == OP_DIV_SLOT || e->code[i].op == OP_POW ||
            e->code[i].op == OP_TAN)
            return true;
    return false;
}

struct expr *expr_plus(const struct expr *e, double x, struct arena *arena)
{
    struct instruction *code = TAKE(arena, struct instruction, e->n + 1);
    struct expr *o = TAKE(arena, struct expr, 1);
    memcpy(code, e->code, (size_t)e->n * sizeof *code);
    code[e->n - 1] = (struct instruction){.op = OP_ADD_CONST, .value = x};
    code[e->n] = (struct instruction){.op = OP_END};
    *o = (struct expr){e->n + 1, code};
    return o;
}
