/* lateral.h -- is the motion of flexible bodies that are stepped in a plane stable against leaving the plane
 * (lateral buckling)?
 *
 * Out-of-plane modes that are 0 stay 0 by symmetry (model/mirror.h), buckled or not, and are left out.  At records
 * the slopes K of their rows are found in the whole system, by differences at the rates and accelerations of the
 * instant.  Where the least eigenvalue -s^2 of (K + K')/2 relative to their masses is negative, a disturbance out of
 * the plane grows by exp(s t).  If one grows 20 times without interruption, the run says so. */
#ifndef FMDSUB_SIM_LATERAL_H
#define FMDSUB_SIM_LATERAL_H

#include <stdbool.h>

struct lateral {
    struct system *whole;   /* with these modes; NULL: none are left out */
    int n, *at;             /* [n] independent coordinates of `whole` that are left out */
    const int *from;        /* number in the model of each tree coordinate of `whole`; -1: left out */
    double *q, *near;       /* [nq] */
    double *v, *a, *r, *dx; /* [n of the whole] */
    double *K, *M, *X;      /* [n x n] */
    double *all, *lambda;   /* [n x n of the whole], [n] */
    double last;            /* time of the last look [s] */
    double growth;          /* integral of s over the time in which it has been positive without interruption */
    double since;           /* beginning of that time [s] */
    double t;               /* the same, once it is to be told; NAN: nothing grows */
    int body;               /* flexible body of the mode that moves most */
};

#endif
