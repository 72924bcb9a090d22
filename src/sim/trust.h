/* trust.h -- the estimated error of a run, from the local errors of its own steps.
 *
 * engine/missed.h sums the sizes of local errors, of every coordinate and velocity.  At a few records of the run the
 * state is displaced by a small part of these sums, with signs drawn at random, and the columns are evaluated there.
 * The estimated error of a column is the root mean square of its change over the draws, scaled back to the whole
 * sums, relative to the range of the column in the run; or, where it is larger and nothing depends explicitly on time, its
 * change in the delay by the steps so far.  Where small differences grow all along the run (growth.c) errors do, too: it is
 * taken that they grow in proportion to time, as along an orbit, which is the least.
 *
 * The motion keeps the sum of the energies, random signs do not: an energy is taken to change by no more than the other
 * energies do, plus what the run's balance and works leave open.
 *
 * With one degree of freedom, no contacts and no drives, errors are propagated along the motion instead (engine/tangent.h);
 * where forces bend or jump, the larger of both counts. */
#ifndef FMDSUB_SIM_TRUST_H
#define FMDSUB_SIM_TRUST_H

#include <stdbool.h>

#include "system/system.h"

enum { TRUST_PLACES = 6, TRUST_APART = 2 }; /* states at which columns are displaced: evenly spaced, and others */
static const double TRUST_GROWN = 3;        /* small differences that grow by exp(3) over the run are worth a word */

struct trust {
    /* Gathered with the records. */
    double *low, *high;    /* [columns] least and largest value of a column so far */
    double *mean, *spread; /* [columns] of its values, and the sum of their squared distances from it */
    bool *compared;        /* [columns] is it compared by its error? */
    bool asked;            /* is any column compared by its error at all? */
    int n;                 /* states kept in place[] for the end, */
    long every, seen;      /* one of every so many records; records so far */
    struct trust_place {
        double t;
        long chart;                      /* system_charts() at the time: sums of another chart are not comparable */
        double *q, *v;                   /* [nq], [n] state */
        double *position, *velocity;     /* [n] sums of local errors up to there */
        double late, *a;                 /* delay by them [s], accelerations [n] there or where the step ends */
    } place[TRUST_PLACES + TRUST_APART]; /* the last ones besides: where accelerations, and where rare values of columns
                                          * times errors are largest, */
    double most[TRUST_APART];            /* and these */
    double worked;                       /* sum of |work| over all channels, the largest at a record [J] */

    /* Scratch at the end of the run. */
    double *base, *sum;    /* [columns] values at a place; sum over the draws of their squared changes */
    double *top;           /* [n] largest |velocity| at a record so far */
    double *dq, *dv;       /* [n] displacement, velocity */
    struct energies there; /* at a place, not displaced */

    /* The estimate. */
    double *off;     /* [columns] error, in units of the column: the largest of the places */
    double growth;   /* least growth rate of small differences at the places [1/s]; 0: not all grow; NAN: not known */
    bool known;      /* is `worst` an estimate? */
    const char *why; /* why the steps cannot tell; NULL: they can */
    double worst;    /* largest error relative to the column's range */
    int column;      /* the column of `worst`, among those written; -1: none */
    int still;       /* first column that changes by no more than its own error; -1: none */
    double beyond;   /* largest error relative to what a tolerance refers to, size or range: trust_told.c */
    int farthest;    /* the column of `beyond` */
};

#endif
