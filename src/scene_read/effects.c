/* effects.c -- `effects`: which of them the deck wants, which it leaves to the program */
#include <math.h>

#include "scene_read/parts.h"

/* With a tolerance of the run what is left out may have a tenth of it at most. */
static void take_share(struct builder *b)
{
    static const double SHARE = .1;
    double *tolerance = &b->scene->effects.tolerance, x;
    const struct node *n = node_find(node_find(b->scene->deck->root, "integrate"), "tolerance");
    if (!n || n->implied || n->type != NODE_SCALAR || deck_number(&x, n, b->reader.deck) != OK || !(x > 0)) return;
    *tolerance = fmin(*tolerance > 0 ? *tolerance : EFFECTS_TOLERANCE, SHARE * x);
}

void read_effects(struct builder *b, const struct node *n)
{
    struct effect_wishes *o = &b->scene->effects;
    b->scene->effects_node = n;
    if (n && read_keys(o, keys_effects, n, NULL, "'effects'", &b->reader)) return;
    take_share(b);
    for (int i = 0; i < EFFECTS; i++) {
        const unsigned bit = effect_bit((enum effect_id)i);
        if (o->wish[i] != WISH_OFF) continue;
        b->denied |= bit;
        if (b->unheard & bit) o->wish[i] = WISH_AUTO;
    }
}
