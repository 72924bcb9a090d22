/* stiff.h -- the largest rate of small motions about the state, excited or not: what keeps an explicit scheme's steps short.
 *
 * By power iteration of u'' = da(q, v; u, u') with differences of the accelerations, two evaluations of them to the square of
 * that rate. */
#ifndef FMDSUB_STUDY_STIFF_H
#define FMDSUB_STUDY_STIFF_H

#include "sim/sim.h"

/* [rad/s], about; 0: not known. */
double stiff_rate(struct sim *sim);

#endif
