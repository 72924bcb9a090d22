/* t-schur.c -- eigenvalues of any matrix: A X = X s, traces, matrices of known spectrum */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <math.h>
#include <string.h>

#include "la/schur.h"

#include <cmocka.h>

enum { MOST = 60 };

static double roll(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 * 2 - 1;
}

/* The largest entry of A X - X s. */
static double defect(const double *A, const double complex *s, const double complex *X, int n)
{
    double most = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double complex sum = -s[j] * X[i + n * j];
            for (int k = 0; k < n; k++) sum += A[i + n * k] * X[k + n * j];
            most = fmax(most, cabs(sum));
        }
    return most;
}

static void test_any(void **state)
{
    uint64_t dice = 3;
    (void)state;
    for (int n = 1; n <= MOST; n += n < 8 ? 1 : 13) {
        struct arena *scratch = arena_open();
        double *A = TAKE(scratch, double, n *n), *B = TAKE(scratch, double, n *n), trace = 0, square = 0;
        double complex *s = TAKE(scratch, double complex, n), *X = TAKE(scratch, double complex, n *n), sum[2] = {0, 0};
        for (int i = 0; i < n * n; i++) B[i] = A[i] = roll(&dice);
        assert_true(schur_eigen(s, X, B, n, scratch));
        assert_true(defect(A, s, X, n) < 1e-12 * n);
        for (int i = 0; i < n; i++) {
            trace += A[i + n * i];
            sum[0] += s[i];
            sum[1] += s[i] * s[i];
            for (int j = 0; j < n; j++) square += A[i + n * j] * A[j + n * i];
        }
        assert_true(cabs(sum[0] - trace) < 1e-12 * n);
        assert_true(cabs(sum[1] - square) < 1e-11 * n);
        arena_close(scratch);
    }
}

/* Cyclic shifts: roots of one on a circle, where plain shifts do not converge; a block of Jordan; zero. */
static void test_known(void **state)
{
    enum { N = 9 };
    double complex s[N], X[N * N];
    double A[N * N] = {0};
    (void)state;
    struct arena *scratch = arena_open();
    for (int i = 0; i < N; i++) A[(i + 1) % N + N * i] = 1;
    assert_true(schur_eigen(s, X, A, N, scratch));
    for (int i = 0; i < N; i++) assert_true(cabs(cpow(s[i], N) - 1) < 1e-12);
    memset(A, 0, sizeof A);
    for (int i = 0; i < N; i++) A[i + N * i] = 2;
    A[N] = 1;
    assert_true(schur_eigen(s, X, A, N, scratch));
    for (int i = 0; i < N; i++) assert_true(cabs(s[i] - 2) < 1e-12);
    memset(A, 0, sizeof A);
    assert_true(schur_eigen(s, X, A, N, scratch));
    for (int i = 0; i < N; i++) assert_true(s[i] == 0);
    A[3] = NAN;
    assert_false(schur_eigen(s, X, A, N, scratch));
    arena_close(scratch);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_any), cmocka_unit_test(test_known)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
