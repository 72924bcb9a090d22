/* t-pivot.c -- LU with full pivoting: products, solutions, ranks, preferences. */
#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "la/sparse_pivot.h"
#include "unit/trees.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST = 12 };

static void random_matrix(double *A, struct tree_dice *d, int m, int n, double zeros)
{
    for (int i = 0; i < m * n; i++) A[i] = tree_roll(d, 0, 1) < zeros ? 0 : tree_roll(d, -1, 1);
}

/* A [m x n] of the given rank: a product of thin matrices. */
static void ranked_matrix(double *A, struct tree_dice *d, int m, int n, int rank)
{
    double X[MOST * MOST], Y[MOST * MOST];
    random_matrix(X, d, m, rank, 0);
    random_matrix(Y, d, rank, n, 0);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < m; i++) {
            A[i + j * m] = 0;
            for (int k = 0; k < rank; k++) A[i + j * m] += X[i + k * m] * Y[k + j * rank];
        }
}

static void ranks(void **state)
{
    struct tree_dice d = {1};
    (void)state;
    for (int trial = 0; trial < 500; trial++) {
        int m = 1 + tree_pick(&d, MOST), n = 1 + tree_pick(&d, MOST), least = m < n ? m : n;
        int rank = tree_pick(&d, least + 1), row[MOST], col[MOST];
        double A[MOST * MOST], LU[MOST * MOST];
        ranked_matrix(A, &d, m, n, rank);
        memcpy(LU, A, sizeof A);
        assert_int_equal(pivot_lu(LU, row, col, m, n, m, NULL, least, 1e-11), rank);
        for (int i = 0; i < m; i++) /* P A Q = L U */
            for (int j = 0; j < n; j++) {
                double sum = 0;
                for (int k = 0; k < rank && k <= i && k <= j; k++) sum += (k == i ? 1 : LU[i + k * m]) * LU[k + j * m];
                assert_true(fabs(sum - A[row[i] + col[j] * m]) < 1e-12);
            }
    }
}

/* b = A x, or A' x. */
static void product(double *b, const double *A, const double *x, int n, bool transposed)
{
    for (int i = 0; i < n; i++) b[i] = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) b[transposed ? j : i] += A[i + j * n] * x[transposed ? i : j];
}

static void near_all(const double *a, const double *b, int n)
{
    for (int i = 0; i < n; i++) assert_true(fabs(a[i] - b[i]) < 1e-11);
}

/* Both solvers, the one by rows both ways, against the product. */
static void solutions(void **state)
{
    struct tree_dice d = {2};
    int done = 0;
    (void)state;
    for (int trial = 0; trial < 500; trial++) {
        int n = 1 + tree_pick(&d, MOST), row[MOST], col[MOST], swap[MOST], band[2] = {n, 2 * n};
        const int below = 1 + trial / 5 % 4; /* of a band */
        double A[MOST * MOST], LU[MOST * MOST], rows[MOST * MOST], x[MOST], b[MOST], work[MOST];
        double many[3 * MOST];
        random_matrix(A, &d, n, n, trial % 2 ? .6 : 0);
        for (int i = 0; i < n; i++) A[i + n * ((i + trial) % n)] += 3;
        for (int i = 0; trial % 5 == 4 && i < n; i++)
            for (int j = 0; j < n; j++) A[i + j * n] = i - j > below || j - i > 1 ? 0 : tree_roll(&d, -1, 1);
        if (trial % 5 == 4) band[0] = below, band[1] = below + 1;
        if (trial % 5 == 3) band[0] = band[1] = n - 1;
        for (int i = 0; i < n; i++) x[i] = tree_roll(&d, -1, 1);
        memcpy(LU, A, sizeof A);
        memcpy(rows, A, sizeof A);
        if (pivot_lu(LU, row, col, n, n, n, NULL, n, 1e-3) < n) continue;
        assert_int_equal(pivot_rows(rows, swap, band, n, n), n);
        product(b, A, x, n, false);
        pivot_solve(LU, row, col, b, work, n, n);
        near_all(b, x, n);
        product(b, A, x, n, false);
        pivot_rows_solve(rows, swap, band, b, n, n);
        near_all(b, x, n);
        for (int k = 0; k < 3; k++) product(many + k * n, A, x, n, false);
        for (int i = 0; i < n; i++) many[n + i] *= 2;
        pivot_rows_solves(rows, swap, band, many, n, n, 3);
        for (int i = 0; i < n; i++) many[n + i] /= 2;
        for (int k = 0; k < 3; k++) near_all(many + k * n, x, n);
        product(b, A, x, n, true);
        pivot_rows_tsolve(rows, swap, band, b, n, n);
        near_all(b, x, n);
        done++;
    }
    assert_true(done > 300);
}

/* Columns that are to stay out are taken last: never while others give the rank. */
static void preferences(void **state)
{
    struct tree_dice d = {3};
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        const int m = 4, n = 8;
        int row[4], col[8], out = tree_pick(&d, n);
        double A[32], weight[8];
        random_matrix(A, &d, m, n, 0);
        for (int j = 0; j < n; j++) weight[j] = j == out ? 1e-7 : 1;
        assert_int_equal(pivot_lu(A, row, col, m, n, m, weight, m, 0), m);
        for (int k = 0; k < m; k++) assert_int_not_equal(col[k], out);
    }
}

/* Few numbers in each row, often equal ones. */
static void few_numbers(double *A, int *start, int *column, double *value, struct tree_dice *d, int m, int n,
                        bool whole)
{
    const int some = 1 + tree_pick(d, 4);
    start[0] = 0;
    for (int i = 0; i < m; i++) {
        start[i + 1] = start[i];
        for (int k = 0, j = tree_pick(d, n); k < some && j < n; k++, j += 1 + tree_pick(d, 3)) {
            A[i + j * m] = whole ? tree_pick(d, 5) - 2 : tree_roll(d, -1, 1);
            column[start[i + 1]] = j;
            value[start[i + 1]++] = A[i + j * m];
        }
    }
}

/* One step of elimination of A [m x n], exchanged; the largest |number| weight behind it. */
static double step_on(double *A, int k, int m, int n, const double *weight, const int *col)
{
    double most = 0;
    for (int i = k + 1; i < m; i++)
        for (int j = k + 1; j < n; j++) {
            A[i + j * m] -= A[i + k * m] / A[k + k * m] * A[k + j * m];
            most = fmax(most, fabs(A[i + j * m]) * weight[col[j]]);
        }
    return most;
}

/* By rows: the rank of the dense matrix; pivots that elimination in this order meets, none below half of what is left;
 * nothing left behind the last. */
static void by_rows(void **state)
{
    struct tree_dice d = {4};
    struct arena *scratch = arena_open();
    const size_t used = arena_mark(scratch).used;
    int deficient = 0;
    (void)state;
    for (int trial = 0; trial < 2000; trial++) {
        const int m = 1 + tree_pick(&d, MOST), n = 1 + tree_pick(&d, MOST);
        int row[MOST], col[MOST], row2[MOST], col2[MOST], start[MOST + 1], column[MOST * MOST];
        double A[MOST * MOST] = {0}, B[MOST * MOST], value[MOST * MOST], pivot[MOST], weight[MOST], left = 0;
        few_numbers(A, start, column, value, &d, m, n, trial % 2);
        for (int j = 0; j < n; j++) weight[j] = trial % 3 || tree_pick(&d, 4) ? 1 : .1;
        int rank =
            sparse_pivot(row, col, pivot, start, column, value, m, n, trial % 3 ? NULL : weight, m, 1e-11, scratch);
        for (int i = 0; i < m; i++)
            for (int j = 0; j < n; j++) {
                B[i + j * m] = A[row[i] + col[j] * m];
                left = fmax(left, fabs(A[i + j * m]) * weight[j]);
            }
        for (int k = 0; k < rank; k++) {
            assert_true(fabs(pivot[k] - B[k + k * m]) < 1e-12);
            assert_true(fabs(pivot[k]) * weight[col[k]] > .5 * left - 1e-12);
            left = step_on(B, k, m, n, weight, col);
        }
        assert_true(left < 1e-10);
        assert_int_equal(pivot_lu(A, row2, col2, m, n, m, NULL, m, 1e-11), rank);
        deficient += rank < m && rank < n;
    }
    assert_true(deficient > 200);
    assert_true(arena_mark(scratch).used == used);
    arena_close(scratch);
}

/* Many rows in a chain: as many pivots, found as fast as there are rows. */
static void long_chain(void **state)
{
    enum { N = 20000 };
    struct arena *scratch = arena_open();
    int *start = TAKE(scratch, int, N + 1), *column = TAKE(scratch, int, 3 * N);
    int *row = TAKE(scratch, int, N), *col = TAKE(scratch, int, N + 2);
    double *value = TAKE(scratch, double, 3 * N), *pivot = TAKE(scratch, double, N);
    (void)state;
    for (int i = 0; i < N; i++) {
        start[i + 1] = start[i] + 3;
        for (int k = 0; k < 3; k++) {
            column[3 * i + k] = i + k;
            value[3 * i + k] = (i * 7 + k * 3) % 5 - 2.5;
        }
    }
    const size_t before = arena_used(scratch);
    assert_int_equal(sparse_pivot(row, col, pivot, start, column, value, N, N + 2, NULL, N, 1e-12, scratch), N);
    assert_true(arena_used(scratch) - before < (size_t)N * 1000);
    arena_close(scratch);
}

/* Square bands in compact storage: bit for bit those of full storage. */
static void compact(void **state)
{
    enum { N = 20, BELOW = 3, ABOVE = 5, LD = BELOW + ABOVE };
    struct tree_dice d = {5};
    (void)state;
    for (int trial = 0; trial < 100; trial++) {
        const int band[2] = {BELOW, ABOVE};
        int swap[N], swap2[N];
        double A[N * N] = {0}, store[N * (LD + 1)] = {0}, *B = store + ABOVE, x[N], y[N];
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++)
                if (i - j <= BELOW && j - i <= ABOVE - BELOW) A[i + j * N] = B[i + j * LD] = tree_roll(&d, -1, 1);
        assert_int_equal(pivot_rows(A, swap, band, N, N), pivot_rows(B, swap2, band, N, LD));
        for (int i = 0; i < N; i++) x[i] = y[i] = tree_roll(&d, -1, 1);
        pivot_rows_solve(A, swap, band, x, N, N);
        pivot_rows_solve(B, swap2, band, y, N, LD);
        assert_memory_equal(x, y, sizeof x);
        pivot_rows_tsolve(A, swap, band, x, N, N);
        pivot_rows_tsolve(B, swap2, band, y, N, LD);
        assert_memory_equal(x, y, sizeof x);
    }
}

static void hopeless(void **state)
{
    (void)state;
    int row[3], col[3];
    const int band[2] = {3, 6};
    double zero[9] = {0}, nan[9], gap[9] = {1, 0, 0, 0, 0, 0, 0, 0, 1};
    for (int i = 0; i < 9; i++) nan[i] = NAN;
    assert_int_equal(pivot_lu(zero, row, col, 3, 3, 3, NULL, 3, 0), 0);
    assert_int_equal(pivot_lu(nan, row, col, 3, 3, 3, NULL, 3, 0), 0);
    assert_int_equal(pivot_rows(zero, row, band, 3, 3), 0);
    assert_int_equal(pivot_rows(nan, row, band, 3, 3), 0);
    assert_int_equal(pivot_rows(gap, row, band, 3, 3), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(ranks),       cmocka_unit_test(solutions),
                                       cmocka_unit_test(preferences), cmocka_unit_test(by_rows),
                                       cmocka_unit_test(long_chain),  cmocka_unit_test(compact),
                                       cmocka_unit_test(hopeless)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
