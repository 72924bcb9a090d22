/* loops_parts.h -- what the files of loops.h share. */
#ifndef FMDSUB_LOOP_LOOPS_PARTS_H
#define FMDSUB_LOOP_LOOPS_PARTS_H

#include "la/vec3.h"
#include "loop/loops.h"

/* A row's unit: angles as they are, lengths over the mechanism's. */
static inline double loops_scale(const struct loops *o, int l)
{
    return o->model->measure[o->model->loop[l].measure].angular ? 1 : 1 / o->length;
}

static inline bool loops_along_coordinate(const struct loops *o, int l)
{
    return o->model->measure[o->model->loop[l].measure].type == MEASURE_COORDINATE;
}

/* n of a span; 0 while its points are in one place. */
static inline void loops_normal(double *n, const double *d)
{
    const double size = v3_norm(d);
    v3_scale(n, size > 0 ? 1 / size : 0, d);
}

#endif
