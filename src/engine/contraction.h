/* contraction.h -- how a simplified Newton iteration will contract, as the steps before have shown it.
 *
 * The norm of the corrections need not fall evenly: what is large at first may vanish at once and leave a small part
 * that converges slowly, and errors may go round between blocks of unknowns.  So what is left after an iteration is
 * not given by the last quotient theta_k = |dz_k| / |dz_k-1|, but by theta_k+1.  After the first two iterations the
 * largest stands for it that the steps before have shown at the same place, older ones fading; and that much more as
 * this step has come out worse than foreseen so far; or, where it has come out far better, what was foreseen: the slow
 * part of the error is still there.  What has not been seen for some steps is trusted less and less, and what was never
 * seen is the root of what is seen.  A new matrix has what new matrices had before: that may be long ago, and have been
 * at rest, so that before a step has shown a quotient itself not any is believed. */
#ifndef FMDSUB_ENGINE_CONTRACTION_H
#define FMDSUB_ENGINE_CONTRACTION_H

#include "base/recall.h"

/* theta after so many iterations; 0: not known. */
struct prospect {
    double known, ahead; /* as seen; as trusted by now */
};

enum { CONTRACTION_PLACES = 2 };

struct contraction {
    struct prospect old[CONTRACTION_PLACES], anew[CONTRACTION_PLACES]; /* of a kept and of a new matrix */
    double seen[CONTRACTION_PLACES];                                   /* in this step */
    double theta;                                                      /* of the iteration before */
    int at, fresh; /* iterations done in this step with this matrix; it is new */
};

void contraction_forget(struct contraction *o);
/* A step begins; a new matrix. */
void contraction_begin(struct contraction *o);
void contraction_renewed(struct contraction *o);
/* The next quotient to expect; theta: of this iteration, not read at the first, where none below `hearsay` is
 * believed. */
double contraction_after(struct contraction *o, double theta, double hearsay);
void contraction_recall(struct contraction *o, struct recall *r);

#endif
