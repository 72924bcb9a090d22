/* tangent.h -- the error of a run with one degree of freedom, propagated along the motion by its variational equation.
 *
 * Where nothing depends explicitly on time, f = (v, a) solves the variational equation (a shift in time), and any small
 * difference (dq, dv) of the motion is
 *
 *     (dq, dv) = tau f + P/M g,      g = (-a, w^2 v)/(a^2 + w^2 v^2),      P = M (v dv - a dq),
 *
 * a delay tau and an error P of the energy; w is any frequency.  Without damping P is constant, since M (v dv - a
 * dq) is the Wronskian of two solutions times the weight M of the equation; with damping P' = D P, D = da/dv +
 * (dM/dq) v/M.  An error of the energy builds up a delay: from one look to the next g becomes c g + s f, and tau
 * grows by s P/M.  Near an unstable equilibrium, where f nearly vanishes, this is the dominant part.  s follows from
 * (dq, dv)' = [0 1; da/dq, da/dv] (dq, dv) with the mean coefficients of both looks.
 *
 * A force that time itself changes is taken as one that jumps at looks and is constant in between: f changes by (0, da), the
 * error does not, and is taken apart along the new f and g.  What time has changed of the acceleration in the first half of the
 * way from look to look jumps at its start, by the mass there; the rest at its end.  Where looks are too far apart for that, as
 * under a force that is quick beside the motion, (dq, dv) is propagated as it is, with the local errors of steps.
 *
 * A step adds to tau the part of its local error (missed.h) along f, with its sign where that is known, and to P its contribution to
 * the residual of the energy balance.  Without works that is no estimate; works bring the errors of their quadrature, which are of the
 * scheme's order, too.  Contributions come in evenly between looks, and damping takes its part of them. */
#ifndef FMDSUB_ENGINE_TANGENT_H
#define FMDSUB_ENGINE_TANGENT_H

#include <math.h>
#include <stdbool.h>

#include "engine/missed.h"
#include "engine/stepper.h"

struct tangent {
    bool timed;                /* do forces depend explicitly on time? */
    bool known;                /* there has been a look; of the last one: */
    double t, v, a, M, A, D;   /* time, velocity, acceleration, mass; A = da/dq; D as above, without damping 0 */
    double excess;             /* residual of the energy balance [J] */
    double quick;              /* how quickly time changes forces there, 0 to 1 (tangent.c) */
    double q_off, v_off;       /* dq, dv */
    double position, velocity; /* largest |dq|, |dv| so far */
    double far, next;      /* displacement after which, time at which the next look is due; INFINITY: by far alone */
    double way, late;      /* since the last look: displacement, delay added by steps, */
    double q_told, v_told; /* and their local errors */
    double t_step, v_step; /* end of the last step, velocity there */
    double seen_position, seen_velocity; /* signed sums of missed.h at the last change of these, */
    long told;                           /* after so many steps */
    long looks;                          /* so far */
    double apart;                        /* displacement from look to look, in usual sizes */
    double usual;                        /* size of the coordinate */
    double *q, *u, *b;                   /* [nq], [1], [1] scratch */
};

/* After stepper_open(), with one degree of freedom, no contacts, and no drives; timed: forces depend explicitly on time. */
void tangent_open(struct stepper *s, bool timed, struct arena *life);

/* missed.h has new local errors, after a step h that ends with velocity v: tau takes them in. */
void tangent_told(struct stepper *s, double h, double v);
/* After each step, which has led to x. */
static inline void tangent_step(struct stepper *s, const struct state *x)
{
    struct tangent *o = s->tangent;
    const double h = x->t - o->t_step, v = x->v[0];
    o->way += h * fabs(v);
    if (s->missed->told != o->told) tangent_told(s, h, v);
    o->t_step = x->t;
    o->v_step = v;
}

/* Are so few looks taken yet, for the steps so far and the way since the last one, that another is affordable at x? */
bool tangent_affords(const struct stepper *s, const struct state *x);
/* Is one due, too? */
static inline bool tangent_due(const struct stepper *s, const struct state *x)
{
    const struct tangent *o = s->tangent;
    return !(o->way < o->far && x->t < o->next) && tangent_affords(s, x);
}

/* Propagates the error from the last look to x.  excess: residual of the energy balance without numerical damping
 * [J]; works: do other than conservative forces do work?  Then D is found, too. */
void tangent_look(struct stepper *s, const struct state *x, double excess, bool works);
/* A new chart has been chosen at x; v, a: velocity and acceleration there in the old one. */
void tangent_rechart(struct stepper *s, const struct state *x, double v, double a);
void tangent_recall(struct tangent *o, struct recall *r);

#endif
