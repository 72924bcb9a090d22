/* near.h -- arrays of numbers compared by their largest difference. */
#ifndef FMDSUB_TESTS_NEAR_H
#define FMDSUB_TESTS_NEAR_H

#include <math.h>

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

#endif
