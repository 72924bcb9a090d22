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
        PARAM_REAL(struct effect_wishes, tolerance, "tolerance", NULL, 0, 1, KEY_ABOVE, NULL,
                   "share that what is left out may have: of columns the modes that 'modes: auto' leaves out (default "
                   "1.0e-3), and effects turned off (W-effect); at most a tenth of the run's own tolerance"),
    KEYS_END,
};

enum effect_wish effect_wish(const struct effect_wishes *o, enum effect_id id)
{
    if (o->wish[id] == WISH_AUTO && o->all) return WISH_ON;
    return o->wish[id];
}
