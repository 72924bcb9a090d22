/* t-misprints.c -- the paper's equations as printed and as corrected in man/fmdsub-equations.7.
 *
 * Nothing here calls the program: the formulas of the page are written out and held against what they stand for:
 * a motion of constant acceleration, an augmented system solved whole, and for h -> 0 the true motion. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

/* x := A^-1 x by Gauss with column pivots; A [n x n] by row, overwritten. */
static void solve(double *A, double *x, int n)
{
    for (int k = 0; k < n; k++) {
        int p = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(A[i * n + k]) > fabs(A[p * n + k])) p = i;
        for (int j = 0; j < n; j++) {
            double t = A[k * n + j];
            A[k * n + j] = A[p * n + j];
            A[p * n + j] = t;
        }
        double t = x[k];
        x[k] = x[p];
        x[p] = t;
        for (int i = k + 1; i < n; i++) {
            double f = A[i * n + k] / A[k * n + k];
            for (int j = k; j < n; j++) A[i * n + j] -= f * A[k * n + j];
            x[i] -= f * x[k];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) x[i] -= A[i * n + j] * x[j];
        x[i] /= A[i * n + i];
    }
}

/* ---- (2-3*), (2-4*): three coordinates, the last dependent ---- */

static const double M3[3][3] = {{3, .5, -.4}, {.5, 2, .7}, {-.4, .7, 1.5}};
static const double Q3[3] = {1.1, -.6, 2.3}; /* Q_F + Q_v - K q */
static const double Cq[3] = {.8, -1.3, .6};
static const double gacc = .9;

static void augmented(double *a)
{
    double A[16], x[4];
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) A[4 * i + j] = M3[i][j];
        A[4 * i + 3] = A[12 + i] = Cq[i];
        x[i] = Q3[i];
    }
    A[15] = 0;
    x[3] = gacc;
    solve(A, x, 4);
    memcpy(a, x, 3 * sizeof *a);
}

/* The accelerations of (2-4); printed: C_qd' for C_qi' in the last term of M^. */
static void condensed(double *a, int printed)
{
    double B[2] = {Cq[0] / Cq[2], Cq[1] / Cq[2]}, g = gacc / Cq[2], M[4];
    for (int i = 0; i < 2; i++) {
        double left = printed ? 1 : B[i];
        for (int j = 0; j < 2; j++) M[2 * i + j] = M3[i][j] - M3[i][2] * B[j] - left * (M3[2][j] - M3[2][2] * B[j]);
        a[i] = Q3[i] - M3[i][2] * g - B[i] * (Q3[2] - M3[2][2] * g);
    }
    solve(M, a, 2);
    a[2] = g - B[0] * a[0] - B[1] * a[1];
}

static void test_condensed(void **state)
{
    double whole[3], part[3];
    (void)state;
    augmented(whole);
    condensed(part, 0);
    for (int i = 0; i < 3; i++) assert_true(fabs(part[i] - whole[i]) < 1e-12);
    condensed(part, 1);
    assert_true(fabs(part[0] - whole[0]) > 1e-2);
}

/* ---- (2-17), (2-18), (2-24): accelerations made of interpolated positions ---- */

struct newmark {
    double a0, a2, a3;
};

static struct newmark constants(double beta, double h)
{
    return (struct newmark){1 / (beta * h * h), 1 / (beta * h), 1 / (2 * beta) - 1};
}

static double printed_17(const struct newmark *c, int n, double dq, double v, double a)
{
    return c->a0 / n * dq - c->a2 * v - c->a3 * a;
}

static double printed_18(const struct newmark *c, int n, double dq, double v, double a)
{
    return c->a0 / n * dq - c->a2 / n * v - c->a3 * a;
}

static double printed_24(const struct newmark *c, int n, int i, double dq, const double *v, const double *a)
{
    return (c->a0 * dq - c->a2 * ((n - i) * v[0] + i * v[1]) - c->a3 * ((n - i) * a[0] + i * a[1])) / n;
}

static void test_constant_acceleration(void **state)
{
    const double h = .1, v = .7, a = 1.3, betas[] = {.25, .3025};
    (void)state;
    for (int n = 1; n <= 7; n++)
        for (int k = 0; k < 2; k++) {
            double beta = betas[k], H = n * h, mean = 0;
            struct newmark c = constants(beta, h);
            double dqH = H * v + H * H / 2 * a, dqh = h * v + h * h / 2 * a;
            double ends[2] = {v, v + H * a}, same[2] = {a, a};
            double x17 = printed_17(&c, n, dqH, v, a) / a, x18 = printed_18(&c, n, dqh, v, a) / a;
            assert_true(fabs(x17 - (1 + (n - 1) / (2 * beta))) < 1e-11);
            assert_true(fabs(x18 - (1 - (n - 1) / (2 * n * beta))) < 1e-11);
            if (k == 0) assert_true(fabs(x17 - (2 * n - 1)) < 1e-11 && fabs(x18 - (2. / n - 1)) < 1e-11);
            for (int i = 0; i < n; i++) {
                double x24 = printed_24(&c, n, i, dqH, ends, same) / a;
                assert_true(fabs(x24 - (1 + (n - 2 * i - 1) / (2 * beta))) < 1e-11);
                mean += x24 / n;
            }
            assert_true(fabs(mean - 1) < 1e-11);
        }
}

/* ---- the scheme of (2-13)...(2-25) on M a + K q = 0 with common inertia ---- */

enum { L, S };
static const double M[2][2] = {{2, .6}, {.6, 1}}, K[2][2] = {{24, -20}, {-20, 400}};
static const double beta = .25;

struct motion {
    double q[2], v[2], a[2];
};

static void accelerate(struct motion *x)
{
    double A[4] = {M[0][0], M[0][1], M[1][0], M[1][1]};
    for (int i = 0; i < 2; i++) x->a[i] = -K[i][0] * x->q[0] - K[i][1] * x->q[1];
    solve(A, x->a, 2);
}

/* (2-5), (2-6) */
static void advance(double *q, double *v, double h, double a0, double a1)
{
    *q += h * *v + h * h / 2 * ((1 - 2 * beta) * a0 + 2 * beta * a1);
    *v += h / 2 * (a0 + a1);
}

/* Rows S at t + h and L at t + H for z = (q''_S1, q''_Ln). */
static void common_rows(double *r, const struct motion *x, const double *z, double h, int n, int printed)
{
    double H = n * h, qS = x->q[S], vS = x->v[S], qL = x->q[L], vL = x->v[L];
    struct newmark c = constants(beta, h);
    advance(&qS, &vS, h, x->a[S], z[0]);
    advance(&qL, &vL, H, x->a[L], z[1]);
    double qL1 = ((n - 1) * x->q[L] + qL) / n, qSn = x->q[S] + n * (qS - x->q[S]);
    double aL1 = ((n - 1) * x->a[L] + z[1]) / n, aSn = x->a[S] + n * (z[0] - x->a[S]);
    if (printed) {
        aL1 = printed_17(&c, n, qL - x->q[L], x->v[L], x->a[L]);
        aSn = printed_18(&c, n, qS - x->q[S], x->v[S], x->a[S]);
    }
    r[0] = M[S][S] * z[0] + M[S][L] * aL1 + K[S][L] * qL1 + K[S][S] * qS;
    r[1] = M[L][L] * z[1] + M[L][S] * aSn + K[L][L] * qL + K[L][S] * qSn;
}

static void common(double *z, const struct motion *x, double h, int n, int printed)
{
    const double none[2] = {0, 0};
    double c[2], e[2], A[4];
    common_rows(c, x, none, h, n, printed);
    for (int j = 0; j < 2; j++) {
        double unit[2] = {j == 0, j == 1};
        common_rows(e, x, unit, h, n, printed);
        for (int i = 0; i < 2; i++) A[2 * i + j] = e[i] - c[i];
    }
    z[0] = -c[0];
    z[1] = -c[1];
    solve(A, z, 2);
}

static void major(struct motion *x, double h, int n, int printed)
{
    double z[2], qL = x->q[L], vL = x->v[L];
    struct newmark c = constants(beta, h);
    common(z, x, h, n, printed);
    advance(&qL, &vL, n * h, x->a[L], z[1]);
    double v[2] = {x->v[L], vL}, a[2] = {x->a[L], z[1]};
    for (int i = 0; i < n; i++) {
        double s = (i + 1.) / n, qLi = (1 - s) * x->q[L] + s * qL, aS = z[0];
        if (i > 0) {
            double aL = printed ? printed_24(&c, n, i, qL - x->q[L], v, a) : (1 - s) * a[0] + s * a[1];
            double star = x->q[S] + h * x->v[S] + h * h / 2 * (1 - 2 * beta) * x->a[S];
            aS = -(M[S][L] * aL + K[S][L] * qLi + K[S][S] * star) / (M[S][S] + beta * h * h * K[S][S]);
        }
        advance(&x->q[S], &x->v[S], h, x->a[S], aS);
        x->a[S] = aS;
    }
    x->q[L] = qL;
    x->v[L] = vL;
    x->a[L] = z[1];
}

/* q_L, q_S at t = 1 by n minor steps to a major one. */
static struct motion run(int steps, int n, int printed)
{
    struct motion x = {.q = {1, .2}, .v = {.3, 0}};
    accelerate(&x);
    for (int k = 0; k < steps / n; k++) major(&x, 1. / steps, n, printed);
    return x;
}

static double apart(const struct motion *x, const struct motion *y)
{
    double d = fmax(fabs(x->q[0] - y->q[0]), fabs(x->q[1] - y->q[1]));
    return isfinite(d) ? d : INFINITY;
}

static void test_step_to_zero(void **state)
{
    struct motion truth = run(1 << 20, 1, 0);
    (void)state;
    for (int n = 2; n <= 4; n *= 2) {
        struct motion x = run(4096, n, 0), y = run(8192, n, 0);
        double coarse = apart(&x, &truth), fine = apart(&y, &truth);
        assert_true(fine < 1e-3 && coarse / fine > 3.4 && coarse / fine < 4.6);
        x = run(4096, n, 1);
        y = run(8192, n, 1);
        coarse = apart(&x, &truth);
        fine = apart(&y, &truth);
        if (n == 2) /* a wrong motion */
            assert_true(fine > .1 && fabs(fine - coarse) < .01);
        else /* none */
            assert_true(fine > 1e6 && fine > 2 * coarse);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_condensed),
        cmocka_unit_test(test_constant_acceleration),
        cmocka_unit_test(test_step_to_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
