/* tree.h -- YAML text to nodes.
 *
 * libyaml's events, not its loader: duplicates, aliases, tags and limits are our own to judge, and
 * every key and value keeps its marks. */
#ifndef FMDSUB_DECK_TREE_H
#define FMDSUB_DECK_TREE_H

#include "base/arena.h"
#include "deck/diag.h"
#include "deck/node.h"

enum {
    MAX_DEPTH = 64,
    MAX_ANCHORS = 1000,
    MAX_NODES = 1000000,
    MAX_SCALAR = 1 << 20,
    MAX_COPIES = 100000,
    MAX_REPEATED = 2000000 /* nodes after repeat: */
};

/* Where nodes and their texts come from; counts them for the whole deck. */
struct pool {
    struct arena *arena;
    struct node *node; /* free ones */
    int left;
    char *byte;
    size_t capacity;
    long nodes; /* in the deck so far */
};

struct node *pool_node(struct pool *pool);
char *pool_text(struct pool *pool, const char *text, size_t len);
struct node **pool_items(struct pool *pool, struct node *const *items, int n);
struct node *pool_scalar(struct pool *pool, const char *text, const struct node *place);

/* A copy all through, with its own scope; text is shared. */
struct node *tree_copy(struct pool *pool, const struct node *n, const struct scope *scope);
long tree_size(const struct node *n);

/* The document that starts at byte `from` of a source.  NULL: no tree could be made, diags say why.  What can be gone
 * past (a duplicate, a tag) is reported and left out. */
struct node *tree_parse(struct pool *pool, struct diags *diags, int file, size_t from);

/* Refuses keys given twice; the first stays. */
void tree_unique(struct node *map, struct diags *diags, struct arena *arena);

/* Replaces or appends a member. */
void tree_append(struct pool *pool, struct node *map, struct node *member);

#endif
