/* basis.h -- the few displacement fields that stand for the body.
 *
 * Craig-Bampton (Craig & Bampton, AIAA J. 6 (1968) 1313): constraint modes of every interface but the reference, and
 * the lowest modes with all interfaces held; or the lowest modes with the reference held alone.  To either the
 * answers to loads of a moving frame may be added (load modes: Rixen, Proc. IMAC 19 (2001)): then stresses at constant
 * speed are those of the whole mesh.  Then
 *
 *     V' K V Y = V' M V Y diag(omega^2),   V := V Y
 *
 * so that coordinates are modes with the reference held, of mass one, ascending, the sign such that the largest
 * displacement is positive. */
#ifndef FMDSUB_REDUCE_BASIS_H
#define FMDSUB_REDUCE_BASIS_H

#include "reduce/hold.h"

enum basis_method { CRAIG_BAMPTON, EIGENMODES };

struct basis {
    int n, size;       /* fields; 3 fe->n */
    double *V;         /* [size x n] */
    double *MV;        /* [size x n] M V */
    double *lambda;    /* [n] omega^2 [1/s2] */
    int fixed;         /* modes asked of the held body */
    double last, next; /* [Hz] highest of those, first left out; next 0: not known */
};

struct basis_options {
    enum basis_method method;
    int modes;       /* of the held body */
    int nload;       /* and static answers to loads */
    const int *load; /* [nload] kinds of loads.h */
};

enum status basis_make(struct basis *o, const struct fe *fe, const struct tie *tie, int ntie,
                       const struct basis_options *options, struct arena *life, struct report *report);

#endif
