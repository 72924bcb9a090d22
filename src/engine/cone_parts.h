/* cone_parts.h -- what the files of cone.h share. */
#ifndef FMDSUB_ENGINE_CONE_PARTS_H
#define FMDSUB_ENGINE_CONE_PARTS_H

#include "engine/cone.h"

/* p from where they are; false: it does not converge, and p is anything. */
bool cone_newton(double *p, const double *W, const double *u0, const struct cone *cone, int n, int rows, double size,
                 double rough, struct cone_work *work);

#endif
