/* missed.h -- the sizes of the local errors of all steps of a run, summed for every coordinate and velocity.
 *
 * Let a scheme of order p have a phase error of c (omega h)^(p+1) in a step h (stepper_kind.late).  With D the
 * difference from step to step its local error is
 *
 *     c h D^p v   in the positions,      c D^(p+1) v   in the velocities.
 *
 * With fixed steps these differences are taken in bursts of p + 2 successive velocities: one burst after the other
 * at the start of a run, then more and more seldom; each stands for all steps since the burst before.  Schemes that
 * estimate their local errors themselves add them with missed_add().
 *
 * For a vibration the sum is the accumulated phase error, within a factor of 2: local errors keep their size and add
 * up.  What of them is along the motion is a delay, and these add up as such: where nothing depends on time by itself an error
 * of that kind grows and shrinks as the motion is quick and slow, as of a mechanism that comes to rest before it is whipped
 * round.  The sum is too small where errors grow by themselves (chaos), and too large where the motion forgets them
 * (damping). */
#ifndef FMDSUB_ENGINE_MISSED_H
#define FMDSUB_ENGINE_MISSED_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/recall.h"
#include "system/ode2.h"

enum { MISSED_ORDER = 4 }; /* the highest of a scheme of fixed steps */

struct missed {
    int n;
    double *position, *velocity;             /* [n] sums of |local error| */
    double signed_position, signed_velocity; /* with one degree of freedom: sums with their signs */
    long steps;                              /* taken so far */
    long told;                               /* of these, for which the sums stand */
    long next;                               /* number of the step with which the next burst begins */
    int seen;                                /* velocities so far in the burst under way */
    double h;                                /* its step [s] */
    double *v[MISSED_ORDER + 2];             /* [n] its velocities, then their differences */
    double *way, *extent;                    /* [n] displacement so far, and its largest, in usual sizes */
    double late;                             /* sum of the delays by steps [s] */
    double fastest, steepest;             /* largest sums of squares of velocities and accelerations, in usual sizes */
    double *before[2];                    /* [n] position, velocity before the last burst was added, */
    double signed_before[2], late_before; /* and their signed ones, the delay; */
    long told_before, next_before;        /* and these */
    double *a, *bend;                     /* [n] scratch */
};

void missed_open(struct missed *o, int n, struct arena *life);

/* A step of fixed length begins: is it one of a burst? */
static inline bool missed_looks(struct missed *o)
{
    return o->steps++ >= o->next;
}
/* Such a step of length h.  The burst begins anew where h has changed, or afresh: where the motion has (an event, a
 * chart). */
void missed_begin(struct missed *o, bool afresh, double h);
/* Then, for schemes of one rate: velocities [n] at its start; at its end, with the order p and the factor c of the
 * scheme.  straight: what its straight ways miss of rotations is a part of that in the positions, with 1/12 for c where p is 2
 * or less. */
void missed_before(struct missed *o, const double *v);
void missed_after(struct missed *o, const struct ode2 *ode, const double *v, int order, double late, bool straight);
/* For schemes that are not symmetric in time, whose energy drifts by `part` of their local errors: over a time h at
 * velocities v [n], errors of velocities change frequencies and so go on into errors of positions. */
void missed_drift(struct missed *o, const struct ode2 *ode, const double *v, double h, double part);
/* The same of errors of velocities `off` [n] alone. */
void missed_moved(struct missed *o, const struct ode2 *ode, const double *v, double h, const double *off);
/* The burst begins anew: the motion has changed. */
void missed_break(struct missed *o);
/* Adds the local errors [n], of any sign, of one step with velocities v and accelerations a [n], that stands for all since the
 * last call. */
void missed_add(struct missed *o, const struct ode2 *ode, const double *position, const double *velocity,
                const double *v, const double *a);
/* The last step has gone over an edge of a force, for which the differences of a burst cannot stand: it begins anew, and if it has
 * ended with that step, that does not count; unless one is long overdue. */
void missed_crossed(struct missed *o);
/* What one step of H has left in velocities [n], sizes, which no other one stands for. */
void missed_once(struct missed *o, const double *velocity, double H);
/* The sums have been transformed to a new chart: signs do not count, displacements begin anew. */
void missed_rechart(struct missed *o);
void missed_recall(struct missed *o, struct recall *r);

#endif
