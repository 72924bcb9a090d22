/* set.c -- --set path=value: the deck with one value changed.
 *
 *     bodies.rod.mass=2    output.columns.0=t    initial.hub.angle=0.5    bodies."odd.name".mass=1
 *
 * At each map the longest key that the path begins with is taken, so that keys with dots are found; a list
 * item is a number from 0.  What is not there is made, to be judged by whoever reads the keys. */
#include <stdlib.h>
#include <string.h>

#include "deck/stages.h"

struct setting {
    const char *text, *path; /* path=value; the path alone */
    int file;
    struct node *value; /* NULL: reported */
    bool done;
};

struct set {
    int n;
    struct setting *item;
};

bool deck_was_set(const struct deck *deck, const struct node *n)
{
    const struct source *s = diags_source(deck->diags, n->file);
    return s && s->set;
}

bool deck_was_made(const struct deck *deck, const struct node *n)
{
    return deck_was_set(deck, n) && n->mark.line == 1 && n->mark.col == 1; /* a value stands behind its path */
}

static struct span path_span(const struct setting *s)
{
    return (struct span){s->file, {1, 1}, {1, (int)strlen(s->path) + 1}};
}

static void parse_setting(struct setting *s, const char *text, const char *option, struct deck *deck)
{
    const char *equal = strchr(text, '=');
    struct source *source = source_of(option ? option : "--set", text, strlen(text), deck->arena);
    source->set = true;
    source->option = option != NULL;
    size_t flaw;
    *s = (struct setting){.text = text, .done = true, .file = diags_add_source(deck->diags, source)};
    hash_text(deck, text, strlen(text) + 1);
    s->path = arena_copy(deck->arena, text, equal ? (size_t)(equal - text) : strlen(text));
    if (source_check(source, &flaw) != SOURCE_FINE)
        diag_error_in(deck->diags, (struct span){s->file, source_mark(source, flaw), source_mark(source, flaw)},
                      "E-character", "a character that cannot be in a deck");
    else if (!equal || equal == text)
        diag_error_in(deck->diags, path_span(s), "E-set", "expected path=value");
    else if ((s->value = tree_parse(&deck->pool, deck->diags, s->file, (size_t)(equal - text) + 1)))
        s->done = false;
}

struct set *set_open(const struct deck_options *options, struct deck *deck)
{
    struct set *set = TAKE(deck->arena, struct set, 1);
    set->n = options ? options->nset : 0;
    set->item = TAKE(deck->arena, struct setting, set->n);
    for (int i = 0; i < set->n; i++)
        parse_setting(&set->item[i], options->set[i], options->option ? options->option[i] : NULL, deck);
    return set;
}

/* ---- walking ---- */

/* The next key of a path: up to the first dot, or in quotes.  Returns what follows. */
static const char *first_key(const char *path, char **key, struct arena *arena)
{
    const char *quote = *path == '"' ? strchr(path + 1, '"') : NULL;
    bool quoted = quote && (quote[1] == '.' || quote[1] == 0);
    size_t start = quoted, len = quoted ? (size_t)(quote - path) - 1 : strcspn(path, ".");
    *key = arena_copy(arena, path + start, len);
    path += len + 2 * start;
    return *path == '.' ? path + 1 : path;
}

/* The member whose key the path begins with, the longest; *rest: what follows it. */
static struct node *member(const struct node *map, const char *path, const char **rest, struct arena *arena)
{
    struct node *found = NULL;
    size_t longest = 0;
    char *key;
    const char *after = first_key(path, &key, arena);
    for (int i = 0; i < map->count; i++) {
        const char *name = map->item[i]->key;
        size_t n = strlen(name);
        bool here = !strncmp(path, name, n) && (path[n] == '.' || path[n] == 0);
        if (*path == '"' && !strcmp(name, key)) return *rest = after, map->item[i];
        if (!here || (found && n <= longest)) continue;
        found = map->item[i];
        longest = n;
    }
    if (found) *rest = path[longest] ? path + longest + 1 : path + longest;
    return found;
}

static struct node *item(const struct node *list, const char *path, const char **rest)
{
    char *end;
    if (*path < '0' || *path > '9') return NULL;
    long i = strtol(path, &end, 10);
    if ((*end && *end != '.') || i >= list->count) return NULL;
    *rest = *end ? end + 1 : end;
    return list->item[i];
}

/* The deepest node that is there; *rest: the part of the path that is not. */
static struct node *walk(struct node *n, const char *path, const char **rest, struct arena *arena)
{
    *rest = path;
    while (**rest) {
        struct node *next = n->type == NODE_MAP    ? member(n, *rest, rest, arena)
                            : n->type == NODE_LIST ? item(n, *rest, rest)
                                                   : NULL;
        if (!next) break;
        n = next;
    }
    return n;
}

/* ---- making ---- */

/* Gives a value its key, with the path as the key's place. */
static struct node *with_key(const struct setting *s, const char *key, struct node *value)
{
    value->key = key;
    value->key_mark = (struct mark){1, 1};
    value->key_end = path_span(s).to;
    return value;
}

/* The value takes the place of a node, and keeps its key and its loop variables. */
static void replace(const struct setting *s, struct node *n, struct deck *deck)
{
    const char *key = n->key;
    struct replaced *old = TAKE(deck->arena, struct replaced, 1);
    *old = (struct replaced){deck->replaced, *n};
    deck->replaced = old;
    *n = *tree_copy(&deck->pool, s->value, n->scope);
    if (key) with_key(s, key, n);
}

static void report_no_place(const struct setting *s, const struct node *n, const char *rest, struct deck *deck)
{
    struct diags *d = deck->diags;
    if (n->type == NODE_LIST)
        diag_error_in(d, path_span(s), "E-set", "no item '%s' in a list of %d", diag_clip(d, rest), n->count);
    else
        diag_error_in(d, path_span(s), "E-set", "'%s' is below a value that is not a map", diag_clip(d, rest));
    diag_note(d, n, AT_KEY, "the path leads here");
}

/* The next key of what is to be made.  Names in initial: hold dots themselves. */
static const char *new_key(const char *rest, char **key, const struct node *map, struct deck *deck)
{
    if (!map->key || strcmp(map->key, "initial") || *rest == '"') return first_key(rest, key, deck->arena);
    *key = arena_copy(deck->arena, rest, strlen(rest));
    return rest + strlen(rest);
}

/* Makes the maps of `rest` below n, and the value in the last one. */
static void make(const struct setting *s, struct node *n, const char *rest, struct deck *deck)
{
    for (int depth = 0; n->type == NODE_MAP && depth < MAX_DEPTH - 8; depth++) {
        char *key;
        rest = new_key(rest, &key, n, deck);
        struct node *value = *rest ? pool_node(&deck->pool) : tree_copy(&deck->pool, s->value, n->scope);
        if (*rest)
            *value = (struct node){
                .type = NODE_MAP, .file = s->file, .mark = {1, 1}, .end = path_span(s).to, .scope = n->scope};
        tree_append(&deck->pool, n, with_key(s, key, value));
        if (!*rest) return;
        n = value;
    }
    report_no_place(s, n, rest, deck);
}

/* What is to be made waits for repeat:, unless it is for repeat: itself. */
static bool made_early(const char *path)
{
    return !strcmp(path, "parameters") || !strncmp(path, "parameters.", 11) || strchr(path, '$');
}

static void apply(struct setting *s, bool late, struct deck *deck)
{
    const char *rest;
    if (s->done) return;
    if (!strcmp(s->path, "include") || !strncmp(s->path, "include.", 8)) {
        s->done = true;
        diag_error_in(deck->diags, path_span(s), "E-set", "'include' is done before --set: it belongs into the deck");
        return;
    }
    struct node *n = walk(deck->root, s->path, &rest, deck->arena);
    if (*rest && !late && !made_early(s->path)) return;
    s->done = true;
    if (!*rest)
        replace(s, n, deck);
    else if (n->type == NODE_MAP)
        make(s, n, rest, deck);
    else
        report_no_place(s, n, rest, deck);
}

void set_early(struct set *set, struct deck *deck)
{
    for (int i = 0; i < set->n; i++) apply(&set->item[i], false, deck);
}

void set_late(struct set *set, struct deck *deck)
{
    for (int i = 0; i < set->n; i++) apply(&set->item[i], true, deck);
}
