/* growth.h -- how a linear system grows from major step to major step of a scheme, by the scheme's own step.
 *
 * The amplification matrix is made of steps from unit states: positions, velocities, accelerations (a scheme may carry
 * them apart from what (2-4) gives, as miao does of the slow ones) and what else a scheme carries of the motion
 * (stepper_kind.carried).  Its spectral radius is the growth. */
#ifndef FMDSUB_PROBE_GROWTH_H
#define FMDSUB_PROBE_GROWTH_H

#include "base/arena.h"
#include "engine/stepper.h"

struct growth {
    double radius; /* a major step */
    double angle;  /* that the eigenvector of the largest turns by in it [rad] */
    int most;      /* the coordinate that moves most in it, by energy */
};

/* E_NUMERIC: a step does not converge, or the eigenvalues do not. */
enum status growth_find(struct growth *o, struct ode2 *linear, const struct stepper_kind *kind,
                        const struct step_options *options, double h, int ratio, struct trouble *why);

/* The largest real part of the exponents of linear's motion itself [1/s]: what a right step grows by is exp of it times
 * H.  NAN: not found. */
double growth_own(struct ode2 *linear);

#endif
