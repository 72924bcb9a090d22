/* dense.h -- small dense algebra of fixed order.
 *
 * Matrices are stored by column, A(i,j) = A[i + j * ld].  Every sum runs in the order of the plain
 * scalar loop and nothing is contracted, so all machines give the same bits.  Exact zeros are
 * skipped: matrices with branch structure cost less.  Outputs never overlap inputs unless said. */
#ifndef FMDSUB_LA_DENSE_H
#define FMDSUB_LA_DENSE_H

/* A = L L', L in the lower triangle of A (the upper one is neither read nor written).  Returns -1, or
 * the column whose pivot vanishes against its diagonal, is negative or not a number. */
int dense_cholesky(double *A, int n, int ld);
/* x := (L L')^-1 x;  the same for m right sides X [n x m]. */
void dense_cholesky_solve(const double *L, double *x, int n, int ld);
void dense_cholesky_solves(const double *L, double *X, int n, int ld, int m, int ldx);

/* P A = L U with partial pivoting; swap [n] rows.  Returns -1, or the column without a pivot. */
int dense_lu(double *A, int *swap, int n, int ld);
/* x := A^-1 x. */
void dense_lu_solve(const double *LU, const int *swap, double *x, int n, int ld);

/* y [rows] += s A x  and  y [cols] += s A' x,  A [rows x cols]. */
void dense_gemv(double *y, double s, const double *A, const double *x, int rows, int cols, int ld);
void dense_gemtv(double *y, double s, const double *A, const double *x, int rows, int cols, int ld);
/* C [rows x cols] += s A B,  A [rows x inner];  C [rows x cols] += s A' B,  A [inner x rows]. */
void dense_gemm(double *C, double s, const double *A, const double *B, int rows, int inner, int cols, int ldc, int lda,
                int ldb);
void dense_gemtm(double *C, double s, const double *A, const double *B, int rows, int inner, int cols, int ldc, int lda,
                 int ldb);

/* B [rows x cols] := A. */
void dense_copy(double *B, const double *A, int rows, int cols, int ldb, int lda);
/* Largest |A(i,j) - A(j,i)| over the largest |A(i,i)|. */
double dense_asymmetry(const double *A, int n, int ld);

#endif
