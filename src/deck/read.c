/* read.c -- see read.h */
#include "deck/read.h"

#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/text.h"
#include "deck/stages.h"

enum { WORDS = 256 };

/* Nodes are the deck's and never const themselves; readers mark them. */
static void mark_reported(const struct node *n)
{
    ((struct node *)n)->reported = true;
}

static const char *name_of(const struct node *n, const struct key *key)
{
    return key ? key->name : n->key ? n->key : "the value";
}

/* ---- shapes ---- */

static const char *found_text(const struct node *n, struct reader *rd)
{
    if (n->type != NODE_SCALAR || node_is_null(n)) return node_type_name(n);
    return arena_print(rd->deck->arena, "'%s'", diag_clip(rd->diags, n->text));
}

static int wrong_type(const struct node *n, const char *what, const char *expected, struct reader *rd)
{
    if (n->reported) return 1;
    mark_reported(n);
    diag_error(rd->diags, n, node_is_null(n) ? AT_KEY : AT_VALUE, "E-type", "%s%sexpected %s, found %s",
               what ? what : "", what ? ": " : "", expected, found_text(n, rd));
    const char *colon = n->type == NODE_SCALAR ? strchr(n->text, ':') : NULL;
    if (colon && colon[1] != ' ' && colon != n->text) diag_hint(rd->diags, "is a space missing after ':'?");
    return 1;
}

int read_map(const struct node *n, const char *what, struct reader *rd)
{
    const bool nothing = node_is_null(n) && !n->reported;
    if (n->type == NODE_MAP) return 0;
    wrong_type(n, what, "a map", rd);
    if (nothing) diag_hint(rd->diags, "what belongs to it stands below it, further to the right");
    return 1;
}

int read_list(const struct node *n, const char *what, struct reader *rd)
{
    return n->type == NODE_LIST ? 0 : wrong_type(n, what, "a list", rd);
}

int read_text(const char **out, const struct node *n, const char *what, struct reader *rd)
{
    if (n->reported) return 1;
    if (n->type != NODE_SCALAR || node_is_null(n)) return wrong_type(n, what, "a text", rd);
    *out = n->text;
    return 0;
}

/* ---- numbers ---- */

static const char *interval(const struct key *key, struct deck *deck)
{
    char lo[40], hi[40];
    const char *above = key->flags & KEY_ABOVE ? "above" : "at least",
               *below = key->flags & KEY_BELOW ? "below" : "at most";
    const char *unit = key->unit ? key->unit : "", *blank = key->unit ? " " : "";
    number_text(lo, key->lo);
    number_text(hi, key->hi);
    if (isinf(key->hi)) return arena_print(deck->arena, "%s %s%s%s", above, lo, blank, unit);
    if (isinf(key->lo)) return arena_print(deck->arena, "%s %s%s%s", below, hi, blank, unit);
    return arena_print(deck->arena, "%s %s and %s %s%s%s", above, lo, below, hi, blank, unit);
}

static bool unbounded(const struct key *key)
{
    return !key || (key->lo == 0 && key->hi == 0) || (isinf(key->lo) && isinf(key->hi));
}

static int check_range(double x, const struct node *n, const struct key *key, struct reader *rd)
{
    char number[40];
    if (unbounded(key)) return 0;
    bool low = key->flags & KEY_ABOVE ? x <= key->lo : x < key->lo,
         high = key->flags & KEY_BELOW ? x >= key->hi : x > key->hi;
    if (!low && !high) return 0;
    diag_error(rd->diags, n, AT_VALUE, "E-range", "'%s' must be %s, not %s", name_of(n, key), interval(key, rd->deck),
               number_text(number, x));
    mark_reported(n);
    return 1;
}

int read_number(double *out, const struct node *n, const struct key *key, struct reader *rd)
{
    double x;
    if (deck_number(&x, n, rd->deck) != OK || n->reported || check_range(x, n, key, rd)) return 1;
    *out = x;
    return 0;
}

int read_int(int *out, const struct node *n, const struct key *key, struct reader *rd)
{
    double x;
    char number[40];
    if (key && key->words && n->type == NODE_SCALAR && strcmp(n->text, key->words) == 0) {
        *out = 0;
        return 0;
    }
    if (deck_number(&x, n, rd->deck) != OK || n->reported) return 1;
    if (x != floor(x) || fabs(x) > INT_MAX) {
        diag_error(rd->diags, n, AT_VALUE, "E-integer",
                   x == floor(x) ? "'%s' must be at most 2147483647 in size, not %s"
                                 : "'%s' must be a whole number, not %s",
                   name_of(n, key), number_text(number, x));
        mark_reported(n);
        return 1;
    }
    if (check_range(x, n, key, rd)) return 1;
    *out = (int)x;
    return 0;
}

int read_bool(int *out, const struct node *n, struct reader *rd)
{
    static const char *const yes[] = {"yes", "on", "y", "1"}, *const no[] = {"no", "off", "n", "0"};
    if (n->reported) return 1;
    if (n->type == NODE_SCALAR && !n->quoted) {
        if (!strcmp(n->text, "true")) return *out = 1, 0;
        if (!strcmp(n->text, "false")) return *out = 0, 0;
    }
    mark_reported(n);
    diag_error(rd->diags, n, node_is_null(n) ? AT_KEY : AT_VALUE, "E-boolean", "expected true or false, found %s",
               found_text(n, rd));
    if (n->type != NODE_SCALAR) return 1;
    bool as_yes = !strcasecmp(n->text, "true"), as_no = !strcasecmp(n->text, "false");
    for (size_t i = 0; i < sizeof yes / sizeof *yes; i++) {
        as_yes |= !strcasecmp(n->text, yes[i]);
        as_no |= !strcasecmp(n->text, no[i]);
    }
    if (as_yes || as_no)
        diag_hint(rd->diags, "write %s%s", as_yes ? "true" : "false", n->quoted ? ", without quotes" : "");
    return 1;
}

/* The parts of "a|b|c". */
static int split_words(const char **list, const char *words, struct arena *arena)
{
    int n = 0;
    for (const char *p = words; n < WORDS; p++) {
        size_t len = strcspn(p, "|");
        list[n++] = arena_copy(arena, p, len);
        p += len;
        if (!*p) break;
    }
    return n;
}

/* The index of the text in "newmark|midpoint|...". */
static int read_word(int *out, const struct node *n, const char *words, struct reader *rd)
{
    const char *list[WORDS], *text;
    if (read_text(&text, n, NULL, rd)) return 1;
    int count = split_words(list, words, rd->deck->arena);
    for (int i = 0; i < count; i++)
        if (!strcmp(text, list[i])) return *out = i, 0;
    mark_reported(n);
    diag_error(rd->diags, n, AT_VALUE, "E-choice", "unknown word '%s' for '%s'", diag_clip(rd->diags, text),
               name_of(n, NULL));
    diag_suggest(rd->diags, text, list, count);
    return 1;
}

/* ---- lists of numbers ---- */

static int wrong_count(const struct node *list, const char *what, const char *expected, struct reader *rd)
{
    diag_error(rd->diags, list, AT_VALUE, "E-count", "%s%sexpected %s, found %d", what ? what : "", what ? ": " : "",
               expected, list->count);
    mark_reported(list);
    return 1;
}

int read_vector(double *x, int n, const struct node *list, const char *what, struct reader *rd)
{
    const char *numbers = arena_print(rd->deck->arena, "a list of %d numbers", n);
    int errors = 0;
    if (list->reported) return 1;
    if (list->type != NODE_LIST) return wrong_type(list, what, numbers, rd);
    if (list->count != n) return wrong_count(list, what, arena_print(rd->deck->arena, "%d numbers", n), rd);
    for (int i = 0; i < n; i++) errors += read_number(&x[i], list->item[i], NULL, rd);
    return errors != 0;
}

void read_unknown(const struct node *n, enum diag_at at, const char *code, const char *what, const char *name,
                  const char *const *words, int nwords, struct reader *rd)
{
    diag_error(rd->diags, n, at, code, "unknown %s '%s'", what, diag_clip(rd->diags, name));
    diag_suggest(rd->diags, name, words, nwords);
}

/* The numbers of a vector in the deck's space, each in the key's range. */
static int read_components(double *x, const struct node *n, const struct key *key, struct reader *rd)
{
    const int count = rd->space == 2 ? 2 : 3;
    int errors = 0;
    if (count == 2 && key->flags & KEY_ABOUT) return read_number(&x[2], n, key, rd);
    if (read_vector(x, count, n, arena_print(rd->deck->arena, "'%s'", key->name), rd)) return 1;
    for (int i = 0; i < count; i++) errors += check_range(x[i], n->item[i], key, rd);
    return errors;
}

/* ---- maps by table ---- */

static int read_value(void *out, const struct key *key, const struct node *n, struct reader *rd)
{
    void *member = (char *)out + key->offset;
    switch (key->type) {
    case KEY_REAL:
        return read_number(member, n, key, rd);
    case KEY_INT:
        return read_int(member, n, key, rd);
    case KEY_BOOL:
        return read_bool(member, n, rd);
    case KEY_WORD:
        return read_word(member, n, key->words, rd);
    case KEY_TEXT:
        return read_text(member, n, NULL, rd);
    case KEY_VECTOR:
        return read_components(member, n, key, rd);
    case KEY_TABLE:
        return read_table(member, n, rd);
    case KEY_CSV:
        return read_table_file(member, n, rd);
    case KEY_NODE:
        break;
    }
    *(const struct node **)member = n;
    return n->reported;
}

/* The default of a key as a node of the map, so that printing shows it. */
static const struct node *imply(const struct key *key, const struct node *map, struct reader *rd)
{
    struct pool *pool = &rd->deck->pool;
    struct node *n = pool_scalar(pool, key->fallback, map);
    n->key = key->name;
    n->implied = true;
    tree_append(pool, (struct node *)map, n);
    return n;
}

static bool other_space(const struct key *key, const struct reader *rd)
{
    return (key->flags & KEY_PLANAR && rd->space == 3) || (key->flags & KEY_SPATIAL && rd->space == 2);
}

static int read_key(void *out, const struct key *key, const struct node *map, const char *what, struct reader *rd)
{
    const struct node *n = node_find(map, key->name);
    if (n && other_space(key, rd)) {
        if (!n->implied)
            diag_error(rd->diags, n, AT_KEY, "E-dimension", "'%s' is for %s decks; this one is %s", key->name,
                       rd->space == 3 ? "2-D" : "3-D", rd->space == 3 ? "3-D" : "2-D");
        return !n->implied;
    }
    if (n) return read_value(out, key, n, rd);
    if (other_space(key, rd)) return 0;
    if (key->flags & KEY_REQUIRED && map->reported) return 1; /* that may be what it lacks */
    if (key->flags & KEY_REQUIRED) {
        diag_error(rd->diags, map, AT_KEY, "E-missing-key", "%s has no '%s'", what, key->name);
        if (key->brief)
            diag_hint(rd->diags, "%s: %s%s%s%s", key->name, key->brief, key->unit ? " [" : "",
                      key->unit ? key->unit : "", key->unit ? "]" : "");
        return 1;
    }
    if (!key->fallback) return 0;
    n = imply(key, map, rd);
    return n ? read_value(out, key, n, rd) : 1;
}

static int list_words(const char **words, const struct key *keys, const char *const *also)
{
    int n = 0;
    for (const struct key *k = keys; k->name && n < WORDS; k++) words[n++] = k->name;
    for (; also && *also && n < WORDS; also++) words[n++] = *also;
    return n;
}

/* {mass: 2,5}: a key of digits without a value, behind a number. */
static bool decimal_comma(const struct node *map, int i, struct reader *rd)
{
    const struct node *n = map->item[i], *before = i > 0 ? map->item[i - 1] : NULL;
    const size_t digits = strspn(n->key, "0123456789");
    if (!before || before->type != NODE_SCALAR || n->type != NODE_SCALAR || n->len > 0) return false;
    if (digits == 0 || n->key[digits] || before->len == 0 || strspn(before->text, "+-0123456789") < before->len)
        return false;
    diag_hint(rd->diags, "numbers have a decimal point: %s: %s.%s", before->key, diag_clip(rd->diags, before->text),
              diag_clip(rd->diags, n->key));
    return true;
}

static int refuse_unknown(const struct key *keys, const struct node *map, const char *const *also, const char *what,
                          struct reader *rd)
{
    const char *words[WORDS];
    int n = list_words(words, keys, also), errors = 0;
    for (int i = 0; i < map->count && !diags_full(rd->diags); i++) {
        const struct node *member = map->item[i];
        bool known = member->implied;
        for (int k = 0; k < n && !known; k++) known = !strcmp(member->key, words[k]);
        if (known) continue;
        errors++;
        diag_error(rd->diags, member, AT_KEY, "E-unknown-key", "unknown key '%s' in %s",
                   diag_clip(rd->diags, member->key), what);
        if (!decimal_comma(map, i, rd) && !suggest_section(member->key, words, n, keys, rd))
            diag_suggest(rd->diags, member->key, words, n);
    }
    return errors;
}

/* Is there an unknown key that was meant to be this one?  Then that has been reported. */
static bool misspelt(const struct key *key, const struct key *keys, const struct node *map)
{
    for (int i = 0; i < map->count; i++) {
        const char *word = map->item[i]->key;
        bool known = false;
        for (const struct key *k = keys; k->name && !known; k++) known = !strcmp(word, k->name);
        if (!known && diag_nearest(word, &key->name, 1)) return true;
    }
    return false;
}

/* Tells what the map that should be here would hold. */
static int no_map(const struct key *keys, const struct node *n, const char *const *also, const char *what,
                  struct reader *rd)
{
    const char *words[WORDS];
    const bool told = n->reported;
    read_map(n, what, rd);
    if (!told && n->type == NODE_LIST) diag_words(rd->diags, words, list_words(words, keys, also));
    return 1;
}

int read_keys(void *out, const struct key *keys, const struct node *map, const char *const *also, const char *what,
              struct reader *rd)
{
    if (map->type != NODE_MAP) return no_map(keys, map, also, what, rd);
    int errors = map->reported + refuse_unknown(keys, map, also, what, rd);
    for (const struct key *k = keys; k->name; k++)
        if (!errors || !(k->flags & KEY_REQUIRED) || node_find(map, k->name) ||
            !(diags_full(rd->diags) || misspelt(k, keys, map)))
            errors += read_key(out, k, map, what, rd);
    return errors;
}

int read_also(void *out, const struct key *keys, const struct node *map, const char *what, struct reader *rd)
{
    int errors = 0;
    for (const struct key *k = keys; k->name; k++) errors += read_key(out, k, map, what, rd);
    return errors;
}
