/* left_out.h -- a run whose deck turns effects off, and for each a second one with it: what leaving it out changes.
 *
 * A sink between the run and where it writes to.  It keeps the records, of five seconds by price at most; behind the
 * run's end as much is run with each effect that is off and may matter, and both are compared, column by column.  What is
 * watched at records as it is (sim/neglects.h), on all bodies, and stays far from the tolerance of `effects` (1.0e-3 where
 * it has none), is run no second time.
 *
 * Less than that says nothing: foretold from a tenth of the run, by how the change grew there, half the shares of 24 runs
 * were wrong by more than 3, some by hundreds. */
#ifndef FMDSUB_STUDY_LEFT_OUT_H
#define FMDSUB_STUDY_LEFT_OUT_H

#include "study/flip.h"

struct left_out {
    struct sink sink; /* for the run */
    struct sink *to;
    struct sim *sim; /* the run; open */
    /* Reads the deck once more, all it says against these effects (effect_bit()) unheard. */
    enum status (*load)(struct scene **scene, void *self, unsigned unheard, struct arena *life);
    void *self; /* of load */
    struct flip first;
    struct price price;
    bool cut; /* not all records have been kept */
    struct arena *own;
};

/* sink: o->sink, or `to`, where nothing is left out that could be watched so. */
struct sink *left_out_open(struct left_out *o, struct sim *sim, struct sink *to, struct arena *life);

#endif
