/* material.h -- is the stiffness matrix that of the material that stresses are made with?
 *
 * A uniform strain is a displacement that every element holds exactly, so that by the matrix, too, it costs
 *
 *     u'Ku = (lambda + 2 mu) V where stretched along an axis, mu V where sheared,
 *
 * whatever the mesh. */
#ifndef FMDSUB_REDUCE_MATERIAL_H
#define FMDSUB_REDUCE_MATERIAL_H

#include "reduce/options.h"

/* Warns on stderr where the --material that stresses or stiffening take is not that of K; silent where the mesh has
 * elements whose volume is not known. */
void material_check(const struct fe *fe, const struct options *options, struct arena *life);

#endif
