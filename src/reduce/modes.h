/* modes.h -- lowest eigenmodes of the held body: K phi = omega^2 M phi.
 *
 * Lanczos on K^-1 M in the inner product of M (ARPACK's shift-invert mode about zero), from a fixed start vector, to
 * machine precision. */
#ifndef FMDSUB_REDUCE_MODES_H
#define FMDSUB_REDUCE_MODES_H

#include "reduce/hold.h"

/* lambda [n] = omega^2 [1/s2] ascending, X [size x n] with X' M X = 1. */
enum status modes_lowest(double *lambda, double *X, const struct hold *hold, int n, struct report *report);

#endif
