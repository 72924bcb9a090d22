/* classes.h -- the condensed system (2-4) linearised about a posture, as an ode2 that the schemes can step:
 *
 *     M x'' + (C + G) x' + (K + N) x = 0
 *
 * Each matrix is the sum of a part of the fast and a part of the slow bodies and elements.  Schemes of two rates
 * evaluate these apart, so they are linearised apart (linear.h). */
#ifndef FMDSUB_PROBE_CLASSES_H
#define FMDSUB_PROBE_CLASSES_H

#include "base/arena.h"
#include "sim/sim.h"
#include "system/ode2.h"

enum { CLASSES = 2 }; /* fast, slow */

struct classes {
    struct ode2 ode; /* its owner is this */
    int n;
    double *M[CLASSES], *C[CLASSES], *K[CLASSES]; /* [n x n] by column; C with G, K with N */
};

/* About the present state of the run.  o must not be moved as long as its ode is used.  E_NUMERIC: the residual is
 * not a number. */
enum status classes_find(struct classes *o, const struct sim *sim, struct arena *life, struct trouble *why);

/* A [n x n] := the sum of both parts of a matrix. */
void classes_sum(double *A, double *const part[CLASSES], int n);

#endif
