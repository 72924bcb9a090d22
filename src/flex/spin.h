/* spin.h -- how fast a body may turn before its linear elasticity gives way.
 *
 * Without second-order displacements the centrifugal load of a turn W about the axis e (unit) through the reference
 * node softens the body and nothing stiffens it,
 *
 *     (K - W^2 Z) q = 0,     Z_ij = int (P phi_i).(P phi_j) dm = tr ff_ij - e'ff_ij e,   P = 1 - e e',
 *
 * the second-order terms of the inertia about e, which do not depend on where the axis passes.  From the lowest such W
 * on the body bends away without bound.  Where the deflection is across the axis and the rotary inertia of sections
 * small it is the first frequency; a real beam has no such speed (Kane, Ryan & Banerjee, J. Guidance 10 (1987) 139). */
#ifndef FMDSUB_FLEX_SPIN_H
#define FMDSUB_FLEX_SPIN_H

#include "flex/body.h"

/* The lowest W about e, body axes [rad/s]; INFINITY: none.  Of modes the softest SPIN_MOST alone are asked. */
enum { SPIN_MOST = 40 };
double flex_spin_limit(const struct flex_body *o, const double *e, struct arena *scratch);

/* The lowest over all axes (in the plane: z), and that axis. */
double flex_spin_worst(double *e, const struct flex_body *o, int space, struct arena *scratch);

#endif
