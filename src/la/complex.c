/* complex.c -- see complex.h */
#include "la/complex.h"

#include <math.h>

/* y -= (a + i b) x */
static void subtract(double *yre, double *yim, double a, double b, const double *xre, const double *xim, int n)
{
    for (int i = 0; i < n; i++) {
        yre[i] -= a * xre[i] - b * xim[i];
        yim[i] -= a * xim[i] + b * xre[i];
    }
}

static void exchange(double *x, int i, int j)
{
    const double kept = x[i];
    x[i] = x[j];
    x[j] = kept;
}

/* x *= 1 / (a + i b) (Smith 1962) */
static void divide(double *xre, double *xim, double a, double b)
{
    const double re = *xre, im = *xim;
    if (fabs(a) >= fabs(b)) {
        const double r = b / a, d = a + b * r;
        *xre = (re + im * r) / d;
        *xim = (im - re * r) / d;
    } else {
        const double r = a / b, d = a * r + b;
        *xre = (re * r + im) / d;
        *xim = (im * r - re) / d;
    }
}

static int largest(const double *re, const double *im, int from, int n)
{
    int at = from;
    double most = 0;
    for (int i = from; i < n; i++) {
        const double size = fabs(re[i]) + fabs(im[i]);
        if (size > most) most = size, at = i;
    }
    return most > 0 && isfinite(most) ? at : -1;
}

int complex_lu(double *re, double *im, int *swap, int n)
{
    for (int k = 0; k < n; k++) {
        double *cre = re + k * n, *cim = im + k * n;
        const int p = swap[k] = largest(cre, cim, k, n);
        if (p < 0) return k;
        for (int j = 0; j < n && p != k; j++) exchange(re + j * n, k, p), exchange(im + j * n, k, p);
        for (int i = k + 1; i < n; i++) divide(&cre[i], &cim[i], cre[k], cim[k]);
        for (int j = k + 1; j < n; j++)
            if (re[k + j * n] != 0 || im[k + j * n] != 0)
                subtract(re + j * n + k + 1, im + j * n + k + 1, re[k + j * n], im[k + j * n], cre + k + 1, cim + k + 1,
                         n - k - 1);
    }
    return -1;
}

void complex_lu_solve(const double *re, const double *im, const int *swap, double *xre, double *xim, int n)
{
    for (int k = 0; k < n; k++) exchange(xre, k, swap[k]), exchange(xim, k, swap[k]);
    for (int k = 0; k < n; k++) {
        const double *cre = re + k * n + k + 1, *cim = im + k * n + k + 1;
        subtract(xre + k + 1, xim + k + 1, xre[k], xim[k], cre, cim, n - k - 1);
    }
    for (int k = n - 1; k >= 0; k--) {
        divide(&xre[k], &xim[k], re[k + k * n], im[k + k * n]);
        subtract(xre, xim, xre[k], xim[k], re + k * n, im + k * n, k);
    }
}
