/* complex.h -- dense complex systems, real and imaginary parts apart.  Matrices by column, see dense.h. */
#ifndef FMDSUB_LA_COMPLEX_H
#define FMDSUB_LA_COMPLEX_H

/* P A = L U with partial pivoting; swap [n] rows.  Returns -1, or the column without a pivot. */
int complex_lu(double *re, double *im, int *swap, int n);
/* x := A^-1 x. */
void complex_lu_solve(const double *re, const double *im, const int *swap, double *xre, double *xim, int n);

#endif
