/* works.h -- the works of a step, held by the tolerance as its motion is.
 *
 *     err = max |e_c| / (tol (E + sum |work|)) <= 1,
 *
 * e_c the error of channel c, sum over all channels and steps so far, this one included; E the largest kinetic energy that
 * is known, drives' included, with the speed added of what all but stands (adaptive.h).  It is asked for where works may
 * make a step shorter, once in H.  Where errors do not fall with the square of the step, as they do not where
 * powers are round-off, E becomes what they are below; what is more than that, as of a power that jumps, is held. */
#ifndef FMDSUB_ENGINE_WORKS_H
#define FMDSUB_ENGINE_WORKS_H

#include "engine/adaptive.h"

void works_open(struct works *o, int n, struct arena *life);
/* A step has been taken; works of H before and after it. */
void works_taken(struct works *o, const double *before, const double *after);
/* E + sum |work| at the state, at t [J]. */
double works_scale(struct stepper *s, double t);

#endif
