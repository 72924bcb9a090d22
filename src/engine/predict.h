/* predict.h -- where a step of a single-rate scheme begins its iteration, from the steps before it.
 *
 * The linear part of r, differentiated along the motion, is M a' + C a + K v = phi', phi the forces that it does not
 * know.  For one step of a scheme with the iteration matrix J this is, exactly,
 *
 *     J (a1 - a0) = dphi - h (K v + C a0),
 *
 * v the velocity with which q would move over the step if a stayed: vibration under constant forces is foreseen
 * whatever its frequency is.  What is left, g = J^-1 dphi, goes on from step to step by the recursion of fit.h.  Where
 * J knows little (rotation stiffens, say, or M^ changes fast) the recursion for a1 - a0 itself may foresee more: each
 * coordinate takes the one that has been closer, older steps fading.  Where that saves little, J is not asked for some
 * time.
 *
 * What J buys: evaluations without it, in percent more, on the twelve decks of renewal.h, before broyden.h:
 *
 *     chain 0, bar-slider 0, stiff-leaf-chain 0, four-bar 0, spin-up +2, cantilever +13, flexible-crank +34, axle +9,
 *     andrews 0, whip +24, double-pendulum 0, heavy-top 0
 *
 * What the recursion costs: each coordinate has its own, so that a1 need not keep what the motion keeps, such as the
 * length of a beam.  Where stiff modes follow others far above the step (in the segments of whip omega h is 10 and 18;
 * soft-pendulum is such, too) this error is in the directions that a kept J knows worst: in whip the second
 * correction is 0.067 of the first, and 0.009 where a1 goes on by the last difference, which keeps all that is linear,
 * with first corrections as large.  There the last difference would take 15 to 22 percent less, but 11 percent more in the
 * mean of all shipped decks under midpoint and newmark.  One recursion for all coordinates would take 16 to 22 percent
 * less there, 17 to 24 more where coordinates swing each for itself (free-top, spring-pendulum), and nothing in the
 * mean. */
#ifndef FMDSUB_ENGINE_PREDICT_H
#define FMDSUB_ENGINE_PREDICT_H

#include "base/arena.h"
#include "engine/broyden.h"
#include "engine/fit.h"

struct predict {
    int n, room;          /* lists are [room], see fit.h */
    struct fit_row plain; /* of a1 - a0 */
    struct fit_row model; /* of g */
    double *drift, *v;    /* J^-1 h (K v + C a0) */
    double *da;           /* a1 - a0, as foreseen and as it came, */
    double *as_plain;     /* and as foreseen by each */
    double *as_model;
    double *miss_plain; /* squares of what was missed, older ones fading */
    double *miss_model;
    int modelled;   /* drift is known */
    int seen, rest; /* steps it has been in a row; steps that it will not be asked for */
    double h;       /* of the step before */
};

void predict_open(struct predict *p, int n, struct arena *life);
void predict_forget(struct predict *p);
void predict_recall(struct predict *p, struct recall *r);
/* a1 [n] for a step h from v0, a0; J is that of this h, or NULL; `ahead`: v = v0 + ahead a0. */
void predict_make(struct predict *p, double *a1, struct broyden *J, double h, const double *v0, const double *a0,
                  double ahead);
/* h/12 times what a changes by if it goes on changing as in the step before: the local error of second-order schemes as
 * a velocity, the largest in units 1/per [n] (Zienkiewicz & Xie, Earthq. Eng. Struct. Dyn. 20 (1991) 871). */
double predict_error(const struct predict *p, double h, const double *per);
/* The step has been found; corrections are measured in units 1/per [n]. */
void predict_keep(struct predict *p, const double *a1, const double *a0, double h, const double *per);

#endif
