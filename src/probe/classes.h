/* classes.h -- the condensed system (2-4) linearised about a posture, as a system of its own for the schemes to step:
 *
 *     M x'' + (C + G) x' + (K + N) x = 0,     M, C + G and K + N each the sum of what fast and what slow bodies bring
 *
 * Schemes of two rates ask for the classes apart, so they are linearised apart (linear.h). */
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

/* Where the run stands; o stays where it is as long as its ode is used.  E_NUMERIC: the residual is not a number there. */
enum status classes_find(struct classes *o, const struct sim *sim, struct arena *life, struct trouble *why);

/* Of all: A [n x n] := the sum of both parts. */
void classes_sum(double *A, double *const part[CLASSES], int n);

#endif
