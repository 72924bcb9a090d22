/* radau_parts.h -- Radau IIA: what radau.c, the steps, and radau_stages.c, the equations of their stages, share */
#ifndef FMDSUB_ENGINE_RADAU_PARTS_H
#define FMDSUB_ENGINE_RADAU_PARTS_H

#include <stdbool.h>

#include "engine/adaptive.h"
#include "engine/stage_matrix.h"

enum { STAGES = COLLOCATION_STAGES, MOST_ITERATIONS = 10 };

struct radau {
    struct collocation table;
    double *a[STAGES], *v[STAGES], *u[STAGES], *du[STAGES], *r[STAGES]; /* [n] */
    double *gain[STAGES], *last[STAGES]; /* [n] of u: in an iteration, in its last pass */
    double *q[STAGES];                   /* [nq] */
    double w[STAGES][POWER_CHANNELS];
    double *before[STAGES]; /* [n] a of the last step */
    double h_before;        /* its h; 0: there was none */
    double longer;          /* h of the last step over that of the one before; 0: there was none */

    struct stage_matrix matrix;
    bool stale;          /* M, C, K are to be formed anew */
    bool here;           /* they are of this step's start */
    double *e, *gu, *gv; /* [n] */
    double theta;        /* contraction, last seen */
    double fnewt; /* what the iteration may leave, in scales of the tolerance: of the step's share, for it adds up */
    double faded; /* of the last iteration's change: what was left behind it when one more looked */
    long trials;  /* so far: one of SELDOM looks */
    int count;    /* iterations of the last trial */
};

/* The stages of a step h from t: matrices as it wants them, then a, v, u, du, q and w of each; where iterations do not converge
 * E_NUMERIC. */
enum status radau_stages(struct stepper *s, struct adaptive *m, double t, double h, struct trouble *why);

#endif
