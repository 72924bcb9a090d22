/* newmark.h -- what Newmark's method shares with sub-cycling by it (miao.c): its numbers. */
#ifndef FMDSUB_ENGINE_NEWMARK_H
#define FMDSUB_ENGINE_NEWMARK_H

#include "engine/stepper.h"

extern const struct stepper_kind step_newmark;

#define KEYS_NEWMARK                                                                                                   \
    PARAM_REAL(struct step_options, beta, "beta", NULL, 0, 1, KEY_ABOVE | KEY_META, "0.25", "beta of (2-5)"),          \
        PARAM_REAL(struct step_options, gamma, "gamma", NULL, 0.5, 1, KEY_META, "0.5", "gamma of (2-6)")

/* beta and gamma, or what rho_infinity below 1 makes of them: (3 - rho)/(2 + 2 rho) for gamma and 1/(1 + rho)^2 for beta leave
 * rho of what the step does not resolve, in both of its parts alike. */
struct newmark_weights {
    double beta, gamma;
};
struct newmark_weights newmark_weights(const struct step_options *o);

/* Is it stable for every step?  See stepper_kind.fits. */
bool newmark_fits(const struct step_options *o, struct misfit *why);

#endif
