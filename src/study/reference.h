/* reference.h -- the reference solution that the runs of a study are compared with, and its uncertainty.
 *
 * It is made of two runs by different schemes of high order, the two that short trials predict to be the cheapest at
 * a tolerance of 1e-11.  Where coordinates of the two part by more than a thousandth of their range the motion
 * cannot be predicted any further (chaos, or a motion that neither resolves): the horizon ends there.  Up to the
 * horizon the difference of the two is the uncertainty of each column.  A column in which it is above a hundredth of
 * the range is not compared, nor is one that is round-off beside the other columns of its unit.
 *
 * With rigid contacts, which only midpoint takes, the two runs are by midpoint at two tolerances, 1e-8 and 1e-7
 * where the budget allows.
 *
 * Where the budget is too small the second run takes a larger tolerance, then both do, then the end of the run is
 * brought forward.  Two runs that turn out to be much dearer than predicted are broken off, and two are chosen anew
 * by what those have cost. */
#ifndef FMDSUB_STUDY_REFERENCE_H
#define FMDSUB_STUDY_REFERENCE_H

#include "study/outcome.h"

enum { MOST_TRIALS = 16 };

struct reference {
    struct outcome run;           /* the first run: the reference itself */
    struct setting first, second; /* of the two runs */
    double seconds, work;         /* cost of the first: predicted from its counts [s]; evaluations */
    double spent;                 /* cost of all runs and trials, likewise [s] */
    int ntrial;
    struct trialled {
        const struct stepper_kind *kind;
        double rate;           /* predicted cost of a second of the motion at a tolerance of 1e-6 [s] */
    } trial[MOST_TRIALS];      /* [ntrial] */
    double horizon;            /* time up to which is compared [s] */
    bool whole;                /* the two do not part before the end */
    bool cut;                  /* the budget has brought the end forward */
    double *uncertain;         /* [n] uncertainty of each column, relative to its range */
    double *range, *largest;   /* [n] largest less least value, largest |value|, up to the horizon */
    double *least;             /* [n] errors are relative to no less than this: round-off of the column */
    double apart;              /* largest uncertainty of a coordinate */
    int left_out;              /* columns of the deck that are not compared, */
    const char *left_out_name; /* the first of them; NULL: none */
};

/* Makes a reference at a predicted cost of about `most` seconds; INFINITY: any.  subject->until becomes the end up
 * to which is compared, and columns that are too uncertain are not compared any more.  E_NUMERIC: no two runs come
 * to an end, or the horizon is less than a tenth of the run; E_LIMIT: `most` does not suffice for one record behind
 * the start. */
enum status reference_make(struct reference *o, struct subject *subject, double most, struct arena *life,
                           struct report *report);

/* A reference of one run alone, without uncertainties, for reference_left(). */
void reference_alone(struct reference *o, const struct outcome *run, const struct subject *subject, struct arena *life);
/* Does the last row of `run` differ from it, in a coordinate, by more than `parted` of the range? */
bool reference_left(const struct reference *o, const struct outcome *run, double parted, const struct subject *subject);

/* A reference from o->run, which is there, and a second run: they part where coordinates differ by more than
 * `parted` of their range; columns that differ by more than `uncertain` of theirs are not compared. */
void reference_between(struct reference *o, const struct outcome *second, double parted, double uncertain,
                       struct subject *subject, struct arena *life);

/* Does the scheme form full matrices that are too large for the coordinates of this deck? */
enum { MOST_DENSE = 200 }; /* coordinates up to which full matrices are the cheaper way */
bool too_full(const struct stepper_kind *kind, const struct subject *subject);

/* From now on is compared up to time `end` only; ranges become those of that part. */
void reference_up_to(struct reference *o, double end);

/* Errors of a run, the largest over the records that it has in common with the reference. */
struct errors {
    double fast, slow; /* of fast and of slow coordinates, relative to their largest |value|; NAN: there are none */
    double worst,
        absolute; /* of the deck's columns, relative to their range, and in their unit; NAN: none is compared */
    int column;   /* of `worst`; -1: none */
    int instants; /* records that were compared, besides the start */
};
/* INFINITY: the run has stopped before the horizon. */
void reference_compare(struct errors *e, const struct reference *o, const struct subject *subject,
                       const struct outcome *run);

#endif
