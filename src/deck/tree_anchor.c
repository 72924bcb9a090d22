/* tree_anchor.c -- anchors and aliases: an alias is a copy of what its anchor names, counted in full. */
#include <string.h>

#include "deck/tree_parts.h"

static struct anchor *find_anchor(struct builder *b, const char *name)
{
    for (int i = 0; i < b->anchors; i++)
        if (!strcmp(b->anchor[i].name, name)) return &b->anchor[i];
    return NULL;
}

int anchor_open(struct builder *b, const yaml_char_t *text, struct node *n, struct span at)
{
    const char *name = (const char *)text;
    if (!name) return 0;
    const struct anchor *first = find_anchor(b, name);
    if (first) {
        diag_error_in(b->diags, at, "E-anchor", "anchor '&%s' is given twice", diag_clip(b->diags, name));
        diag_note_in(b->diags, first->at, "first given here");
        return 0;
    }
    if (b->anchors == MAX_ANCHORS) {
        diag_error_in(b->diags, at, "E-limit-anchors", "more than %d anchors", MAX_ANCHORS);
        return -1;
    }
    if (!b->anchor) b->anchor = TAKE(b->pool->arena, struct anchor, MAX_ANCHORS);
    struct anchor *a = &b->anchor[b->anchors++];
    *a = (struct anchor){pool_text(b->pool, name, strlen(name)), n, at, true, b->pool->nodes};
    return b->anchors;
}

void anchor_close(struct builder *b, int number)
{
    if (number <= 0) return;
    struct anchor *a = &b->anchor[number - 1];
    a->open = false;
    a->nodes = b->pool->nodes - a->nodes + 1;
}

struct node *alias_node(struct builder *b, const yaml_event_t *e)
{
    const char *name = (const char *)e->data.alias.anchor;
    struct span at = tree_span(b, e);
    struct node *n = pool_node(b->pool);
    *n = (struct node){
        .type = NODE_SCALAR, .file = b->file, .mark = at.from, .end = at.to, .text = "", .reported = true};
    const struct anchor *a = find_anchor(b, name);
    if (!a || a->open) {
        diag_error_in(b->diags, at, "E-anchor",
                      a ? "alias '*%s' is inside of what it names" : "no anchor '&%s' before this alias",
                      diag_clip(b->diags, name));
        if (a) diag_note_in(b->diags, a->at, "it names this");
        return n;
    }
    if (b->aliases == MAX_ANCHORS) {
        diag_error_in(b->diags, at, "E-limit-anchors", "more than %d aliases", MAX_ANCHORS);
        return NULL;
    }
    if (!tree_within(b, a->nodes, at) || !tree_shallow(b, a->node->height, at)) return NULL;
    b->pool->nodes += a->nodes - 1;
    *n = *a->node;
    n->mark = at.from;
    n->end = at.to;
    n->key = NULL;
    if (!b->alias) b->alias = TAKE(b->pool->arena, struct node *, MAX_ANCHORS);
    b->alias[b->aliases++] = n;
    return n;
}

void aliases_part(struct builder *b)
{
    long nodes = b->pool->nodes; /* counted already */
    for (int i = 0; i < b->aliases; i++) {
        struct node *n = b->alias[i];
        if (n->count) n->item = pool_items(b->pool, n->item, n->count);
        for (int k = 0; k < n->count; k++) n->item[k] = tree_copy(b->pool, n->item[k], NULL);
    }
    b->pool->nodes = nodes;
}
