/* near.h -- the gaps of many contacts that are near, and of the others that they are not.
 *
 * Contacts of one body with a surface of another are a group.  Where all its gaps have been found, those below a distance D
 * are its near ones; while the bodies have moved since by less than D - reach against each other,
 *
 *     |x - x0| + |R - R0| rho,   x the place and R the turn of the one seen from the other (Frobenius' norm),
 *                                rho the farthest of its points from its centre,
 *     over a plane |n . (x - x0)| + |(R - R0)' n| rho,
 *
 * no other gap can be below the reach, as each is a distance.  What is told does not depend on when they were found last. */
#ifndef FMDSUB_CONTACT_NEAR_H
#define FMDSUB_CONTACT_NEAR_H

#include "base/nearby.h"
#include "contact/contact.h"

struct near;

struct near *near_build(const struct contacts *c, const struct model *m, const struct sweep_ops *ops,
                        struct arena *life);
/* Where the sweep's bodies are placed at q: gaps g; of groups, none above the reach. */
void near_gaps(struct near *o, const struct sweep *s, struct nearby *g, double reach, const double *q);

#endif
