/* near.h -- the gaps of many contacts that are near, and of the others that they are not.
 *
 * Contacts of one body with a surface of another are a group.  Where all its gaps have been found, those below a distance D
 * are its near ones; while the bodies have moved since by less than D - reach against each other,
 *
 *     |x - x0| + |R - R0| rho,   x the place and R the turn of the one seen from the other (Frobenius' norm),
 *                                rho the farthest of its points from its centre,
 *
 * no other gap can be below the reach, as each is a distance.  What is told does not depend on when they were found last. */
#ifndef FMDSUB_CONTACT_NEAR_H
#define FMDSUB_CONTACT_NEAR_H

#include "contact/contact.h"

struct near;

struct near *near_build(const struct contacts *c, const struct model *m, const struct sweep_ops *ops,
                        struct arena *life);
/* Where the sweep's bodies are placed at q: gaps g [contacts]; of groups, INFINITY for one above the reach. */
void near_gaps(struct near *o, const struct sweep *s, double *g, double reach, const double *q);

#endif
