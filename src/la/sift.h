/* sift.h -- y = base + A x for a matrix A that stays as it is and may be zero in most places.
 *
 * Rows with the same places (or nearly) stand together as a dense group of the columns that they have; rows of zeros
 * are left out.  The tables of a beam are so: bending in one plane, bending in the other, stretch and torsion have
 * entries with each other where symmetry lets them.  A matrix that is full is one group.  Sums run in the order of
 * dense_gemv(). */
#ifndef FMDSUB_LA_SIFT_H
#define FMDSUB_LA_SIFT_H

#include "base/arena.h"

enum { SIFT_BLOCK = 8 };

struct sift_group {
    int blocks, ncol; /* rows by SIFT_BLOCK; the last one stands as often as fills a block */
    int *row, *col;
    double *A, *base; /* [blocks x ncol x SIFT_BLOCK], [blocks x SIFT_BLOCK] */
};

struct sift {
    int ngroup; /* 0: A is zero */
    struct sift_group *group;
};

/* Of A [rows x cols] by column and base [rows] (NULL: sift_at() is not asked). */
void sift_build(struct sift *o, const double *A, const double *base, int rows, int cols, struct arena *life);
/* y [rows] = base + A x, but in rows of zeros, where y is as it was: to be base from the start. */
void sift_at(double *restrict y, const struct sift *o, const double *restrict x);
/* y [rows] = A x, but in rows of zeros. */
void sift_times(double *restrict y, const struct sift *o, const double *restrict x);

static inline int sift_empty(const struct sift *o)
{
    return o->ngroup == 0;
}

#endif
