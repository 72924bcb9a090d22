/* effect.c -- the rows of effect.h as tables */
#include "kind/effect.h"

#include <math.h>

const struct effect_kind effect_kinds[EFFECTS] = {
#define X(id, name, ...) {name, __VA_ARGS__},
    EFFECT_ROWS(X)
#undef X
};

const struct key keys_effects[] = {
    PARAM_WORD(
        struct effect_wishes, all, "mode", "auto|all", 0, "auto",
        "auto: what has no effect at all in the scene is left out, and books that nobody reads; all: nothing is"),
#define X(id, name, brief, ...)                                                                                        \
    PARAM_WORD(struct effect_wishes, wish[EFFECT_##id], name, EFFECT_WISHES, 0, "auto", brief),
    EFFECT_ROWS(X)
#undef X
        KEYS_END,
};

enum effect_wish effect_wish(const struct effect_wishes *o, enum effect_id id)
{
    if (o->wish[id] == WISH_AUTO && o->all) return WISH_ON;
    return o->wish[id];
}
