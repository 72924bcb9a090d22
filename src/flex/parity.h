/* parity.h -- the symmetry of a flexible body about the plane z = 0: which coordinates deform it in the plane, which
 * out of it.
 *
 * In a body that is its own mirror image, a coordinate keeps its sign under the reflection (even) or changes it
 * (odd).  An inertia integral or a field at a node in the plane changes sign with each z component of a
 * displacement, with each x or y component of a rotation, and with each odd coordinate in it.  Those that change
 * sign as a whole must be zero in the data; else the body is not symmetric. */
#ifndef FMDSUB_FLEX_PARITY_H
#define FMDSUB_FLEX_PARITY_H

#include "flex/body.h"

/* The same body in axes turned by T [9, by column]: x' = T x. */
struct flex_body *flex_in_axes(const struct flex_body *o, const double *T, struct arena *life);

/* odd [n] := which coordinates are odd; false: the body is not symmetric about z = 0. */
bool flex_parity(bool *odd, const struct flex_body *o);

/* For a symmetric body with even coordinates only: do all points move parallel to the plane?  Then flex/planar.h
 * gives the same motion as flex/motion.h. */
bool flex_is_plane(const struct flex_body *o);

#endif
