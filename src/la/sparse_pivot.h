/* sparse_pivot.h -- LU with nearly full pivoting of a matrix of few numbers: rank, and which rows and columns make it.
 *
 * Every pivot is at least half as large as the largest number left; of such pivots one is taken that leaves few new
 * numbers (Markowitz, Management Science 3 (1957) 255).  Time and memory are those of the numbers met: for rows that
 * each reach a few others, as the loops of a mechanism do, in proportion to the rows, times a logarithm for the
 * search. */
#ifndef FMDSUB_LA_SPARSE_PIVOT_H
#define FMDSUB_LA_SPARSE_PIVOT_H

#include "base/arena.h"

/* A [m x n]: row i has the numbers value[e] in columns column[e], start[i] <= e < start[i + 1], no column twice.
 * At most `most` pivots, while |pivot| weight (by column; NULL: 1) is above `least` times the first one; sizes are
 * meant with the weight.  row [m], col [n]: those of the pivots in their order, then the others; pivot [min(m, n)].
 * Returns the number of pivots.  What it takes from `scratch` it gives back. */
int sparse_pivot(int *row, int *col, double *pivot, const int *start, const int *column, const double *value, int m,
                 int n, const double *weight, int most, double least, struct arena *scratch);

#endif
