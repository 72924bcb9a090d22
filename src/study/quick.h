/* quick.h -- which coordinates need small steps, from the accelerations at the ends of the steps of a run.
 *
 * In a step h the midpoint rule has an error of h^3/12 times the third derivative of a position, and the fourth for
 * its rate (engine/local_error.h), and of a rotation what its straight way misses (ode2_move).  In the scales of a tolerance (engine/adaptive.h) and per second of the run that
 * is e_i h^2; the step that coordinate i needs goes with the mean e_i seen to the power -1/2.
 *
 * A joint is fast or slow as a whole.  If a mode of a body is fast, those of higher frequency are, too; its lower
 * ones, as of a blade, may be slow.
 *
 * Fast coordinates shake the rest: the acceleration of a hub contains that of the blades which vibrate on it.
 * Schemes of two rates remove this inertia coupling, so what counts for slow coordinates is u = v_L + W v_S, W =
 * M_LL^-1 M_LS (multirate/decouple.h), where they are few enough to find W. */
#ifndef FMDSUB_STUDY_QUICK_H
#define FMDSUB_STUDY_QUICK_H

#include "sim/sim.h"

enum { QUICK_SAMPLES = 64 };

struct quick {
    int n;
    int known;              /* derivatives known at the last step's end: 0, 1: accelerations, 2: third ones, too */
    double t, h;            /* of that end, of that step [s] */
    double *a, *j;          /* [n] accelerations and third derivatives there */
    double *top;            /* [n] largest |v| so far */
    double *bend;           /* [n] scratch */
    double *third, *fourth; /* [n] integrals of |derivative| over the time seen */
    double seen;            /* that time [s] */
    long charts;            /* system_charts() there */
    int samples;            /* of third and fourth derivatives; the latest QUICK_SAMPLES are kept */
    struct quick_sample {
        double h, *j, *k; /* step [s], the two derivatives [n] */
    } sample[QUICK_SAMPLES];
};

void quick_open(struct quick *o, const struct sim *sim, struct arena *life);
/* At the end of each step that an adaptive scheme has chosen. */
void quick_note(struct quick *o, const struct sim *sim);
/* e_i of coordinate i from its third and fourth derivatives j and k; from the means of those that were seen. */
double quick_off(const struct quick *o, const struct sim *sim, int i, double j, double k);
double quick_mean_off(const struct quick *o, const struct sim *sim, int i);
/* The tolerance at which the midpoint rule would take steps of about h in a run of `span` [s]; the step that it
 * would take at a tolerance [s]. */
double quick_tolerance(const struct quick *o, const struct sim *sim, double h, double span);
double quick_step(const struct quick *o, const struct sim *sim, double tolerance, double span);

/* A choice of fast coordinates. */
struct quick_cut {
    int n;
    struct scene_choice *fast; /* [n] */
    double apart;              /* smallest step that a slow coordinate needs over the smallest that a fast one needs */
    double share;              /* of the bodies that move with the fast ones */
    double gain;               /* by counts: work of one rate over that of two */
    double fourth[2];          /* error per second of a run by order 4 (engine/composed.h): factors of h^4 and of H^4 */
};

enum { QUICK_CUTS = 2 };
/* quick_cuts.c: the best choices by gain, which is 1.2 at least, the best first; returns their number. */
int quick_cuts(struct quick_cut *cut, const struct quick *o, struct sim *sim, struct arena *life);
/* `apart` of the fast coordinates of the deck; fourth [2] as above, NULL: not wanted. */
double quick_apart(const struct quick *o, struct sim *sim, double *fourth);

#endif
