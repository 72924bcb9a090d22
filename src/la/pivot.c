/* pivot.c -- see pivot.h */
#include "la/pivot.h"

#include <math.h>
#include <stddef.h>

/* Where the next pivot stands, and the largest |number| left; false: nothing but zeros and NaN. */
static int choose(int *pi, int *pj, double *largest, const double *A, const int *col, int from, int m, int n, int ld,
                  const double *weight)
{
    double best = 0;
    *largest = 0;
    for (int j = from; j < n; j++) {
        double w = weight ? weight[col[j]] : 1;
        for (int i = from; i < m; i++) {
            double x = fabs(A[i + j * ld]);
            if (x > *largest) *largest = x;
            if (!(x * w > best)) continue;
            best = x * w;
            *pi = i;
            *pj = j;
        }
    }
    return best > 0;
}

static void exchange(int *p, int i, int j)
{
    int k = p[i];
    p[i] = p[j];
    p[j] = k;
}

static void bring(double *A, int *row, int *col, int k, int pi, int pj, int m, int n, int ld)
{
    for (int j = 0; pi != k && j < n; j++) {
        double x = A[k + j * ld];
        A[k + j * ld] = A[pi + j * ld];
        A[pi + j * ld] = x;
    }
    for (int i = 0; pj != k && i < m; i++) {
        double x = A[i + k * ld];
        A[i + k * ld] = A[i + pj * ld];
        A[i + pj * ld] = x;
    }
    exchange(row, k, pi);
    exchange(col, k, pj);
}

static void eliminate(double *A, int k, int m, int n, int ld)
{
    double pivot = A[k + k * ld];
    for (int i = k + 1; i < m; i++) A[i + k * ld] /= pivot;
    for (int j = k + 1; j < n; j++) {
        double u = A[k + j * ld];
        if (u == 0) continue;
        for (int i = k + 1; i < m; i++) A[i + j * ld] -= A[i + k * ld] * u;
    }
}

int pivot_lu(double *A, int *row, int *col, int m, int n, int ld, const double *weight, int most, double least)
{
    int k = 0, pi = 0, pj = 0;
    double first = 0, largest;
    for (int i = 0; i < m; i++) row[i] = i;
    for (int j = 0; j < n; j++) col[j] = j;
    for (; k < most && k < m && k < n; k++) {
        if (!choose(&pi, &pj, &largest, A, col, k, m, n, ld, weight)) break;
        if (k == 0) first = largest;
        if (!(largest > least * first)) break;
        bring(A, row, col, k, pi, pj, m, n, ld);
        eliminate(A, k, m, n, ld);
    }
    return k;
}

/* A = P'L U Q': y = P x, L, U, x = Q y. */
void pivot_solve(const double *LU, const int *row, const int *col, double *x, double *work, int n, int ld)
{
    for (int i = 0; i < n; i++) work[i] = x[row[i]];
    for (int j = 0; j < n; j++)
        for (int i = j + 1; i < n; i++) work[i] -= LU[i + j * ld] * work[j];
    for (int j = n - 1; j >= 0; j--) {
        work[j] /= LU[j + j * ld];
        for (int i = 0; i < j; i++) work[i] -= LU[i + j * ld] * work[j];
    }
    for (int j = 0; j < n; j++) x[col[j]] = work[j];
}
