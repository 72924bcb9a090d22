/* adaptive.h -- schemes that choose their own steps inside a major one: what they share, so that a scheme's file is its
 * formulas.
 *
 * From t to the end of the major step, landing on it and on every known kink and corner in time between; the step used
 * before such a cut is kept.  Where the run is asked to end (base/stop.h) it ends after a step, short of that.  A step is
 * accepted where its error is at most its share in scales of the tolerance:
 *
 *     err = rms of e_i / (tol (Y_i + |y_i|)) <= h / (t + 10 h),      t the time that has gone by,
 *
 * so that what all steps leave adds up to the tolerance, however many there are; and at most the root of that where the scheme
 * goes on from a value of higher order than the error is of.
 *
 * Y_i is what makes the tolerance a share in any units: of a position its usual size L_i (a radian, the mechanism's
 * length), of a velocity L_i times a hundredth of the fastest |v_j|/L_j so far, of drives, too, a tenth where the scheme goes on from a
 * value of the estimate's order; there |y_i| of a velocity is its largest so far.  Starting step: Hairer, Norsett & Wanner,
 * Solving Ordinary Differential Equations I, II.4. */
#ifndef FMDSUB_ENGINE_ADAPTIVE_H
#define FMDSUB_ENGINE_ADAPTIVE_H

#include <stdbool.h>

#include "engine/rk.h"
#include "engine/stepper.h"

/* The scale of works, tol (energy + turned), where errors of a step's works, each channel's, are to be below 1, too: the
 * motion alone may be smoother than the powers are. */
struct works {
    double turned;       /* sum of |work| of all steps and channels so far [J] */
    double energy;       /* largest kinetic energy known, and what all but stands has [J] */
    bool asked;          /* has it been asked for in this H, or since the last record? */
    double until;        /* the next one, then */
    double tried, error; /* step and error of the last trial from here; 0: there was none */
    int slow;            /* trials from here whose errors did not fall with the square of the step */
    double *u;           /* [n] */
};

/* See creep.h. */
struct creep {
    long steps;  /* since then */
    double from; /* a time */
};

struct adaptive {
    const struct adaptive_scheme *scheme;
    double *q, *v, *a;    /* the state inside H: [nq], [n], and its accelerations [n] */
    double *q1, *v1;      /* the end under trial */
    double *ahead;        /* [n] accelerations there, of schemes whose estimates corners mislead; NULL: not known */
    double *q0, *v0;      /* where the last step began, */
    double *a0;           /* its accelerations there, */
    double t0, t1;        /* and when, and its end */
    double *u, *dx;       /* [n] scratch */
    double tolerance;     /* of the scales: the deck's, or what open() makes of it */
    double pace;          /* largest |v|/L so far, of drives, too [1/s] */
    double *top;          /* [n] largest |v| so far */
    double *span;         /* [n] displacement since the start, where positions have a move of their own */
    double elapsed;       /* time gone by since the run's start [s] */
    bool known;           /* a, and the slopes at the state, are those of the last step's end */
    bool ready;           /* between() has what it asks for of the last trial */
    double h, old;        /* next step; error of the last one */
    double came;          /* how far the trial has come: its step, or less, to where something touches */
    double beyond;        /* the trial's part of an edge: see edge.h */
    bool leaps;           /* it goes over a jump, in a step that is so short that its error does not matter */
    double held;          /* next step before a jump was in the way; 0: none was */
    int jumps;            /* trials of this step that met one */
    long nshort;          /* steps in a row that are far shorter for it */
    struct creep creep;   /* those that have led how far */
    long rejected;        /* steps given up in this H */
    struct sides *sides;  /* see sides.h; NULL: no force has any */
    struct trouble cause; /* of steps that have shrunk to nothing, since the last that was taken */
    double work[POWER_CHANNELS];
    struct passing_look *passing; /* see passing.h; NULL: nothing could be passed over */
    struct works works;           /* what their errors are judged by */
    struct rk rk;                 /* slopes at points: rk.du[0], rk.dv[0], rk.w[0] are those at the state */
    void *own;                    /* the scheme's memory */
    struct relay *relay;          /* of several schemes; NULL: it is one */
};

struct adaptive_scheme {
    int stages; /* of rk, for an explicit method; 2 for the start of any other */
    int order;  /* of the estimate + 1: the first step goes by err^(1/order) */
    bool plain; /* what it goes on from is of the estimate's order, not of a higher one */
    /* Its estimate tells no signs: it is an odd number of orders below what the scheme goes on from, and of two such errors
     * one delays a vibration where the other takes energy from it. */
    bool sizes_only;
    /* Required.  Once: memory into m->own. */
    void (*open)(struct stepper *s, struct adaptive *m, struct arena *life);
    /* Optional.  The state was changed from outside: what is known of steps before is of no use. */
    void (*forget)(struct adaptive *m);
    /* Required.  One trial from t to t + h, or as far as m->came is made: its error, in q1, v1 its end. */
    enum status (*attempt)(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why);
    /* Required.  The trial is the step: m->work, a, rk.w[0] and m->span follow; q and v are the caller's. */
    void (*take)(struct stepper *s, struct adaptive *m, double h);
    /* Required.  Times the step for the next one: of a trial with this error that failed; of one that was taken. */
    double (*shrink)(const struct adaptive *m, double err);
    double (*grow)(const struct adaptive *m, double err);
    /* Optional.  Inside the step that was taken last, from m->q0, v0 to m->q, v: displacement u [n] and velocity v [n] at
     * the part x of it. */
    void (*between)(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x);
    double between_from; /* the least tolerance that this will do for */
    /* Optional, where between() needs it.  Of the trial from t to t + h, before it is taken: all that between() asks for, and
     * what it is off by in scales of the tolerance.  Not OK: it cannot be had. */
    enum status (*ready)(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why);
    /* Required.  What the estimate says that the trial is off by [n], of any sign. */
    void (*off)(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h);
    /* Optional.  Adds what iterations have left in the trial [n], which no order makes smaller. */
    void (*left)(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h);
    /* What the scheme goes on from is off by the estimate times its share of the scales to this power: about by how much its
     * order is the higher one, over the order of the estimate and 1; of schemes of high order as measured (`make trust`). */
    double sharper;
    double drifts; /* the part of what steps leave in the energy that adds up: see missed_drift() */
    /* Optional.  What it remembers. */
    enum status (*recall)(struct stepper *s, struct adaptive *m, struct recall *r);
};

/* The block of a stepper of such a kind. */
struct adaptive *adaptive_of(const struct stepper *s);

/* Slots of a stepper_kind whose `formulas` are a struct adaptive_scheme. */
void adaptive_open(struct stepper *s, struct arena *life);
/* The same by another scheme than that of the kind, which is not opened yet. */
void adaptive_open_by(struct stepper *s, const struct adaptive_scheme *scheme, struct arena *life);
enum status adaptive_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why);

/* Size of position i.  A position that is moved by quasi-displacements has none of its own: what it has travelled, at most its
 * usual size. */
double adaptive_size(const struct stepper *s, const double *q, int i);
/* tol (Y_i + |y_i|) of position and of velocity i. */
double adaptive_scale_q(const struct stepper *s, int i);
double adaptive_scale_v(const struct stepper *s, int i);
/* How fast velocity i may be and all but stand. */
double adaptive_standing(const struct stepper *s, int i);
/* What that is of a plain scheme whose largest |v_i| was `top`, whatever s is of. */
double adaptive_scale_plain(const struct stepper *s, int i, double top);

/* The error of works e [POWER_CHANNELS], of a trial from t by h that did `work`. */
double adaptive_works(struct stepper *s, const double *e, const double *work, double t, double h);
/* Of the tolerance, what a step h may take. */
double adaptive_share(const struct adaptive *m, double h);

/* Can records be had between the ends of its own steps? */
bool adaptive_interpolates(const struct stepper *s);
/* q [nq] and v [n] at t in the last step, or round-off beside it: at its ends those there.  false: nothing was made ready inside
 * it, as no record was due there when it was tried. */
bool adaptive_between(const struct stepper *s, double *q, double *v, double t);
/* The same of any adaptive scheme, good enough to look for something: by cubics where it has no better. */
void adaptive_look(const struct stepper *s, double *q, double *v, double t);
/* What records that are due inside the trial from t by h, to `end`, would be off by, in scales of the tolerance: where it may not be
 * taken for it, more than 1; 0: none is due.  m->ready follows. */
double adaptive_records(struct stepper *s, double t, double h, double end);
/* For between(): u by Hermite's cubic through positions and rates at both ends; dx, rate [n]: scratch. */
void adaptive_cubic(const struct stepper *s, const struct adaptive *m, double *u, double *dx, double *rate, double x);
/* For take(): m->span goes on from q to q1; dx [n]: scratch. */
void adaptive_travel(const struct stepper *s, struct adaptive *m, double *dx);

extern const struct key adaptive_keys[];
enum status adaptive_recall(struct stepper *s, struct recall *r);
#define ADAPTIVE                                                                                                       \
    .keys = adaptive_keys, .adaptive = 1, .open = adaptive_open, .step = adaptive_step, .recall = adaptive_recall

#endif
