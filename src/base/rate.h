/* rate.h -- the two classes of a sub-cycled system: what takes the minor step, what the major one.  LIMBS, of a
 * tree, are FAST with all that shares their inertia: bodies that stand on the ground on the same limb. */
#ifndef FMDSUB_BASE_RATE_H
#define FMDSUB_BASE_RATE_H

enum rate { FAST = 1, SLOW = 2, ALL = 3, LIMBS = 4 };

#endif
