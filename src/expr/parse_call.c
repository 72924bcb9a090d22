/* parse_call.c -- calls of functions, and if(). */
#include <math.h>
#include <string.h>

#include "expr/parse_parts.h"

/* "if(" truth "," value "," value ")": the branch not taken is not run; with a constant condition it is not kept. */
static enum made if_then(struct parser *p)
{
    size_t start = p->at;
    int from = p->n;
    bool outer = p->condition;
    p->condition = true;
    enum made made = parse_truth(p);
    p->condition = outer;
    if (made == FAILED) return FAILED;
    if (made != TRUTH) return parse_wrong(p, start, p->at - start, "expected a condition such as 't < 1'");
    if (emit_is_constant(p, from) && isnan(p->code[from].value))
        return parse_wrong(p, start, p->at - start, "one side of the condition is no finite number");
    if (!scan_accept(p, ',')) return parse_expected(p, "','");
    bool known = emit_is_constant(p, from), yes = known && p->code[from].value != 0;
    p->stack--;
    int unless = p->n;
    emit_code(p, (struct instruction){.op = OP_UNLESS});
    if (parse_sum(p) == FAILED) return FAILED;
    if (!scan_accept(p, ',')) return parse_expected(p, "','");
    p->stack--;
    int skip = p->n;
    emit_code(p, (struct instruction){.op = OP_SKIP});
    if (parse_sum(p) == FAILED) return FAILED;
    if (!scan_accept(p, ')')) return parse_expected(p, "')'");
    p->code[unless].index = skip - unless;
    p->code[skip].index = p->n - skip - 1;
    if (!known) return NUMBER;
    int keep = yes ? unless + 1 : skip + 1, n = yes ? skip - unless - 1 : p->n - skip - 1;
    memmove(p->code + from, p->code + keep, (size_t)n * sizeof *p->code);
    p->n = from + n;
    return NUMBER;
}

static enum made arguments(struct parser *p, const struct expr_function *f, size_t start)
{
    int from = p->n, n = 1;
    if (scan_next(p) == ')') return parse_arity(p, f, start, 0);
    if (parse_sum(p) == FAILED) return FAILED;
    for (; scan_accept(p, ','); n++) {
        int right = p->n;
        if (n >= f->nmax) {
            while (p->text[p->at] && parse_sum(p) != FAILED && scan_accept(p, ',')) n++;
            return parse_arity(p, f, start, n + 1);
        }
        if (parse_sum(p) == FAILED) return FAILED;
        emit_binary(p, (enum op)f->op, from, right, start);
    }
    if (!scan_accept(p, ')')) return parse_expected(p, n < f->nmax ? "',' or ')'" : "')'");
    if (n < f->nmin) return parse_arity(p, f, start, n);
    if (f->nmax == 1) emit_unary(p, (enum op)f->op, from, start);
    return NUMBER;
}

/* One more argument: a constant. */
static enum made constant(double *out, struct parser *p, const char *name)
{
    const int from = p->n;
    scan_next(p);
    const size_t start = p->at;
    if (parse_sum(p) == FAILED) return FAILED;
    if (!emit_is_constant(p, from))
        return parse_wrong(p, start, p->at - start, "'%s' begins and ends at constants, not at what moves", name);
    *out = p->code[from].value;
    p->n = from;
    p->stack--;
    return NUMBER;
}

/* "step(x, a)" and "ramp(x, a, b)": of x - a, or of (x - a)/(b - a). */
static enum made since(struct parser *p, const struct expr_function *f, size_t start)
{
    const int from = p->n;
    double a, b = 0;
    if (scan_next(p) == ')') return parse_arity(p, f, start, 0);
    if (parse_sum(p) == FAILED) return FAILED;
    if (!scan_accept(p, ',')) return scan_next(p) == ')' ? parse_arity(p, f, start, 1) : parse_expected(p, "','");
    if (constant(&a, p, f->name) == FAILED) return FAILED;
    if (f->nmax == 3) {
        if (!scan_accept(p, ',')) return scan_next(p) == ')' ? parse_arity(p, f, start, 2) : parse_expected(p, "','");
        if (constant(&b, p, f->name) == FAILED) return FAILED;
    }
    if (!scan_accept(p, ')'))
        return scan_next(p) == ',' ? parse_arity(p, f, start, f->nmax + 1) : parse_expected(p, "')'");
    if (f->nmax == 3 && !(b > a))
        return parse_wrong(p, start, p->at - start, "'%s' ends at %g, which is not behind %g", f->name, b, a);
    const int constant_at = p->n;
    if (emit_constant(p, a, start) == FAILED) return FAILED;
    emit_binary(p, OP_SUB, from, constant_at, start);
    if (f->nmax == 3) {
        const int length_at = p->n;
        if (emit_constant(p, b - a, start) == FAILED) return FAILED;
        emit_binary(p, OP_DIV, from, length_at, start);
    }
    emit_unary(p, (enum op)f->op, from, start);
    return NUMBER;
}

enum made parse_call(struct parser *p, size_t start, const char *name)
{
    if (parse_deeper(p) == FAILED) return FAILED;
    const struct expr_function *f = expr_functions;
    bool outer = p->condition;
    p->condition = false;
    enum made made;
    if (!strcmp(name, "if")) {
        made = if_then(p);
    } else {
        while (f->name && strcmp(f->name, name)) f++;
        made = !f->name             ? parse_unknown_function(p, start, name)
               : op_is_since(f->op) ? since(p, f, start)
                                    : arguments(p, f, start);
    }
    p->condition = outer;
    p->depth--;
    return made;
}
