/* vector.h -- what is done to vectors number by number: where there are many, by the vectors that a processor has.
 *
 * The same bits whatever those are.  Outputs may be one of the inputs. */
#ifndef FMDSUB_LA_VECTOR_H
#define FMDSUB_LA_VECTOR_H

enum { VECTOR_MANY = 16 }; /* numbers from which on a call costs less than it saves */

void vector_times_many(double *y, double s, const double *x, int n);
void vector_move_many(double *y, const double *x, double s, const double *d, int n);

/* y [n] := s x. */
static inline void vector_times(double *y, double s, const double *x, int n)
{
    if (n >= VECTOR_MANY)
        vector_times_many(y, s, x, n);
    else
        for (int i = 0; i < n; i++) y[i] = s * x[i];
}

/* y [n] := x + s d. */
static inline void vector_move(double *y, const double *x, double s, const double *d, int n)
{
    if (n >= VECTOR_MANY)
        vector_move_many(y, x, s, d, n);
    else
        for (int i = 0; i < n; i++) y[i] = x[i] + s * d[i];
}

#endif
