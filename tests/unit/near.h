/* near.h -- arrays of numbers compared by their largest difference. */
#ifndef FMDSUB_TESTS_NEAR_H
#define FMDSUB_TESTS_NEAR_H

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

/* Largest difference; infinite when one is not a number. */
static inline double worst(const double *a, const double *b, int n)
{
    double x = 0;
    for (int i = 0; i < n; i++) x = fmax(x, isnan(a[i] - b[i]) ? INFINITY : fabs(a[i] - b[i]));
    return x;
}

static inline double size(const double *a, int n)
{
    double x = 1;
    for (int i = 0; i < n; i++) x = fmax(x, fabs(a[i]));
    return x;
}

/* Of the size of b, at least 1. */
#define NEAR(a, b, n, tolerance) assert_true(worst(a, b, n) <= (tolerance)*size(b, n))

/* The same, and says which is not. */
static inline bool all_near(const double *a, const double *b, int n, double tolerance)
{
    const double most = tolerance * size(b, n);
    for (int i = 0; i < n; i++) {
        if (fabs(a[i] - b[i]) <= most) continue;
        fprintf(stderr, "entry %d: %.17g is not %.17g\n", i, a[i], b[i]);
        return false;
    }
    return true;
}

#endif
