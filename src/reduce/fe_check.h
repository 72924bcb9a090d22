/* fe_check.h -- is this the mass, is this the stiffness of a free solid body? */
#ifndef FMDSUB_REDUCE_FE_CHECK_H
#define FMDSUB_REDUCE_FE_CHECK_H

#include "reduce/fe.h"

/* Blocks m_IJ 1, not negative, total mass positive; fills mass, centre and size. */
enum status fe_check_mass(struct fe *o, const char *path, struct arena *life, struct report *report);

/* K r = 0 for the six rigid motions r, to 1e-5 of what its entries add up to (coordinates have few digits). */
enum status fe_check_stiffness(const struct fe *o, const char *path, struct arena *life, struct report *report);

#endif
