/* flip.h -- a deck run with an effect and without it: what that costs, and what it changes. */
#ifndef FMDSUB_STUDY_FLIP_H
#define FMDSUB_STUDY_FLIP_H

#include "study/outcome.h"

struct flip {
    struct outcome kept; /* but for its work, CPU time and share of energy; seconds: with those of the books */
    struct outcome_column *column; /* [kept.n] */
    double instructions;           /* that its counts stand for, with those of the books */
    double until;                  /* when it ended [s] */
    double spin;                   /* fastest turn of a flexible body's frame at a record [rad/s] */
    struct sim sim;
};

/* Of scene as its plan says, to `until` (0: its end).  Fails where it does not open. */
enum status flip_run(struct flip *o, const struct scene *scene, double until, struct diags *diags, struct arena *life,
                     struct report *report);

/* The largest value of column i of a, which is k of b, but no less than what round-off is beside others of its unit; where
 * all of them stay at 0, its largest in b. */
double flip_usual(const struct flip *a, int i, const struct flip *b, int k);
/* The column of that name; -1: there is none. */
int flip_column(const struct flip *o, const char *name);

/* The largest change of a column over its largest value in a, over the time that both ran, and whose; NULL: there is no
 * column to compare.  What is round-off beside the columns of its unit is none.  NAN: they share no time but the start. */
double flip_change(const char **column, const struct flip *a, const struct flip *b);

#endif
