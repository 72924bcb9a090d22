/* emit.c -- the program that an expression becomes.
 *
 * An operation whose operands are single constants is computed at once, with the machine that will run the rest; one
 * whose second operand is a constant or a slot takes it in. */
#include <string.h>

#include "expr/parse_parts.h"

void emit_code(struct parser *p, struct instruction x)
{
    p->code = arena_more(p->arena, p->code, p->n, &p->capacity, sizeof *p->code);
    p->code[p->n++] = x;
}

enum made emit_operand(struct parser *p, struct instruction x)
{
    if (++p->stack > EXPR_STACK - 1) {
        p->error->limit = true;
        return parse_wrong(p, p->at, 1, "the expression needs more than %d operands at a time", EXPR_STACK - 1);
    }
    if (p->n >= EXPR_LENGTH) {
        p->error->limit = true;
        return parse_wrong(p, p->at, 1, "the expression comes to more than %d operations", EXPR_LENGTH);
    }
    emit_code(p, x);
    return NUMBER;
}

enum made emit_constant(struct parser *p, double value, size_t offset)
{
    return emit_operand(p, (struct instruction){OP_CONST, (int)offset, value});
}

bool emit_is_constant(const struct parser *p, int from)
{
    return p->n == from + 1 && p->code[from].op == OP_CONST;
}

static double run(struct instruction *code, int n)
{
    struct instruction program[4];
    memcpy(program, code, (size_t)n * sizeof *program);
    program[n] = (struct instruction){.op = OP_END};
    return expr_value(&(struct expr){n + 1, program}, NULL);
}

/* The last operation has constants as operands: it becomes their result, reported by offset if not finite. */
static void fold(struct parser *p, int operands, size_t offset)
{
    int from = p->n - 1 - operands;
    double value = run(p->code + from, operands + 1);
    p->n = from;
    emit_code(p, (struct instruction){OP_CONST, (int)offset, value});
}

void emit_unary(struct parser *p, enum op op, int from, size_t offset)
{
    bool folds = emit_is_constant(p, from);
    emit_code(p, (struct instruction){.op = op});
    if (folds) fold(p, 1, offset);
}

/* op with its second operand inside: OP_ADD to OP_DIV only. */
static bool merge(struct parser *p, enum op op)
{
    struct instruction *last = &p->code[p->n - 1];
    if (op < OP_ADD || op > OP_DIV || (last->op != OP_CONST && last->op != OP_SLOT)) return false;
    last->op = (last->op == OP_CONST ? OP_ADD_CONST : OP_ADD_SLOT) + (op - OP_ADD);
    return true;
}

static bool whole_power(struct parser *p, enum op op)
{
    const struct instruction *last = &p->code[p->n - 1];
    if (op != OP_POW || last->op != OP_CONST || (last->value != 2 && last->value != 3)) return false;
    p->code[p->n - 1] = (struct instruction){.op = last->value == 2 ? OP_SQUARE : OP_CUBE};
    return true;
}

void emit_binary(struct parser *p, enum op op, int left, int right, size_t offset)
{
    p->stack--;
    bool single = p->n == right + 1;
    if (right == left + 1 && p->code[left].op == OP_CONST && emit_is_constant(p, right)) {
        emit_code(p, (struct instruction){.op = op});
        fold(p, 2, offset);
    } else if (!single || (!merge(p, op) && !whole_power(p, op))) {
        emit_code(p, (struct instruction){.op = op});
    }
}
