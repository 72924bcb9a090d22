/* accel.h -- the accelerations of (2-4), and the power of the loads at the same state. */
#ifndef FMDSUB_ENGINE_ACCEL_H
#define FMDSUB_ENGINE_ACCEL_H

#include "base/arena.h"
#include "engine/stepper.h"

struct accel {
    const struct ode2 *ode;
    struct effort *effort;
    struct arena *life;
    double *r; /* [n] */
    double *M; /* [n x n]; NULL as long as the owner's solver serves */
};

void accel_open(struct accel *c, const struct ode2 *ode, struct effort *effort, struct arena *life);

/* a = M^-1 Q^ at (q, v, t); w [POWER_CHANNELS]: power along v, NULL: not wanted. */
enum status accel_solve(struct accel *c, double *a, double *w, const double *q, const double *v, double t,
                        struct trouble *why);

#endif
