/* pivot.c -- see pivot.h */
#include "la/pivot.h"

#include <math.h>
#include <stddef.h>

/* Where the next pivot stands, and the largest |number| left; false: nothing but zeros and NaN. */
static int choose(int *pi, int *pj, double *largest, const double *A, const int *col, int from, int m, int n, int ld,
                  const double *weight)
{
    double best = 0;
    *largest = 0;
    for (int j = from; j < n; j++) {
        double w = weight ? weight[col[j]] : 1;
        for (int i = from; i < m; i++) {
            double x = fabs(A[i + j * ld]);
            if (x > *largest) *largest = x;
            if (!(x * w > best)) continue;
            best = x * w;
            *pi = i;
            *pj = j;
        }
    }
    return best > 0;
}

static void exchange(int *p, int i, int j)
{
    int k = p[i];
    p[i] = p[j];
    p[j] = k;
}

static void bring(double *A, int *row, int *col, int k, int pi, int pj, int m, int n, int ld)
{
    for (int j = 0; pi != k && j < n; j++) {
        double x = A[k + j * ld];
        A[k + j * ld] = A[pi + j * ld];
        A[pi + j * ld] = x;
    }
    for (int i = 0; pj != k && i < m; i++) {
        double x = A[i + k * ld];
        A[i + k * ld] = A[i + pj * ld];
        A[i + pj * ld] = x;
    }
    exchange(row, k, pi);
    exchange(col, k, pj);
}

static void eliminate(double *A, int k, int m, int n, int ld)
{
    double pivot = A[k + k * ld];
    for (int i = k + 1; i < m; i++) A[i + k * ld] /= pivot;
    for (int j = k + 1; j < n; j++) {
        double u = A[k + j * ld];
        if (u == 0) continue;
        for (int i = k + 1; i < m; i++) A[i + j * ld] -= A[i + k * ld] * u;
    }
}

int pivot_lu(double *A, int *row, int *col, int m, int n, int ld, const double *weight, int most, double least)
{
    int k = 0, pi = 0, pj = 0;
    double first = 0, largest;
    for (int i = 0; i < m; i++) row[i] = i;
    for (int j = 0; j < n; j++) col[j] = j;
    for (; k < most && k < m && k < n; k++) {
        if (!choose(&pi, &pj, &largest, A, col, k, m, n, ld, weight)) break;
        if (k == 0) first = largest;
        if (!(largest > least * first)) break;
        bring(A, row, col, k, pi, pj, m, n, ld);
        eliminate(A, k, m, n, ld);
    }
    return k;
}

/* A = P'L U Q': y = P x, L, U, x = Q y. */
void pivot_solve(const double *LU, const int *row, const int *col, double *x, double *work, int n, int ld)
{
    for (int i = 0; i < n; i++) work[i] = x[row[i]];
    for (int j = 0; j < n; j++)
        for (int i = j + 1; i < n; i++) work[i] -= LU[i + j * ld] * work[j];
    for (int j = n - 1; j >= 0; j--) {
        work[j] /= LU[j + j * ld];
        for (int i = 0; i < j; i++) work[i] -= LU[i + j * ld] * work[j];
    }
    for (int j = 0; j < n; j++) x[col[j]] = work[j];
}

static int least_of(int a, int b)
{
    return a < b ? a : b;
}

/* --- by rows ------------------------------------------------------------------------------------ *
 *
 * Columns before k keep the multipliers where they were made: exchanges are repeated in solving (as LAPACK's dgbtrf).
 * Numbers are divided by pivots, not multiplied by their inverses: what is equal becomes exactly 1, and mechanisms that
 * are symmetric stay so where C_q is nearly singular. */

/* The largest |number| of x[k ... rows), its place; -1: none, or not finite. */
static inline int largest(const double *x, int k, int rows)
{
    double best = fabs(x[k]);
    int p = k;
    for (int i = k + 1; i < rows; i++)
        if (fabs(x[i]) > best) best = fabs(x[i]), p = i;
    return best > 0 && best < INFINITY ? p : -1;
}

static inline void exchange_x(double *x, int i, int j)
{
    double y = x[i];
    x[i] = x[j];
    x[j] = y;
}

/* x [n] -= y a;  a . x; two numbers at a time, for bands are narrow. */
static inline void take_away(double *restrict x, double y, const double *restrict a, int n)
{
    for (; n >= 2; n -= 2, x += 2, a += 2) {
        x[0] -= a[0] * y;
        x[1] -= a[1] * y;
    }
    if (n) x[0] -= a[0] * y;
}

static inline double sum_of(const double *restrict a, const double *restrict x, int n)
{
    double even = 0, odd = 0;
    for (; n >= 2; n -= 2, x += 2, a += 2) {
        even += a[0] * x[0];
        odd += a[1] * x[1];
    }
    return n ? even + a[0] * x[0] + odd : even + odd;
}

static int rows_factor(double *A, int *swap, const int *band, int n, int ld)
{
    for (int k = 0; k < n; k++) {
        const int rows = least_of(k + band[0] + 1, n), cols = least_of(k + band[1] + 1, n);
        double *l = A + (size_t)k * (size_t)ld, *x = l;
        const int p = swap[k] = largest(l, k, rows);
        if (p < 0) return k;
        if (p != k) exchange_x(l, k, p);
        for (int i = k + 1; i < rows; i++) l[i] /= l[k];
        for (int j = k + 1; j < cols; j++) {
            x += ld;
            if (p != k) exchange_x(x, k, p);
            if (x[k] != 0) take_away(x + k + 1, x[k], l + k + 1, rows - k - 1);
        }
    }
    return n;
}

static void rows_solve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    const double *a = LU;
    for (int j = 0; j < n; j++, a += ld) {
        const double y = x[swap[j]];
        x[swap[j]] = x[j];
        x[j] = y;
        if (y != 0) take_away(x + j + 1, y, a + j + 1, least_of(band[0], n - j - 1));
    }
    for (int j = n - 1; j >= 0; j--) {
        a -= ld;
        const int first = j > band[1] ? j - band[1] : 0;
        const double y = x[j] /= a[j];
        if (y != 0) take_away(x + first, y, a + first, j - first);
    }
}

static void rows_tsolve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    const double *a = LU;
    for (int j = 0; j < n; j++, a += ld) {
        const int first = j > band[1] ? j - band[1] : 0;
        x[j] = (x[j] - sum_of(a + first, x + first, j - first)) / a[j];
    }
    for (int j = n - 1; j >= 0; j--) {
        a -= ld;
        const double y = x[j] - sum_of(a + j + 1, x + j + 1, least_of(band[0], n - j - 1));
        x[j] = x[swap[j]];
        x[swap[j]] = y;
    }
}

/* --- the same for two or three rows, unrolled: loops would cost more than what is in them ------------ */

#if defined(__GNUC__) && !defined(__clang__)
#define FEW __attribute__((always_inline)) static inline
#define UNROLLED _Pragma("GCC unroll 4")
#else
#define FEW static inline
#define UNROLLED
#endif

FEW int few_factor(double *A, int *swap, int n, int ld)
{
    UNROLLED
    for (int k = 0; k < n; k++) {
        double *l = A + k * ld, best = fabs(l[k]);
        int p = k;
        UNROLLED
        for (int i = k + 1; i < n; i++)
            if (fabs(l[i]) > best) best = fabs(l[i]), p = i;
        if (!(best > 0 && best < INFINITY)) return k;
        swap[k] = p;
        if (p != k) exchange_x(l, k, p);
        UNROLLED
        for (int i = k + 1; i < n; i++) l[i] /= l[k];
        UNROLLED
        for (int j = k + 1; j < n; j++) {
            double *x = A + j * ld;
            if (p != k) exchange_x(x, k, p);
            UNROLLED
            for (int i = k + 1; i < n; i++) x[i] -= l[i] * x[k];
        }
    }
    return n;
}

FEW void few_solve(const double *restrict LU, const int *swap, double *restrict x, int n, int ld)
{
    UNROLLED
    for (int j = 0; j < n; j++) {
        const double *l = LU + j * ld, y = x[swap[j]];
        x[swap[j]] = x[j];
        x[j] = y;
        UNROLLED
        for (int i = j + 1; i < n; i++) x[i] -= l[i] * y;
    }
    UNROLLED
    for (int j = n - 1; j >= 0; j--) {
        const double *u = LU + j * ld, y = x[j] /= u[j];
        UNROLLED
        for (int i = 0; i < j; i++) x[i] -= u[i] * y;
    }
}

FEW void few_tsolve(const double *restrict LU, const int *swap, double *restrict x, int n, int ld)
{
    UNROLLED
    for (int j = 0; j < n; j++) {
        const double *u = LU + j * ld;
        double y = x[j];
        UNROLLED
        for (int i = 0; i < j; i++) y -= u[i] * x[i];
        x[j] = y / u[j];
    }
    UNROLLED
    for (int j = n - 1; j >= 0; j--) {
        const double *l = LU + j * ld;
        double y = x[j];
        UNROLLED
        for (int i = j + 1; i < n; i++) y -= l[i] * x[i];
        x[j] = x[swap[j]];
        x[swap[j]] = y;
    }
}

/* n, where the band is as wide as the matrix; 0: any other. */
static int whole(const int *band, int n)
{
    return band[0] == n - 1 && band[1] == n - 1 ? n : 0;
}

int pivot_rows(double *A, int *swap, const int *band, int n, int ld)
{
    switch (whole(band, n)) {
    case 2:
        return few_factor(A, swap, 2, ld);
    case 3:
        return few_factor(A, swap, 3, ld);
    default:
        return rows_factor(A, swap, band, n, ld);
    }
}

void pivot_rows_solve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    switch (whole(band, n)) {
    case 2:
        few_solve(LU, swap, x, 2, ld);
        break;
    case 3:
        few_solve(LU, swap, x, 3, ld);
        break;
    default:
        rows_solve(LU, swap, band, x, n, ld);
    }
}

void pivot_rows_solves(const double *LU, const int *swap, const int *band, double *X, int n, int ld, int m)
{
    switch (whole(band, n)) {
    case 2:
        for (int k = 0; k < m; k++) few_solve(LU, swap, X + (long)k * 2, 2, ld);
        break;
    case 3:
        for (int k = 0; k < m; k++) few_solve(LU, swap, X + (long)k * 3, 3, ld);
        break;
    default:
        for (int k = 0; k < m; k++) rows_solve(LU, swap, band, X + (long)k * n, n, ld);
    }
}

void pivot_rows_tsolve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    switch (whole(band, n)) {
    case 2:
        few_tsolve(LU, swap, x, 2, ld);
        break;
    case 3:
        few_tsolve(LU, swap, x, 3, ld);
        break;
    default:
        rows_tsolve(LU, swap, band, x, n, ld);
    }
}
