/* node.h -- a deck as a tree: maps, lists, scalars, each with its place in the text.
 *
 * The tree is what the deck says after include:, --set, parameters: and repeat:.  Scalars stay text until a
 * reader asks for a number.  Sizes: at most 1e6 nodes. */
#ifndef FMDSUB_DECK_NODE_H
#define FMDSUB_DECK_NODE_H

#include <stdbool.h>
#include <stddef.h>

/* 1-based; col in characters. */
struct mark {
    int line, col;
};

enum node_type { NODE_SCALAR, NODE_LIST, NODE_MAP };

/* The loop variables of a repeat: around a node, innermost first. */
struct scope {
    const struct scope *up;
    const char *name;
    double value;
};

struct node {
    enum node_type type;
    int file;              /* of the sources in diags */
    struct mark mark, end; /* of the value; end is behind it */

    /* Member of a map: its key; else NULL. */
    const char *key;
    struct mark key_mark, key_end;

    /* Scalar; of a table among signals: an expression that is the same. */
    const char *text;
    size_t len;
    bool quoted;

    /* List items or map members, in the order of the text. */
    int count;
    struct node **item;
    int height; /* of the tree below as it was read: 0 for a scalar */

    const struct scope *scope;
    bool flow;     /* list or map inside [ ] or { }; members then too */
    bool implied;  /* a default that the reader filled in */
    bool reported; /* what is wrong with it has been said: readers fail silently; of a map that a member is lost */
    bool formula;  /* read as an expression of more than parameters: its names stay names */
    bool has_value;
    double value; /* the number it was read as */
};

/* The member of map with this key, or NULL; implied ones too. */
struct node *node_find(const struct node *map, const char *key);

/* A scalar that is not there: nothing, `null` or `~`, unquoted. */
bool node_is_null(const struct node *n);

/* "a map", "a list", "nothing", "text". */
const char *node_type_name(const struct node *n);

#endif
