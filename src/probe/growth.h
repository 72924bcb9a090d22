/* growth.h -- the growth of a linear system from major step to major step of a scheme, found with the scheme's own
 * step().
 *
 * The columns of the amplification matrix are steps from unit states: positions, velocities, accelerations (a scheme
 * may carry others than (2-4) gives, as miao does for slow coordinates) and what else a scheme carries of the motion
 * (stepper_kind.carried).  Its spectral radius is the growth. */
#ifndef FMDSUB_PROBE_GROWTH_H
#define FMDSUB_PROBE_GROWTH_H

#include "base/arena.h"
#include "engine/stepper.h"

struct growth {
    double radius; /* spectral radius of a major step */
    double angle;  /* argument of the largest eigenvalue: phase per major step [rad] */
    int most;      /* coordinate that moves most in its eigenvector, by energy */
};

/* The growth of `linear` under a scheme with minor step h.  E_NUMERIC: a step or the eigenvalues do not converge. */
enum status growth_find(struct growth *o, struct ode2 *linear, const struct stepper_kind *kind,
                        const struct step_options *options, double h, int ratio, struct trouble *why);

/* The largest real part of the exponents s of the motion itself [1/s]: an exact step H grows by exp(s H).  NAN: not
 * found. */
double growth_own(struct ode2 *linear);

#endif
