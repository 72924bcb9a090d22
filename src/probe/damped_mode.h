/* damped_mode.h -- small motions of any linear system p'' + D p' + K p = 0, D and K not symmetric, K not positive.
 *
 * With p = exp(s t) two eigenvalues s make a motion: a conjugate pair, or two real ones.  Of the real ones the largest
 * goes with the smallest. */
#ifndef FMDSUB_PROBE_DAMPED_MODE_H
#define FMDSUB_PROBE_DAMPED_MODE_H

#include <stdbool.h>

#include "base/arena.h"

struct damped_mode {
    double omega;   /* |s| [rad/s]; where a real s > 0: -s */
    double damping; /* -re s/|s|; above 1: two real ones, half their sum over the root of their product */
    double *p;      /* [2 n] real, then imaginary parts */
};

/* o [n], ascending by omega; K, D [n x n].  False: no convergence. */
bool damped_modes_find(struct damped_mode *o, const double *K, const double *D, int n, struct arena *life);

#endif
