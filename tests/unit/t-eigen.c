/* t-eigen.c -- eigenvalues of symmetric matrices and pairs, on random ones and on a chain with known values. */
#include "la/eigen.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { MOST = 24 };

static double roll(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 * 2 - 1;
}

/* A = B' B + small, or indefinite. */
static void random_symmetric(double *A, int n, uint64_t *state, int definite)
{
    double B[MOST * MOST];
    for (int i = 0; i < n * n; i++) B[i] = roll(state);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double sum = definite && i == j ? 0.1 : 0;
            for (int k = 0; k < n; k++) sum += B[k + i * n] * B[k + j * n];
            A[i + j * n] = definite ? sum : (B[i + j * n] + B[j + i * n]) / 2;
        }
}

static double defect(const double *K, const double *M, const double *X, const double *lambda, int n)
{
    double worst = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double kx = 0, mx = 0;
            for (int k = 0; k < n; k++) {
                kx += K[i + k * n] * X[k + j * n];
                mx += M ? M[i + k * n] * X[k + j * n] : (i == k) * X[k + j * n];
            }
            worst = fmax(worst, fabs(kx - lambda[j] * mx));
        }
    return worst;
}

static void test_random(void **state)
{
    uint64_t dice = 7;
    (void)state;
    for (int n = 1; n <= MOST; n++) {
        double A[MOST * MOST], B[MOST * MOST], X[MOST * MOST], l[MOST];
        random_symmetric(A, n, &dice, 0);
        memcpy(B, A, sizeof B);
        eigen_symmetric(l, X, B, n);
        assert_true(defect(A, NULL, X, l, n) < 1e-13 * n * n);
        for (int i = 1; i < n; i++) assert_true(l[i] >= l[i - 1]);
    }
}

static void test_pairs(void **state)
{
    uint64_t dice = 11;
    (void)state;
    for (int n = 1; n <= MOST; n++) {
        double K[MOST * MOST], M[MOST * MOST], K1[MOST * MOST], M1[MOST * MOST], X[MOST * MOST], l[MOST];
        random_symmetric(K, n, &dice, 0);
        random_symmetric(M, n, &dice, 1);
        memcpy(K1, K, sizeof K);
        memcpy(M1, M, sizeof M);
        assert_int_equal(eigen_general(l, X, K1, M1, n), -1);
        assert_true(defect(K, M, X, l, n) < 1e-10 * n);
        double graded[MOST], work[2 * MOST * MOST + MOST];
        assert_int_equal(eigen_graded(graded, X, K, M, n, work), -1);
        assert_true(defect(K, M, X, graded, n) < 1e-10 * n);
        for (int i = 0; i < n; i++) assert_true(fabs(graded[i] - l[i]) < 1e-10 * n);
        for (int i = 0; i < n; i++) { /* X' M X = 1 */
            double sum = 0;
            for (int j = 0; j < n; j++)
                for (int k = 0; k < n; k++) sum += X[j + i * n] * M[j + k * n] * X[k + i * n];
            assert_true(fabs(sum - 1) < 1e-10);
        }
    }
}

/* n equal masses and springs between walls: lambda_j = 4 sin^2(j pi / (2 (n + 1))). */
static void test_chain(void **state)
{
    enum { N = 20 };
    double K[N * N] = {0}, M[N * N] = {0}, X[N * N], l[N];
    (void)state;
    for (int i = 0; i < N; i++) {
        K[i + i * N] = 2;
        M[i + i * N] = 1;
        if (i) K[i - 1 + i * N] = K[i + (i - 1) * N] = -1;
    }
    assert_int_equal(eigen_general(l, X, K, M, N), -1);
    for (int j = 1; j <= N; j++) {
        double s = sin(j * acos(-1) / (2 * (N + 1)));
        assert_true(fabs(l[j - 1] - 4 * s * s) < 1e-14);
    }
}

/* A mass on a rod of n light pieces: heavy and slow beside light and quick, by 12 decades. */
static void test_graded(void **state)
{
    enum { N = 12 };
    double K[N * N] = {0}, M[N * N] = {0}, X[N * N], l[N], work[2 * N * N + N], low = 0;
    (void)state;
    for (int i = 0; i < N; i++) { /* the first spring holds the wall; every coordinate moves all masses outside */
        K[i + i * N] = pow(10, i);
        for (int j = 0; j < N; j++) M[j + i * N] = 1 + (i == j ? 1e-9 : 0);
        low += 1 / K[i + i * N];
    }
    assert_int_equal(eigen_graded(l, X, K, M, N, work), -1);
    assert_true(fabs(l[0] * low - 1) < 1e-8); /* springs in a row, and the light masses' part */
    for (int i = 1; i < N; i++) assert_true(l[i] > l[i - 1]);
    for (int i = 0; i < N; i++) K[i + i * N] -= 0.5 * M[i + i * N]; /* and one that grows */
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            if (i != j) K[i + j * N] -= 0.5 * M[i + j * N];
    const double shifted = l[0] - 0.5;
    assert_int_equal(eigen_graded(l, X, K, M, N, work), -1);
    assert_true(fabs(l[0] - shifted) < 1e-12);
    K[0] = K[3] = 2, K[1] = K[2] = -2; /* two equal masses on a spring */
    M[0] = M[3] = 1, M[1] = M[2] = 0;
    assert_int_equal(eigen_graded(l, X, K, M, 2, work), -1);
    assert_true(l[0] == 0 && fabs(l[1] - 4) < 1e-14);
    K[0] = K[3] = 0; /* no stiffness of a coordinate alone */
    assert_int_equal(eigen_graded(l, X, K, M, 2, work), -1);
    assert_true(fabs(l[0] + 2) < 1e-14 && fabs(l[1] - 2) < 1e-14);
}

static void test_not_positive(void **state)
{
    double K[4] = {1, 0, 0, 1}, M[4] = {1, 2, 2, 1}, X[4], l[2];
    (void)state;
    double work[10];
    assert_int_equal(eigen_graded(l, X, K, M, 2, work), 1);
    assert_int_equal(eigen_general(l, X, K, M, 2), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_random),       cmocka_unit_test(test_pairs),  cmocka_unit_test(test_chain),
        cmocka_unit_test(test_not_positive), cmocka_unit_test(test_graded),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
