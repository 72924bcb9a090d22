/* hold.h -- the body with its interfaces held: u = K^-1 f there.
 *
 * Freedoms of rigid ties are left out of the factor.  Average ties are constraints C u = 0 with multipliers:
 *
 *     u = K^-1 f - Y (C Y)^-1 C K^-1 f,   Y = K^-1 C'
 *
 * Where no tie is rigid K has the six rigid motions R left: with the reference's rows C0, for which C0 R = 1,
 * the load is balanced first, f - C0' R' f, three nodes carry nothing as supports, and u - R C0 u goes back. */
#ifndef FMDSUB_REDUCE_HOLD_H
#define FMDSUB_REDUCE_HOLD_H

#include "reduce/factor.h"
#include "reduce/tie.h"

struct hold {
    const struct fe *fe;
    int size; /* 3 fe->n */
    struct factor K;
    bool *held;               /* [size] left out of the factor */
    bool floating;            /* no rigid tie */
    double *C0, *R;           /* [size x 6] floating: rows of the reference as columns, rigid motions about it */
    int nc;                   /* further constraints */
    double *C, *Y;            /* [size x nc] */
    double *G;                /* [nc x nc] Cholesky factor of C Y */
    const struct tie **owner; /* [nc] */
    int freedom;              /* displacements left */
    double *f, *mu;           /* [size], [nc] work */
};

/* tie [ntie]: those held; the first is the reference. */
enum status hold_make(struct hold *o, const struct fe *fe, const struct tie *const *tie, int ntie, struct arena *life,
                      struct report *report);

/* u = displacement under loads f [size], interfaces held; u may be f. */
void hold_solve(double *u, const struct hold *o, const double *f);

/* u = displacement where tie i, one of those held, makes its motion k, the others held: a constraint mode. */
void hold_static(double *u, const struct hold *o, const struct tie *tie, int k);

#endif
