/* stiff.h -- the largest rate of small motions about the state, excited or not: what keeps an explicit scheme's steps short.
 *
 * By power iteration of u'' = da(q, v; u, u') with differences of the accelerations, two evaluations of them to the square of
 * that rate. */
#ifndef FMDSUB_STUDY_STIFF_H
#define FMDSUB_STUDY_STIFF_H

#include "sim/sim.h"

enum { STIFF_EVALUATIONS = 13 }; /* that it takes */

/* [rad/s], about; 0: not known. */
double stiff_rate(const struct sim *sim);

#endif
