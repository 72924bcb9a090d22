/* reference_parts.h -- what the files of reference.h share.
 *
 *     reference.c         the two runs, where they part, what is compared with them
 *     reference_choice.c  which two, at which tolerance, how far */
#ifndef FMDSUB_STUDY_REFERENCE_PARTS_H
#define FMDSUB_STUDY_REFERENCE_PARTS_H

#include "study/reference.h"

/* Schemes of high order, and what each costs. */
struct candidates {
    int n; /* 0: rigid contacts, which are midpoint's alone */
    struct candidate {
        struct setting setting; /* the tolerance that its rate is of */
        double rate;            /* cost per second of the motion; INFINITY: it does not run */
        double cost;            /* [s] of its trial */
    } of[MOST_TRIALS];          /* [n] */
    double most;                /* [s] each trial */
    double spent;               /* [s] by all of them */
    double until;               /* [s] the end of the deck */
    const struct subject *subject;
};

/* Runs the trials; `most` as for reference_make(). */
enum status reference_candidates(struct candidates *among, struct reference *o, const struct subject *subject,
                                 double most, struct arena *life, struct report *report);

/* What a run by the kind of `setting` has cost is what it is foretold by from now on. */
void candidates_learn(struct candidates *among, const struct setting *setting, const struct outcome *run);

/* Fills o->first and o->second, and subject->until: from the trials, what has been learned, and what is left of `most`.
 * E_NUMERIC: there are no two. */
enum status reference_choose(struct reference *o, const struct candidates *among, struct subject *subject, double most,
                             struct arena *life, struct report *report);

#endif
