/* tree_parts.h -- what the files that make the tree share.
 *
 *     tree.c         scalars, lists, maps, the document
 *     tree_anchor.c  anchors and aliases
 */
#ifndef FMDSUB_DECK_TREE_PARTS_H
#define FMDSUB_DECK_TREE_PARTS_H

#include <yaml.h>

#include "deck/syntax.h"
#include "deck/tree.h"

struct anchor {
    const char *name;
    struct node *node;
    struct span at;
    bool open;  /* its node is being built */
    long nodes; /* in it, aliases counted in full */
};

struct builder {
    struct pool *pool;
    struct diags *diags;
    struct syntax syntax;
    int file;
    int depth, anchors, aliases;
    struct anchor *anchor; /* [MAX_ANCHORS], once there is one */
    struct node **alias;   /* [MAX_ANCHORS] copies whose children are still the anchor's */
    struct node **stack;   /* items of the open collections */
    int top, capacity;
    yaml_parser_t parser;
};

/* Where an event stands. */
struct span tree_span(const struct builder *b, const yaml_event_t *e);
/* Are there places for so many more nodes, so many more levels?  Else reported. */
bool tree_within(struct builder *b, long nodes, struct span at);
bool tree_shallow(struct builder *b, int height, struct span at);

/* Registers the anchor of an event, if it has one.  -1: no more of them; else its number + 1, 0: none. */
int anchor_open(struct builder *b, const yaml_char_t *text, struct node *n, struct span at);
/* Its node is whole: aliases may name it. */
void anchor_close(struct builder *b, int number);
/* A copy of what the anchor names; children stay shared until the whole is known to be small enough. */
struct node *alias_node(struct builder *b, const yaml_event_t *e);
/* Gives every alias children of its own. */
void aliases_part(struct builder *b);

#endif
