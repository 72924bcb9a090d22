/* parse.c -- the text of an expression becomes code; see expr.h for the grammar.
 *
 * Recursive descent, one function a rule.  Each rule leaves its code at the end of the growing
 * program and returns what it made: a number, a truth, or a failure that is already reported. */
#include <math.h>
#include <string.h>

#include "expr/parse_parts.h"

enum made parse_deeper(struct parser *p)
{
    if (++p->depth <= EXPR_DEPTH) return NUMBER;
    p->error->limit = true;
    return parse_wrong(p, p->at, 1, "the expression is nested more than %d deep", EXPR_DEPTH);
}

static enum made a_number(struct parser *p, enum made made, size_t offset)
{
    if (made != TRUTH) return made;
    return parse_wrong(p, offset, p->at - offset, "a comparison is not a number");
}

static enum made number(struct parser *p)
{
    double value;
    const char *complaint;
    size_t start = p->at, n = expr_number(&value, p->text + start, &complaint);
    if (complaint) return parse_wrong(p, start, n, "%s", complaint);
    p->at += n;
    char after = p->text[p->at];
    if (!scan_is_letter(after) && after != '.') return emit_constant(p, value, start);
    size_t length;
    const char *word = scan_found(p, &length);
    parse_wrong(p, p->at, length, "a number cannot be followed by %s", word);
    parse_hint(p, "write the product with '*'; numbers have no unit words, decks are in SI units");
    return FAILED;
}

static enum made parenthesis(struct parser *p)
{
    size_t start = p->at++;
    if (parse_deeper(p) == FAILED) return FAILED;
    enum made made = p->condition ? parse_truth(p) : parse_sum(p);
    if (made == FAILED) return FAILED;
    if (!scan_accept(p, ')')) {
        parse_expected(p, "')'");
        if (!p->text[p->at]) parse_hint(p, "'(' at character %zu is not closed", start + 1);
        return FAILED;
    }
    p->depth--;
    return made;
}

static enum made the_end(struct parser *p)
{
    return scan_next(p) ? parse_expected(p, "an operator") : NUMBER;
}

/* The text that stands for a name, here; what it has wrong is told of the name. */
static enum made in_its_place(struct parser *p, size_t start, const char *name, const struct expr_stand_in *o)
{
    const struct parser outer = *p;
    if (parse_deeper(p) == FAILED) return FAILED;
    p->text = o->text;
    p->at = 0;
    p->condition = false;
    p->names = o->names;
    enum made made = parse_sum(p);
    if (made != FAILED) made = the_end(p);
    p->text = outer.text;
    p->at = outer.at;
    p->condition = outer.condition;
    p->names = outer.names;
    p->depth--;
    if (made != FAILED) return made;
    p->error->offset = start;
    p->error->length = strlen(name);
    return FAILED;
}

static enum made variable(struct parser *p, size_t start, const char *name)
{
    int slot = -1;
    double value = 0;
    struct expr_stand_in text;
    if (!strcmp(name, "pi")) return emit_constant(p, 3.14159265358979323846, start);
    if (expr_is_word(name)) return parse_wrong(p, start, strlen(name), "'%s' cannot stand here by itself", name);
    if (p->names && p->names->stand_in && p->names->stand_in(&text, p->names->self, name))
        return in_its_place(p, start, name, &text);
    p->error->text[0] = 0;
    if (!p->names || p->names->find(p->names->self, &slot, &value, name, p->error)) {
        if (!p->error->text[0]) return parse_wrong(p, start, strlen(name), "unknown name '%.100s'", name);
        p->error->offset = start;
        p->error->length = strlen(name);
        return FAILED;
    }
    if (slot < 0) return emit_constant(p, value, start);
    return emit_operand(p, (struct instruction){OP_SLOT, slot, 0});
}

static enum made name_or_call(struct parser *p)
{
    size_t start = p->at, n = scan_name(p->text + start);
    char *name = arena_copy(p->arena, p->text + start, n);
    p->at += n;
    if (scan_accept(p, '(')) return parse_call(p, start, name);
    p->at = start + n;
    return variable(p, start, name);
}

static enum made atom(struct parser *p)
{
    char c = scan_next(p);
    if (c == '(') return parenthesis(p);
    if (scan_is_digit(c) || (c == '.' && scan_is_digit(p->text[p->at + 1]))) return number(p);
    if (scan_is_letter(c)) return name_or_call(p);
    return parse_expected(p, "a number or a name");
}

static enum made sign(struct parser *p);

static enum made power(struct parser *p)
{
    size_t start = (scan_next(p), p->at), offset;
    int left = p->n;
    enum made made = atom(p);
    if (made == FAILED || scan_next(p) != '^') return made;
    if (a_number(p, made, start) == FAILED || parse_deeper(p) == FAILED) return FAILED;
    offset = p->at++;
    int right = p->n;
    start = (scan_next(p), p->at);
    if (a_number(p, sign(p), start) == FAILED) return FAILED;
    emit_binary(p, OP_POW, left, right, offset);
    p->depth--;
    return NUMBER;
}

static enum made sign(struct parser *p)
{
    char c = scan_next(p);
    if (c != '-' && c != '+') return power(p);
    if (parse_deeper(p) == FAILED) return FAILED;
    size_t start = p->at++, operand = (scan_next(p), p->at);
    int from = p->n;
    enum made made = a_number(p, sign(p), operand);
    if (made == NUMBER && c == '-') emit_unary(p, OP_NEG, from, start);
    p->depth--;
    return made;
}

/* One level of operators from left to right: chars[i] means ops[i]. */
static enum made level(struct parser *p, enum made (*operand)(struct parser *), const char *chars, const enum op *ops)
{
    size_t start = (scan_next(p), p->at);
    int left = p->n;
    enum made made = operand(p);
    for (const char *c; made != FAILED && scan_next(p) && (c = strchr(chars, p->text[p->at]));) {
        if (a_number(p, made, start) == FAILED) return FAILED;
        size_t offset = p->at++;
        int right = p->n;
        start = (scan_next(p), p->at);
        made = a_number(p, operand(p), start);
        if (made == NUMBER) emit_binary(p, ops[c - chars], left, right, offset);
    }
    return made;
}

static enum made product(struct parser *p)
{
    static const enum op ops[] = {OP_MUL, OP_DIV};
    return level(p, sign, "*/", ops);
}

enum made parse_sum(struct parser *p)
{
    static const enum op ops[] = {OP_ADD, OP_SUB};
    return level(p, product, "+-", ops);
}

static enum made relation(struct parser *p)
{
    size_t offset, n;
    scan_next(p);
    int left = p->n;
    enum op op, second;
    enum made made = parse_sum(p);
    if (made != NUMBER || !(n = scan_relation(p, &op))) return made;
    offset = p->at;
    p->at += n;
    int right = p->n;
    size_t start = p->at;
    if (a_number(p, parse_sum(p), start) == FAILED) return FAILED;
    emit_binary(p, op, left, right, offset);
    if ((n = scan_relation(p, &second))) return parse_wrong(p, p->at, n, "two comparisons are joined by 'and' or 'or'");
    return TRUTH;
}

static enum made not_relation(struct parser *p)
{
    size_t start = (scan_next(p), p->at);
    int from = p->n;
    if (!scan_word(p, "not")) return relation(p);
    if (parse_deeper(p) == FAILED) return FAILED;
    enum made made = not_relation(p);
    p->depth--;
    if (made == NUMBER) return parse_wrong(p, start, 3, "'not' is for conditions");
    if (made == TRUTH) emit_unary(p, OP_NOT, from, start);
    return made;
}

static enum made joined(struct parser *p, enum made (*operand)(struct parser *), const char *word, enum op op)
{
    int left = p->n;
    enum made made = operand(p);
    while (made != FAILED) {
        size_t start = (scan_next(p), p->at);
        if (!scan_word(p, word)) break;
        int right = p->n;
        enum made other = made == TRUTH ? operand(p) : NUMBER;
        if (other == NUMBER) return parse_wrong(p, start, strlen(word), "'%s' is for conditions", word);
        if (other == TRUTH) emit_binary(p, op, left, right, start);
        made = other;
    }
    return made;
}

static enum made both(struct parser *p)
{
    return joined(p, not_relation, "and", OP_AND);
}

enum made parse_truth(struct parser *p)
{
    return joined(p, both, "or", OP_OR);
}

/* ---- the whole ---- */

/* A constant that is not finite: 1/0, log(0). */
static enum made all_finite(struct parser *p)
{
    for (int i = 0; i < p->n; i++) {
        const struct instruction *x = &p->code[i];
        bool has_value = x->op == OP_CONST || (x->op >= OP_ADD_CONST && x->op <= OP_DIV_CONST);
        if (!has_value || isfinite(x->value)) continue;
        size_t start = (size_t)x->index, n = scan_name(p->text + start);
        if (p->text[start] == '/') return parse_wrong(p, start, 1, "division by zero");
        return parse_wrong(p, start, n, "'%.*s' gives no finite number here", (int)(n ? n : 1), p->text + start);
    }
    return NUMBER;
}

static enum made only_truth(struct parser *p)
{
    enum made made = parse_truth(p);
    if (made != NUMBER || scan_next(p)) return made;
    return parse_wrong(p, 0, p->at, "expected a condition such as 't < 1'");
}

static int parse(struct expr **out, const char *text, size_t len, const struct expr_names *names, bool condition,
                 struct arena *arena, struct expr_error *error)
{
    *out = NULL;
    *error = (struct expr_error){.length = 1};
    struct parser p = {.names = names, .condition = condition, .arena = arena, .error = error};
    if (len > EXPR_LENGTH) {
        error->limit = true;
        parse_wrong(&p, EXPR_LENGTH, 1, "the expression is longer than %d characters", EXPR_LENGTH);
        return 1;
    }
    p.text = arena_copy(arena, text, len);
    if (strlen(p.text) != len) return parse_wrong(&p, strlen(p.text), 1, "a zero byte in the expression"), 1;
    if ((condition ? only_truth(&p) : parse_sum(&p)) == FAILED || the_end(&p) == FAILED || all_finite(&p) == FAILED)
        return 1;
    emit_code(&p, (struct instruction){.op = OP_END});
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
