/* ascending.h -- where a number lies among others that ascend, by halving. */
#ifndef FMDSUB_BASE_ASCENDING_H
#define FMDSUB_BASE_ASCENDING_H

/* The number of the piece from x[i] to x[i + 1] that holds `at`, of x [n]; the outermost one beyond an end. */
static inline int ascending_piece(const double *x, int n, double at)
{
    int lo = 0, hi = n - 1;
    while (hi - lo > 1) {
        const int mid = lo + (hi - lo) / 2;
        if (x[mid] <= at)
            lo = mid;
        else
            hi = mid;
    }
    return lo;
}

#endif
