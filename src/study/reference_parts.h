/* reference_parts.h -- what the files of reference.h share.
 *
 *     reference.c         the two runs, where they part, errors of other runs against them
 *     reference_choice.c  which two schemes, at which tolerances, up to which time */
#ifndef FMDSUB_STUDY_REFERENCE_PARTS_H
#define FMDSUB_STUDY_REFERENCE_PARTS_H

#include "study/reference.h"

/* Schemes of high order that may be the reference, and what each costs. */
struct candidates {
    int n; /* 0: rigid contacts, which only midpoint takes */
    struct candidate {
        struct setting setting; /* with the tolerance of the run that `rate` is from */
        double rate;            /* cost of a second of the motion [s]; INFINITY: it does not run */
        double cost;            /* of its trial [s] */
    } of[MOST_TRIALS];          /* [n] */
    double most;                /* what each trial may cost [s] */
    double spent;               /* by all of them [s] */
    double until;               /* end of the deck [s] */
    const struct subject *subject;
};

/* Runs the trials; `most` as for reference_make(). */
enum status reference_candidates(struct candidates *among, struct reference *o, const struct subject *subject,
                                 double most, struct arena *life, struct report *report);

/* From now on the cost of the scheme of `setting` is predicted from this run of it. */
void candidates_learn(struct candidates *among, const struct setting *setting, const struct outcome *run);

/* Fills o->first, o->second and subject->until, from the rates of the candidates and what is left of `most`.
 * E_NUMERIC: there are no two that run. */
enum status reference_choose(struct reference *o, const struct candidates *among, struct subject *subject, double most,
                             struct arena *life, struct report *report);

#endif
