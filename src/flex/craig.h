/* craig.h -- Craig and Bampton's reduction of a chain of nodes (AIAA J. 6 (1968) 1313).
 *
 * Basis: static displacements by one freedom of an interface node at a time, the others clamped, and the lowest modes
 * with all interface nodes clamped.  The first interface node stays clamped throughout.  The basis is then turned so
 * that the reduced mass matrix is the unit matrix and the reduced stiffness diagonal. */
#ifndef FMDSUB_FLEX_CRAIG_H
#define FMDSUB_FLEX_CRAIG_H

#include <stdbool.h>

#include "base/status.h"
#include "la/band.h"

struct craig {
    const struct band *K, *M; /* `per` freedoms a node */
    int per;
    const int *interface; /* [ninterface] node numbers, different */
    int ninterface, modes;
    const bool *pick; /* [modes] which of those clamped are taken; NULL: all */
    bool raw;         /* the basis as it is: first modes with all interfaces clamped, then static displacements */
};

/* Coordinates of the result. */
int craig_count(const struct craig *o);

/* Where the modes with all interfaces clamped end. */
struct craig_edge {
    double lambda[2]; /* the highest that is kept (none: 0) and the lowest that is left out (none: infinity); of
                       * families that nothing couples each is looked at as far as the number of modes */
    bool parted;      /* they are one frequency */
    int whole[2];     /* then: the numbers of modes next below and above that part none; 0: the mesh has no more */
};

/* lambda [n] ascending, Phi [freedoms x n]: Phi' M Phi = 1, Phi' K Phi = diag(lambda); raw: lambda 0 of static
 * displacements, which have no such order.  E_MODEL: more modes than
 * freedoms, or a matrix is not positive. */
enum status craig_reduce(double *lambda, double *Phi, struct craig_edge *edge, const struct craig *o,
                         struct arena *scratch, struct report *report);

/* R [n x n] = Phi' A Phi; work [A->n]. */
void craig_project(double *R, const struct band *A, const double *Phi, int n, double *work);

#endif
