/* sparse_pivot.h -- the pivots of pivot_lu() for a matrix of few numbers, kept by rows.
 *
 * The same pivots in the same order, to the bit: of equal numbers the one that stands first by columns in the
 * exchanged matrix.  Time and memory are those of the numbers met: for rows that each reach a few others, as the loops
 * of a mechanism do, in proportion to the rows (times the logarithm for the search). */
#ifndef FMDSUB_LA_SPARSE_PIVOT_H
#define FMDSUB_LA_SPARSE_PIVOT_H

#include "base/arena.h"

/* A [m x n]: row i has the numbers value[e] in columns column[e], start[i] <= e < start[i + 1], no column twice.
 * weight, most as in pivot_lu(); `least` counts |pivot| weight.  row [m], col [n]: what stands where at the end;
 * pivot [min(m, n)].  Returns the number of pivots.  What it takes from `scratch` it gives back. */
int sparse_pivot(int *row, int *col, double *pivot, const int *start, const int *column, const double *value, int m,
                 int n, const double *weight, int most, double least, struct arena *scratch);

#endif
