/* factor.h -- Cholesky factor of a held body's matrix, by LAPACK's band routines.
 *
 * Nodes are numbered by reverse Cuthill-McKee (Cuthill & McKee 1969; George & Liu 1981, ch. 4), held freedoms left
 * out: for bodies longer than wide the band is a cross-section's freedoms. */
#ifndef FMDSUB_REDUCE_FACTOR_H
#define FMDSUB_REDUCE_FACTOR_H

#include "reduce/sparse.h"

struct factor {
    int n, width;  /* freedoms; sub-diagonals */
    const int *of; /* [n] freedom of the body */
    double *L;     /* [(width + 1) x n] lower triangle by LAPACK's band storage */
    double *x;     /* [n] */
};

/* A + shift 1 = L L' over the freedoms not held.  *bad: -1, or the freedom whose pivot is not positive, or vanishes
 * (below 1e-13 of the diagonal).  E_LIMIT when the band would take more than 8 GiB. */
enum status factor_make(struct factor *o, int *bad, const struct sparse *A, const bool *held, double shift,
                        struct arena *life, struct report *report);

/* u = A^-1 f, zero at held freedoms; u may be f.  Both over all freedoms. */
void factor_solve(double *u, const struct factor *o, const double *f, int size);

#endif
