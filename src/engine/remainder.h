/* remainder.h -- what a simplified Newton iteration leaves over, taken off without another evaluation.
 *
 * A kept matrix is a little off, so that each correction d leaves about alpha d behind.  It is below the tolerance, but it
 * has the sign of the matrix's error and of what the prediction missed, and that is odd in time where predictions look
 * back: it works like a damper, or like its opposite, and energies drift over millions of steps (the pendulum at h = 1e-2
 * over 1e7 steps: 3.0 and 4.0 times the bound of its first 1e3 under newmark and midpoint; with this 1.00 and 1.01).
 *
 * alpha, with its sign, is the part of the second correction along the first, and goes on from step to step as a line;
 * alpha/(1 - alpha) d is added to the last correction (Aitken, Proc. R. Soc. Edinb. 46 (1926) 289).  Where the two are
 * not nearly parallel one number says nothing of them, and nothing is added. */
#ifndef FMDSUB_ENGINE_REMAINDER_H
#define FMDSUB_ENGINE_REMAINDER_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/recall.h"

struct remainder {
    int n;
    double *first;      /* [n] the first correction */
    bool known;         /* alpha is, */
    double alpha, rate; /* when last seen; its change a step */
    int age;            /* steps since */
};

void remainder_open(struct remainder *o, int n, struct arena *life);
void remainder_forget(struct remainder *o);
void remainder_recall(struct remainder *o, struct recall *r);
/* A step begins; its first correction d [n]; its second one, of the same matrix, in units 1/per [n]. */
void remainder_begin(struct remainder *o);
void remainder_first(struct remainder *o, const double *d);
void remainder_second(struct remainder *o, const double *d, const double *per);
/* The matrix knows by now what the second correction has shown. */
void remainder_learnt(struct remainder *o);
/* z [n] -= what the last correction d leaves. */
void remainder_take(const struct remainder *o, double *z, const double *d);

#endif
