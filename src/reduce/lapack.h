/* lapack.h -- the Fortran routines that are used, with the lengths of texts at the end, as gfortran wants them. */
#ifndef FMDSUB_REDUCE_LAPACK_H
#define FMDSUB_REDUCE_LAPACK_H

#include <stddef.h>

/* LAPACK: band Cholesky */
void dpbtrf_(const char *uplo, const int *n, const int *kd, double *ab, const int *ldab, int *info, size_t);
void dpbtrs_(const char *uplo, const int *n, const int *kd, const int *nrhs, const double *ab, const int *ldab,
             double *b, const int *ldb, int *info, size_t);

/* ARPACK: symmetric generalised eigenproblem, implicitly restarted Lanczos (Lehoucq, Sorensen & Yang 1998) */
void dsaupd_(int *ido, const char *bmat, const int *n, const char *which, const int *nev, const double *tol,
             double *resid, const int *ncv, double *v, const int *ldv, int *iparam, int *ipntr, double *workd,
             double *workl, const int *lworkl, int *info, size_t, size_t);
void dseupd_(const int *rvec, const char *howmny, int *select, double *d, double *z, const int *ldz,
             const double *sigma, const char *bmat, const int *n, const char *which, const int *nev, const double *tol,
             double *resid, const int *ncv, double *v, const int *ldv, int *iparam, int *ipntr, double *workd,
             double *workl, const int *lworkl, int *info, size_t, size_t, size_t);

#endif
