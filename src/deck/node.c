/* node.c -- see node.h */
#include "deck/node.h"

#include <string.h>

struct node *node_find(const struct node *map, const char *key)
{
    if (!map || map->type != NODE_MAP) return NULL;
    for (int i = 0; i < map->count; i++)
        if (!strcmp(map->item[i]->key, key)) return map->item[i];
    return NULL;
}

bool node_is_null(const struct node *n)
{
    if (n->type != NODE_SCALAR || n->quoted) return false;
    return n->len == 0 || !strcmp(n->text, "null") || !strcmp(n->text, "~");
}

const char *node_type_name(const struct node *n)
{
    if (n->type == NODE_MAP) return "a map";
    if (n->type == NODE_LIST) return "a list";
    return node_is_null(n) ? "nothing" : "text";
}
