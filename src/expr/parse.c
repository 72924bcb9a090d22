/* parse.c -- the text of an expression becomes code; see expr.h for the grammar.
 *
 * Recursive descent, one function a rule.  Each rule leaves its code at the end of the growing
 * program and returns what it made: a number, a truth, or a failure that is already told.  A rule whose
 * operands are single constants computes at once, with the machine that will run the rest. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "expr/code.h"
#include "expr/expr.h"

enum made { FAILED, NUMBER, TRUTH };

struct parser {
    const char *text; /* a copy with a 0 after it */
    size_t at;        /* next byte */
    int depth;
    int stack;      /* operands that wait at this place of the program */
    bool condition; /* inside the condition of an if, where relations are allowed */
    const struct expr_names *names;
    struct arena *arena;
    struct expr_error *error;
    struct instruction *code;
    int n, room;
};

static enum made sum(struct parser *p);
static enum made truth(struct parser *p);

__attribute__((format(printf, 4, 5))) static enum made wrong(struct parser *p, size_t offset, size_t length,
                                                             const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(p->error->text, sizeof p->error->text, format, args);
    va_end(args);
    p->error->offset = offset;
    p->error->length = length ? length : 1;
    return FAILED;
}

static void hint(struct parser *p, const char *text)
{
    snprintf(p->error->hint, sizeof p->error->hint, "%s", text);
}

/* ---- the program ---- */

static void emit(struct parser *p, struct instruction x)
{
    if (p->n == p->room) {
        struct instruction *more = TAKE(p->arena, struct instruction, p->room = p->room ? 2 * p->room : 64);
        if (p->n) memcpy(more, p->code, (size_t)p->n * sizeof *more);
        p->code = more;
    }
    p->code[p->n++] = x;
}

static enum made push(struct parser *p, struct instruction x)
{
    if (++p->stack > EXPR_STACK - 1) {
        p->error->limit = true;
        return wrong(p, p->at, 1, "the expression needs more than %d operands at a time", EXPR_STACK - 1);
    }
    emit(p, x);
    return NUMBER;
}

static enum made push_constant(struct parser *p, double value, size_t offset)
{
    return push(p, (struct instruction){OP_CONST, (int)offset, value});
}

/* Is the code from here on one constant? */
static bool constant(const struct parser *p, int from)
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

/* The last operation has constants as operands: it becomes their result, told by offset if not finite. */
static void fold(struct parser *p, int operands, size_t offset)
{
    int from = p->n - 1 - operands;
    double value = run(p->code + from, operands + 1);
    p->n = from;
    emit(p, (struct instruction){OP_CONST, (int)offset, value});
}

static void unary(struct parser *p, enum op op, int from, size_t offset)
{
    bool folds = constant(p, from);
    emit(p, (struct instruction){.op = op});
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

/* The operands' code is [left, right) and [right, n). */
static void binary(struct parser *p, enum op op, int left, int right, size_t offset)
{
    p->stack--;
    bool single = p->n == right + 1;
    if (right == left + 1 && p->code[left].op == OP_CONST && constant(p, right)) {
        emit(p, (struct instruction){.op = op});
        fold(p, 2, offset);
    } else if (!single || (!merge(p, op) && !whole_power(p, op))) {
        emit(p, (struct instruction){.op = op});
    }
}

/* ---- the text ---- */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static char next(struct parser *p)
{
    while (p->text[p->at] == ' ' || p->text[p->at] == '\t' || p->text[p->at] == '\n' || p->text[p->at] == '\r') p->at++;
    return p->text[p->at];
}

static bool accept(struct parser *p, char c)
{
    if (next(p) != c) return false;
    p->at++;
    return true;
}

/* Bytes of the name at text: letters, digits, '_', and dots between. */
static size_t name_length(const char *text)
{
    size_t n = 0;
    if (!is_letter(text[0])) return 0;
    while (is_letter(text[n]) || is_digit(text[n]) || (text[n] == '.' && is_letter(text[n + 1]))) n++;
    return n;
}

static bool accept_word(struct parser *p, const char *word)
{
    next(p);
    size_t n = name_length(p->text + p->at);
    if (n != strlen(word) || strncmp(p->text + p->at, word, n)) return false;
    p->at += n;
    return true;
}

/* What stands at p->at, for "found ...". */
static const char *found(struct parser *p, size_t *length)
{
    const char *here = p->text + p->at;
    size_t n = name_length(here);
    if (!n) n = is_digit(*here) ? strspn(here, "0123456789.") : 1;
    while (((unsigned char)here[n] & 0xc0) == 0x80) n++; /* the whole of a UTF-8 character */
    *length = n;
    if (!*here) return "the end";
    return arena_print(p->arena, "'%.*s'", (int)(n < 40 ? n : 40), here);
}

/* The relation at p->at: its bytes, 0 if there is none. */
static size_t relation_at(struct parser *p, enum op *op)
{
    static const struct {
        char text[3];
        enum op op;
    } relations[] = {{"<=", OP_LE}, {">=", OP_GE}, {"==", OP_EQ}, {"!=", OP_NE}, {"<", OP_LT}, {">", OP_GT}};
    next(p);
    for (size_t i = 0; i < sizeof relations / sizeof *relations; i++) {
        size_t n = strlen(relations[i].text);
        *op = relations[i].op;
        if (!strncmp(p->text + p->at, relations[i].text, n)) return n;
    }
    return 0;
}

/* What is usually meant by something that cannot stand at p->at. */
static enum made expected(struct parser *p, const char *what)
{
    enum op op;
    size_t length, n = relation_at(p, &op);
    const char *here = found(p, &length);
    char c = p->text[p->at];
    if (n && !p->condition) return wrong(p, p->at, n, "a comparison belongs into the condition of if(c, a, b)");
    wrong(p, p->at, length, "expected %s, found %s", what, here);
    if (c == '?' || c == ':') hint(p, "write if(c, a, b)");
    if (c == ',') hint(p, "a decimal point is '.'");
    if (c == '*') hint(p, "a power is written '^'");
    return FAILED;
}

/* ---- the rules ---- */

static enum made deeper(struct parser *p)
{
    if (++p->depth <= EXPR_DEPTH) return NUMBER;
    p->error->limit = true;
    return wrong(p, p->at, 1, "the expression is nested more than %d deep", EXPR_DEPTH);
}

static enum made a_number(struct parser *p, enum made made, size_t offset)
{
    if (made != TRUTH) return made;
    return wrong(p, offset, p->at - offset, "a comparison is not a number");
}

static enum made number(struct parser *p)
{
    double value;
    const char *complaint;
    size_t start = p->at, n = expr_number(&value, p->text + start, &complaint);
    if (complaint) return wrong(p, start, n, "%s", complaint);
    p->at += n;
    char after = p->text[p->at];
    if (!is_letter(after) && after != '.') return push_constant(p, value, start);
    size_t length;
    const char *word = found(p, &length);
    wrong(p, p->at, length, "a number cannot be followed by %s", word);
    hint(p, "write the product with '*'; numbers have no unit words, decks are in SI units");
    return FAILED;
}

static enum made parenthesis(struct parser *p)
{
    size_t start = p->at++;
    if (deeper(p) == FAILED) return FAILED;
    enum made made = p->condition ? truth(p) : sum(p);
    if (made == FAILED) return FAILED;
    if (!accept(p, ')')) {
        expected(p, "')'");
        if (!p->text[p->at])
            snprintf(p->error->hint, sizeof p->error->hint, "'(' at character %zu is not closed", start + 1);
        return FAILED;
    }
    p->depth--;
    return made;
}

static enum made unknown_function(struct parser *p, size_t start, const char *name)
{
    const char *names[64];
    int n = 0;
    for (const struct expr_function *f = expr_functions; f->name && n < 60; f++) names[n++] = f->name;
    names[n++] = "if";
    const char *near = text_nearest(name, names, n);
    wrong(p, start, strlen(name), "unknown function '%.60s'", name);
    if (near) snprintf(p->error->hint, sizeof p->error->hint, "did you mean '%s'?", near);
    return FAILED;
}

/* "if(" truth "," value "," value ")": the branch not taken is not run; with a constant condition it is not kept. */
static enum made if_then(struct parser *p)
{
    size_t start = p->at;
    int from = p->n;
    bool outer = p->condition;
    p->condition = true;
    enum made made = truth(p);
    p->condition = outer;
    if (made == FAILED) return FAILED;
    if (made != TRUTH) return wrong(p, start, p->at - start, "expected a condition such as 't < 1'");
    if (!accept(p, ',')) return expected(p, "','");
    bool known = constant(p, from), yes = known && p->code[from].value != 0;
    p->stack--;
    int unless = p->n;
    emit(p, (struct instruction){.op = OP_UNLESS});
    if (sum(p) == FAILED) return FAILED;
    if (!accept(p, ',')) return expected(p, "','");
    p->stack--;
    int skip = p->n;
    emit(p, (struct instruction){.op = OP_SKIP});
    if (sum(p) == FAILED) return FAILED;
    if (!accept(p, ')')) return expected(p, "')'");
    p->code[unless].index = skip - unless;
    p->code[skip].index = p->n - skip - 1;
    if (!known) return NUMBER;
    int keep = yes ? unless + 1 : skip + 1, n = yes ? skip - unless - 1 : p->n - skip - 1;
    memmove(p->code + from, p->code + keep, (size_t)n * sizeof *p->code);
    p->n = from + n;
    return NUMBER;
}

static enum made arity(struct parser *p, const struct expr_function *f, size_t start, int n)
{
    return wrong(p, start, strlen(f->name), "'%s' takes %d%s argument%s, found %d", f->name, f->nmin,
                 f->nmax > f->nmin ? " or more" : "", f->nmin == 1 ? "" : "s", n);
}

static enum made arguments(struct parser *p, const struct expr_function *f, size_t start)
{
    int from = p->n, n = 1;
    if (next(p) == ')') return arity(p, f, start, 0);
    if (sum(p) == FAILED) return FAILED;
    for (; accept(p, ','); n++) {
        int right = p->n;
        if (n >= f->nmax) {
            while (p->text[p->at] && sum(p) != FAILED && accept(p, ',')) n++;
            return arity(p, f, start, n + 1);
        }
        if (sum(p) == FAILED) return FAILED;
        binary(p, (enum op)f->op, from, right, start);
    }
    if (!accept(p, ')')) return expected(p, n < f->nmax ? "',' or ')'" : "')'");
    if (n < f->nmin) return arity(p, f, start, n);
    if (f->nmax == 1) unary(p, (enum op)f->op, from, start);
    return NUMBER;
}

static enum made call(struct parser *p, size_t start, const char *name)
{
    if (deeper(p) == FAILED) return FAILED;
    const struct expr_function *f = expr_functions;
    bool outer = p->condition;
    p->condition = false;
    enum made made;
    if (!strcmp(name, "if")) {
        made = if_then(p);
    } else {
        while (f->name && strcmp(f->name, name)) f++;
        made = f->name ? arguments(p, f, start) : unknown_function(p, start, name);
    }
    p->condition = outer;
    p->depth--;
    return made;
}

static enum made variable(struct parser *p, size_t start, const char *name)
{
    int slot = -1;
    double value = 0;
    if (!strcmp(name, "pi")) return push_constant(p, 3.14159265358979323846, start);
    if (expr_is_word(name)) return wrong(p, start, strlen(name), "'%s' cannot stand here by itself", name);
    p->error->text[0] = 0;
    if (!p->names || p->names->find(p->names->self, &slot, &value, name, p->error)) {
        if (!p->error->text[0]) return wrong(p, start, strlen(name), "unknown name '%.100s'", name);
        p->error->offset = start;
        p->error->length = strlen(name);
        return FAILED;
    }
    if (slot < 0) return push_constant(p, value, start);
    return push(p, (struct instruction){OP_SLOT, slot, 0});
}

static enum made name_or_call(struct parser *p)
{
    size_t start = p->at, n = name_length(p->text + start);
    char *name = arena_copy(p->arena, p->text + start, n);
    p->at += n;
    if (accept(p, '(')) return call(p, start, name);
    p->at = start + n;
    return variable(p, start, name);
}

static enum made atom(struct parser *p)
{
    char c = next(p);
    if (c == '(') return parenthesis(p);
    if (is_digit(c) || (c == '.' && is_digit(p->text[p->at + 1]))) return number(p);
    if (is_letter(c)) return name_or_call(p);
    return expected(p, "a number or a name");
}

static enum made sign(struct parser *p);

static enum made power(struct parser *p)
{
    size_t start = (next(p), p->at), offset;
    int left = p->n;
    enum made made = atom(p);
    if (made == FAILED || next(p) != '^') return made;
    if (a_number(p, made, start) == FAILED || deeper(p) == FAILED) return FAILED;
    offset = p->at++;
    int right = p->n;
    start = p->at;
    if (a_number(p, sign(p), start) == FAILED) return FAILED;
    binary(p, OP_POW, left, right, offset);
    p->depth--;
    return NUMBER;
}

static enum made sign(struct parser *p)
{
    char c = next(p);
    if (c != '-' && c != '+') return power(p);
    if (deeper(p) == FAILED) return FAILED;
    size_t start = p->at++;
    int from = p->n;
    enum made made = a_number(p, sign(p), start + 1);
    if (made == NUMBER && c == '-') unary(p, OP_NEG, from, start);
    p->depth--;
    return made;
}

/* One level of operators from left to right: chars[i] means ops[i]. */
static enum made level(struct parser *p, enum made (*operand)(struct parser *), const char *chars, const enum op *ops)
{
    size_t start = (next(p), p->at);
    int left = p->n;
    enum made made = operand(p);
    for (const char *c; made != FAILED && next(p) && (c = strchr(chars, p->text[p->at]));) {
        if (a_number(p, made, start) == FAILED) return FAILED;
        size_t offset = p->at++;
        int right = p->n;
        start = p->at;
        made = a_number(p, operand(p), start);
        if (made == NUMBER) binary(p, ops[c - chars], left, right, offset);
    }
    return made;
}

static enum made product(struct parser *p)
{
    static const enum op ops[] = {OP_MUL, OP_DIV};
    return level(p, sign, "*/", ops);
}

static enum made sum(struct parser *p)
{
    static const enum op ops[] = {OP_ADD, OP_SUB};
    return level(p, product, "+-", ops);
}

static enum made relation(struct parser *p)
{
    size_t offset, n;
    next(p);
    int left = p->n;
    enum op op, second;
    enum made made = sum(p);
    if (made != NUMBER || !(n = relation_at(p, &op))) return made;
    offset = p->at;
    p->at += n;
    int right = p->n;
    size_t start = p->at;
    if (a_number(p, sum(p), start) == FAILED) return FAILED;
    binary(p, op, left, right, offset);
    if ((n = relation_at(p, &second))) return wrong(p, p->at, n, "two comparisons are joined by 'and' or 'or'");
    return TRUTH;
}

static enum made not_relation(struct parser *p)
{
    size_t start = (next(p), p->at);
    int from = p->n;
    if (!accept_word(p, "not")) return relation(p);
    if (deeper(p) == FAILED) return FAILED;
    enum made made = not_relation(p);
    p->depth--;
    if (made == NUMBER) return wrong(p, start, 3, "'not' is for conditions");
    if (made == TRUTH) unary(p, OP_NOT, from, start);
    return made;
}

static enum made joined(struct parser *p, enum made (*operand)(struct parser *), const char *word, enum op op)
{
    int left = p->n;
    enum made made = operand(p);
    while (made != FAILED) {
        size_t start = (next(p), p->at);
        if (!accept_word(p, word)) break;
        int right = p->n;
        enum made other = made == TRUTH ? operand(p) : NUMBER;
        if (other == NUMBER) return wrong(p, start, strlen(word), "'%s' is for conditions", word);
        if (other == TRUTH) binary(p, op, left, right, start);
        made = other;
    }
    return made;
}

static enum made both(struct parser *p)
{
    return joined(p, not_relation, "and", OP_AND);
}

static enum made truth(struct parser *p)
{
    return joined(p, both, "or", OP_OR);
}

/* ---- the whole ---- */

static enum made the_end(struct parser *p)
{
    return next(p) ? expected(p, "an operator") : NUMBER;
}

/* A constant that is not finite: 1/0, log(0). */
static enum made all_finite(struct parser *p)
{
    for (int i = 0; i < p->n; i++) {
        const struct instruction *x = &p->code[i];
        bool has_value = x->op == OP_CONST || (x->op >= OP_ADD_CONST && x->op <= OP_DIV_CONST);
        if (!has_value || isfinite(x->value)) continue;
        size_t start = (size_t)x->index, n = name_length(p->text + start);
        if (p->text[start] == '/') return wrong(p, start, 1, "division by zero");
        return wrong(p, start, n, "'%.*s' gives no finite number here", (int)(n ? n : 1), p->text + start);
    }
    return NUMBER;
}

static enum made only_truth(struct parser *p)
{
    enum made made = truth(p);
    if (made != NUMBER || next(p)) return made;
    return wrong(p, 0, p->at, "expected a condition such as 't < 1'");
}

static int parse(struct expr **out, const char *text, size_t len, const struct expr_names *names, bool condition,
                 struct arena *arena, struct expr_error *error)
{
    *out = NULL;
    *error = (struct expr_error){.length = 1};
    struct parser p = {.names = names, .condition = condition, .arena = arena, .error = error};
    if (len > EXPR_LENGTH) {
        error->limit = true;
        wrong(&p, EXPR_LENGTH, 1, "the expression is longer than %d characters", EXPR_LENGTH);
        return 1;
    }
    p.text = arena_copy(arena, text, len);
    if (strlen(p.text) != len) return wrong(&p, strlen(p.text), 1, "a zero byte in the expression"), 1;
    if ((condition ? only_truth(&p) : sum(&p)) == FAILED || the_end(&p) == FAILED || all_finite(&p) == FAILED) return 1;
    emit(&p, (struct instruction){.op = OP_END});
    *out = TAKE(arena, struct expr, 1);
    **out = (struct expr){p.n, p.code};
    return 0;
}

int expr_parse(struct expr **out, const char *text, size_t len, const struct expr_names *names, struct arena *arena,
               struct expr_error *error)
{
    return parse(out, text, len, names, false, arena, error);
}

int expr_parse_truth(struct expr **out, const char *text, size_t len, const struct expr_names *names,
                     struct arena *arena, struct expr_error *error)
{
    return parse(out, text, len, names, true, arena, error);
}
