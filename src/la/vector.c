/* vector.c -- see vector.h */
#include "la/vector.h"

#include "la/wide.h"

WIDE void vector_times_many(double *y, double s, const double *x, int n)
{
    for (int i = 0; i < n; i++) y[i] = s * x[i];
}

WIDE void vector_move_many(double *y, const double *x, double s, const double *d, int n)
{
    for (int i = 0; i < n; i++) y[i] = x[i] + s * d[i];
}
