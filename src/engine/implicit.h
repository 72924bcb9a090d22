/* implicit.h -- implicit one-step schemes of one rate: what they share, so that a scheme's file is its formulas.
 *
 * The unknown of a step h is an acceleration z [n].  It is found from the residual at a fraction s of the step,
 *
 *     r(q0 (+) s dx, v, z, t0 + s h) = 0,      q1 = q0 (+) dx,
 *
 * where v and dx are the scheme's: linear in z.  There are two families:
 *
 *     middle    s = 1/2.  The residual is that of the step as a whole: it is given the ends (discrete gradients; drives
 *               move by their means), and its power by channel times h is the work of the step.
 *     end       s = 1.  The residual is that of a point of time, work is taken by the trapezoidal rule.  The kind of
 *               such a scheme has `points`.
 *
 * newton.h solves for z with the matrix J = M^ + cc C + ck K, cc = dv/dz and ck = s d(dx)/dz.  The step begins where
 * predict.h leads, and z becomes state.a: for schemes of the middle the mean acceleration of the step.
 *
 * One step calls begin(), then rates() before each residual and once more with the z found, then accept(). */
#ifndef FMDSUB_ENGINE_IMPLICIT_H
#define FMDSUB_ENGINE_IMPLICIT_H

#include "engine/broyden.h"
#include "engine/newton.h"
#include "engine/predict.h"
#include "engine/single.h"

struct implicit {
    const struct implicit_scheme *scheme;
    const struct step_options *options;
    const struct ode2 *ode;
    struct effort *effort;
    struct accel *accel;
    void *own;  /* the scheme's memory, by its open() */
    bool damps; /* by open(): it takes out what the step does not resolve */

    /* the step under way */
    double h;
    const double *q0, *v0, *a0; /* state at its start */
    double cc, ck;              /* of J, by begin() */
    struct instant x;           /* where the residual is taken */
    double *z;                  /* [n] */
    double *v, *dx;             /* [n] velocity there, displacement of the step: by rates() */
    double *v1;                 /* [n] velocity at the end, by rates() of a middle scheme; else v itself */
    double *q, *q1;             /* [nq] positions there and at the end; q1 is q itself where that is the end */
    bool open;                  /* loops are open in q, by what the next iterate closes */
    double w0[POWER_CHANNELS], w[POWER_CHANNELS]; /* power at the start (end schemes), at the last residual */

    /* the iteration */
    struct equations equations;
    struct newton newton;
    struct broyden J;
    double hfactor; /* h that J was made for; 0: there is none */
    struct predict predict;
    double *hs;         /* [n] h of each coordinate, newton's measure of corrections: all the same here */
    struct single keep; /* the state before a major step of several steps */
};

struct implicit_scheme {
    bool middle;
    /* Required.  At the start of a step: cc and ck for m->h; h, q0, v0 and a0 are there. */
    void (*begin)(struct implicit *m);
    /* Required.  v, dx and, of a middle scheme, v1 for z: runs on trial values in any order. */
    void (*rates)(struct implicit *m, const double *z);
    int variant; /* the scheme's own, where several are one file */
    /* Optional.  Once: memory into m->own; may put other equations in the place of Newton's. */
    void (*open)(struct implicit *m, struct arena *life);
    /* Optional.  Before the first step, and after anything outside has changed the state: a0 are the accelerations of
     * (2-4). */
    void (*start)(struct implicit *m);
    /* Optional.  z is found; v, dx, q and q1 are its own: what the scheme has lost of the energy goes to s->lost, and
     * what it remembers is brought up to date. */
    enum status (*accept)(struct implicit *m, struct stepper *s, struct trouble *why);
    /* Optional.  What it remembers. */
    void (*recall)(struct implicit *m, struct recall *r);
};

struct implicit *implicit_new(struct stepper *s, const struct implicit_scheme *scheme, struct arena *life);
/* One step h of x to time t1, work added to s->work; or x as it was. */
enum status implicit_once(struct implicit *m, struct stepper *s, struct state *x, double h, double t1,
                          struct trouble *why);

/* What is carried from step to step. */
enum status implicit_remember(struct implicit *m, struct recall *r);

/* Slots of a stepper_kind whose `formulas` are a struct implicit_scheme; those of an end scheme. */
void implicit_open(struct stepper *s, struct arena *life);
enum status implicit_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why);
enum status implicit_recall(struct stepper *s, struct recall *r);
#define IMPLICIT_AT_END .points = 1, .open = implicit_open, .step = implicit_step, .recall = implicit_recall

/* Iterations z := z - r without a matrix: r is the residual times M^^-1. */
void implicit_without_matrix(struct implicit *m, enum status (*resid)(void *self, double *r, double *dk,
                                                                      const double *z, struct trouble *why));
/* v, dx, q (and q1) of z, in the step under way. */
void implicit_place(struct implicit *m, const double *z);
/* The residual where the step's own is taken, for other accelerations a. */
enum status implicit_resid(struct implicit *m, double *r, const double *a, struct trouble *why);

#endif
