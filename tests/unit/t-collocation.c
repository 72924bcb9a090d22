/* t-collocation.c -- the tables of Radau IIA: order conditions, eigenvalues, eigenvectors, error weights; complex LU */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <complex.h>
#include <math.h>

#include "engine/collocation.h"
#include "la/complex.h"

#include <cmocka.h>

/* B(2s - 1): sum b_i c_i^(k-1) = 1/k;  C(s): sum A_ij c_j^(k-1) = c_i^k / k;  the last point is the end. */
static void test_order(void **state)
{
    (void)state;
    for (int s = 3; s <= 5; s += 2) {
        struct collocation o;
        collocation_radau(&o, s);
        assert_true(o.c[s - 1] == 1);
        for (int k = 1; k <= 2 * s - 1; k++) {
            double sum = 0;
            for (int i = 0; i < s; i++) sum += o.b[i] * pow(o.c[i], k - 1);
            if (!(fabs(sum - 1. / k) < 2e-15)) print_error("s = %d, k = %d: %g\n", s, k, sum - 1. / k);
            assert_true(fabs(sum - 1. / k) < 2e-15);
        }
        double beyond = 0;
        for (int i = 0; i < s; i++) beyond += o.b[i] * pow(o.c[i], 2 * s - 1);
        assert_true(fabs(beyond - .5 / s) > 1e-7); /* B(2s) does not hold */
        for (int i = 0; i < s; i++)
            for (int k = 1; k <= s; k++) {
                double sum = 0;
                for (int j = 0; j < s; j++) sum += o.A[i][j] * pow(o.c[j], k - 1);
                assert_true(fabs(sum - pow(o.c[i], k) / k) < 3e-15);
            }
    }
}

/* A = sum t lambda l over all modes, 1 = sum t l; of three stages lambda is 1/3.6378342527444957 (Hairer & Wanner). */
static void test_modes(void **state)
{
    (void)state;
    for (int s = 3; s <= 5; s += 2) {
        struct collocation o;
        collocation_radau(&o, s);
        assert_int_equal(o.nmode, (s + 1) / 2);
        assert_true(o.mode[0].im == 0 && (s != 3 || fabs(o.mode[0].re - 1 / 3.6378342527444957) < 1e-14));
        for (int i = 0; i < s; i++)
            for (int j = 0; j < s; j++) {
                double one = 0, A = 0;
                for (int k = 0; k < o.nmode; k++) {
                    const struct collocation_mode *m = &o.mode[k];
                    double complex part = (m->tre[i] + m->tim[i] * I) * (m->lre[j] + m->lim[j] * I);
                    one += (k ? 2 : 1) * creal(part);
                    A += (k ? 2 : 1) * creal(part * (m->re + m->im * I));
                }
                assert_true(fabs(one - (i == j)) < 1e-12);
                assert_true(fabs(A - o.A[i][j]) < 1e-12);
            }
    }
}

/* lambda f(0) + sum d_i f(c_i) vanishes for polynomials below degree s, and not at s. */
static void test_error(void **state)
{
    (void)state;
    for (int s = 3; s <= 5; s += 2) {
        struct collocation o;
        collocation_radau(&o, s);
        for (int k = 0; k <= s; k++) {
            double sum = k == 0 ? o.mode[0].re : 0;
            for (int i = 0; i < s; i++) sum += o.d[i] * pow(o.c[i], k);
            assert_true(k < s ? fabs(sum) < 1e-14 : fabs(sum) > 1e-4);
        }
    }
}

static void test_complex(void **state)
{
    (void)state;
    enum { N = 7 };
    double re[N * N], im[N * N], lre[N * N], lim[N * N], x[N], y[N];
    int swap[N];
    unsigned seed = 1;
    for (int i = 0; i < N * N; i++) {
        lre[i] = re[i] = (double)(seed = seed * 1664525u + 1013904223u) / 4294967296. - .5;
        lim[i] = im[i] = (double)(seed = seed * 1664525u + 1013904223u) / 4294967296. - .5;
    }
    lre[0] = re[0] = lim[0] = im[0] = 0; /* wants a swap */
    for (int i = 0; i < N; i++) {
        x[i] = y[i] = 0;
        for (int j = 0; j < N; j++) {
            x[i] += re[i + j * N] * (j + 1) - im[i + j * N] * (2 - j);
            y[i] += im[i + j * N] * (j + 1) + re[i + j * N] * (2 - j);
        }
    }
    assert_int_equal(complex_lu(lre, lim, swap, N), -1);
    complex_lu_solve(lre, lim, swap, x, y, N);
    for (int i = 0; i < N; i++) assert_true(fabs(x[i] - (i + 1)) < 1e-12 && fabs(y[i] - (2 - i)) < 1e-12);
    double zre[4] = {1, 2, 2, 4}, zim[4] = {0}; /* singular */
    assert_int_equal(complex_lu(zre, zim, swap, 2), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_modes),
        cmocka_unit_test(test_error),
        cmocka_unit_test(test_complex),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
