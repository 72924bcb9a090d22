/* band.h -- symmetric band matrices: Cholesky's factorization, and the lowest of K x = lambda M x.
 *
 * The lower half is stored by column, A(i,j) = a[i - j + j (width + 1)] for j <= i <= j + width. */
#ifndef FMDSUB_LA_BAND_H
#define FMDSUB_LA_BAND_H

#include <stdbool.h>

#include "base/arena.h"

struct band {
    int n, width;
    double *a; /* [(width + 1) x n] */
};

struct band band_take(int n, int width, struct arena *life);
struct band band_copy(const struct band *o, struct arena *life);
/* A(i,j) and A(j,i), |i - j| <= width. */
double *band_at(const struct band *o, int i, int j);
/* Row and column i become those of the unit matrix times pivot. */
void band_isolate(struct band *o, int i, double pivot);
/* y = A x. */
void band_mul(double *y, const struct band *A, const double *x);

/* A = L L' in place.  Returns -1, or the column whose pivot vanishes against its diagonal, is negative or not a
 * number. */
int band_cholesky(struct band *A);
/* x := (L L')^-1 x;  x := L^-1 x;  x := L^-T x. */
void band_cholesky_solve(const struct band *L, double *x);
void band_lower_solve(const struct band *L, double *x);
void band_upper_solve(const struct band *L, double *x);

/* The lowest `count` solutions of K x = lambda M x among vectors whose entries are zero where use[] is false, which
 * K and M must not couple to the others: lambda [count] ascending, X [n x count], X' M X = 1.  K = L L' is given
 * factored; M >= 0.  Same data, same bits.  Returns the iterations taken; -1: fewer than `count` finite ones; -2: no
 * convergence. */
int band_lowest(double *lambda, double *X, const struct band *L, const struct band *M, const bool *use, int count,
                struct arena *scratch);

#endif
