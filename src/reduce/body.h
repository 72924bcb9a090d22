/* body.h -- a basis made into a reduced body: integrals, nodes, geometric stiffness, damping.
 *
 * With a mass matrix of blocks m_IJ 1 and fields a, b given by nodal values,
 *
 *     int a b' dm = sum_IJ m_IJ a_I b_J'
 *
 * exactly for the interpolated fields; x is one of them in isoparametric elements, and so is 1. */
#ifndef FMDSUB_REDUCE_BODY_H
#define FMDSUB_REDUCE_BODY_H

#include "flex/body.h"
#include "reduce/basis.h"

struct body_damping {
    double zeta;        /* share of critical, all modes */
    double alpha, beta; /* D = alpha M + beta K [1/s], [s] */
};

/* nodes: the ties in order; the reference is the first.  stiffening: room for s and xs, zero. */
struct flex_body *body_make(const struct fe *fe, const struct basis *basis, const struct tie *tie, int ntie,
                            int nstress, bool stiffening, const struct body_damping *damping, struct arena *life);

#endif
