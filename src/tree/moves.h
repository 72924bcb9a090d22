/* moves.h -- positions moved by quasi-displacements, q1 = q0 (+) dx: the ode2_move of a model.
 *
 * Plain coordinates add; the quaternion of a spherical or free joint turns by R1 = R0 cay(dx), and
 * the fractions of the path lie on the same axis. */
#ifndef FMDSUB_TREE_MOVES_H
#define FMDSUB_TREE_MOVES_H

#include "base/arena.h"
#include "model/model.h"

/* A quaternion and its three rates. */
struct turn {
    int iq[4], iv[3];
};

struct moves {
    int nplain;
    int nfirst;              /* of these the first nfirst have iq = iv = their own number */
    const int *iq, *iv;      /* [nplain] */
    int nturn;               /* 0 and nfirst = n: the default q0 + dx does as well */
    const struct turn *turn; /* [nturn] */
};

void moves_build(struct moves *o, const struct model *m, struct arena *life);

/* As in struct ode2_move. */
void moves_point(const struct moves *m, double *q1, const double *q0, const double *dx, double s);
void moves_diff(const struct moves *m, double *dx, const double *q1, const double *q0);
/* Into dx, of the rotations alone: what is left from q1 to q0 (+) s dx0. */
void moves_left(const struct moves *m, double *dx, const double *q1, const double *q0, const double *dx0, double s);
void moves_rate(const struct moves *m, double *dxrate, const double *dx, const double *v);
void moves_bend(const struct moves *m, double *off, const double *v, const double *a, int order);

#endif
