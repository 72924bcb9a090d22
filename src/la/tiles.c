/* tiles.c -- see tiles.h
 *
 * Columns are summed by fours, then what is left of them:
 *
 *     y + ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)) ...,   + a or + (a + b) or + (a + b) + c */
#include "la/tiles.h"

#include <stdbool.h>

#include "la/wide.h"

/* The number of columns is known where this is written in.  more: to y as it is, not to base. */
INTO static inline void pass(double *restrict y, const double *restrict base, const double *restrict A,
                             const double *restrict x, int columns, int tiles, int n, bool more)
{
    const int rest = columns % 4, from = columns - rest;
    for (int t = 0; t < tiles; t++)
        for (int i = 0; i < 4; i++) {
            const double *a = A + 4 * (long)n * t + i, *b = a + 4 * from;
            double sum = more ? y[4 * t + i] : base[4 * t + i];
            if (columns >= 4) sum += (a[0] * x[0] + a[4] * x[1]) + (a[8] * x[2] + a[12] * x[3]);
            if (columns >= 8) sum += (a[16] * x[4] + a[20] * x[5]) + (a[24] * x[6] + a[28] * x[7]);
            if (rest == 1) sum += b[0] * x[from];
            if (rest >= 2) sum += b[0] * x[from] + b[4] * x[from + 1];
            if (rest == 3) sum += b[8] * x[from + 2];
            y[4 * t + i] = sum;
        }
}

#define PASS(columns)                                                                                                  \
    case columns:                                                                                                      \
        pass(y, base, A, x, columns, tiles, n, more);                                                                  \
        break

/* y += columns from j on, four at a time, the last time with what is left: from four to seven. */
INTO static inline void add_rest(int j, double *restrict y, const double *restrict A, const double *restrict x,
                                 int tiles, int n)
{
    const double *const base = x; /* not looked at */
    const bool more = true;
    A += 4 * j;
    x += j;
    for (int columns; j < n; j += columns, A += 4 * columns, x += columns) {
        columns = n - j < 8 ? n - j : 4;
        switch (columns) {
            PASS(4);
            PASS(5);
            PASS(6);
            PASS(7);
        }
    }
}

/* Up to eleven columns in one pass, else eight at first: as many as there are registers for x. */
WIDE void tiles_times(double *y, const double *base, const double *A, const double *x, int rows, int n)
{
    const bool more = false;
    const int tiles = rows / 4, columns = n < 12 ? n : 8;
    switch (columns) {
        PASS(1);
        PASS(2);
        PASS(3);
        PASS(4);
        PASS(5);
        PASS(6);
        PASS(7);
        PASS(8);
        PASS(9);
        PASS(10);
        PASS(11);
    }
    add_rest(columns, y, A, x, tiles, n);
}
