/* neglects.h -- what effects that the deck has turned off would have changed, watched at records. */
#ifndef FMDSUB_SIM_NEGLECTS_H
#define FMDSUB_SIM_NEGLECTS_H

#include "kind/effect.h"
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
    struct neglect_found {
        bool known;
        double share;       /* its largest change of a column, of the column's largest value */
        double t;           /* when the tolerance is passed [s]; -1: it is not */
        double until;       /* what was compared [s] */
        const char *column; /* of places, angles, rates and stresses that which changes most; else of any */
        double acts;        /* likewise of forces, energies and accelerations, */
        const char *acting; /* of which; NULL: there is none */
        double noise;       /* what the runs' own errors may be of it */
    } found[EFFECTS];       /* by a second run with the effect: study/left_out.h */
};

/* May an effect that is off matter, by what its watch says, or has it none on all bodies? */
struct sim;
bool neglects_unsettled(const struct sim *sim, enum effect_id id);

#endif
