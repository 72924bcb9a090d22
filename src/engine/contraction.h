/* contraction.h -- predicts the contraction of a simplified Newton iteration from the steps before.
 *
 * The corrections need not decrease evenly: a large part of the error may vanish at once and leave a small part that
 * converges slowly, and errors may circulate between blocks of unknowns.  So the error left after an iteration does
 * not follow from the last quotient theta_k = |dz_k| / |dz_k-1|, but from the next one, theta_k+1, which has to be
 * predicted.
 *
 * For the first two iterations of a step the prediction is the largest theta that earlier steps have shown after the
 * same iteration, older ones fading.  It is raised by as much as this step has come out worse than predicted so far;
 * where the step has come out far better the prediction stands, since the slow part of the error is still there.  A
 * prediction that has not been confirmed for some steps is trusted less and less; where there is none it is the root
 * of the quotient seen.  A new matrix takes the predictions from earlier new matrices.  These may be old, and from a
 * time at rest, so that before the step has shown a quotient itself they are believed to a limit only. */
#ifndef FMDSUB_ENGINE_CONTRACTION_H
#define FMDSUB_ENGINE_CONTRACTION_H

#include "base/recall.h"

/* A prediction of theta; 0: there is none. */
struct prospect {
    double known, ahead; /* as it was seen; as it is trusted by now */
};

enum { CONTRACTION_PLACES = 2 };

struct contraction {
    struct prospect old[CONTRACTION_PLACES], anew[CONTRACTION_PLACES]; /* of a kept and of a new matrix */
    double seen[CONTRACTION_PLACES];                                   /* in this step */
    double theta;                                                      /* of the iteration before */
    int at, fresh; /* iterations done in this step with this matrix; it is new */
};

void contraction_forget(struct contraction *o);
/* A step begins; the matrix is new. */
void contraction_begin(struct contraction *o);
void contraction_renewed(struct contraction *o);
/* After an iteration: the quotient to expect of the next one.  theta: quotient of this iteration, not read after the
 * first, where no prediction below `hearsay` is believed. */
double contraction_after(struct contraction *o, double theta, double hearsay);
void contraction_recall(struct contraction *o, struct recall *r);

#endif
