/* linear.h -- the condensed system (2-4) linearised about a posture at rest while drives move on,
 *
 *     M^ x'' + (G + C) x' + (K + N) x = 0
 *
 * K and N are the symmetric and the antisymmetric part of dr/dq, by central differences of r(q, 0, 0, t), so that
 * gravity, preloads and centrifugal loads are included.  G is the antisymmetric part of dr/dv, the Coriolis forces
 * of driven rotation; C the symmetric part of the slopes of the elements.  N comes from loads without a potential:
 * those that follow a body, or read other coordinates than they act on.  The part G'/2 of N that comes from the
 * acceleration of drives is left out: with it, vibrations whose frequencies change slowly would seem to grow. */
#ifndef FMDSUB_PROBE_LINEAR_H
#define FMDSUB_PROBE_LINEAR_H

#include "base/arena.h"
#include "system/ode2.h"

struct linear {
    const struct ode2 *ode;
    const double *q; /* [nq] posture */
    double t;
    int n;
    unsigned cls;      /* classes of bodies and elements that are taken in: ALL, or one of them */
    double *M, *K, *C; /* [n x n] */
    double *N;         /* [n x n] circulatory: the antisymmetric part of dr/dq */
    double *G;         /* [n x n] gyroscopic: the antisymmetric part of dr/dv */
};

/* Fills M to G, from ode, q, t, n and cls.  E_NUMERIC: r is not a number there. */
enum status linearise(struct linear *l, struct arena *life, struct trouble *why);

#endif
