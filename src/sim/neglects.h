/* neglects.h -- what effects that the deck has turned off would have changed in the results, estimated at records. */
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
        double share;       /* largest change of a column, relative to the column's largest value */
        double t;           /* when the tolerance is exceeded [s]; -1: it is not */
        double until;       /* time up to which was compared [s] */
        const char *column; /* that of the largest change: a position, angle, rate or stress if there is one */
        double acts;        /* largest change of a force, energy or acceleration, likewise, */
        const char *acting; /* and its column; NULL: there is none */
        double noise;       /* part of `share` that may be the numerical error of the runs */
    } found[EFFECTS];       /* by a second run with the effect: study/left_out.h */
};

/* May an effect that is off matter, by its estimate, or has it no estimate on some bodies? */
struct sim;
bool neglects_unsettled(const struct sim *sim, enum effect_id id);

#endif
