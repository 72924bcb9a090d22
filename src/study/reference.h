/* reference.h -- what the runs of a study are compared with, and how far it is to be trusted.
 *
 * Two runs of high order by different schemes.  Where the coordinates of both part by more than a thousandth of their
 * range the motion cannot be foretold any longer (chaos, or a scene that neither resolves): the horizon ends there.  What
 * they differ by up to it is the uncertainty of each column; a column in which that is above a hundredth of its range
 * is not compared. */
#ifndef FMDSUB_STUDY_REFERENCE_H
#define FMDSUB_STUDY_REFERENCE_H

#include "study/outcome.h"

struct reference {
    struct outcome run;
    const char *scheme, *second; /* which two */
    bool small;                  /* full matrices of all coordinates are the cheaper way */
    double horizon;              /* [s] compared up to here */
    bool whole;                  /* that is the end of the run */
    double *uncertain;           /* [n] of each column, as a share of its range */
    double *range, *largest;     /* [n] up to the horizon, of values and of |values| */
    double apart;                /* the largest uncertainty of a coordinate */
    int left_out;                /* columns of the deck that are not compared, the first: */
    const char *left_out_name;   /* NULL: none */
};

/* every: the time between records [s].  E_NUMERIC: no such run comes to its end, or the horizon is less than a tenth of
 * it. */
enum status reference_make(struct reference *o, const struct scene *scene, double every, const char *version,
                           struct diags *diags, struct arena *life, struct report *report);

struct errors {
    double fast, slow; /* coordinates, over their largest value; NAN: there are none */
    double worst;      /* columns of the deck, over their range; NAN: none is compared */
    int column;        /* which; -1: none */
    int instants;      /* that were compared, besides the start */
};
void reference_compare(struct errors *e, const struct reference *o, const struct outcome *run);

#endif
