/* parse_parts.h -- what the files of the parser share.
 *
 *     parse.c  the rules of the grammar
 *     parse_call.c  calls of functions
 *     scan.c   words and signs of the text
 *     emit.c   the program: operations joined, constants folded
 *     wrong.c  what is wrong with a text, where, and what may have been meant
 */
#ifndef FMDSUB_EXPR_PARSE_PARTS_H
#define FMDSUB_EXPR_PARSE_PARTS_H

#include "expr/code.h"
#include "expr/expr.h"

/* What a rule has made; FAILED: reported. */
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
    int n, capacity;
};

/* --- the rules ---------------------------------------------------------------------------------- */

/* One level deeper, which p->depth-- leaves; FAILED: too deep. */
enum made parse_deeper(struct parser *p);
enum made parse_sum(struct parser *p);
enum made parse_truth(struct parser *p);
/* Of the function `name`, written at start, behind its "(". */
enum made parse_call(struct parser *p, size_t start, const char *name);

/* --- the text ----------------------------------------------------------------------------------- */

bool scan_is_letter(char c);
bool scan_is_digit(char c);
/* Passes blanks; the character then at p->at. */
char scan_next(struct parser *p);
/* Passes c, or the word, if it is next. */
bool scan_accept(struct parser *p, char c);
bool scan_word(struct parser *p, const char *word);
/* Bytes of the name at text: letters, digits, '_', and dots between. */
size_t scan_name(const char *text);
/* What stands at p->at, for "found ...". */
const char *scan_found(struct parser *p, size_t *length);
/* The relation at p->at: its bytes, 0 if there is none. */
size_t scan_relation(struct parser *p, enum op *op);

/* --- messages: all FAILED ----------------------------------------------------------------------- */

/* What is wrong with `length` bytes at offset. */
enum made parse_wrong(struct parser *p, size_t offset, size_t length, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* Adds to it what to try. */
void parse_hint(struct parser *p, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* What is usually meant by something that cannot stand at p->at. */
enum made parse_expected(struct parser *p, const char *what);
enum made parse_unknown_function(struct parser *p, size_t start, const char *name);
/* f with n arguments, written at start. */
enum made parse_arity(struct parser *p, const struct expr_function *f, size_t start, int n);

/* --- the program -------------------------------------------------------------------------------- */

void emit_code(struct parser *p, struct instruction x);
/* One more operand: FAILED where there are too many. */
enum made emit_operand(struct parser *p, struct instruction x);
enum made emit_constant(struct parser *p, double value, size_t offset);
/* Of an operand whose code begins at `from`; of two, with code [left, right) and [right, n).  What constants give is
 * reported by offset if it is not finite. */
void emit_unary(struct parser *p, enum op op, int from, size_t offset);
void emit_binary(struct parser *p, enum op op, int left, int right, size_t offset);
/* Is the code from here on one constant? */
bool emit_is_constant(const struct parser *p, int from);

#endif
