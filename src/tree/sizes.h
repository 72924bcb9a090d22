/* sizes.h -- a usual change of every coordinate: one radian, or what moves something by the mechanism's length. */
#ifndef FMDSUB_TREE_SIZES_H
#define FMDSUB_TREE_SIZES_H

#include "model/model.h"

/* A length of the mechanism [m]: the largest arm of a joint on a body, or rod; the ground's place in the world does not
 * count.  Without any, how far bodies stand from each other, what the start displaces, or how far off stops and springs begin
 * to act and what radius touches; 1 where nothing tells. */
double sizes_length(const struct model *m);
/* That, where bodies do not tell it, for a run that goes on from there; else 0. */
double sizes_of_start(const struct model *m);

/* Is the k-th rate of a joint along a length? */
bool sizes_is_length(const struct model *m, const struct model_joint *j, int k);

/* size [m->n] */
void sizes_fill(double *size, const struct model *m);

#endif
