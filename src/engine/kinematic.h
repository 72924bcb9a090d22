/* kinematic.h -- systems that drives move as a whole: no freedom is left, only forces are sought. */
#ifndef FMDSUB_ENGINE_KINEMATIC_H
#define FMDSUB_ENGINE_KINEMATIC_H

#include "engine/stepper.h"

/* One major step of a system with n = 0: positions follow the time, works by the midpoint rule over `ratio` parts,
 * of an adaptive scheme over as many as its tolerance takes, with the rule's error taken off.
 * E_NUMERIC where the drives cannot be followed. */
enum status kinematic_step(struct stepper *s, struct state *x, int ratio, double to, struct trouble *why);

#endif
