/* price.h -- what a run costs, from what it counts: evaluations and factorizations at fixed prices by what they sweep.
 *
 * The prices are constants of the program, measured once on 60 decks (price.c), so that what follows from them is the
 * same on every machine and whatever else that does; CPU seconds on a machine like that one are a third off, rms. */
#ifndef FMDSUB_STUDY_PRICE_H
#define FMDSUB_STUDY_PRICE_H

#include "sim/sim.h"

struct price {
    double evaluation;       /* of all bodies [s] */
    double full, structured; /* a matrix of all coordinates for all stages, one that knows the structure [s] */
    double rows;             /* equations that close loops */
    double fast;             /* an evaluation of the fast part, as a share of all */
    double balance;          /* of the momenta of what floats, as a share of an evaluation */
    double look;             /* at the energies after a major step [s] */
};

/* Of an open run, which is of no other use: it looks at its loops. */
void price_find(struct price *o, const struct sim *sim);
/* The same in instructions instead of seconds, by the table that `make prices` counts: for telling, not for choosing. */
void price_count(struct price *o, const struct sim *sim);

double price_seconds(const struct price *o, const struct stepper_kind *kind, const struct effort *e);
/* The same, and what momenta and energies take besides, which those prices have as a usual share. */
double price_whole(const struct price *o, const struct stepper_kind *kind, const struct effort *e);

#endif
