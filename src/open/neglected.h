/* neglected.h -- what effects that were left out of a flexible body would do to its coordinates, at a state of the run.
 *
 * Stiffening: the forces of its second-order displacements, of inertia and at its nodes.  Damping: its power.  Of a body in
 * its free vibration a share lambda = |sum q.d|/sum q.Kq of the stiffness shifts the frequency by half of it, which adds up
 * as phase; a rate mu = sum v.Dv/sum v.Mv takes energy (see effects in fmdsub-deck(5)). */
#ifndef FMDSUB_OPEN_NEGLECTED_H
#define FMDSUB_OPEN_NEGLECTED_H

#include "model/model.h"

struct neglected;
/* NULL: nothing was left out of the body that is known. */
struct neglected *neglected_open(const struct model_body *b, struct arena *life);
bool neglected_stiffens(const struct neglected *o);
bool neglected_damps(const struct neglected *o);

/* How the body moves, in axes of its frame: a with gravity in it as upward acceleration. */
struct neglected_motion {
    const double *a, *w, *al;  /* [3] each */
    const double *q, *q1, *q2; /* [n] each */
};
/* Begins with the inertia's share; adds what acts on a node, a force f and a moment n, body axes. */
void neglected_inertia(struct neglected *o, const struct neglected_motion *x);
void neglected_load(struct neglected *o, int node, const double *f, const double *n, const double *q);

/* sum q.d, sum q.Kq, sum v.Dv, sum v.Mv. */
struct neglected_sums {
    double work, stiff, power, inertia;
};
void neglected_sum(struct neglected_sums *to, const struct neglected *o, const double *q, const double *q1);

#endif
