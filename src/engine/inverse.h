/* inverse.h -- the inverse of the iteration matrix, which goes on with time and learns from every iteration.
 *
 * A matrix costs one to three evaluations, and one that is kept is worth less with each step.  Its inverse B is of
 * small systems known as it is; and two things are known of it between two matrices.
 *
 * Where J changes smoothly, as masses do when a crank turns, B goes on as a line through the last two, if such a line
 * would have foretold the last one twice as well as standing still.
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
 *     .0044; andrews 1.73 and .10, 1.48 and .022; flexible-crank 2.98 and .23, 2.42 and .089; bearing 2.27 and .14, 2.08 and
 *     .056; suspension 1.42 and .021, 1.42 and .025 */
#ifndef FMDSUB_ENGINE_INVERSE_H
#define FMDSUB_ENGINE_INVERSE_H

#include "engine/matrix.h"

struct inverse {
    struct matrix J;
    bool serves; /* the system is small, its matrix dense; else J is solved with */
    double *B;   /* [n x n] as it goes on and has learnt */
    double *F;   /* [n x n] as it was formed last */
    double *S;   /* [n x n] its change a second, from the one before */
    double *x;   /* [n] work */
    double h;    /* of the step that F was formed for */
    double t;    /* where F was formed */
    double at;   /* where B stands */
    int formed;  /* two: S is known */
    bool moves;  /* S foretells F */
};

void inverse_open(struct inverse *o, const struct ode2 *ode, struct effort *effort, struct arena *life);
/* What comes is another motion. */
void inverse_forget(struct inverse *o);
/* As matrix_factor(), for steps h. */
enum status inverse_form(struct inverse *o, double h, double cc, double ck, const struct instant *x,
                         struct trouble *why);
/* Goes on to time t. */
void inverse_go(struct inverse *o, double t);
/* x := B x. */
void inverse_solve(struct inverse *o, double *x);
/* The correction s that came of the residual r0 has been made, r is the residual since and d = B r: false where nothing can
 * be learnt of it; else d := B r with what has. */
bool inverse_learn(struct inverse *o, double *d, const double *s, const double *r0, const double *r);
/* x := J^-1 h (K v + C a), what a changes by in a step h of velocity v under constant forces; 0: that is nothing. */
int inverse_drift(struct inverse *o, double *x, double h, const double *v, const double *a);
/* E_LIMIT as matrix_need(). */
enum status inverse_recall(struct inverse *o, struct recall *r);

#endif
