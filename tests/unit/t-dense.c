/* t-dense.c -- factorizations against products formed by the textbook triple loop, and against one another */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "la/dense.h"
#include "unit/oscillators.h"

#include <cmocka.h>

enum { MOST = 70 };

struct square {
    double a[MOST * MOST];
};

/* C = A B, by the definition. */
static void product(double *C, const double *A, const double *B, int n, int ld)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            double sum = 0;
            for (int k = 0; k < n; k++) sum += A[i + k * ld] * B[k + j * ld];
            C[i + j * ld] = sum;
        }
}

static void test_cholesky(void **state)
{
    (void)state;
    static struct square A, L, U, LU;
    struct dice dice = {7};
    for (int n = 1; n <= 40; n++) {
        int ld = n + n % 3;
        random_positive(A.a, n, ld, &dice, 1, 1e3);
        memcpy(L.a, A.a, sizeof L.a);
        assert_int_equal(dense_cholesky(L.a, n, ld), -1);
        memset(&U, 0, sizeof U);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                if (i < j)
                    L.a[i + j * ld] = 0;
                else
                    U.a[j + i * ld] = L.a[i + j * ld];
            }
        product(LU.a, L.a, U.a, n, ld);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) assert_true(fabs(LU.a[i + j * ld] - A.a[i + j * ld]) < 1e3 * n * 1e-15);
    }
}

static void test_solves(void **state)
{
    (void)state;
    static struct square A, F;
    double x[3 * MOST], b[3 * MOST], y[3 * MOST];
    int swap[MOST];
    struct dice dice = {11};
    for (int n = 1; n <= MOST; n += 3) {
        random_positive(A.a, n, n, &dice, 1, 1e2);
        for (int i = 0; i < 3 * n; i++) x[i] = dice_range(&dice, -1, 1);
        memset(b, 0, sizeof b);
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++) b[i + k * n] += A.a[i + j * n] * x[j + k * n];
        memcpy(y, b, sizeof y);
        memcpy(F.a, A.a, sizeof F.a);
        assert_int_equal(dense_cholesky(F.a, n, n), -1);
        dense_cholesky_solves(F.a, y, n, n, 3, n);
        for (int i = 0; i < 3 * n; i++) assert_true(fabs(y[i] - x[i]) < 1e-11);
        memcpy(F.a, A.a, sizeof F.a);
        for (int j = 0; j < n; j++) /* an unsymmetric matrix, rows in a turned order: needs pivots */
            for (int i = 0; i < n; i++) F.a[i + j * n] = A.a[(i + 1) % n + j * n];
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < n; i++) y[i + k * n] = b[(i + 1) % n + k * n];
        assert_int_equal(dense_lu(F.a, swap, n, n), -1);
        for (int k = 0; k < 3; k++) dense_lu_solve(F.a, swap, y + k * n, n, n);
        for (int i = 0; i < 3 * n; i++) assert_true(fabs(y[i] - x[i]) < 1e-11);
    }
}

/* The wide and the narrow compilation, and the blocked and the scalar order, give the same bits. */
static void test_bits(void **state)
{
    (void)state;
    static struct square A, L, S;
    struct dice dice = {3};
    int n = 61;
    random_positive(A.a, n, n, &dice, 1, 1e4);
    memcpy(L.a, A.a, sizeof L.a);
    memcpy(S.a, A.a, sizeof S.a);
    dense_cholesky(L.a, n, n);
    for (int j = 0; j < n; j++) {
        for (int k = 0; k < j; k++)
            for (int i = j; i < n; i++) S.a[i + j * n] -= S.a[i + k * n] * S.a[j + k * n];
        S.a[j + j * n] = sqrt(S.a[j + j * n]);
        double s = 1 / S.a[j + j * n];
        for (int i = j + 1; i < n; i++) S.a[i + j * n] *= s;
    }
    for (int j = 0; j < n; j++) assert_memory_equal(L.a + j + j * n, S.a + j + j * n, (size_t)(n - j) * sizeof(double));
}

static void test_singular(void **state)
{
    (void)state;
    int swap[3];
    double A[9] = {4, 2, 2, 2, 1, 1, 2, 1, 5};
    double B[9] = {4, 2, 2, 2, 1, 1, 2, 1, 5};
    double C[4] = {1, 2, 2, 1};
    double D[4] = {1, NAN, NAN, 1};
    double E[4] = {0, 1, 1, 0};
    double Z[1] = {0};
    assert_int_equal(dense_cholesky(A, 3, 3), 1);
    assert_int_equal(dense_lu(B, swap, 3, 3), 1);
    assert_int_equal(dense_cholesky(C, 2, 2), 1);
    assert_int_equal(dense_cholesky(D, 2, 2), 1);
    assert_int_equal(dense_lu(E, swap, 2, 2), -1);
    assert_int_equal(dense_lu(Z, swap, 1, 1), 0);
    assert_int_equal(dense_cholesky(Z, 1, 1), 0);
}

static void test_products(void **state)
{
    (void)state;
    enum { R = 17, N = 5, C = 4, LD = 20 };
    double A[LD * R], B[LD * C], out[LD * C] = {0}, outt[LD * C] = {0}, y[R] = {0}, yt[N] = {0};
    struct dice dice = {5};
    for (int i = 0; i < LD * R; i++) A[i] = dice_range(&dice, -1, 1);
    for (int i = 0; i < LD * C; i++) B[i] = dice_range(&dice, -1, 1);
    dense_gemm(out, 2, A, B, R, N, C, LD, LD, LD);
    dense_gemtm(outt, 2, A, B, N, R, C, LD, LD, LD);
    dense_gemv(y, 2, A, B, R, N, LD);
    dense_gemtv(yt, 2, A, B, R, N, LD);
    for (int j = 0; j < C; j++) {
        for (int i = 0; i < R; i++) {
            double sum = 0;
            for (int k = 0; k < N; k++) sum += 2 * A[i + k * LD] * B[k + j * LD];
            assert_true(fabs(sum - out[i + j * LD]) < 1e-14);
            if (j == 0) assert_true(fabs(sum - y[i]) < 1e-14);
        }
        for (int i = 0; i < N; i++) {
            double sum = 0;
            for (int k = 0; k < R; k++) sum += 2 * A[k + i * LD] * B[k + j * LD];
            assert_true(fabs(sum - outt[i + j * LD]) < 1e-14);
            if (j == 0) assert_true(fabs(sum - yt[i]) < 1e-14);
        }
    }
    assert_true(dense_asymmetry((double[]){2, 1, 1, 1}, 2, 2) == 0);
    assert_true(dense_asymmetry((double[]){2, 1, 0, 1}, 2, 2) == .5);
}

/* As column by column, to the bit, whichever column counts for nothing: that one is not looked at. */
static void test_columns(void **state)
{
    (void)state;
    enum { R = 11, C = 9, LD = 12 };
    struct dice dice = {9};
    for (int rows = 1; rows <= R; rows++)
        for (int cols = 1; cols <= C; cols++)
            for (int none = -1; none < cols; none++) {
                double A[LD * C], x[C], y[R], expected[R];
                for (int i = 0; i < LD * C; i++) A[i] = i / LD == none ? NAN : dice_range(&dice, -1, 1);
                for (int j = 0; j < C; j++) x[j] = j == none ? 0 : dice_range(&dice, -1, 1);
                for (int i = 0; i < rows; i++) y[i] = expected[i] = dice_range(&dice, -1, 1);
                for (int j = 0; j < cols; j++)
                    for (int i = 0; i < rows && j != none; i++) expected[i] += A[i + j * LD] * (3 * x[j]);
                dense_gemv(y, 3, A, x, rows, cols, LD);
                assert_memory_equal(y, expected, sizeof *y * (size_t)rows);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cholesky), cmocka_unit_test(test_solves),   cmocka_unit_test(test_bits),
        cmocka_unit_test(test_singular), cmocka_unit_test(test_products), cmocka_unit_test(test_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
