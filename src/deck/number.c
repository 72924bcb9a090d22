/* number.c -- scalars as numbers, or as expressions with places in the deck. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "deck/stages.h"

/* ---- names ---- */

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct parameter *)a)->name, ((const struct parameter *)b)->name);
}

static struct parameter *parameter_find(const struct deck *deck, const char *name)
{
    struct parameter key = {.name = name};
    if (!deck->nparameter) return NULL;
    return bsearch(&key, deck->parameter, (size_t)deck->nparameter, sizeof key, by_name);
}

const struct node *deck_signal(const struct deck *deck, const char *name)
{
    const struct node *all = node_find(deck->root, "signals");
    return all && all->type == NODE_MAP ? node_find(all, name) : NULL;
}

int deck_parameter(double *out, const char *name, const struct deck *deck)
{
    const struct parameter *p = parameter_find(deck, name);
    if (!p || p->state != KNOWN) return 1;
    *out = p->value;
    return 0;
}

/* Asks the caller's names last; a near miss may come from parameters and loop variables. */
static int not_here(struct lookup *lookup, int *slot, double *value, const char *name, struct expr_error *error)
{
    int unknown = lookup->more ? lookup->more->find(lookup->more->self, slot, value, name, error) : 1;
    if (unknown == 0) return 0;
    if (unknown == 2) lookup->broken = true;
    const char *near = diag_nearest(name, lookup->deck->parameter_name, lookup->deck->nparameter);
    for (const struct scope *s = lookup->scope; s && !near; s = s->up)
        if (diag_nearest(name, &s->name, 1)) near = s->name;
    if (near && !error->hint[0]) snprintf(error->hint, sizeof error->hint, "did you mean '%.100s'?", near);
    return 1;
}

/* Signals are at the deck's top: no loop variable is theirs.  Short tables have a text, too (scene_read/signals.c). */
static bool stands_for(struct expr_stand_in *o, void *self, const char *name)
{
    const struct lookup *lookup = self;
    const struct node *n = lookup->own ? deck_signal(lookup->deck, name) : NULL;
    for (const struct scope *s = lookup->scope; s; s = s->up)
        if (!strcmp(s->name, name)) return false;
    if (!n || !n->text || n->reported || parameter_find(lookup->deck, name)) return false;
    *o = (struct expr_stand_in){n->text, lookup->own};
    return true;
}

int lookup_find(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    struct lookup *lookup = self;
    *slot = -1;
    for (const struct scope *s = lookup->scope; s; s = s->up)
        if (!strcmp(s->name, name)) return *value = s->value, 0;
    struct parameter *p = parameter_find(lookup->deck, name);
    const struct node *signal = p || !lookup->own ? NULL : deck_signal(lookup->deck, name);
    if (signal && signal->reported) return lookup->broken = true;
    if (!p) return not_here(lookup, slot, value, name, error);
    *value = p->value;
    p->used = true;
    if (p->state == WAITING || p->state == BUSY) lookup->pending = (int)(p - lookup->deck->parameter);
    if (p->state == BROKEN) lookup->broken = true;
    return p->state != KNOWN;
}

/* ---- places ---- */

static struct mark forward(struct mark at, const char *text, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        if (((unsigned char)text[i] & 0xc0) != 0x80) at.col++;
    return at;
}

/* The part of a scalar's text that starts at byte `offset` as a place in the source.  Where the text stands there as it
 * is, the place is exact; after escapes, folds and $i it is the whole value. */
static struct span place(const struct deck *deck, const struct node *n, size_t offset, size_t length)
{
    const struct source *s = diags_source(deck->diags, n->file);
    struct mark from = n->mark;
    if (n->quoted) from.col++;
    size_t start = source_offset(s, from), stop = offset + length < n->len ? offset + length : n->len;
    bool same = start + stop <= s->len && !memcmp(s->text + start, n->text, stop) && !memchr(n->text, '\n', n->len);
    if (!same) return diag_span(n, AT_VALUE);
    struct span at = {n->file, forward(from, n->text, offset), forward(from, n->text, offset + length)};
    return at;
}

static bool is_exact(const struct deck *deck, const struct node *n)
{
    struct span at = place(deck, n, 0, n->len), whole = diag_span(n, AT_VALUE);
    return n->quoted ? at.from.col == whole.from.col + 1 : at.to.col == whole.to.col && at.to.line == whole.to.line;
}

/* ---- what is wrong ---- */

static enum status reported(const struct node *n)
{
    ((struct node *)n)->reported = true; /* nodes are the deck's: never const themselves */
    return E_DECK;
}

/* Was a plain number meant, rather than an expression? */
static bool numeral(const char *text)
{
    text += *text == '-' || *text == '+';
    return ((*text >= '0' && *text <= '9') || *text == '.') && !strpbrk(text, "*/^()") && !strstr(text, " + ") &&
           !strstr(text, " - ");
}

static bool endless(const char *text)
{
    static const char *const words[] = {".nan", "nan", ".inf", "inf", "infinity"};
    text += *text == '-' || *text == '+';
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcasecmp(text, words[i])) return true;
    return false;
}

/* The hint for a numeral that is not one. */
static const char *numeral_hint(const char *text, const struct expr_error *error)
{
    const char *at = text + (error->offset < strlen(text) ? error->offset : strlen(text));
    if (strchr(text, ':')) return "write a time in seconds";
    if (*at == '_') return "digits are not grouped";
    if (*at == ',') return "the decimal point is '.'";
    if ((*at >= 'a' && *at <= 'z') || (*at >= 'A' && *at <= 'Z'))
        return "numbers have no unit words; decks are in SI units";
    return error->hint;
}

static enum status report_numeral(const struct node *n, const struct expr_error *error, struct deck *deck)
{
    const char *hint = numeral_hint(n->text, error);
    diag_error(deck->diags, n, AT_VALUE, error->limit ? "E-limit-expression" : "E-number", "'%s' is not a number: %s",
               diag_clip(deck->diags, n->text), error->text);
    if (*hint) diag_hint(deck->diags, "%s", hint);
    return reported(n);
}

static bool doubled_star(const char *text, size_t at)
{
    return at > 0 && at < strlen(text) && text[at] == '*' && text[at - 1] == '*';
}

/* state: more than parameters may be read here. */
static enum status report_error(const struct node *n, const struct expr_error *error, bool state, struct deck *deck)
{
    struct diags *d = deck->diags;
    const char *code = error->limit ? "E-limit-expression" : "E-expression";
    if (endless(n->text)) {
        diag_error(d, n, AT_VALUE, "E-number", "'%s' is not a number: it is not finite", diag_clip(d, n->text));
        return reported(n);
    }
    if (numeral(n->text)) return report_numeral(n, error, deck);
    if (text_is_name(n->text) && !expr_is_word(n->text) && !state) {
        diag_error(d, n, AT_VALUE, "E-number", "expected a number, found '%s'", diag_clip(d, n->text));
        diag_hint(d, "%s", error->hint[0] ? error->hint : "no parameter has this name");
        return reported(n);
    }
    /* Through a node at the place, so that copies of a repeat are reported once. */
    struct node at = *n;
    struct span span = place(deck, n, error->offset, error->length);
    at.mark = span.from;
    at.end = span.to;
    diag_error(d, &at, AT_VALUE, code, "%s", error->text);
    const char *hint = doubled_star(n->text, error->offset) ? "a power is written x^2" : error->hint;
    if (*hint) diag_hint(d, "%s", hint);
    if (!is_exact(deck, n)) diag_hint(d, "in \"%s\"", diag_clip(d, n->text));
    return reported(n);
}

static enum status report_type(const struct node *n, const char *expected, struct deck *deck)
{
    const char *found = n->type == NODE_SCALAR && n->quoted ? "an empty text" : node_type_name(n);
    diag_error(deck->diags, n, node_is_null(n) ? AT_KEY : AT_VALUE, "E-type", "expected %s, found %s", expected, found);
    return reported(n);
}

/* ---- evaluating ---- */

/* A plain number, the whole text. */
static bool plain(double *out, const struct node *n)
{
    const char *wrong, *text = n->text;
    bool minus = *text == '-';
    text += minus || *text == '+';
    size_t used = expr_number(out, text, &wrong);
    if (!used || wrong || text + used != n->text + n->len) return false;
    if (minus) *out = -*out;
    return true;
}

enum evaluated evaluate(double *out, const struct node *n, struct lookup *lookup)
{
    struct deck *deck = lookup->deck;
    struct expr *e;
    struct expr_error error;
    lookup->pending = -1;
    lookup->broken = false;
    *out = 0;
    if (n->reported) return REPORTED;
    if (n->type != NODE_SCALAR || node_is_null(n) || n->len == 0)
        return (void)report_type(n, "a number", deck), REPORTED;
    if (plain(out, n)) return EVALUATED;
    struct arena_mark mark = arena_mark(deck->scratch);
    int bad = expr_parse(&e, n->text, n->len, &(struct expr_names){.find = lookup_find, .self = lookup}, deck->scratch,
                         &error);
    if (!bad) *out = expr_value(e, NULL);
    arena_rewind(deck->scratch, mark);
    if (!bad) return EVALUATED;
    if (lookup->pending >= 0) return PENDING;
    if (lookup->broken) return (void)reported(n), REPORTED;
    return (void)report_error(n, &error, false, deck), REPORTED;
}

enum status deck_number(double *out, const struct node *n, struct deck *deck)
{
    struct lookup lookup = {.deck = deck, .scope = n->scope};
    *out = n->value;
    if (n->has_value) return OK;
    if (evaluate(out, n, &lookup) != EVALUATED) return E_DECK;
    if (*out != 0 && fabs(*out) < DBL_MIN)
        diag_warn(deck->diags, n, AT_VALUE, "W-denormal", "%g has lost digits: it is below 2.2e-308", *out);
    ((struct node *)n)->has_value = true;
    ((struct node *)n)->value = *out;
    return OK;
}

static enum status compile(struct expr **out, const struct node *n, const struct expr_names *names, bool truth,
                           struct deck *deck)
{
    struct lookup inner = {.deck = deck, .more = names, .pending = -1};
    struct expr_names own = {lookup_find, &inner, stands_for};
    struct lookup lookup = {.deck = deck, .scope = n->scope, .more = names, .pending = -1, .own = names ? &own : NULL};
    struct expr_error error;
    inner.own = lookup.own;
    *out = NULL;
    if (n->reported) return E_DECK;
    if (n->type != NODE_SCALAR || node_is_null(n) || n->len == 0)
        return report_type(n, truth ? "a condition" : "a number or an expression", deck);
    if ((truth ? expr_parse_truth : expr_parse)(
            out, n->text, n->len, &(struct expr_names){lookup_find, &lookup, stands_for}, deck->arena, &error)) {
        if (lookup.broken || inner.broken) return reported(n);
        return report_error(n, &error, names != NULL, deck);
    }
    ((struct node *)n)->formula = true;
    return OK;
}

enum status deck_expr(struct expr **out, const struct node *n, const struct expr_names *names, struct deck *deck)
{
    return compile(out, n, names, false, deck);
}

enum status deck_truth(struct expr **out, const struct node *n, const struct expr_names *names, struct deck *deck)
{
    return compile(out, n, names, true, deck);
}
