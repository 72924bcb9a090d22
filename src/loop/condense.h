/* condense.h -- a tree with loops as a system of independent coordinates.
 *
 *     M a + C_q' lambda = Q,   C(q) = 0                                       (2-1), (2-2)
 *     v_d = G v_i,  a_d = G a_i + C_qd^-1 gacc,  G = -C_qd^-1 C_qi
 *     r = r_i + G' r_d,  lambda = -C_qd^-T r_d,  M^ = T' M T,  T = [1; G]     (2-4)
 *
 * (Wehage & Haug, J. Mech. Design 104 (1982) 247): the augmented system (2-3) by elimination.
 * r_t = M a - Q is the tree's own residual, which this takes from the tree's ode2.  Positions q are those of
 * the whole tree; v and a are of the independent coordinates only, fast ones first.  Nothing is kept of trial
 * states. */
#ifndef FMDSUB_LOOP_CONDENSE_H
#define FMDSUB_LOOP_CONDENSE_H

#include "loop/loops.h"
#include "open/open.h"

struct condense;

enum { BLAME_NOTHING = -1, BLAME_INITIAL = -2, BLAME_PARTITION = -3 };

/* How it went at the start. */
struct condense_start {
    enum status status;
    struct report report;
    int blamed;     /* the loop that the report is about; or BLAME_... */
    double misfit;  /* largest |C| as drawn and started */
    int misfit_row; /* of which row */
    int redundant;  /* rows that say nothing new */
    bool branches;  /* the posture as drawn is one where the loops leave the way open */
    double beside;  /* the start is so far beside it along the deck's rates, in usual changes; 0: it is not */
    double moved;   /* largest change of a coordinate that closed the loops [m] or [rad] */
    int moved_at;   /* place in v */
    double changed; /* by assembly: largest change of a rate */
    int changed_at;
};

/* q0 [nq], v0 [n] of the tree: the start as the deck has it.  The system that comes out stands still where
 * start->status is not OK. */
struct condense *condense_build(struct open_tree *tree, const double *q0, const double *v0, struct arena *life);

const struct condense_start *condense_started(const struct condense *c);
const double *condense_q(const struct condense *c); /* [nq] closed start */
const double *condense_v(const struct condense *c); /* [n] independent */
struct ode2 *condense_ode2(struct condense *c);     /* lives as long */

/* Velocities, accelerations (a NULL: not wanted) of the whole tree [m->n], of the independent v, a at a closed q. */
enum status condense_rates(struct condense *c, double *vt, double *at, const double *q, const double *v,
                           const double *a, double t, struct trouble *why);
/* All of the tree's velocities vt and accelerations at [m->n] and the multipliers lambda [rows], redundant rows 0, by
 * one fresh solve of (2-4). */
enum status condense_accel(struct condense *c, double *vt, double *at, double *lambda, const double *q, const double *v,
                           double t, struct trouble *why);

/* The same of given a [n] of the independents: lambda holds what they take, of them and of all that loads the tree. */
enum status condense_multipliers(struct condense *c, double *vt, double *at, double *lambda, const struct instant *x,
                                 struct trouble *why);

/* r [n] := T' rt, generalized forces rt [m->n] of the tree as those of the independents, at a closed q; 0 where C_qd is
 * singular. */
void condense_reduce(struct condense *c, double *r, const double *rt, const double *q, double t);

/* What is carried from step to step: the split and what it is judged by. */
void condense_recall(struct condense *c, struct recall *r);

const struct loops *condense_loops(const struct condense *c);
double condense_worst(struct condense *c, const double *q, double t); /* max |C| */
int condense_place(const struct condense *c, int i);                  /* place in the tree's v of independent i */
/* Whose reactions no dynamics can tell, because rows are redundant: unique [nloop], unique_joint [njoint]. */
void condense_mark(struct condense *c, bool *unique, bool *unique_joint);
bool condense_dropped(const struct condense *c, int row);
/* The most that a redundant row has missed by so far, of the mechanism's size; of which loop. */
double condense_missed(const struct condense *c, int *loop);
double condense_ratio(struct condense *c); /* least pivot ratio of C_qd at the start */
/* How near the loops have come to a posture where they do not hold what follows, at the ends of steps: the least of the
 * pivots of C_qd over the largest, against what it was when they were chosen. */
struct nearest {
    double ratio, t; /* 1 at first, [s] */
    int place;       /* in the tree's v, of the coordinate that is held least */
};
struct nearest condense_nearest(const struct condense *c);
long condense_charts(const struct condense *c); /* partitions chosen since the start */

#endif
