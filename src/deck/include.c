/* include.c -- include: of other files.
 *
 * Maps are merged key by key, all the way down.  Where both give a value the deck's own wins over an included one;
 * two included files may differ only where it does. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "deck/stages.h"

/* The files that are being read, innermost first. */
struct chain {
    const struct chain *up;
    dev_t dev;
    ino_t ino;
    const char *path;
    int depth;
};

/* ---- merging ---- */

static int by_key(const void *a, const void *b)
{
    return strcmp((*(struct node *const *)a)->key, (*(struct node *const *)b)->key);
}

static bool equal(const struct node *a, const struct node *b)
{
    if (a->type != b->type || a->count != b->count) return false;
    if (a->type == NODE_SCALAR) return !strcmp(a->text, b->text) && a->quoted == b->quoted;
    for (int i = 0; i < a->count; i++)
        if ((a->key && a->type == NODE_MAP && strcmp(a->item[i]->key, b->item[i]->key)) ||
            !equal(a->item[i], b->item[i]))
            return false;
    return true;
}

/* to := to and from.  over: the map that includes both, whose own values win over them; NULL: to wins. */
static void merge(struct node *to, const struct node *from, const struct node *over, struct deck *deck)
{
    static const struct node nothing = {.type = NODE_MAP};
    int n = to->count, all = n + from->count;
    struct node **sorted = pool_items(&deck->pool, to->item, n), **items = TAKE(deck->arena, struct node *, all);
    if (n) memcpy(items, to->item, (size_t)n * sizeof *items);
    if (n) qsort(sorted, (size_t)n, sizeof *sorted, by_key);
    for (int i = 0; i < from->count; i++) {
        struct node *x = from->item[i], **found = n ? bsearch(&x, sorted, (size_t)n, sizeof *sorted, by_key) : NULL;
        const struct node *own = found ? node_find(over, x->key) : NULL;
        if (!found) {
            items[to->count++] = x;
        } else if (own && own->type != NODE_MAP) {
            continue;
        } else if ((*found)->type == NODE_MAP && x->type == NODE_MAP) {
            merge(*found, x, over && !own ? &nothing : own, deck);
        } else if (over && !own && !equal(*found, x)) {
            diag_error(deck->diags, x, AT_KEY, "E-conflict", "included files differ in '%s'",
                       diag_clip(deck->diags, x->key));
            diag_note(deck->diags, *found, AT_KEY, "the other value is here");
        }
    }
    to->item = items;
}

/* ---- files ---- */

static const char *folder_of(const char *path, struct arena *arena)
{
    const char *slash = strrchr(path, '/');
    return slash ? arena_copy(arena, path, (size_t)(slash - path) + 1) : "";
}

/* dir/a.yaml -> b.yaml -> dir/a.yaml */
static const char *chain_text(const struct chain *c, const struct chain *first, struct arena *arena)
{
    if (c == first) return c->path;
    return arena_print(arena, "%s -> %s", chain_text(c->up, first, arena), c->path);
}

static bool in_circle(const struct node *n, const struct chain *c, const struct stat *st, const char *path,
                      struct deck *deck)
{
    for (const struct chain *up = c; up; up = up->up) {
        if (up->dev != st->st_dev || up->ino != st->st_ino) continue;
        diag_error(deck->diags, n, AT_VALUE, "E-include", "files include each other: %s -> %s",
                   chain_text(c, up, deck->arena), path);
        return true;
    }
    if (c->depth < INCLUDE_DEPTH) return false;
    diag_error(deck->diags, n, AT_VALUE, "E-include", "include: is more than %d deep", INCLUDE_DEPTH);
    return true;
}

static struct node *include_into(struct node *root, const struct chain *chain, struct deck *deck);

/* The tree of an open file, its own includes done. */
static struct node *read_part(int fd, const struct node *n, const char *path, const struct chain *chain,
                              struct deck *deck)
{
    struct source *s;
    struct report report = {0};
    enum status status = deck_read(&s, fd, path, deck, &report);
    if (status != OK) {
        diag_error(deck->diags, n, AT_VALUE, status == E_LIMIT ? "E-limit-file" : "E-include", "%s", report.text);
        return NULL;
    }
    struct node *root = deck_parse(deck, s, "an included file");
    return root ? include_into(root, chain, deck) : NULL;
}

static struct node *include_file(const struct node *n, const struct chain *c, struct deck *deck)
{
    struct stat st;
    if (n->reported) return NULL;
    if (n->type != NODE_SCALAR || n->len == 0) {
        diag_error(deck->diags, n, node_is_null(n) ? AT_KEY : AT_VALUE, "E-include", "expected a file name, found %s",
                   node_type_name(n));
        return NULL;
    }
    struct node here = *n; /* a file is named from where it is included, and opened from the deck's folder */
    here.text =
        arena_print(deck->arena, "%s%s", *n->text == '/' || !c->up ? "" : folder_of(c->path, deck->arena), n->text);
    here.len = strlen(here.text);
    int fd = deck_open_file(&here, deck);
    if (fd < 0) return NULL;
    struct node *tree = NULL;
    if (!fstat(fd, &st) && !in_circle(n, c, &st, here.text, deck)) {
        struct chain inner = {c, st.st_dev, st.st_ino, here.text, c->depth + 1};
        tree = read_part(fd, n, here.text, &inner, deck);
    }
    close(fd);
    return tree;
}

static void take_out(struct node *map, const struct node *member)
{
    int kept = 0;
    for (int i = 0; i < map->count; i++)
        if (map->item[i] != member) map->item[kept++] = map->item[i];
    map->count = kept;
}

/* root with what it includes. */
static struct node *include_into(struct node *root, const struct chain *chain, struct deck *deck)
{
    struct node *n = node_find(root, "include"), *parts = NULL;
    if (!n) return root;
    take_out(root, n);
    int count = n->type == NODE_LIST ? n->count : 1;
    for (int i = 0; i < count; i++) {
        struct node *part = include_file(n->type == NODE_LIST ? n->item[i] : n, chain, deck);
        if (part && parts)
            merge(parts, part, root, deck);
        else if (part)
            parts = part;
    }
    if (parts) merge(root, parts, NULL, deck);
    return root;
}

void include_all(struct deck *deck, const struct stat *self)
{
    struct chain chain = {NULL, self->st_dev, self->st_ino, deck->path, 0};
    include_into(deck->root, &chain, deck);
}
