/* eigen.c -- see eigen.h */
#include "la/eigen.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "la/dense.h"

enum { MOST_SWEEPS = 60 };

/* Rotates rows and columns p, q of A so that A(p,q) vanishes. */
static void rotate(double *A, double *X, int p, int q, int n)
{
    double apq = A[p + q * n], theta = (A[q + q * n] - A[p + p * n]) / (2 * apq);
    double t = (theta < 0 ? -1 : 1) / (fabs(theta) + hypot(theta, 1)), c = 1 / hypot(t, 1), s = t * c;
    for (int i = 0; i < n; i++) {
        double ip = A[i + p * n], iq = A[i + q * n];
        A[i + p * n] = c * ip - s * iq;
        A[i + q * n] = s * ip + c * iq;
    }
    for (int i = 0; i < n; i++) {
        double pi = A[p + i * n], qi = A[q + i * n], xp = X[i + p * n], xq = X[i + q * n];
        A[p + i * n] = c * pi - s * qi;
        A[q + i * n] = s * pi + c * qi;
        X[i + p * n] = c * xp - s * xq;
        X[i + q * n] = s * xp + c * xq;
    }
    A[p + q * n] = A[q + p * n] = 0;
}

static void swap_columns(double *lambda, double *X, int a, int b, int n)
{
    double l = lambda[a];
    lambda[a] = lambda[b];
    lambda[b] = l;
    for (int i = 0; i < n; i++) {
        double x = X[i + a * n];
        X[i + a * n] = X[i + b * n];
        X[i + b * n] = x;
    }
}

/* Ascending, and the largest entry of each column positive. */
static void arrange(double *lambda, double *X, int n)
{
    for (int a = 0; a < n; a++) {
        int least = a, top = 0;
        for (int b = a + 1; b < n; b++)
            if (lambda[b] < lambda[least]) least = b;
        if (least != a) swap_columns(lambda, X, a, least, n);
        double *x = X + a * n;
        for (int i = 1; i < n; i++)
            if (fabs(x[i]) > fabs(x[top]) * (1 + 1e-9)) top = i;
        for (int i = 0; x[top] < 0 && i < n; i++) x[i] = i == top ? x[i] : -x[i];
        x[top] = fabs(x[top]);
    }
}

void eigen_symmetric(double *lambda, double *X, double *A, int n)
{
    for (int i = 0; i < n * n; i++) X[i] = i % (n + 1) == 0;
    for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
        int rotations = 0;
        for (int q = 1; q < n; q++)
            for (int p = 0; p < q; p++) {
                double off = fabs(A[p + q * n]), size = sqrt(fabs(A[p + p * n])) * sqrt(fabs(A[q + q * n]));
                if (off <= DBL_EPSILON * size || off < DBL_MIN) continue;
                rotate(A, X, p, q, n);
                rotations++;
            }
        if (!rotations) break;
    }
    for (int i = 0; i < n; i++) lambda[i] = A[i + i * n];
    arrange(lambda, X, n);
}

/* A := L^-1 A L^-T, symmetric. */
static void both_sides(double *A, const double *L, int n)
{
    for (int pass = 0; pass < 2; pass++) { /* A := (L^-1 A)' twice */
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                double sum = A[i + j * n];
                for (int k = 0; k < i; k++) sum -= L[i + k * n] * A[k + j * n];
                A[i + j * n] = sum / L[i + i * n];
            }
        for (int j = 0; j < n; j++)
            for (int i = 0; i < j; i++) {
                double x = A[i + j * n];
                A[i + j * n] = A[j + i * n];
                A[j + i * n] = x;
            }
    }
    for (int j = 0; j < n; j++) /* round-off of the products */
        for (int i = 0; i < j; i++) A[i + j * n] = A[j + i * n] = (A[i + j * n] + A[j + i * n]) / 2;
}

/* X := L^-T X. */
static void back(double *X, const double *L, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = n - 1; i >= 0; i--) {
            double sum = X[i + j * n];
            for (int k = i + 1; k < n; k++) sum -= L[k + i * n] * X[k + j * n];
            X[i + j * n] = sum / L[i + i * n];
        }
}

/* With M = L L': the symmetric problem of L^-1 K L^-T, and X := L^-T X. */
int eigen_general(double *lambda, double *X, double *K, double *M, int n)
{
    int pivot = dense_cholesky(M, n, n);
    if (pivot >= 0) return pivot;
    both_sides(K, M, n);
    eigen_symmetric(lambda, X, K, n);
    back(X, M, n);
    return -1;
}

/* ---- graded ---- */

/* A := D (K + sigma M) D factored, D [n] such that its diagonal is one.  Positive, with no pivot below `least`, so that it is
 * not by round-off alone? */
static bool shifted_cholesky(double *A, double *D, const double *K, const double *M, double sigma, double least, int n)
{
    for (int i = 0; i < n; i++) {
        const double k = K[i + i * n] + sigma * M[i + i * n];
        if (!(k > 0)) return false;
        D[i] = 1 / sqrt(k);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) A[i + j * n] = (K[i + j * n] + sigma * M[i + j * n]) * D[i] * D[j];
    if (dense_cholesky(A, n, n) >= 0) return false;
    for (int i = 0; i < n; i++)
        if (A[i + i * n] * A[i + i * n] < least) return false;
    return true;
}

/* The least shift, by decades; -1: there is none.  Pivots of the mass matrix of a long chain are small beside its diagonal,
 * 1e-8 of it with 300 links: where no shift makes them large, smaller ones do. */
static double shift(double *A, double *D, const double *K, const double *M, int n)
{
    double most = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) most = fmax(most, fabs(K[i + j * n]) / sqrt(M[i + i * n] * M[j + j * n]));
    if (most == 0) most = 1;
    for (double least = 1e-6; least > 1e-13; least *= 1e-3) {
        if (shifted_cholesky(A, D, K, M, 0, least, n)) return 0;
        for (double part = 1e-14; part < 1e6; part *= 10)
            if (shifted_cholesky(A, D, K, M, part * most, least, n)) return part * most;
    }
    return -1;
}

static double form(const double *A, const double *x, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) sum += x[i] * A[i + j * n] * x[j];
    return sum;
}

static int largest(const double *x, int n)
{
    int top = 0;
    for (int i = 1; i < n; i++)
        if (fabs(x[i]) > fabs(x[top])) top = i;
    return top;
}

/* Unit mass, Rayleigh's quotient, round-off of its terms is nothing; false: the motion has no mass. */
static bool finish(double *lambda, double *x, const double *K, const double *M, double sigma, int n)
{
    static const double nothing = 1e-15;
    double terms = sigma;
    const double mass = form(M, x, n);
    if (!(mass > 0)) return false;
    for (int i = 0; i < n; i++) x[i] /= sqrt(mass);
    *lambda = form(K, x, n);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) terms += fabs(x[i] * K[i + j * n] * x[j]);
    if (fabs(*lambda) <= nothing * terms) *lambda = 0;
    return true;
}

/* Columns of X and lambda from the last to the first. */
static void turn_round(double *lambda, double *X, int n)
{
    for (int a = 0, b = n - 1; a < b; a++, b--) swap_columns(lambda, X, a, b, n);
}

int eigen_graded(double *lambda, double *X, const double *K, const double *M, int n, double *work)
{
    double *L = work, *H = work + (long)n * n, *D = H + (long)n * n;
    memcpy(L, M, sizeof *L * (size_t)n * (size_t)n);
    const int pivot = dense_cholesky(L, n, n);
    if (pivot >= 0) return pivot;
    const double sigma = shift(L, D, K, M, n);
    if (!(sigma >= 0)) return n - 1;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) H[i + j * n] = M[i + j * n] * D[i] * D[j];
    both_sides(H, L, n);
    eigen_symmetric(lambda, X, H, n);
    turn_round(lambda, X, n);
    back(X, L, n);
    for (int j = 0; j < n; j++) {
        double *x = X + (long)j * n;
        for (int i = 0; i < n; i++) x[i] *= D[i];
        if (!finish(lambda + j, x, K, M, sigma, n)) return largest(x, n);
    }
    arrange(lambda, X, n);
    return -1;
}
