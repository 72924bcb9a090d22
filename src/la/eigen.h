/* eigen.h -- eigenvalues of small symmetric matrices. */
#ifndef FMDSUB_LA_EIGEN_H
#define FMDSUB_LA_EIGEN_H

/* A X = X diag(lambda), A [n x n] symmetric by column (destroyed), X [n x n] orthonormal, lambda [n]
 * ascending; the largest entry of every column of X is positive.  Cyclic Jacobi rotations (Rutishauser,
 * Numer. Math. 9, 1966): slow beyond some hundreds, accurate for small eigenvalues. */
void eigen_symmetric(double *lambda, double *X, double *A, int n);

/* K X = M X diag(lambda), X' M X = 1; M [n x n] symmetric positive definite, K symmetric; both destroyed.
 * Returns -1, or the column where M is not positive. */
int eigen_general(double *lambda, double *X, double *K, double *M, int n);

#endif
