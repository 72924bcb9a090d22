/* dense.c -- see dense.h.
 *
 * Factorizations work by columns (axpy form), four columns at a time:
 *
 *     c = (((c - a0 f0) - a1 f1) - a2 f2) - a3 f3
 *
 * which keeps the order of the scalar loop and vectorizes without licence to reorder sums.
 * Golub & Van Loan, Matrix Computations, 4th ed., 3.2.9 (LU, gaxpy form) and 4.2.5 (Cholesky). */
#include "la/dense.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "la/wide.h"

/* Below, the call through the loader's table costs more than it gives: factors; products. */
enum { NARROW = 12, SHORT = 8 };

/* c [n] -= A f,  the m columns of A in order; f(k) = f[k * step]. */
INTO static inline void subtract_columns(double *restrict c, const double *restrict A, const double *restrict f, int n,
                                         int m, int ld, int step)
{
    int k = 0;
    for (; k + 4 <= m; k += 4) {
        const double *a0 = A + (long)k * ld, *a1 = a0 + ld, *a2 = a1 + ld, *a3 = a2 + ld;
        double f0 = f[(long)k * step], f1 = f[(long)(k + 1) * step];
        double f2 = f[(long)(k + 2) * step], f3 = f[(long)(k + 3) * step];
        if (f0 == 0 && f1 == 0 && f2 == 0 && f3 == 0) continue;
        for (int i = 0; i < n; i++) c[i] = (((c[i] - a0[i] * f0) - a1[i] * f1) - a2[i] * f2) - a3[i] * f3;
    }
    for (; k < m; k++) {
        const double *a = A + (long)k * ld;
        double fk = f[(long)k * step];
        if (fk == 0) continue;
        for (int i = 0; i < n; i++) c[i] -= a[i] * fk;
    }
}

INTO static inline int cholesky(double *A, int n, int ld)
{
    for (int j = 0; j < n; j++) {
        double *c = A + (long)j * ld, diagonal = c[j];
        subtract_columns(c + j, A + j, A + j, n - j, j, ld, ld);
        if (!(c[j] > 4 * DBL_EPSILON * diagonal) || c[j] > DBL_MAX) return j;
        c[j] = sqrt(c[j]);
        double s = 1 / c[j];
        for (int i = j + 1; i < n; i++) c[i] *= s;
    }
    return -1;
}

WIDE static int cholesky_wide(double *A, int n, int ld)
{
    return cholesky(A, n, ld);
}

int dense_cholesky(double *A, int n, int ld)
{
    return n <= NARROW ? cholesky(A, n, ld) : cholesky_wide(A, n, ld);
}

/* x := L^-1 x of a block on the diagonal, n <= 4. */
static inline void forth(const double *c, double *x, int n, int ld)
{
    const double *c1 = c + ld, *c2 = c1 + ld, *c3 = c2 + ld;
    x[0] = x[0] / c[0];
    if (n > 1) x[1] = (x[1] - c[1] * x[0]) / c1[1];
    if (n > 2) x[2] = ((x[2] - c[2] * x[0]) - c1[2] * x[1]) / c2[2];
    if (n > 3) x[3] = (((x[3] - c[3] * x[0]) - c1[3] * x[1]) - c2[3] * x[2]) / c3[3];
}

void dense_cholesky_solve(const double *restrict L, double *restrict x, int n, int ld)
{
    int j = 0;
    for (; j + 4 < n; j += 4) {
        const double *c = L + (long)j * (ld + 1);
        forth(c, x + j, 4, ld);
        subtract_columns(x + j + 4, c + 4, x + j, n - j - 4, 4, ld, 1);
    }
    if (j < n) forth(L + (long)j * (ld + 1), x + j, n - j, ld);
    for (j = n - 1; j >= 0; j--) {
        const double *c = L + (long)j * ld;
        double sum = x[j];
        for (int i = j + 1; i < n; i++) sum -= c[i] * x[i];
        x[j] = sum / c[j];
    }
}

void dense_cholesky_solves(const double *L, double *X, int n, int ld, int m, int ldx)
{
    for (int k = 0; k < m; k++) dense_cholesky_solve(L, X + (long)k * ldx, n, ld);
}

static void swap_entries(double *c, const int *swap, int n)
{
    for (int i = 0; i < n; i++) {
        double keep = c[i];
        c[i] = c[swap[i]];
        c[swap[i]] = keep;
    }
}

/* Column j of U and, unscaled, of L; the rows of earlier swaps are already in place. */
INTO static inline void lu_column(double *A, double *c, int j, int n, int ld)
{
    for (int k = 0; k < j; k++) {
        const double *a = A + (long)k * ld;
        double f = c[k];
        if (f == 0) continue;
        for (int i = k + 1; i < j; i++) c[i] -= a[i] * f;
    }
    subtract_columns(c + j, A + j, c, n - j, j, ld, 1);
}

INTO static inline int lu(double *A, int *swap, int n, int ld)
{
    for (int j = 0; j < n; j++) {
        double *c = A + (long)j * ld, size = 0;
        for (int i = 0; i < n; i++) size = fmax(size, fabs(c[i]));
        swap_entries(c, swap, j);
        lu_column(A, c, j, n, ld);
        int p = j;
        for (int i = j + 1; i < n; i++)
            if (fabs(c[i]) > fabs(c[p])) p = i;
        if (!(fabs(c[p]) > 4 * DBL_EPSILON * size) || fabs(c[p]) > DBL_MAX) return j;
        swap[j] = p;
        for (int k = 0; k <= j; k++) {
            double *b = A + (long)k * ld, keep = b[j];
            b[j] = b[p];
            b[p] = keep;
        }
        double s = 1 / c[j];
        for (int i = j + 1; i < n; i++) c[i] *= s;
    }
    return -1;
}

WIDE static int lu_wide(double *A, int *swap, int n, int ld)
{
    return lu(A, swap, n, ld);
}

int dense_lu(double *A, int *swap, int n, int ld)
{
    return n <= NARROW ? lu(A, swap, n, ld) : lu_wide(A, swap, n, ld);
}

/* x -= f a + g b */
INTO static inline void minus_two(double *restrict x, const double *restrict a, double f, const double *restrict b,
                                  double g, int n)
{
    for (int i = 0; i < n; i++) x[i] = (x[i] - a[i] * f) - b[i] * g;
}

/* x/c; what is nothing stays so, whatever the pivot. */
static inline double over(double x, double c)
{
    return x == 0 ? x : x / c;
}

/* Two columns at a time. */
void dense_lu_solve(const double *LU, const int *swap, double *x, int n, int ld)
{
    int j = 0;
    swap_entries(x, swap, n);
    for (; j + 1 < n; j += 2) {
        const double *a = LU + (long)j * ld, *b = a + ld;
        x[j + 1] -= a[j + 1] * x[j];
        minus_two(x + j + 2, a + j + 2, x[j], b + j + 2, x[j + 1], n - j - 2);
    }
    for (j = n - 1; j > 0; j -= 2) {
        const double *a = LU + (long)j * ld, *b = a - ld;
        x[j] = over(x[j], a[j]);
        x[j - 1] = over(x[j - 1] - a[j - 1] * x[j], b[j - 1]);
        minus_two(x, a, x[j], b, x[j - 1], j - 1);
    }
    if (j == 0) x[0] = over(x[0], LU[0]);
}

/* y += s A x in one pass over one to four columns, their sums in order; false: a factor is 0, and nothing is done. */
INTO static inline bool add_columns(double *restrict y, double s, const double *restrict A, const double *restrict x,
                                    int columns, int rows, int ld)
{
    const long to = ld;
    const double f = s * x[0], g = columns > 1 ? s * x[1] : 1, h = columns > 2 ? s * x[2] : 1;
    const double k = columns > 3 ? s * x[3] : 1;
    if (f == 0 || g == 0 || h == 0 || k == 0) return false;
    for (int i = 0; i < rows; i++) {
        double sum = y[i] + A[i] * f;
        if (columns > 1) sum += A[i + to] * g;
        if (columns > 2) sum += A[i + 2 * to] * h;
        if (columns > 3) sum += A[i + 3 * to] * k;
        y[i] = sum;
    }
    return true;
}

/* Column by column, several in one pass where all of them count. */
INTO static inline void gemv(double *restrict y, double s, const double *restrict A, const double *restrict x, int rows,
                             int cols, int ld)
{
    int j = 0;
    for (; j + 4 <= cols && add_columns(y, s, A, x + j, 4, rows, ld); j += 4) A += 4 * (long)ld;
    if (cols - j == 3 && add_columns(y, s, A, x + j, 3, rows, ld)) return;
    if (cols - j == 2 && add_columns(y, s, A, x + j, 2, rows, ld)) return;
    for (; j < cols; j++, A += ld) add_columns(y, s, A, x + j, 1, rows, ld);
}

WIDE static void gemv_wide(double *y, double s, const double *A, const double *x, int rows, int cols, int ld)
{
    gemv(y, s, A, x, rows, cols, ld);
}

void dense_gemv(double *y, double s, const double *A, const double *x, int rows, int cols, int ld)
{
    if (rows < SHORT)
        gemv(y, s, A, x, rows, cols, ld);
    else
        gemv_wide(y, s, A, x, rows, cols, ld);
}

void dense_gemtv(double *y, double s, const double *A, const double *x, int rows, int cols, int ld)
{
    for (int j = 0; j < cols; j++) {
        const double *c = A + (long)j * ld;
        double sum = 0;
        for (int i = 0; i < rows; i++) sum += c[i] * x[i];
        y[j] += s * sum;
    }
}

void dense_gemm(double *C, double s, const double *A, const double *B, int rows, int inner, int cols, int ldc, int lda,
                int ldb)
{
    for (int j = 0; j < cols; j++) dense_gemv(C + (long)j * ldc, s, A, B + (long)j * ldb, rows, inner, lda);
}

void dense_gemtm(double *C, double s, const double *A, const double *B, int rows, int inner, int cols, int ldc, int lda,
                 int ldb)
{
    for (int j = 0; j < cols; j++) dense_gemtv(C + (long)j * ldc, s, A, B + (long)j * ldb, inner, rows, lda);
}

void dense_copy(double *B, const double *A, int rows, int cols, int ldb, int lda)
{
    for (int j = 0; j < cols; j++) memmove(B + (long)j * ldb, A + (long)j * lda, (size_t)rows * sizeof *A);
}

double dense_asymmetry(const double *A, int n, int ld)
{
    double worst = 0, size = 0;
    for (int j = 0; j < n; j++) {
        size = fmax(size, fabs(A[j + (long)j * ld]));
        for (int i = 0; i < j; i++) worst = fmax(worst, fabs(A[i + (long)j * ld] - A[j + (long)i * ld]));
    }
    return worst > 0 ? worst / size : 0;
}
