/* idle_parts.h -- what the files of idle.h share */
#ifndef FMDSUB_SYSTEM_IDLE_PARTS_H
#define FMDSUB_SYSTEM_IDLE_PARTS_H

#include "system/idle.h"

/* M^ at a posture, factored. */
struct inverse {
    const struct ode2 *ode;
    void *F;   /* by articulated bodies */
    double *L; /* [n x n], NULL: F */
};

/* False: it is singular, or too large for a dense one where the other does not go. */
bool inverse_build(struct inverse *o, const struct ode2 *ode, const double *q, double t, struct arena *scratch);
void inverse_apply(const struct inverse *o, double *x);

double idle_dot(const double *a, const double *b, int n);
/* A number in [-1, 1] from another, always the same. */
double idle_scatter(unsigned i);

#endif
