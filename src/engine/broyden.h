/* broyden.h -- the inverse of the iteration matrix, which goes on with time and learns from every iteration.
 *
 * A matrix costs one to three evaluations, and one that is kept is worth less with each step.  Its inverse B is of
 * small systems known as it is; and two things are known of it between two matrices.
 *
 * Where J changes smoothly, as masses do when a crank turns, B goes on as a line through the last two, if such a line
 * would have served for the last one, and twice as well as standing still: B J - I tells, as energy measures it.  (Numbers
 * of B do not: what is stiff is small in B, and a line that is right to 1e-5 of the largest may turn it round.)
 *
 * Two iterations of one step show J along the correction s between them: J s = y, the change of the residual, where B
 * y was expected to be s and d = s - B y is what B makes of the second residual r.  The least change of B that knows
 * this, as energy measures it, is
 *
 *     B := B + d s'/(s'y),   so that the second correction becomes   B r = d + d s'r/(s'y)
 *
 * (Broyden, Math. Comp. 19 (1965) 577).  s'y is nearly s'J s, so that units do not matter.  Other directions than s
 * are not looked at while they are out of date: so what has been learnt fades.
 *
 * Vibration is foreseen (predict.h) by the matrix as it was formed, goes on with time, but has not learnt: it must
 * belong to the slopes that it was formed with.
 *
 * What it buys: evaluations and matrices a step without it and with it, on shipped decks under midpoint:
 *
 *     four-bar 2.19 and .19, 1.95 and .033; slider-crank 2.01 and .15, 1.75 and .030; heavy-top 2.05 and .038, 1.50 and
 *     .004; andrews 1.73 and .10, 1.49 and .022; flexible-crank 2.39 and .18, 2.15 and .067; bearing 2.25 and .14, 2.08 and
 *     .059; suspension 1.42 and .021, 1.42 and .025 */
#ifndef FMDSUB_ENGINE_BROYDEN_H
#define FMDSUB_ENGINE_BROYDEN_H

#include "engine/matrix.h"

struct broyden {
    struct matrix J;
    bool serves;  /* the system is small, its matrix dense; else J is solved with */
    int ld;       /* n; where there are more than a few a multiple of four: rows behind n are zeros, for vectors */
    int high;     /* n or four: rows of a tile, as B, F and S stand (la/tiles.h) */
    double *B;    /* [ld x n] as it goes on and has learnt */
    double *F;    /* [ld x n] as it was formed last */
    double *S;    /* [ld x n] its change a second, from the one before */
    double *W;    /* [ld x n] work: B J - I, by column */
    double *y;    /* [ld] work, of zeros behind n */
    double *d;    /* [ld] work */
    double *none; /* [ld] zeros */
    double h;     /* of the step that F was formed for */
    double t;     /* where F was formed */
    double at;    /* where B stands */
    int formed;   /* two: S is known */
    bool moves;   /* S foretells F */
    bool learnt;  /* B is not F */
};

void broyden_open(struct broyden *o, const struct ode2 *ode, struct effort *effort, struct arena *life);
/* What comes is another motion. */
void broyden_forget(struct broyden *o);
/* As matrix_factor(), for steps h. */
enum status broyden_form(struct broyden *o, double h, double cc, double ck, const struct instant *x,
                         struct trouble *why);
/* Goes on to time t; returns whether as a line. */
bool broyden_go(struct broyden *o, double t);
/* d := B r. */
void broyden_solve(struct broyden *o, double *d, const double *r);
/* The correction s that came of the residual r0 has been made, r is the residual since and d = B r: false where nothing can
 * be learnt of it; else d := B r with what has. */
bool broyden_learn(struct broyden *o, double *d, const double *s, const double *r0, const double *r);
/* x := J^-1 h (K v + C a), what a changes by in a step h of velocity v under constant forces; 0: that is nothing. */
int broyden_drift(struct broyden *o, double *x, double h, const double *v, const double *a);
/* E_LIMIT as matrix_need(). */
enum status broyden_recall(struct broyden *o, struct recall *r);

#endif
