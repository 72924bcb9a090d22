/* idle.h -- turns that move no mass: of a slender rod between two ball joints about its own axis, of a point mass on one.
 * An inertia of less than 1e-8 of what the body has about its other axes, or its mass at the mechanism's length, is taken
 * for none where nothing acts along the turn and the deck starts none.
 *
 * M^ of (2-4) is singular along them.  Where nothing acts along them either they are no part of the motion, and are held
 * still: with S the spins e.w [n of them] of as many bodies about an axis e for which they have no inertia,
 *
 *     (M^ + S' J S) a = Q^
 *
 * has the accelerations of M^ a = Q^ for which the spins do not change, whatever J is.  For v in the null space of M^,
 * v' S' J S a = v' Q^ = 0; so spins that begin with 0 stay 0, and J enters neither forces nor energies.
 *
 * They are found by direction, not by coordinate.  With S and J of all axes without inertia,
 *
 *     B = 1 - J^1/2 S (M^ + S' J S)^-1 S' J^1/2
 *
 * is singular along J^1/2 S v for each null vector v of M^, and for no other; its elimination with pivots leaves as many
 * spins as it has null vectors, which then tell these apart. */
#ifndef FMDSUB_SYSTEM_IDLE_H
#define FMDSUB_SYSTEM_IDLE_H

#include <stdbool.h>

#include "system/system.h"

struct idle_turn {
    int body;       /* of the model */
    double axis[3]; /* unit, body axes */
    double inertia; /* by which it is held [kg m2] */
    double real;    /* that of the body itself, to which it is added: 0, or next to nothing */
    bool given;     /* the deck says how fast the body's joint moves at the start */
    double dropped; /* of its rate at the start [rad/s] */
};

struct idle {
    const struct model *model;
    int n;
    struct idle_turn *turn; /* [n] */
};

/* The turns of s, which is of m.  Where there are any, m's bodies hold them from now on, and s is to be built anew. */
void idle_find(struct idle *o, struct system *s, const struct model *m, double t1, struct arena *life);

/* Does something act along them at q, near it, or at any time until t1?  pushed [n of them]; the first, -1: none. */
int idle_pushed(bool *pushed, const struct idle *o, struct system *s, const double *q, double t, double t1);

/* v := v without them. */
void idle_still(struct idle *o, struct system *s, const double *q, double *v, double t);

/* K [n x n] := P' K P + k S' S, P being motion without them: what acts on all else, and k on them. */
void idle_clear(const struct idle *o, struct system *s, double *K, double k, const double *q, double t);

/* The energy that is in them at the last system_energy_at() [J]; *most: where most of it is. */
double idle_energy(int *most, const struct idle *o, const struct system *s);

#endif
