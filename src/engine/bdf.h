/* bdf.h -- what CVODE and bdf.c have between them; only where there is CVODE. */
#ifndef FMDSUB_ENGINE_BDF_H
#define FMDSUB_ENGINE_BDF_H

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdbool.h>

#include "engine/adaptive.h"
#include "engine/stage_matrix.h"

struct bdf {
    struct stepper *stepper; /* for what CVODE calls */
    struct adaptive *motion;
    int n, channels; /* of v; of W: 0 where there are no powers */
    SUNContext context;
    void *cvode;
    N_Vector y, scratch;
    SUNMatrix shell;
    SUNLinearSolver solver;
    struct stage_matrix matrix;
    double gamma, t;                /* that it is factored for; of the last evaluation */
    double *base, *q, *look;        /* [nq] q0; of the last evaluation; for records */
    double *start;                  /* [n] what u is less of at q0 */
    double *u, *x;                  /* [n] from there, of the last evaluation; scratch */
    double *y0;                     /* [2 n + channels] at the start of the last step */
    double *q1, *v1, *a1;           /* [nq], [n] its end */
    double t1, w1[POWER_CHANNELS];  /* when, and the powers there */
    bool begun;                     /* there is a past, and it ends at t1 */
    bool plain;                     /* the last step was CVODE's; else one too short for it */
    long steps;                     /* so far */
    long iterations, tests, solves; /* as CVODE has counted them last */
    enum status status;             /* of what CVODE has called last */
    struct trouble why;             /* if that is not OK */
};

static inline double *bdf_values(N_Vector y)
{
    return N_VGetArrayPointer(y);
}

/* CVODE for x of stepper, motion, n, channels, with its vectors inside; `life` gives it back. */
void bdf_open(struct bdf *x, struct arena *life);

/* y' at t, y; x->q, u and t are of there. */
enum status bdf_evaluate(struct bdf *x, double t, const double *y, double *rate);

/* One step of CVODE's, to t + h at most; *end is where. */
enum status bdf_step(struct bdf *x, double *end, double t, double h, struct trouble *why);

#endif
