/* tiles.h -- matrices by tiles of four rows, each tile by column: a product runs through one from front to end.
 *
 *     A(i, j) = A[(i/4 n + j) 4 + i%4],   n columns
 *
 * Rows are a multiple of four, those that are too many 0.  The order of sums is fixed: the same bits for vectors of any
 * width. */
#ifndef FMDSUB_LA_TILES_H
#define FMDSUB_LA_TILES_H

static inline int tiles_rows(int rows)
{
    return (rows + 3) / 4 * 4;
}

static inline long tiles_at(int i, int j, int n)
{
    return 4 * ((long)(i / 4) * n + j) + i % 4;
}

/* y [rows] := base [rows] + A x, where x is [n], n > 0.  y lies apart from the others. */
void tiles_times(double *y, const double *base, const double *A, const double *x, int rows, int n);

#endif
