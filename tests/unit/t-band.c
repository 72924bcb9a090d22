/* t-band.c -- band matrices against the same in full storage. */
#include "la/band.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "la/eigen.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { N = 40, WIDTH = 4 };

static double roll(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 * 2 - 1;
}

/* Diagonally dominant, in both storages; freedoms of odd and even number apart where step is 2. */
static struct band random_band(double *A, int step, double growth, uint64_t *dice, struct arena *life)
{
    struct band B = band_take(N, WIDTH, life);
    for (int k = 0; k < N * N; k++) A[k] = 0;
    for (int j = 0; j < N; j++)
        for (int i = j; i < N && i <= j + WIDTH; i += step)
            *band_at(&B, i, j) = A[i + N * j] = A[j + N * i] = i == j ? 2 * WIDTH + 1 + growth * i : roll(dice);
    return B;
}

static void test_solve(void **state)
{
    struct arena *life = arena_open();
    double A[N * N], x[N], b[N], y[N];
    uint64_t dice = 3;
    struct band B = random_band(A, 1, 0, &dice, life), L = band_copy(&B, life);
    (void)state;
    for (int i = 0; i < N; i++) x[i] = roll(&dice);
    band_mul(b, &B, x);
    for (int i = 0; i < N; i++) {
        double sum = 0;
        for (int j = 0; j < N; j++) sum += A[i + N * j] * x[j];
        assert_true(fabs(b[i] - sum) < 1e-12 * (1 + fabs(sum)));
    }
    assert_int_equal(band_cholesky(&L), -1);
    memcpy(y, b, sizeof y);
    band_cholesky_solve(&L, y);
    for (int i = 0; i < N; i++) assert_true(fabs(y[i] - x[i]) < 1e-13);
    band_lower_solve(&L, b);
    band_upper_solve(&L, b);
    for (int i = 0; i < N; i++) assert_true(b[i] == y[i]);
    arena_close(life);
}

static void test_not_positive(void **state)
{
    struct arena *life = arena_open();
    struct band B = band_take(3, 1, life);
    (void)state;
    for (int i = 0; i < 3; i++) *band_at(&B, i, i) = i == 0 ? 1 : 2; /* free chain but for a round-off */
    *band_at(&B, 0, 1) = *band_at(&B, 2, 1) = -1;
    *band_at(&B, 2, 2) = 1;
    assert_int_equal(band_cholesky(&B), 2);
    *band_at(&B, 0, 0) = -1;
    assert_int_equal(band_cholesky(&B), 0);
    arena_close(life);
}

static void check_lowest(int count, int step, int first)
{
    struct arena *life = arena_open();
    double *A = TAKE(life, double, N *N), *B = TAKE(life, double, N *N), *Q = TAKE(life, double, N *N), l[N];
    double lambda[N], *X = TAKE(life, double, N *N), y[N];
    bool use[N];
    uint64_t dice = 17;
    struct band K = random_band(A, step, 20, &dice, life), M = random_band(B, step, 0, &dice, life),
                L = band_copy(&K, life);
    int n = 0, k = 0;
    for (int i = 0; i < N; i++) use[i] = i >= first && (i - first) % step == 0;
    for (int j = 0; j < N; j++) /* the dense pair of the freedoms used */
        for (int i = 0; use[j] && i < N; i++)
            if (use[i]) A[k] = A[i + N * j], B[k++] = B[i + N * j];
    for (int i = 0; i < N; i++) n += use[i];
    assert_int_equal(eigen_general(l, Q, A, B, n), -1);
    assert_int_equal(band_cholesky(&L), -1);
    assert_true(band_lowest(lambda, X, &L, &M, use, count, life) > 0);
    for (int j = 0; j < count; j++) {
        assert_true(fabs(lambda[j] / l[j] - 1) < 1e-10);
        for (int i = 0; i < N; i++) assert_true(use[i] || X[i + N * j] == 0);
        for (int i = 0; i < count; i++) {
            double sum = i == j ? -1 : 0;
            band_mul(y, &M, X + N * j);
            for (int a = 0; a < N; a++) sum += y[a] * X[a + N * i];
            assert_true(fabs(sum) < 1e-6);
        }
    }
    arena_close(life);
}

static void test_lowest(void **state)
{
    (void)state;
    check_lowest(3, 1, 0);
    check_lowest(10, 1, 0);
    check_lowest(N, 1, 0);
    check_lowest(2, 2, 0);
    check_lowest(N / 2, 2, 1);
}

static void test_too_many(void **state)
{
    struct arena *life = arena_open();
    struct band K = band_take(3, 0, life), M = band_take(3, 0, life);
    double lambda[3], X[9];
    bool use[3] = {true, true, true};
    (void)state;
    for (int i = 0; i < 3; i++) K.a[i] = M.a[i] = i + 1;
    M.a[1] = 0;
    assert_int_equal(band_cholesky(&K), -1);
    assert_true(band_lowest(lambda, X, &K, &M, use, 2, life) > 0);
    assert_true(fabs(lambda[1] - 1) < 1e-15);
    assert_int_equal(band_lowest(lambda, X, &K, &M, use, 3, life), -1); /* one has no mass */
    use[2] = false;
    assert_int_equal(band_lowest(lambda, X, &K, &M, use, 3, life), -1);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_solve),
        cmocka_unit_test(test_not_positive),
        cmocka_unit_test(test_lowest),
        cmocka_unit_test(test_too_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
