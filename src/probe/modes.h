/* modes.h -- frequencies of small motions about a posture, and what they ask of the steps.
 *
 * The condensed system (2-4) linearised about the posture at rest while drives move on: M^ x'' + G x' + K x = 0, K =
 * dr/dq by central differences of r(q, 0, 0, t), so that gravity, preloads and centrifugal loads are in it, G the
 * antisymmetric part of dr/dv, the Coriolis forces of driven rotation.  Where K is not positive G is left out, and
 * `gyroscopic_left_out` says so: rotation may stabilise what looks unstable then.  The damping of a mode is to first
 * order, x'Cx / (2 omega) with C of the elements. */
#ifndef FMDSUB_PROBE_MODES_H
#define FMDSUB_PROBE_MODES_H

#include "base/arena.h"
#include "sim/sim.h"

struct mode {
    double omega;   /* [rad/s]; negative: the posture is unstable, a growth rate */
    double damping; /* share of critical */
    int top[3];     /* coordinates that share its energy most, -1: none */
    double share[3];
    double fast; /* share of the fast coordinates */
};

struct modes {
    int n;
    struct mode *mode;          /* [n], ascending */
    double slow_top, fast_top;  /* local frequency of the quickest slow and fast coordinate [rad/s] */
    int slow_worst, fast_worst; /* which; -1: none */
    bool gyroscopic_left_out;
};

enum { MODES_MOST = 300 };

/* About the state that the run has reached; E_LIMIT beyond MODES_MOST freedoms. */
enum status modes_find(struct modes *o, const struct sim *sim, struct arena *life, struct report *report);

/* A step and ratio that resolve what the linearisation shows: omega h = 0.1 of the quickest coordinate of each class.
 */
void modes_suggest(double *h, int *ratio, const struct modes *o, const struct sim *sim);

#endif
