/* modes.h -- frequencies of small motions about a posture, and what they ask of the steps.
 *
 * M^ x'' + (G + C) x' + (K + N) x = 0 of linear.h about the posture where the run stands.
 *
 * Where N is nothing, K positive and C small beside G (or G nothing) the damping of a mode is to first order, x'Cx / (2 omega). Elsewhere
 * the eigenvalues s of the whole are found: omega = |s|, damping -re s/|s|, which is negative where the mode grows. */
#ifndef FMDSUB_PROBE_MODES_H
#define FMDSUB_PROBE_MODES_H

#include "base/arena.h"
#include "sim/sim.h"

struct mode {
    double omega;   /* [rad/s]; negative: the posture is unstable, a growth rate */
    double damping; /* share of critical; negative: growing vibration */
    int top[3];     /* coordinates that share its energy most, -1: none */
    double share[3];
    double fast; /* share of the fast coordinates */
};

struct modes {
    int n;
    struct mode *mode;          /* [n], ascending */
    double slow_top, fast_top;  /* local frequency of the quickest slow and fast coordinate [rad/s] */
    int slow_worst, fast_worst; /* which; -1: none */
    double doubt;               /* by what share the highest may be wrong: light parts that are nearly lost in round-off
                                 * beside heavy ones */
};

enum { MODES_MOST = 300 };

/* About the state that the run has reached; E_LIMIT beyond MODES_MOST freedoms. */
enum status modes_find(struct modes *o, const struct sim *sim, struct arena *life, struct report *report);

/* A hundredth of the run: nobody wants fewer steps [s]. */
double modes_longest_step(const struct sim *sim);
/* A step and ratio that resolve what the linearisation shows: omega h = 0.1 of the quickest coordinate of each class; no
 * major step longer than that. */
void modes_suggest(double *h, int *ratio, const struct modes *o, const struct sim *sim);

#endif
