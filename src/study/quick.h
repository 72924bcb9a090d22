/* quick.h -- which coordinates are quick in the motion itself, from the
 * accelerations at the ends of a run's steps.
 *
 * A step h of the midpoint rule is off by h^3/12 times the third derivative of
 * a position and the fourth of its rate (engine/local_error.h).  In the scales
 * of a tolerance (engine/adaptive.h) and for a second of the run that is e_i
 * h^2; with the mean e_i of what was seen, coordinates want steps that go with
 * e_i to the power -1/2.
 *
 * A joint is fast or slow as a whole.  Of a body's modes those of higher
 * frequency are as fast: the low ones of a blade are slow.
 *
 * What is fast shakes the rest: accelerations of a hub have those of what
 * vibrates on it.  Two rates take that out, so what counts of slow coordinates
 * is u = v_L + W v_S, W = M_LL^-1 M_LS of the masses (multirate/decouple.h),
 * where there are few enough to find W. */
#ifndef FMDSUB_STUDY_QUICK_H
#define FMDSUB_STUDY_QUICK_H

#include "sim/sim.h"

enum { QUICK_SAMPLES = 64 };

struct quick {
    int n;
    int known; /* accelerations, third derivatives that are known: 0, 1, 2 */
    double t, h;
    double *a, *j;          /* [n] there */
    double *top;            /* [n] largest |v| so far */
    double *third, *fourth; /* [n] |derivatives| over the time that was seen */
    double seen;            /* [s] */
    long charts;
    int samples; /* of third and fourth derivatives, the latest ones */
    struct quick_sample {
        double h, *j, *k; /* [n] */
    } sample[QUICK_SAMPLES];
};

void quick_open(struct quick *o, const struct sim *sim, struct arena *life);
/* Of a run by an adaptive scheme, at the end of a step of its own. */
void quick_note(struct quick *o, const struct sim *sim);
/* What a second of the run is off by in coordinate i, over h^2, by its third and fourth derivatives j and k; by the mean of
 * those that were seen. */
double quick_off(const struct quick *o, const struct sim *sim, int i, double j, double k);
double quick_mean_off(const struct quick *o, const struct sim *sim, int i);
/* The tolerance at which the midpoint rule would take steps of about h, and steps that it would take for one [s]. */
double quick_tolerance(const struct quick *o, const struct sim *sim, double h, double span);
double quick_step(const struct quick *o, const struct sim *sim, double tolerance, double span);

/* A part of the coordinates that might take the minor steps. */
struct quick_cut {
    int n;
    struct scene_choice *fast; /* [n] */
    double apart;              /* the step that the quickest of the others wants, over the
                   least that these want */
    double share;              /* of the bodies that move with these */
    double gain;               /* by counts: work of one rate over that of two */
    double fourth[2];          /* what a second of a run by order 4 (engine/composed.h) is off by, over h^4 and H^4 */
};

enum { QUICK_CUTS = 2 };
/* quick_cuts.c: the best ones by counts, of gain 1.2 at least, the best first; their number. */
int quick_cuts(struct quick_cut *cut, const struct quick *o, struct sim *sim, struct arena *life);
/* The same of what is fast in the deck: how far apart; fourth [2] as above, NULL: not wanted. */
double quick_apart(const struct quick *o, struct sim *sim, double *fourth);

#endif
