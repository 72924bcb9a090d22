/* spin.h -- the angular velocity up to which a flexible body without geometric stiffening is stable.
 *
 * Without second-order displacements the centrifugal load at an angular velocity W about the axis e (unit) through the
 * reference node softens the body and nothing stiffens it,
 *
 *     (K - W^2 Z) q = 0,     Z_ij = int (P phi_i).(P phi_j) dm = tr ff_ij - e'ff_ij e,   P = 1 - e e',
 *
 * Z the second-order terms of the inertia about e, which do not depend on where the axis passes.  From the lowest
 * such W on the computed deflection grows without bound.  If it is across the axis, and the rotary inertia of
 * sections small, this W is the first frequency.  A real beam has no such limit (Kane, Ryan & Banerjee, J. Guidance
 * 10 (1987) 139). */
#ifndef FMDSUB_FLEX_SPIN_H
#define FMDSUB_FLEX_SPIN_H

#include "flex/body.h"

/* The lowest W about e, body axes [rad/s]; INFINITY: there is none.  Only the SPIN_MOST softest modes are taken into
 * account. */
enum { SPIN_MOST = 40 };
double flex_spin_limit(const struct flex_body *o, const double *e, struct arena *scratch);

/* The lowest W over all axes e (space 2: z alone), and that axis. */
double flex_spin_worst(double *e, const struct flex_body *o, int space, struct arena *scratch);

#endif
