/* pivot.h -- LU with full pivoting: rank, the best square block, solutions with it.
 *
 *     P A Q = L U
 *
 * Matrices by column, A(i,j) = A[i + j * ld].  Rows and columns are exchanged in A itself; row[i] and col[j]
 * tell which ones stand there now (Golub & Van Loan, Matrix Computations, 3.4.8). */
#ifndef FMDSUB_LA_PIVOT_H
#define FMDSUB_LA_PIVOT_H

/* Factors A [m x n] as far as pivots go: at most `most` of them, and while the largest number left is above `least`
 * times the first one.  weight [n], by original column: of two columns, the one with the larger |pivot| weight is taken
 * first; NULL: all equal.  Returns the number of pivots: the rank when `most` does not end it. */
int pivot_lu(double *A, int *row, int *col, int m, int n, int ld, const double *weight, int most, double least);

/* x := A^-1 x for a square A with n pivots; work [n]. */
void pivot_solve(const double *LU, const int *row, const int *col, double *x, double *work, int n, int ld);

/* L^-1 P A = U by partial pivoting, for a square A with its numbers near the diagonal: none more than band[0] below it,
 * none more than band[1] - band[0] above (row exchanges fill up to band[1]); the rest of A is not looked at.
 * swap [n].  Returns the number of pivots, n unless A is singular or not finite.  x := A^-1 x, x := A^-T x.
 * Compact: with ld = band[0] + band[1], A = store + band[1], the bands of the columns stand one behind the other in
 * store [n (ld + 1)]. */
int pivot_rows(double *A, int *swap, const int *band, int n, int ld);
void pivot_rows_solve(const double *LU, const int *swap, const int *band, double *x, int n, int ld);
/* The same for the m columns of X [n x m]. */
void pivot_rows_solves(const double *LU, const int *swap, const int *band, double *X, int n, int ld, int m);
void pivot_rows_tsolve(const double *LU, const int *swap, const int *band, double *x, int n, int ld);

#endif
