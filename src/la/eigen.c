/* eigen.c -- see eigen.h */
#include "la/eigen.h"

#include <float.h>
#include <math.h>

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

/* With M = L L': the symmetric problem of L^-1 K L^-T, and X := L^-T X. */
int eigen_general(double *lambda, double *X, double *K, double *M, int n)
{
    int pivot = dense_cholesky(M, n, n);
    if (pivot >= 0) return pivot;
    for (int pass = 0; pass < 2; pass++) { /* K := (L^-1 K)' twice */
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) {
                double sum = K[i + j * n];
                for (int k = 0; k < i; k++) sum -= M[i + k * n] * K[k + j * n];
                K[i + j * n] = sum / M[i + i * n];
            }
        for (int j = 0; j < n; j++)
            for (int i = 0; i < j; i++) {
                double x = K[i + j * n];
                K[i + j * n] = K[j + i * n];
                K[j + i * n] = x;
            }
    }
    for (int j = 0; j < n; j++) /* round-off of the products */
        for (int i = 0; i < j; i++) K[i + j * n] = K[j + i * n] = (K[i + j * n] + K[j + i * n]) / 2;
    eigen_symmetric(lambda, X, K, n);
    for (int j = 0; j < n; j++)
        for (int i = n - 1; i >= 0; i--) {
            double sum = X[i + j * n];
            for (int k = i + 1; k < n; k++) sum -= M[k + i * n] * X[k + j * n];
            X[i + j * n] = sum / M[i + i * n];
        }
    return -1;
}
