/* pivot_rows.c -- see pivot.h: square matrices by partial pivoting, in bands.
 *
 * Columns before k keep the multipliers where they were made: exchanges are repeated in solving (as LAPACK's dgbtrf).
 * Numbers are divided by pivots, not multiplied by their inverses: what is equal becomes exactly 1, and mechanisms that
 * are symmetric stay so where C_q is nearly singular. */
#include <math.h>
#include <stddef.h>

#include "base/inline.h"
#include "la/pivot.h"

/* --- any band ------------------------------------------------------------------------------------ */

static int least_of(int a, int b)
{
    return a < b ? a : b;
}

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

static int rows_factor(double *A, int *swap, const int *band, int from, int n, int ld)
{
    for (int k = from; k < n; k++) {
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
    for (int j = 0; j < n - 1; j++) { /* the last row has none to be exchanged with */
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
    for (int j = n - 2; j >= 0; j--) {
        const double *l = LU + j * ld;
        double y = x[j];
        UNROLLED
        for (int i = j + 1; i < n; i++) y -= l[i] * x[i];
        x[j] = x[swap[j]];
        x[swap[j]] = y;
    }
}

/* --- and for bands with two or three numbers below the diagonal, as chains of loops have them --------- */

/* x[-n ... -1] -= y a[-n ... -1]: most bands have four at most there, to which a jump is shorter than a loop. */
FEW void take_before(double *restrict x, double y, const double *restrict a, int n)
{
    for (; n > 4; n--) x[-n] -= a[-n] * y;
    switch (n) {
    case 4:
        x[-4] -= a[-4] * y; /* fall through */
    case 3:
        x[-3] -= a[-3] * y; /* fall through */
    case 2:
        x[-2] -= a[-2] * y; /* fall through */
    case 1:
        x[-1] -= a[-1] * y; /* fall through */
    default:
        break;
    }
}

/* y - a[-n] x[-n] - ... - a[-1] x[-1], in that order. */
FEW double less_before(double y, const double *restrict a, const double *restrict x, int n)
{
    for (; n > 4; n--) y -= a[-n] * x[-n];
    switch (n) {
    case 4:
        y -= a[-4] * x[-4]; /* fall through */
    case 3:
        y -= a[-3] * x[-3]; /* fall through */
    case 2:
        y -= a[-2] * x[-2]; /* fall through */
    case 1:
        y -= a[-1] * x[-1]; /* fall through */
    default:
        return y;
    }
}

FEW int narrow_factor(double *A, int *swap, int below, const int *band, int n, int ld)
{
    int k = 0;
    for (; k + below < n; k++) {
        const int above = least_of(band[1], n - 1 - k);
        double *l = A + (size_t)k * (size_t)ld + k, *x = l, best = fabs(l[0]);
        int p = 0;
        UNROLLED
        for (int i = 1; i <= below; i++)
            if (fabs(l[i]) > best) best = fabs(l[i]), p = i;
        if (!(best > 0 && best < INFINITY)) return k;
        swap[k] = k + p;
        if (p) exchange_x(l, 0, p);
        UNROLLED
        for (int i = 1; i <= below; i++) l[i] /= l[0];
        for (int j = 0; j < above; j++) {
            x += ld;
            if (p) exchange_x(x, 0, p);
            if (x[0] == 0) continue;
            UNROLLED
            for (int i = 1; i <= below; i++) x[i] -= l[i] * x[0];
        }
    }
    return rows_factor(A, swap, band, k, n, ld);
}

FEW void narrow_solve(const double *restrict LU, const int *swap, int below, const int *band, double *restrict x, int n,
                      int ld)
{
    const double *a = LU;
    int j = 0;
    for (; j + below < n; j++, a += ld + 1) {
        const double y = x[swap[j]];
        x[swap[j]] = x[j];
        x[j] = y;
        UNROLLED
        for (int i = 1; i <= below; i++) x[j + i] -= a[i] * y;
    }
    for (; j < n; j++, a += ld + 1) {
        const double y = x[swap[j]];
        x[swap[j]] = x[j];
        x[j] = y;
        for (int i = 1; j + i < n; i++) x[j + i] -= a[i] * y;
    }
    for (j = n - 1; j >= 0; j--) {
        a -= ld + 1;
        x[j] /= a[0];
        take_before(x + j, x[j], a, least_of(band[1], j));
    }
}

FEW void narrow_tsolve(const double *restrict LU, const int *swap, int below, const int *band, double *restrict x,
                       int n, int ld)
{
    const double *a = LU;
    int j = 0;
    for (; j < n; j++, a += ld + 1) {
        x[j] = less_before(x[j], a, x + j, least_of(band[1], j)) / a[0];
    }
    for (j = n - 1; j >= 0; j--) {
        a -= ld + 1;
        double y = x[j];
        if (j + below < n) {
            UNROLLED
            for (int i = 1; i <= below; i++) y -= a[i] * x[j + i];
        } else {
            for (int i = 1; j + i < n; i++) y -= a[i] * x[j + i];
        }
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
    case 1:
        return few_factor(A, swap, 1, ld);
    case 2:
        return few_factor(A, swap, 2, ld);
    case 3:
        return few_factor(A, swap, 3, ld);
    }
    switch (band[0]) {
    case 2:
        return narrow_factor(A, swap, 2, band, n, ld);
    case 3:
        return narrow_factor(A, swap, 3, band, n, ld);
    default:
        return rows_factor(A, swap, band, 0, n, ld);
    }
}

INTO static inline void any_solve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    switch (band[0]) {
    case 2:
        narrow_solve(LU, swap, 2, band, x, n, ld);
        break;
    case 3:
        narrow_solve(LU, swap, 3, band, x, n, ld);
        break;
    default:
        rows_solve(LU, swap, band, x, n, ld);
    }
}

void pivot_rows_solve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    switch (whole(band, n)) {
    case 1:
        x[0] /= LU[0];
        break;
    case 2:
        few_solve(LU, swap, x, 2, ld);
        break;
    case 3:
        few_solve(LU, swap, x, 3, ld);
        break;
    default:
        any_solve(LU, swap, band, x, n, ld);
    }
}

void pivot_rows_solves(const double *LU, const int *swap, const int *band, double *X, int n, int ld, int m)
{
    switch (whole(band, n)) {
    case 1:
        for (int k = 0; k < m; k++) X[k] /= LU[0];
        break;
    case 2:
        for (int k = 0; k < m; k++) few_solve(LU, swap, X + (long)k * 2, 2, ld);
        break;
    case 3:
        for (int k = 0; k < m; k++) few_solve(LU, swap, X + (long)k * 3, 3, ld);
        break;
    default:
        for (int k = 0; k < m; k++) any_solve(LU, swap, band, X + (long)k * n, n, ld);
    }
}

void pivot_rows_tsolve(const double *LU, const int *swap, const int *band, double *x, int n, int ld)
{
    switch (whole(band, n)) {
    case 1:
        x[0] /= LU[0];
        return;
    case 2:
        few_tsolve(LU, swap, x, 2, ld);
        return;
    case 3:
        few_tsolve(LU, swap, x, 3, ld);
        return;
    }
    switch (band[0]) {
    case 2:
        narrow_tsolve(LU, swap, 2, band, x, n, ld);
        break;
    case 3:
        narrow_tsolve(LU, swap, 3, band, x, n, ld);
        break;
    default:
        rows_tsolve(LU, swap, band, x, n, ld);
    }
}
