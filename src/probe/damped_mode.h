/* damped_mode.h -- modes of a linear system p'' + D p' + K p = 0, where D and K need not be symmetric, nor K positive.
 *
 * With p = exp(s t) a mode has two eigenvalues s: a conjugate pair, or two real ones, of which the largest is paired
 * with the smallest. */
#ifndef FMDSUB_PROBE_DAMPED_MODE_H
#define FMDSUB_PROBE_DAMPED_MODE_H

#include <stdbool.h>

#include "base/arena.h"

struct damped_mode {
    double omega;   /* |s| [rad/s]; of a real s > 0, which grows, -s */
    double damping; /* -re s/|s|; of two real ones half their sum over the root of their product, above 1 */
    double *p;      /* [2 n] the eigenvector: real, then imaginary parts */
};

/* The modes o [n], ascending by omega, of K, D [n x n] by column.  false: the eigenvalues do not converge. */
bool damped_modes_find(struct damped_mode *o, const double *K, const double *D, int n, struct arena *life);

#endif
