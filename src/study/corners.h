/* corners.h -- times, known before a run, at which loads or drives bend or jump, and steps that end at all of them.
 *
 * A fixed step that goes over one is of first order there, or misses a pulse whole, and how much it misses is a matter of
 * where in it the corner lies. */
#ifndef FMDSUB_STUDY_CORNERS_H
#define FMDSUB_STUDY_CORNERS_H

#include "sim/sim.h"

struct corners {
    int n;
    double *t;    /* [n] ascending, behind `start` and before `until` [s] */
    double start; /* of the run */
    bool more;    /* there are more than anybody wants to step onto */
};

/* Of a run that is open and stands at its start. */
void corners_find(struct corners *o, const struct sim *sim, double until, struct arena *life);

/* The least number of steps to an interval `every` from the start by which all corners are ends of steps; 1: there is no
 * corner; 0: there is no such number, or a very large one. */
double corners_grid(const struct corners *o, double every);

/* Does a run with such a step, as it is read from a deck, meet them all to the last digit?  *first: one that it does not. */
bool corners_met(const struct corners *o, double step, double *first);

/* The least multiple of a and of b: whole numbers; 0: too large. */
double corners_both(double a, double b);

#endif
