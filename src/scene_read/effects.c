/* effects.c -- `effects`: which of them the deck wants, which it leaves to the program */
#include "scene_read/parts.h"

int read_effects(struct builder *b, const struct node *n)
{
    b->scene->effects_node = n;
    return n && read_keys(&b->scene->effects, keys_effects, n, NULL, "'effects'", &b->reader) ? 1 : 0;
}
