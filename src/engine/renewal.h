/* renewal.h -- when a kept iteration matrix is worth another.
 *
 * A matrix of age T has taken e_1 + .. + e_T iterations more than new ones do.  A renewal at the price of R evaluations
 * every T steps costs (R + e_1 + .. + e_T) / T a step, and where the excess grows evenly with age this is least when
 * e_1 + .. + e_T = R.  Iterations are those that the step would have taken at its mean contraction, a number without
 * jumps.
 *
 * What a new matrix needs is learnt from the first step after each renewal, and hoped to be a little less as time goes
 * by, so that one that was made at a bad moment is not the measure for ever.
 *
 * What it buys: evaluations without it, a matrix being kept until its contraction is above 0.3, in percent more, on the
 * shipped decks as they are (those at 0 are sub-cycled, and renew their masses in each step), before broyden.h:
 *
 *     chain +46, bar-slider 0, stiff-leaf-chain 0, four-bar +14, spin-up +25, cantilever +4, flexible-crank +258,
 *     axle +16, andrews +15, whip +118, double-pendulum 0, heavy-top -1 */
#ifndef FMDSUB_ENGINE_RENEWAL_H
#define FMDSUB_ENGINE_RENEWAL_H

#include "base/recall.h"

struct renewal {
    double price;  /* R */
    double need;   /* iterations with a new matrix; 0: not known */
    double wasted; /* sum of e since the last renewal */
    double once;   /* e_1, as it was seen last */
    double young;  /* the lesser of the last two: above R, a matrix serves for one step */
    int age;       /* steps since the last renewal */
};

void renewal_forget(struct renewal *o, double price);
/* Iterations that it takes from a first correction down to the tolerance where count iterations bring it, or the root
 * of its energy, down by the factor fall.  Logarithms are those of straight lines between powers of two: the same bits
 * everywhere. */
double renewal_need(double first, double tolerance, double fall, int count);
/* A step has taken that many; fresh: its matrix was new.  1: another is due. */
int renewal_due(struct renewal *o, double need, int fresh);
void renewal_recall(struct renewal *o, struct recall *r);

#endif
