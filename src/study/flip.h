/* flip.h -- a deck run with an effect and without it: what that costs, and what it changes. */
#ifndef FMDSUB_STUDY_FLIP_H
#define FMDSUB_STUDY_FLIP_H

#include "study/outcome.h"

struct flip {
    struct outcome kept; /* but for its work, CPU time and share of energy; seconds: with those of the books */
    struct outcome_column *column; /* [kept.n] */
    double until;                  /* when it ended [s] */
    double spin;                   /* fastest turn of a flexible body's frame at a record [rad/s] */
    struct sim sim;
};

/* Of scene as its plan says, to `until` (0: its end).  Fails where it does not open. */
enum status flip_run(struct flip *o, const struct scene *scene, double until, struct diags *diags, struct arena *life,
                     struct report *report);

/* The largest change of a column over its largest value in a, over the time that both ran, and whose; NULL: there is no
 * column to compare.  What is round-off beside the columns of its unit is none.  NAN: they share no time but the start. */
double flip_change(const char **column, const struct flip *a, const struct flip *b);

#endif
