/* rigid.h -- rigid motions as nodal displacements. */
#ifndef FMDSUB_REDUCE_RIGID_H
#define FMDSUB_REDUCE_RIGID_H

#include "reduce/fe.h"

/* u [3]: of a point at x in the small motion k about `about`: 0 ... 2 moved along an axis, 3 ... 5 turned. */
void rigid_at(double *u, const double *x, const double *about, int k);

/* The same at all nodes, r [3n]. */
void rigid_motion(double *r, const struct fe *fe, const double *about, int k);

#endif
