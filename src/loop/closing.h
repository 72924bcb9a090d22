/* closing.h -- positions that keep the loops closed.
 *
 * A way from a base is given by its independent part dx_i; the dependent part starts on the tangent at the base, dx_d =
 * G0 dx_i, drives going from where they were to where they are, and goes by Newton's method to C(q0 (+) dx) = 0:
 *
 *     dx_d := dx_d - C_qd^-1 C
 *
 * where the columns of a rotation with dependents are those along its Cayley vector: convergence is quadratic.  The
 * tangent is good for as long as the base and the split have the same number.
 *
 * A way along the velocities of the last residual bends off the tangent by h^2/2 of what the dependents' accelerations are
 * without those of the independents and drives, h from dx = h v: what is missed from there is of third order. */
#ifndef FMDSUB_LOOP_CLOSING_H
#define FMDSUB_LOOP_CLOSING_H

#include "loop/solve.h"

/* The tangent of one component. */
struct tangent {
    double *G; /* [nr x ni]; of a wide part NULL, and */
    struct factor C_qd;
    double *T, *s; /* [nr x nlead] C_qd^-1 of the unit vectors of drives; [nlead] their measures */
    struct store store;
};

/* q1 = base (+) dx; rotations that are wholly independent go the fraction s of `full`. */
struct way {
    const double *base, *full; /* [nq], [of the tree]; s = 1: full is not looked at */
    double s;
    double *dx; /* [of the tree] independents given, dependents found */
};

/* The worst loop of a posture that could not be closed, its |C| at the nearest posture met. */
struct miss {
    int loop;
    double by;
};

struct closing {
    struct rows *rows;
    const struct split *split;
    struct solve *solve;
    struct tangent *tangent; /* of each component */
    struct posture base;
    struct made made;     /* what the tangent is of: base and split */
    struct posture about; /* a base whose tangent is that `at` a posture beside it; 0: there is none */
    double *at;           /* [nq] */
    double *along;        /* [of the tree] velocities of a step, and */
    double *bend;  /* how dependents bend off the tangent on it: their accelerations beyond G a_i and the drives' */
    bool bends;    /* are they known? */
    double first;  /* the first correction of the last way that was closed from a tangent */
    bool factored; /* a run that goes on: C_qd was, at solve->at, and has not been since */
    bool plain;    /* all drives, if any, are of coordinates */
    double *C;     /* [rows] */
    double *x, *y; /* [of a component's rows or coordinates] */
    double *full, *dx, *last; /* [of the tree] */
    struct arena *life;
};

void closing_build(struct closing *o, struct solve *solve, struct arena *life);
/* Room for the split of component i as it is now. */
void closing_fit(struct closing *o, int i);

/* The tangent at q, which is the base then; 0: singular there. */
int closing_tangent(struct closing *o, const double *q);
/* The same for a step from q, with what is factored already, where that is right beside q: from now on the tangent at q. */
int closing_tangent_about(struct closing *o, const double *q);
/* Where C_q is factored the tree moves with v, a: the next way along v begins on a curve, not on its tangent, if that was not
 * near enough. */
void closing_bend(struct closing *o, const double *v, const double *a);
void closing_recall(struct closing *o, struct recall *r);
/* split_gain() of component i there. */
double closing_gain(const struct closing *o, int i);
/* dx of the dependents along it. */
void closing_predict(const struct closing *o, double *dx);
/* What is missed comes into forces by its part of the cube of the pivots' ratio: of a way, the root of that. */
double closing_worth(const struct closing *o);
/* Closes a way to q1 by its dependents; WAY_LOST: it cannot be, and *miss says why.  After a correction up to `ajar`, in
 * scales, it is left as open as its square; less near a dead point. */
enum way_end { WAY_LOST, WAY_CLOSED, WAY_AJAR };
enum way_end closing_close(struct closing *o, double *q1, struct miss *miss, const struct way *way, double ajar);

/* q1 = q0 (+) s dx [n], as ode2_move has it, with drives as they are; WAY_LOST: it cannot be closed.  q1 may be q0. */
enum way_end closing_point(struct closing *o, double *q1, struct miss *miss, const double *q0, const double *dx,
                           double s, double ajar);
/* The same from q1, a closed posture of another dx, if that takes so many corrections at most: closing_again.c. */
struct again {
    int corrections;
    bool open;           /* q1 is nearly closed, or closed for drives of another time */
    double ajar;         /* a way up to this, in scales, is left as open as its square; less near a dead point */
    double left;         /* correction, in scales, that may be missing; less near a dead point; 0: round-off */
    const double *v, *a; /* the tree's motion at q1, in a step along v, drives as they are; NULL: not known */
};
enum way_end closing_again(struct closing *o, double *q1, const double *q0, const double *dx, double s,
                           const struct again *how);

/* Between its files: what closing_bend() finds, and dx of the dependents off the tangent on a way along those velocities, by how
 * much, in scales; q1 of a way; dx of the dependents -= C_qd^-1 C, by how much, in scales. */
void closing_put(const struct closing *o, double *q1, const struct way *way);
double closing_correct(const struct closing *o, double *dx, const double *C);
void closing_find_bend(struct closing *o, const double *v, const double *a);
double closing_follow_bend(const struct closing *o, double *dx, const double *way);

#endif
