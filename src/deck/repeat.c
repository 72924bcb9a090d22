/* repeat.c -- members that are copied: link$i: {repeat: {i: [1, 10]}, at: [i - 0.5, 0], ...}.
 *
 * A copy is made for every value of the variables, the last one fastest.  $i and $(i - 1) become digits in the
 * keys and texts of the copy; numbers know the variable through their scope.  A repeat: inside a copy is expanded in
 * turn, so $ words that no variable answers yet are left standing; those that stay to the end are errors. */
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "deck/stages.h"

enum { RANGE = 1000000000 };

struct list {
    struct node **item;
    int n, capacity;
};

static void append(struct list *list, struct node *n, struct arena *arena)
{
    list->item = arena_more(arena, list->item, list->n, &list->capacity, sizeof *list->item);
    list->item[list->n++] = n;
}

/* ---- $i and $(i - 1) in texts ---- */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/* The word behind a $ at p: name or (expression), without brackets; returns the bytes to skip, 0: not a word. */
static size_t dollar_word(const char *p, const char **word, size_t *len)
{
    size_t n = 1;
    *word = p + 1;
    if (p[1] == '(') {
        int open = 0;
        do open += (p[n] == '(') - (p[n] == ')');
        while (open && p[++n]);
        *word = p + 2;
        *len = n - 2;
        return p[n] ? n + 1 : 0;
    }
    while (is_letter(p[n]) || (n > 1 && (p[n] == '_' || (p[n] >= '0' && p[n] <= '9')))) n++;
    *len = n - 1;
    return *len ? n : 0;
}

/* The value of a word: 0, or 1 with error. */
static int dollar_value(double *out, const char *word, size_t len, const struct scope *scope, struct deck *deck,
                        struct expr_error *error)
{
    struct lookup lookup = {.deck = deck, .scope = scope, .pending = -1};
    struct expr *e;
    struct arena_mark mark = arena_mark(deck->scratch);
    int bad =
        expr_parse(&e, word, len, &(struct expr_names){.find = lookup_find, .self = &lookup}, deck->scratch, error);
    if (!bad) *out = expr_value(e, NULL);
    arena_rewind(deck->scratch, mark);
    if (bad || (*out == floor(*out) && fabs(*out) <= RANGE)) return bad;
    snprintf(error->text, sizeof error->text, "%g is not a whole number", *out);
    return 1;
}

/* The text with its words replaced as far as they have values; itself if there are none. */
static const char *substitute(const char *text, const struct scope *scope, struct deck *deck)
{
    if (!strchr(text, '$')) return text;
    size_t capacity = strlen(text) + 1, n = 0;
    for (const char *p = text; *p; p++) capacity += *p == '$' ? 12 : 0;
    char *out = TAKE(deck->arena, char, capacity);
    for (const char *p = text; *p;) {
        const char *word;
        size_t len, skip = *p == '$' ? dollar_word(p, &word, &len) : 0;
        struct expr_error error;
        double value;
        if (skip && dollar_value(&value, word, len, scope, deck, &error) == 0) {
            n += (size_t)snprintf(out + n, capacity - n, "%.0f", value);
            p += skip;
        } else {
            out[n++] = *p++;
        }
    }
    return out;
}

static void substitute_all(struct node *n, struct deck *deck)
{
    if (n->key) n->key = substitute(n->key, n->scope, deck);
    if (n->type == NODE_SCALAR) {
        n->text = substitute(n->text, n->scope, deck);
        n->len = strlen(n->text);
    }
    for (int i = 0; i < n->count; i++) substitute_all(n->item[i], deck);
}

/* ---- copies ---- */

struct loop {
    struct deck *deck;
    const struct node *pattern, *repeat;
    long size; /* nodes of one copy */
    struct list *out;
    bool stop; /* a limit was reached, or an error reported */
};

static void drop_member(struct node *map, const char *key)
{
    int kept = 0;
    for (int i = 0; i < map->count; i++)
        if (strcmp(map->item[i]->key, key)) map->item[kept++] = map->item[i];
    map->count = kept;
}

static void copy_once(struct loop *l, const struct scope *scope)
{
    struct deck *deck = l->deck;
    const struct node *place = l->repeat;
    if (++deck->copies > MAX_COPIES) {
        diag_error(deck->diags, place, AT_KEY, "E-limit-repeat", "repeat: makes more than %d copies", MAX_COPIES);
        l->stop = true;
    } else if (deck->pool.nodes + l->size > MAX_REPEATED) {
        diag_error(deck->diags, place, AT_KEY, "E-limit-nodes", "the deck holds more than %d values", MAX_REPEATED);
        l->stop = true;
    }
    if (l->stop) return;
    struct node *copy = tree_copy(&deck->pool, l->pattern, scope);
    drop_member(copy, "repeat");
    substitute_all(copy, deck);
    append(l->out, copy, deck->arena);
}

/* One end of a range. */
static bool whole(double *out, const struct node *n, const struct scope *scope, struct deck *deck)
{
    struct node here = *n; /* the range of an inner variable may depend on the outer ones */
    struct lookup lookup = {.deck = deck, .scope = scope};
    here.scope = scope;
    if (evaluate(out, &here, &lookup) != EVALUATED) return false;
    if (*out == floor(*out) && fabs(*out) <= RANGE) return true;
    diag_error(deck->diags, &here, AT_VALUE, "E-integer", "expected a whole number, found %g", *out);
    return false;
}

static bool range(double *from, double *to, const struct node *n, const struct scope *scope, struct deck *deck)
{
    if (n->reported) return false;
    if (n->type != NODE_LIST || n->count != 2) {
        diag_error(deck->diags, n, AT_VALUE, "E-repeat", "expected the first and last value of '%s': [1, 10]",
                   diag_clip(deck->diags, n->key));
        return false;
    }
    if (!whole(from, n->item[0], scope, deck) || !whole(to, n->item[1], scope, deck)) return false;
    if (*to >= *from - 1) return true;
    diag_error(deck->diags, n, AT_VALUE, "E-repeat", "the range runs backwards: %.0f to %.0f", *from, *to);
    return false;
}

/* Over the variables v, v + 1, ... of the repeat. */
static void loop_over(struct loop *l, int v, const struct scope *scope)
{
    double from, to;
    if (v == l->repeat->count) {
        copy_once(l, scope);
        return;
    }
    const struct node *n = l->repeat->item[v];
    if (!range(&from, &to, n, scope, l->deck)) {
        l->stop = true;
        return;
    }
    for (double value = from; value <= to && !l->stop; value++) {
        struct scope *inner = TAKE(l->deck->arena, struct scope, 1);
        *inner = (struct scope){scope, n->key, value};
        loop_over(l, v + 1, inner);
    }
}

static bool usable(const struct node *pattern, const struct node *repeat, struct deck *deck)
{
    if (!repeat) {
        diag_error(deck->diags, pattern, AT_KEY, "E-repeat",
                   "'%s' has no repeat:", diag_clip(deck->diags, pattern->key));
        diag_hint(deck->diags, "add, for instance, repeat: {i: [1, 10]}");
        return false;
    }
    if (repeat->reported) return false;
    if (repeat->type != NODE_MAP || repeat->count == 0 || repeat->count > 4) {
        diag_error(deck->diags, repeat, AT_VALUE, "E-repeat",
                   "expected one to four variables with ranges: {i: [1, 10]}");
        return false;
    }
    for (int i = 0; i < repeat->count; i++)
        if (!variable_name(repeat->item[i]->key, repeat->item[i], "E-repeat", deck->diags)) return false;
    return true;
}

static void expand(struct node *n, struct deck *deck);

static bool has_dollar(const struct node *n)
{
    return n->key && strchr(n->key, '$') && n->type == NODE_MAP;
}

static void expand_member(struct list *out, struct node *m, struct deck *deck)
{
    const struct node *repeat = has_dollar(m) ? node_find(m, "repeat") : NULL;
    if (!has_dollar(m)) {
        append(out, m, deck->arena);
        return;
    }
    struct loop l = {.deck = deck, .pattern = m, .repeat = repeat, .size = tree_size(m), .out = out};
    if (usable(m, repeat, deck)) loop_over(&l, 0, m->scope);
}

/* A repeat: whose variable is nowhere in the key would make copies of one name. */
static void stray_repeat(const struct node *m, struct deck *deck)
{
    const struct node *r = node_find(m, "repeat");
    if (!r || r->type != NODE_MAP || r->count == 0 || r->item[0]->type != NODE_LIST) return;
    diag_error(deck->diags, r, AT_KEY, "E-repeat", "the key '%s' of a repeated member needs its variable: '%s$%s'",
               diag_clip(deck->diags, m->key), diag_clip(deck->diags, m->key), diag_clip(deck->diags, r->item[0]->key));
}

static void expand_map(struct node *map, struct deck *deck)
{
    struct list out = {0};
    bool any = false;
    for (int i = 0; i < map->count; i++) any |= has_dollar(map->item[i]);
    for (int i = 0; i < map->count && any; i++) expand_member(&out, map->item[i], deck);
    if (any) {
        map->item = out.item;
        map->count = out.n;
        tree_unique(map, deck->diags, deck->arena);
    }
}

static void expand(struct node *n, struct deck *deck)
{
    if (n->type == NODE_MAP) expand_map(n, deck);
    for (int i = 0; i < n->count; i++) {
        if (n->type == NODE_MAP) stray_repeat(n->item[i], deck);
        expand(n->item[i], deck);
    }
}

/* ---- what is left ---- */

/* Why the first $ of a text that should have none stays; "" if it is no word at all. */
static void report_left(const struct node *n, enum diag_at which, const char *text, struct deck *deck)
{
    const char *word, *p = strchr(text, '$');
    size_t len, skip = dollar_word(p, &word, &len);
    struct expr_error error = {.text = "expected $i or $(i - 1)"};
    double value;
    if (skip) dollar_value(&value, word, len, n->scope, deck, &error);
    diag_error(deck->diags, n, which, "E-repeat", "'%s': %s", diag_clip(deck->diags, text), error.text);
    if (error.hint[0]) diag_hint(deck->diags, "%s", error.hint);
}

static void check_left(struct node *n, struct deck *deck)
{
    if (n->key && strchr(n->key, '$')) report_left(n, AT_KEY, n->key, deck);
    if (n->scope && !n->reported && n->type == NODE_SCALAR && strchr(n->text, '$'))
        report_left(n, AT_VALUE, n->text, deck);
    for (int i = 0; i < n->count; i++) check_left(n->item[i], deck);
}

void repeat_all(struct deck *deck)
{
    int before = diags_errors(deck->diags);
    expand(deck->root, deck);
    if (diags_errors(deck->diags) == before) check_left(deck->root, deck);
}

/* Words without a value stay, for those who read the text to complain of. */
static void fill_in(struct node *n, struct deck *deck)
{
    if (n->type == NODE_SCALAR && !n->scope && strstr(n->text, "$(")) {
        n->text = substitute(n->text, NULL, deck);
        n->len = strlen(n->text);
    }
    for (int i = 0; i < n->count; i++) fill_in(n->item[i], deck);
}

void repeat_rest(struct deck *deck)
{
    fill_in(deck->root, deck);
}
