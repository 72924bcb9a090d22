/* mirror.h -- modes that stay 0 in a scene of space, because the plane that it stays in is its mirror.
 *
 * Kinematic evidence keeps bodies in planes of one normal (flat.h), but not what bends: that stays there where the mirror
 * in one of these planes leaves the scene as it is.  So all centres of mass, points of forces and joints and the flexible
 * bodies' nodes stand in it, gravity and loads act in it, its normal is a principal axis of each body, and the data of the
 * flexible bodies tell odd modes, which bend out of it, from even ones (flex/parity.h).  Then odd modes that begin at 0 feel
 * nothing: the model goes without them. */
#ifndef FMDSUB_MODEL_MIRROR_H
#define FMDSUB_MODEL_MIRROR_H

#include "base/arena.h"
#include "model/model.h"

/* [nbody][modes] those that stay 0; NULL: none does. */
const bool *const *model_still(const struct model *m, struct arena *life);

#endif
