/* missed.h -- what the steps of a run have missed: the sizes of their local errors, summed, of every coordinate.
 *
 * A scheme of order p that is late by the part c of (omega h)^(p+1) leaves in a step h, with differences of velocities from
 * step to step,
 *
 *     c h D^p v   in the positions,      c D^(p+1) v   in the velocities.
 *
 * A scheme of fixed steps is looked at in bursts of p + 1 steps, one behind the other at the start of a run, ever more apart
 * later; what is found stands for the steps since the burst before.  Other schemes know their local errors and tell them.
 *
 * Of a vibration the sum is what it is late by, within a factor of 2: errors stay as large as they were made, and add up.
 * Where they grow on their own (chaos) it is too small, where the motion forgets them too large. */
#ifndef FMDSUB_ENGINE_MISSED_H
#define FMDSUB_ENGINE_MISSED_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/recall.h"
#include "system/ode2.h"

enum { MISSED_ORDER = 4 }; /* the highest of a scheme of fixed steps */

struct missed {
    int n;
    double *position, *velocity;             /* [n] sums */
    double signed_position, signed_velocity; /* of one freedom, the same with their signs */
    long steps;                              /* looked for so far */
    long told;                               /* of these, for which the sums stand */
    long next;                               /* the step with which the next burst begins */
    int seen;                                /* velocities in it */
    double h;                                /* their distance */
    double *v[MISSED_ORDER + 2];             /* [n] these; then their differences */
    double *way, *extent;                    /* [n] displacement so far, and its largest, in usual sizes */
};

void missed_open(struct missed *o, int n, struct arena *life);

/* A step of a scheme of fixed steps begins; is it one to look at? */
static inline bool missed_looks(struct missed *o)
{
    return o->steps++ >= o->next;
}
/* Such a step h; afresh: the past is no longer that of this motion, nor is it where h is another. */
void missed_begin(struct missed *o, bool afresh, double h);
/* Of one rate: velocities [n] at its start, at its end. */
void missed_before(struct missed *o, const double *v);
void missed_after(struct missed *o, const double *v, int order, double late);
/* Errors of velocities go on into positions for a time h, at velocities v [n], usual sizes of coordinates by ode: of schemes
 * that do not go back the way that they came, and so let the energy drift by `part` of what they leave in it. */
void missed_drift(struct missed *o, const struct ode2 *ode, const double *v, double h, double part);
/* The past is no longer that of this motion. */
void missed_break(struct missed *o);
/* Local errors [n], of any sign, of one step that stands for all since the last one that was told. */
void missed_add(struct missed *o, const double *position, const double *velocity);
/* A new chart has taken the sums along. */
void missed_rechart(struct missed *o);
void missed_recall(struct missed *o, struct recall *r);

#endif
