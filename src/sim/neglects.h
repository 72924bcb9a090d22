/* neglects.h -- what effects that the deck has turned off would have changed, watched at records. */
#ifndef FMDSUB_SIM_NEGLECTS_H
#define FMDSUB_SIM_NEGLECTS_H

#include "open/neglected.h"

struct neglects {
    int n;
    struct neglect {
        int body;
        struct neglected *of;
        struct neglected_sums sum;
        double v2, q2, *q, *q1, *a;     /* sums of squares; [modes] */
        double stiffening, damping;     /* the largest shares so far */
        double t_stiffening, t_damping; /* when they passed the tolerance [s]; -1: they have not */
    } * of;                             /* [n] */
};

#endif
