/* grid.h -- what is run: one chain a scheme, from its coarsest setting to its finest. */
#ifndef FMDSUB_STUDY_GRID_H
#define FMDSUB_STUDY_GRID_H

#include "study/study.h"

struct chain {
    int n, capacity;
    struct setting *setting; /* [n] */
    bool ladder;             /* nobody has asked for these: it ends where finer ones are of no use */
    int from;                /* the first that is still to be run */
    double last;             /* [s] what the one before that has cost */
};

struct grid {
    int n, capacity;
    struct chain *chain; /* [n] */
};

/* The deck's own setting, if it names one, then chains by scheme.  E_USAGE: a scheme was asked for that has no step here. */
enum status grid_make(struct grid *o, const struct study_options *options, const struct subject *subject,
                      struct arena *life, struct report *report);

/* What the deck itself says; false: neither a step nor a tolerance. */
bool grid_own(struct setting *o, const struct subject *subject);
bool grid_same(const struct setting *a, const struct setting *b);

/* How much more work the setting `next` of a chain is than `last`, as a factor. */
double grid_growth(const struct setting *last, const struct setting *next);

#endif
