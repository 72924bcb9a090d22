/* parity.h -- a flexible body and a mirror: which coordinates bend it in the mirror's plane, which out of it.
 *
 * Of a body that a mirror z = 0 leaves as it is, each integral and each field at a node on the mirror has coordinates that
 * keep their sign (even) or change it (odd): with one z more or less in a product the sign changes, with x or y of a
 * rotation, and with an odd coordinate.  What must not be there is zero in the data, or there is no such mirror. */
#ifndef FMDSUB_FLEX_PARITY_H
#define FMDSUB_FLEX_PARITY_H

#include "flex/body.h"

/* The same body in axes turned by T [9, by column]: x' = T x. */
struct flex_body *flex_in_axes(const struct flex_body *o, const double *T, struct arena *life);

/* odd [n] of a body with the mirror z = 0; false: there is none. */
bool flex_parity(bool *odd, const struct flex_body *o);

/* Of a body with a mirror and even coordinates alone: do these leave what they move at its height?  Then flex/planar.h has its
 * motion as flex/motion.h does. */
bool flex_is_plane(const struct flex_body *o);

#endif
