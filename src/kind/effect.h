/* effect.h -- what a scene may ask of the physics and of the books, effect by effect.
 *
 * One row an effect: what it adds, what tells whether it matters, what it costs.  The rows are the grammar of `effects:`,
 * `fmdsub list effects` and the first columns of `fmdsub explain DECK`; model/effects.c decides by them what the model
 * of a scene goes without.  A new effect is a row here and its decision there. */
#ifndef FMDSUB_KIND_EFFECT_H
#define FMDSUB_KIND_EFFECT_H

#include "base/keys.h"

/* X(id, deck key, what it adds, the number that tells, its threshold, what it costs, how it is watched) */
#define EFFECT_ROWS(X)                                                                                                 \
    X(OUT_OF_PLANE, "out_of_plane", "motion out of one plane",                                                         \
      "joints that keep one normal, or a scene that is its own mirror image; bodies' data, loads and rates in it",     \
      "0: the deck's data leave no way out of the plane", "3-D over 2-D: 1.3 to 3.2 times the step",                   \
      "not needed: structural")                                                                                        \
    X(GRAVITY, "gravity", "the deck's gravity on all bodies", "g/(Omega^2 l)", "0: the deck has none", "nothing",      \
      "by a second run with it")                                                                                       \
    X(GYROSCOPIC, "gyroscopic", "w x J w of rigid bodies in space", "|w x J w| over the largest moment on the body",   \
      "0: a body that turns about one principal axis, or in the plane", "1 to 2 % of a step in space",                 \
      "by a second run with it")                                                                                       \
    X(STIFFENING, "stiffening", "bending shortens: loads along a body stiffen or soften it",                           \
      "(Omega/w1)^2 (Kane, Ryan & Banerjee 1987; Padilla & von Flotow 1992)", "0: no flexible body",                   \
      "4 to 21 % of an evaluation; without it the iteration takes more of them",                                       \
      "at records by its share of what bends, near the tolerance by a second run")                                     \
    X(ROTARY, "rotary", "rotary inertia of the sections of flexible bodies", "4.65 I/(A l^2) of the first bending",    \
      "0: no flexible body", "0 to 4 % of an evaluation", "by a second run with it")                                   \
    X(SHEAR, "shear", "shear deformation of beams (Timoshenko)", "3 E I/(kappa G A l^2) of the first bending",         \
      "0: no beam with shear factors", "nothing: in the reduced data", "by a second run with it")                      \
    X(DAMPING, "damping", "damping of flexible bodies", "1 - exp(-zeta w1 T)", "0: the deck gives none",               \
      "nothing where there is none", "at records by its share of what bends, near the tolerance by a second run")      \
    X(MOMENTUM, "momentum", "what nothing holds keeps momentum, angular momentum and energy to round-off",             \
      "is a column momentum.* written?", "0: no; then kept as far as the scheme does by itself",                       \
      "half of a satellite's step", "by columns momentum.*")                                                           \
    X(LEDGER, "ledger", "energies at the end of every major step", "is a column energy.* written?",                    \
      "0: no; then they are looked at every eighth step", "up to 18 % of a step", "not needed: works add up anyway")

enum effect_id {
#define X(id, ...) EFFECT_##id,
    EFFECT_ROWS(X)
#undef X
        EFFECTS
};

/* In sets of effects. */
static inline unsigned effect_bit(enum effect_id id)
{
    return 1u << id;
}

enum effect_wish { WISH_AUTO, WISH_ON, WISH_OFF }; /* in this order in the deck's words */
#define EFFECT_WISHES "auto|true|false"

struct effect_kind {
    const char *name, *brief, *evidence, *threshold, *cost, *watched;
};
extern const struct effect_kind effect_kinds[EFFECTS];

/* What the deck says of them. */
struct effect_wishes {
    int all; /* mode: 1: nothing is left out that is not forced */
    int wish[EFFECTS];
    double tolerance; /* of what is left out, a tenth of the run's at most; 0: neither is given */
};
extern const struct key keys_effects[];

/* The share that what is left out may have where the deck says nothing of it. */
#define EFFECTS_TOLERANCE 1.0e-3

/* What it wishes of one: where it says nothing, by its mode. */
enum effect_wish effect_wish(const struct effect_wishes *o, enum effect_id id);

#endif
