/* reference.h -- what the runs of a study are compared with, and how far it is to be trusted.
 *
 * Two runs by different schemes of high order: those two of all that short trials foretell to be the cheapest at a
 * tolerance of 1e-11.  Where the coordinates of both part by more than a thousandth of their range the motion cannot be
 * foretold any longer (chaos, or a scene that neither resolves): the horizon ends there.  What they differ by up to it is
 * the uncertainty of each column; a column in which that is above a hundredth of its range is not compared, nor one that is
 * round-off beside the other columns of its unit.
 *
 * With rigid contacts, which only midpoint takes, it is that by two tolerances, 1e-8 and 1e-7 where the budget allows.
 *
 * Where the budget does not allow as much the second is content with a larger tolerance, then both, then the end of the
 * run is brought forward.  Runs that turn out to be much dearer than foretold are left, and two chosen anew by what they
 * have cost. */
#ifndef FMDSUB_STUDY_REFERENCE_H
#define FMDSUB_STUDY_REFERENCE_H

#include "study/outcome.h"

enum { MOST_TRIALS = 16 };

struct reference {
    struct outcome run;
    struct setting first, second; /* which two */
    double seconds, work;         /* of the first, by its counts; in evaluations */
    double spent;                 /* [s] of all that it took, likewise */
    int ntrial;
    struct trialled {
        const struct stepper_kind *kind;
        double rate;           /* [s] that an error of about 1e-6 costs per second of the motion, foretold */
    } trial[MOST_TRIALS];      /* [ntrial] */
    double horizon;            /* [s] compared up to here */
    bool whole;                /* the two do not part before the end */
    bool cut;                  /* the budget has brought the end forward */
    double *uncertain;         /* [n] of each column, as a share of its range */
    double *range, *largest;   /* [n] up to the horizon, of values and of |values| */
    double *least;             /* [n] no column is compared by less */
    double apart;              /* the largest uncertainty of a coordinate */
    int left_out;              /* columns of the deck that are not compared, the first: */
    const char *left_out_name; /* NULL: none */
};

/* At a predicted cost of about `most` seconds; INFINITY: none.  subject->until becomes the end that is compared, and
 * columns that are known to neither are not compared any more.  E_NUMERIC: no such run comes to its end, or the horizon
 * is less than a tenth of it; E_LIMIT: `most` does not take it to a record behind the start. */
enum status reference_make(struct reference *o, struct subject *subject, double most, struct arena *life,
                           struct report *report);

/* One run by itself, for reference_left(). */
void reference_alone(struct reference *o, const struct outcome *run, const struct subject *subject, struct arena *life);
/* Has the last row of another one parted from it by more than `parted` of a range? */
bool reference_left(const struct reference *o, const struct outcome *run, double parted, const struct subject *subject);

/* The same from two runs that are there, o->run being one of them: they have parted where coordinates differ by more than
 * `parted` of their range, and columns that differ by more than `uncertain` are not compared. */
void reference_between(struct reference *o, const struct outcome *second, double parted, double uncertain,
                       struct subject *subject, struct arena *life);

/* Is kind among those whose matrices are too large here? */
enum { MOST_DENSE = 200 }; /* coordinates up to which full matrices are the cheaper way */
bool too_full(const struct stepper_kind *kind, const struct subject *subject);

/* What is compared ends at `end` from now on, and ranges are of that part. */
void reference_up_to(struct reference *o, double end);

struct errors {
    double fast, slow;      /* coordinates, over their largest value; NAN: there are none */
    double worst, absolute; /* columns of the deck, over their range, and in the unit of that; NAN: none is compared */
    int column;             /* which; -1: none */
    int instants;           /* that were compared, besides the start */
};
void reference_compare(struct errors *e, const struct reference *o, const struct subject *subject,
                       const struct outcome *run);

#endif
