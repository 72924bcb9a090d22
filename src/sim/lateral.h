/* lateral.h -- does a scene whose flexible bodies are stepped in their plane still stand there?
 *
 * Modes out of the plane feel nothing while they are 0 (model/mirror.h), buckled or not.  At records the whole system,
 * with them, is asked for the slopes of their rows, by differences at the rates and accelerations of the instant: where
 * the least eigenvalue -s^2 of (K + K')/2 against their masses is negative a push out of the plane grows by exp(s t).  A run in
 * which one grows 20 times without a pause tells it. */
#ifndef FMDSUB_SIM_LATERAL_H
#define FMDSUB_SIM_LATERAL_H

#include <stdbool.h>

struct lateral {
    struct system *whole;   /* NULL: nothing is left out */
    int n, *at;             /* [n] its independent coordinates that are left out */
    const int *from;        /* of its tree's coordinates: those of the model; -1: left out */
    double *q, *near;       /* [nq] */
    double *v, *a, *r, *dx; /* [n of the whole] */
    double *K, *M, *X;      /* [n x n] */
    double *all, *lambda;   /* [n x n of the whole], [n] */
    double last;            /* time of the last look [s] */
    double growth;          /* int s dt without a pause */
    double since;           /* its beginning [s] */
    double t;               /* told to grow since [s]; NAN: nothing does */
    int body;               /* of the mode that moves most */
};

#endif
