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

/* The same where stiffnesses or masses differ by many decades: lambda small against the largest keeps its digits, as
 * far as K and M have them.  Solved as M z = mu (K + sigma M) z in coordinates of like stiffness, sigma as small as
 * makes K + sigma M positive, by Jacobi rotations, which keep small eigenvalues of scaled positive matrices (Demmel &
 * Veselic, SIAM J. Matrix Anal. Appl. 13 (1992) 1204); lambda by Rayleigh's quotient.  K and M are kept; work [2 n n + n].
 * Returns -1, or a coordinate that moves no mass. */
int eigen_graded(double *lambda, double *X, const double *K, const double *M, int n, double *work);

#endif
