/* tumble.h -- a rigid body by itself that no torque turns keeps its angular momentum and its energy to round-off.
 *
 * The midpoint rule keeps both (engine/midpoint.h), but only as far as its equation is solved: what Newton's method
 * leaves over, 1e-14 in a step, has a sign and adds up over a million.  Here the three equations of the turn, in axes
 * of the body with its inertia J about the centre,
 *
 *     J (w1 - w0) + h w x J w = 0,     w = (w0 + w1)/2,     R1 = R0 cay(h w),
 *
 * are solved on from what Newton has found until nothing changes any more: it needs no forces and no other body.  Over
 * several steps (sub-cycling) w1 is what R1 J w1 = R0 J w0 asks for, and nothing is said of the energy. */
#ifndef FMDSUB_OPEN_TUMBLE_H
#define FMDSUB_OPEN_TUMBLE_H

#include "base/arena.h"
#include "model/model.h"
#include "system/ode2.h"

struct tumbler {
    int iq[4], iv[3];     /* places of its quaternion and of its angular velocity */
    double J[6], Jinv[6]; /* body axes, as its angular velocity */
};

/* Does the body, a tree by itself on which nothing acts but gravity, turn freely about its centre? */
bool tumbles(const struct model *m, int body);
void tumbler_make(struct tumbler *o, const struct model *m, int body);
/* As settle() of ode2.h. */
void tumbler_settle(const struct tumbler *o, double *q1, double *v1, const struct instant *x);

#endif
