/* trust.h -- how far a run is off, as its own steps tell.
 *
 * engine/missed.h sums what steps leave in coordinates and rates.  At a few records the state is moved by a small part of
 * that, each coordinate this way or that, and each column tells what it makes of it: its root mean square over some draws,
 * over the column's range in the run.  Of energies no more than what the others are moved by, and what the run's balance and works
 * leave open: the sum is kept by the motion, not by what is drawn.
 *
 * Of one freedom, where nothing touches, nothing depends on the time by itself and only potentials do work, errors are followed as the
 * motion takes them along (engine/tangent.h), and that is told where it is more than the sums. */
#ifndef FMDSUB_SIM_TRUST_H
#define FMDSUB_SIM_TRUST_H

#include <stdbool.h>

#include "system/system.h"

enum { TRUST_PLACES = 6 };
static const double TRUST_GROWN = 3; /* logarithm of what small differences may have grown by */

struct trust {
    double *low, *high; /* [columns] over the records */
    bool asked;         /* is there a column of the motion? */
    int n;              /* records kept for the end, */
    long every, seen;   /* one of so many; records so far */
    struct trust_place {
        double t;
        long chart;                          /* of system_charts() */
        double *q, *v, *position, *velocity; /* [nq], [n], what was missed up to there [n] */
    } place[TRUST_PLACES];
    double *base, *sum; /* [columns] values at a place; squares of what they are moved by */
    double worked;      /* sum of |work| of all channels, the largest at a record [J] */
    double *dq, *dv;    /* [n] */
    double *off;        /* [columns] largest at a place */

    struct energies there; /* at a place */

    double
        growth; /* least of small differences at the places [1/s]; 0: they do not grow everywhere; NAN: not looked at */
    bool known;
    const char *why; /* not */
    double worst;    /* over its range */
    int column;      /* of the chosen ones; -1: none */
    int still;       /* the first that changes by no more than its error; -1: none */
    double beyond;   /* the largest error over what a tolerance is of: ranges, or sizes where these have an origin */
    int farthest;    /* its column */
};

#endif
