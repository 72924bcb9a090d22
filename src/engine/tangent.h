/* tangent.h -- how far a run of one freedom is off: its errors go on with the motion, as small differences of it do.
 *
 * Nothing depends on the time by itself: then f = (v, a) is a difference, of all that is late, and every other is
 *
 *     (dq, dv) = tau f + P/M g,      g = (-a, w^2 v)/(a^2 + w^2 v^2),      P = M (v dv - a dq),
 *
 * late by tau, and off by the energy P; w any frequency.  Without damping P stays what it is, for M (v dv - a dq) is the Wronskian
 * of two differences over the measure of its equation; with it P' = D P, D = da/dv + (dM/dq) v/M.  What is off by an energy gets late:
 * from look to look g goes over into c g + s f, and tau grows by s P/M, which near an unstable place, where f almost dies, is all
 * that there is.  s follows from (dq, dv)' = [0 1; da/dq, da/dv] (dq, dv), slopes of the mean of both looks.
 *
 * Steps add to tau the part of their local errors (missed.h) along f, with its sign, and to P what they add to the residual of the
 * energy balance, which is found and not estimated. */
#ifndef FMDSUB_ENGINE_TANGENT_H
#define FMDSUB_ENGINE_TANGENT_H

#include <math.h>
#include <stdbool.h>

#include "engine/missed.h"
#include "engine/stepper.h"

struct tangent {
    bool known;                          /* has there been a look? */
    double t, v, a, M, A, D;             /* at the last one; A = da/dq */
    double excess;                       /* residual of the balance there [J] */
    double q_off, v_off;                 /* dq, dv there */
    double position, velocity;           /* the largest so far */
    double far, next;                    /* way and time to the next one; infinity: the way alone tells */
    double way, late;                    /* since the last look: way, what steps have added to tau */
    double t_step, v_step;               /* the last step's end */
    double seen_position, seen_velocity; /* sums of missed.h when they were told last, */
    long told;                           /* after so many steps */
    long looks;
    double apart;      /* usual sizes from look to look */
    double usual;      /* size of the coordinate */
    double *q, *u, *b; /* [nq], [1], [1] */
};

/* After stepper_open(), where there is one freedom, nothing touches and nothing depends on the time by itself. */
void tangent_open(struct stepper *s, struct arena *life);

/* A step was taken to x. */
void tangent_told(struct stepper *s, double h, double v);
static inline void tangent_step(struct stepper *s, const struct state *x)
{
    struct tangent *o = s->tangent;
    const double h = x->t - o->t_step, v = x->v[0];
    o->way += h * fabs(v);
    if (s->missed->told != o->told) tangent_told(s, h, v);
    o->t_step = x->t;
    o->v_step = v;
}

/* Is a look worth while at x? */
bool tangent_affords(const struct stepper *s, const struct state *x);
static inline bool tangent_due(const struct stepper *s, const struct state *x)
{
    const struct tangent *o = s->tangent;
    return !(o->way < o->far && x->t < o->next) && tangent_affords(s, x);
}

/* The look; residual of the energy balance with what the scheme has damped [J]; does any force but potentials do work? */
void tangent_look(struct stepper *s, const struct state *x, double excess, bool works);
/* A new chart at x: velocity and acceleration in the old one. */
void tangent_rechart(struct stepper *s, const struct state *x, double v, double a);
void tangent_recall(struct tangent *o, struct recall *r);

#endif
