/* summary.h -- what a reduction says of itself on stderr: frequencies, effective masses, what is left out. */
#ifndef FMDSUB_REDUCE_WORDS_H
#define FMDSUB_REDUCE_WORDS_H

#include "reduce/basis.h"
#include "reduce/body.h"

/* Share of the movable mass (k < 3) or inertia about the reference point (k >= 3) that mode j answers to a motion k
 * of its support: (int r_k' phi_j dm)^2 / int r_k' r_k dm, r_k the rigid motion.  e [6 x n]. */
void words_effective(double *e, const struct fe *fe, const struct basis *basis, const struct tie *reference,
                     struct arena *life);

/* Table of the modes unless quiet, and warnings. */
void summary_print(const struct fe *fe, const struct basis *basis, const struct tie *reference, bool quiet,
                   struct arena *life);

#endif
