/* modes.h -- frequencies of small motions about a posture, and the steps that they need.
 *
 * These are those of M^ x'' + (G + C) x' + (K + N) x = 0, of linear.h, about the present posture of the run.
 *
 * Where N is zero, K positive definite and C small beside G (or G zero), the damping ratio of a mode is found to
 * first order, x'Cx / (2 omega).  Else the eigenvalues s of the whole are found: omega = |s|, damping -re s/|s|,
 * negative where a mode grows. */
#ifndef FMDSUB_PROBE_MODES_H
#define FMDSUB_PROBE_MODES_H

#include "base/arena.h"
#include "sim/sim.h"

struct mode {
    double omega;   /* [rad/s]; negative: the posture is unstable, a growth rate */
    double damping; /* ratio to critical damping; negative: a vibration that grows */
    int top[3];     /* coordinates with the largest shares of its energy; -1: none */
    double share[3];
    double fast; /* share of the fast coordinates in its energy */
};

struct modes {
    int n;
    struct mode *mode;          /* [n], ascending */
    double slow_top, fast_top;  /* highest local frequency of a slow and of a fast coordinate [rad/s] */
    int slow_worst, fast_worst; /* which coordinates; -1: none */
    double doubt;               /* relative error of the highest mode by round-off, of light parts beside heavy ones */
};

enum { MODES_MOST = 300 };

/* About the state that the run has reached; E_LIMIT beyond MODES_MOST freedoms. */
enum status modes_find(struct modes *o, const struct sim *sim, struct arena *life, struct report *report);

/* The longest major step to suggest: a hundredth of the run [s]. */
double modes_longest_step(const struct sim *sim);
/* A step and a ratio that resolve the linearised motion: omega h = 0.1 for the coordinate of highest frequency in
 * each class, and no major step longer than modes_longest_step(). */
void modes_suggest(double *h, int *ratio, const struct modes *o, const struct sim *sim);

#endif
