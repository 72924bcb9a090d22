/* bent.h -- what records ask of a flexible body in motion: its centre of mass, stresses, how far points are displaced.
 *
 * With the frame at r, turning with w, and the first moment h = f q + q'S q/2 of the mass m, all in frame axes,
 *
 *     c = r + h/m,    c' = r' + w x h/m + h'/m,    c'' = r'' + (w' x h + w x (w x h) + 2 w x h' + h'')/m. */
#ifndef FMDSUB_SYSTEM_BENT_H
#define FMDSUB_SYSTEM_BENT_H

#include "model/model.h"
#include "system/sweep.h"

/* Place, velocity, acceleration of the centre of mass, world axes; frame: the pose of the body's frame, replaced.
 * q, v, a of the model, a NULL: no accelerations. */
void bent_centre(struct pose *frame, const struct model_body *b, const double *q, const double *v, const double *a);

/* Parts of a stress [Pa]: of the tensor, in this order; normal stress along a beam from stretch and from bending; the
 * equivalent stress of the whole tensor (von Mises 1913). */
enum bent_stress {
    STRESS_XX,
    STRESS_YY,
    STRESS_ZZ,
    STRESS_XY,
    STRESS_XZ,
    STRESS_YZ,
    STRESS_AXIAL,
    STRESS_BENDING,
    STRESS_VON_MISES
};
double bent_stress(const struct model_body *b, int stress, enum bent_stress part, const double *q);

/* The lowest angular speed about an axis of the frame (unit) from which a body bends away for want of geometric
 * stiffening [rad/s]: flex/spin.h.  INFINITY: none, or the body lies along the axis (as a shaft does), so that turning
 * would not stiffen it and the speed is a critical one of the real body. */
double bent_spin_limit(const struct model_body *b, const double *axis);

#endif
