/* craig.h -- Craig and Bampton's reduction of a chain of nodes (AIAA J. 6 (1968) 1313).
 *
 * Basis: static displacements by one freedom of an interface node at a time, the others clamped, and the lowest modes
 * with all interface nodes clamped.  The first interface node stays clamped throughout.  The basis is then turned so
 * that the reduced mass matrix is the unit matrix and the reduced stiffness diagonal. */
#ifndef FMDSUB_FLEX_CRAIG_H
#define FMDSUB_FLEX_CRAIG_H

#include "base/status.h"
#include "la/band.h"

struct craig {
    const struct band *K, *M; /* `per` freedoms a node */
    int per;
    const int *interface; /* [ninterface] node numbers, different */
    int ninterface, modes;
};

/* Coordinates of the result. */
int craig_count(const struct craig *o);

/* lambda [n] ascending, Phi [freedoms x n]: Phi' M Phi = 1, Phi' K Phi = diag(lambda).  edge [2]: of the modes with all
 * interfaces clamped the highest lambda that is kept (none: 0) and the lowest that is left out (none: infinity); of
 * families that nothing couples each is looked at as far as the number of modes.  E_MODEL: more modes than
 * freedoms, or a matrix is not positive. */
enum status craig_reduce(double *lambda, double *Phi, double *edge, const struct craig *o, struct arena *scratch,
                         struct report *report);

#endif
