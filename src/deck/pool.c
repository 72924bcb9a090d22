/* pool.c -- where nodes come from: small pieces of large chunks; and trees copied, grown, made unique. */
#include <stdlib.h>
#include <string.h>

#include "deck/tree.h"

struct node *pool_node(struct pool *pool)
{
    if (pool->left == 0) {
        pool->left = 256;
        pool->node = TAKE(pool->arena, struct node, pool->left);
    }
    pool->left--;
    pool->nodes++;
    return pool->node++;
}

/* Bytes aligned for a pointer. */
static char *pool_bytes(struct pool *pool, size_t n)
{
    enum { CHUNK = 1 << 14 };
    n = (n + 7) & ~(size_t)7;
    if (n > CHUNK / 4) return TAKE(pool->arena, char, n);
    if (n > pool->capacity) {
        pool->byte = TAKE(pool->arena, char, CHUNK);
        pool->capacity = CHUNK;
    }
    char *bytes = pool->byte;
    pool->byte += n;
    pool->capacity -= n;
    return bytes;
}

char *pool_text(struct pool *pool, const char *text, size_t len)
{
    char *copy = pool_bytes(pool, len + 1);
    memcpy(copy, text, len);
    copy[len] = 0;
    return copy;
}

struct node **pool_items(struct pool *pool, struct node *const *items, int n)
{
    struct node **copy = (struct node **)(void *)pool_bytes(pool, (size_t)n * sizeof *copy);
    if (n) memcpy(copy, items, (size_t)n * sizeof *copy);
    return copy;
}

struct node *pool_scalar(struct pool *pool, const char *text, const struct node *place)
{
    struct node *n = pool_node(pool);
    *n = (struct node){.type = NODE_SCALAR,
                       .file = place->file,
                       .mark = place->mark,
                       .end = place->end,
                       .scope = place->scope,
                       .text = text,
                       .len = strlen(text)};
    return n;
}

struct node *tree_copy(struct pool *pool, const struct node *n, const struct scope *scope)
{
    struct node *copy = pool_node(pool);
    *copy = *n;
    copy->scope = scope;
    if (n->count) copy->item = pool_items(pool, n->item, n->count);
    for (int i = 0; i < n->count; i++) copy->item[i] = tree_copy(pool, n->item[i], scope);
    return copy;
}

long tree_size(const struct node *n)
{
    long size = 1;
    for (int i = 0; i < n->count; i++) size += tree_size(n->item[i]);
    return size;
}

void tree_append(struct pool *pool, struct node *map, struct node *member)
{
    for (int i = 0; i < map->count; i++)
        if (!strcmp(map->item[i]->key, member->key)) {
            map->item[i] = member;
            return;
        }
    struct node **items = (struct node **)(void *)pool_bytes(pool, (size_t)(map->count + 1) * sizeof *items);
    if (map->count) memcpy(items, map->item, (size_t)map->count * sizeof *items);
    items[map->count++] = member;
    map->item = items;
}

/* ---- duplicates ---- */

struct ranked {
    struct node *node;
    int rank;
};

static int by_key(const void *a, const void *b)
{
    const struct ranked *x = a, *y = b;
    int order = strcmp(x->node->key, y->node->key);
    return order ? order : x->rank - y->rank;
}

static bool same_key(const struct ranked *a, const struct ranked *b)
{
    return !strcmp(a->node->key, b->node->key);
}

/* Tells of the members whose key has been given and takes them out; sorted[0..n) are all members by key. */
static void drop_repeated(struct node *map, const struct ranked *sorted, struct diags *diags, struct arena *arena)
{
    bool *drop = TAKE(arena, bool, map->count);
    for (int i = 1, first = 0; i < map->count; i++) {
        if (!same_key(&sorted[first], &sorted[i])) {
            first = i;
            continue;
        }
        const struct node *n = sorted[i].node;
        drop[sorted[i].rank] = true;
        diag_error(diags, n, AT_KEY, "E-duplicate", "key '%s' is given twice", diag_clip(diags, n->key));
        diag_note(diags, sorted[first].node, AT_KEY, "first given here");
    }
    int kept = 0;
    for (int i = 0; i < map->count; i++)
        if (!drop[i]) map->item[kept++] = map->item[i];
    map->count = kept;
}

void tree_unique(struct node *map, struct diags *diags, struct arena *arena)
{
    struct arena_mark mark = arena_mark(arena);
    struct ranked *sorted = TAKE(arena, struct ranked, map->count);
    bool repeated = false;
    for (int i = 0; i < map->count; i++) sorted[i] = (struct ranked){map->item[i], i};
    qsort(sorted, (size_t)map->count, sizeof *sorted, by_key);
    for (int i = 1; i < map->count; i++) repeated |= same_key(&sorted[i - 1], &sorted[i]);
    if (repeated)
        drop_repeated(map, sorted, diags, arena);
    else
        arena_rewind(arena, mark);
}
