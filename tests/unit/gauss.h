/* gauss.h -- A x = b by elimination with row pivoting. */
#ifndef FMDSUB_TESTS_GAUSS_H
#define FMDSUB_TESTS_GAUSS_H

#include <math.h>

/* x := A^-1 x; A [n x n] by column is overwritten. */
static inline void gauss(double *A, double *x, int n)
{
    for (int k = 0; k < n; k++) {
        int p = k;
        for (int i = k; i < n; i++)
            if (fabs(A[i + n * k]) > fabs(A[p + n * k])) p = i;
        for (int j = 0; j < n; j++) {
            double t = A[k + n * j];
            A[k + n * j] = A[p + n * j], A[p + n * j] = t;
        }
        double t = x[k];
        x[k] = x[p], x[p] = t;
        for (int i = k + 1; i < n; i++) {
            double l = A[i + n * k] / A[k + n * k];
            for (int j = k; j < n; j++) A[i + n * j] -= l * A[k + n * j];
            x[i] -= l * x[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++) x[k] -= A[k + n * j] * x[j];
        x[k] /= A[k + n * k];
    }
}

#endif
