/* schur.h -- eigenvalues and vectors of any small real matrix. */
#ifndef FMDSUB_LA_SCHUR_H
#define FMDSUB_LA_SCHUR_H

#include <complex.h>
#include <stdbool.h>

#include "base/arena.h"

/* A X = X diag(s), A [n x n] real by column (destroyed), X [n x n] with columns of length 1, or NULL, s [n] as found.  By
 * Householder's reflections to Hessenberg's form and Francis' QR algorithm with Wilkinson's shifts to Schur's (Golub &
 * Van Loan, Matrix Computations, ch. 7), in complex numbers.  Vectors of eigenvalues that are equal may be near to one
 * another.  False: no convergence, not finite, or a wish to end (base/stop.h). */
bool schur_eigen(double complex *s, double complex *X, double *A, int n, struct arena *scratch);

#endif
