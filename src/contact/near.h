/* near.h -- which of many contacts are near, so that only their gaps need be found.
 *
 * The contacts of one body with a surface of another are a group.  When all its gaps have been found, those below a
 * distance D are its near ones.  As long as the two bodies have since moved by less than D - reach relative to each
 * other,
 *
 *     |x - x0| + |R - R0| rho,   x position and R rotation of one relative to the other (Frobenius norm),
 *                                rho the distance of its farthest point from its centre,
 *     over a plane |n . (x - x0)| + |(R - R0)' n| rho,
 *
 * no other gap can be below the reach, since gaps are distances.  Results do not depend on when all gaps were found
 * last. */
#ifndef FMDSUB_CONTACT_NEAR_H
#define FMDSUB_CONTACT_NEAR_H

#include "base/nearby.h"
#include "contact/contact.h"

struct near;

struct near *near_build(const struct contacts *c, const struct model *m, const struct sweep_ops *ops,
                        struct arena *life);
/* g := the gaps with the sweep's bodies placed at q; of a group those up to the reach only. */
void near_gaps(struct near *o, const struct sweep *s, struct nearby *g, double reach, const double *q);

#endif
