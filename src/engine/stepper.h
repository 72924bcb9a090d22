/* stepper.h -- what every integration scheme promises.
 *
 * A scheme is one table of functions.  One step() advances the state by one major step H = ratio * h
 * (single-rate schemes: as ratio plain steps of h; adaptive schemes: from t to `to` with steps of
 * their own).  A step that fails leaves the state as it was and returns E_NUMERIC with *why filled.
 * An unconverged step is never accepted.  All memory is taken when the stepper opens, but for
 * subcycle's minor steps, taken once for the largest ratio met. */
#ifndef FMDSUB_ENGINE_STEPPER_H
#define FMDSUB_ENGINE_STEPPER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/recall.h"
#include "base/status.h"
#include "engine/options.h"
#include "system/ode2.h"

/* Where the system stands; the caller owns the arrays. */
struct state {
    double t;  /* [s] */
    double *q; /* [nq] */
    double *v; /* [n] */
    double *a; /* [n] accelerations at t; of schemes that take a step as a whole (midpoint, subcycle) its mean ones */
};

/* What `subcycle` evaluates for: its matrices; the first sweep over a major step, the second one, further ones, whole or coarse;
 * minor steps once more in a sweep.  What begins a run and what looks at its energy is in none of these. */
enum spent_on {
    SPENT_ON_MATRICES,
    SPENT_ON_FIRST,
    SPENT_ON_SECOND,
    SPENT_ON_SECOND_COARSE,
    SPENT_ON_MORE,
    SPENT_ON_MORE_COARSE,
    SPENT_ON_REPEATED,
    SPENT_KINDS
};
struct spent {
    long times, slow, fast; /* how often; evaluations as in struct effort */
};

/* Work counted since opening: times vary, counts do not. */
struct effort {
    long majors;     /* accepted major steps */
    long minors;     /* accepted minor steps */
    long slow, fast; /* evaluations (resid, mass, accel) that swept slow bodies, fast bodies */
    long factors;    /* factorizations of an iteration matrix */
    long sweeps;     /* Newton iterations (subcycle: sweeps over the major step) */
    long rejected;   /* steps or sub-steps tried and given up */
    struct spent spent[SPENT_KINDS];
};

struct stepper;

/* The local error of a step, sizes [n]. */
struct step_error {
    const double *position, *velocity;
    const double *shared_position,
        *shared_velocity; /* two rates: the part of the fast coordinates' [ns] that goes with H */
};

struct stepper_kind {
    const char *name;       /* deck word */
    const char *brief;      /* one line for `fmdsub list` and the manual */
    const struct key *keys; /* the options that it reads, of struct step_options; NULL: none.  Besides, one that is not
                             * adaptive reads step, one of two rates ratio, and all read until */
    /* Optional.  Do the options go together?  false: *why is filled. */
    bool (*fits)(const struct step_options *o, struct misfit *why);
    bool two_rates;                    /* sub-cycling; else ratio plain steps are one major step */
    const struct stepper_kind *single; /* of two rates: what it is at ratio 1, with its neutral options (KEY_NEUTRAL) */
    bool yardstick;                    /* serves for comparison only: nobody is advised to take it */
    bool cut;                          /* its steps may be cut at impacts and where friction sets in: rigid contacts */
    bool keeps;                        /* conserves the momenta of mechanisms that float freely: settle() of ode2.h */
    /* Debian package of a library that a build may be without, NULL: none.  The scheme runs where it is asked for by
     * name alone, so that what is chosen is the same everywhere. */
    const char *needs;
    bool starts_anew; /* a run that goes on from a kept state begins without its history */
    int order;
    int adaptive; /* chooses its own steps inside H */
    bool full;    /* forms full matrices of all coordinates, too large for hundreds of these */
    int points; /* evaluates residuals at points of time, which miss the impulse of a drive whose rate jumps inside the
                   * step: stepper_step() delivers it before step().  0: drives move by their means over the step
                   * (instant.ta, tb), which contain it; or an adaptive scheme looks for corners itself */

    /* Optional: the same with steps of its own by `tolerance`. */
    const struct stepper_kind *tolerant;

    /* Optional: the same composed to order 4 (engine/composed.h), taken where `order` is 4. */
    const struct stepper_kind *fourth;

    const void *formulas; /* of the family that open and step are those of: struct implicit_scheme; NULL: of none */

    /* Optional.  The factor c of its phase error c (omega h)^(order + 1) in a step; with fades(), where that is not
     * 0, the factor d of its loss of amplitude d (omega h)^2. */
    double (*late)(const struct step_options *o);
    double (*fades)(const struct step_options *o);

    /* Required.  Once, by stepper_open(): takes all memory into s->self. */
    void (*open)(struct stepper *s, struct arena *life);
    /* Required.  By each stepper_step(): one major step from x, in place, of minor step h; H = ratio * h.  `to` is
     * the exact time at its end (the caller's i * H, free of sums); an adaptive scheme may end short of it when
     * `stop` is set.  Adds the step's work by channel into s->work, what its damping took into s->lost and what
     * Newton left over into s->left (all set to zero before) [J].  s->fresh: nothing is known of the past, and x->a
     * are the accelerations of (2-4) at x; cleared by a step that is taken.  Counts s->effort but for majors and
     * rejected. */
    enum status (*step)(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why);
    /* Optional.  The last step is undone: what the scheme carries besides the state goes back, too.  The next step
     * begins where that one did, with s->fresh. */
    void (*back)(struct stepper *s);
    /* Optional.  Accelerations [n] that it carries as a part of the motion, besides x->a, with steps of h.  next:
     * those that the next step is to begin with, to be filled by the caller; else those that the last step has left. */
    double *(*carried)(struct stepper *s, double h, bool next);
    /* Optional, two rates.  The local error of the step just made, in its decoupled variables, summed over the minor
     * steps. */
    struct step_error (*error)(struct stepper *s);
    /* Optional, two rates.  Before error(): it is to take in what the accelerations a [n] at the end show. */
    void (*error_end)(struct stepper *s, const double *a);
    /* Optional, two rates.  The step was taken; false: and steps before are no longer of this motion. */
    void (*keep)(struct stepper *s, bool taken);
    /* Optional.  All that step() carries to the next one besides the state: base/recall.h.  E_LIMIT: no memory for
     * it. */
    enum status (*recall)(struct stepper *s, struct recall *r);
};

struct accel;
struct missed;
struct strikes;
struct tangent;
struct touch;

/* The first step of a scheme that chooses its own. */
struct guess {
    double h; /* 0: none */
    int ratio;
};

/* A vibration that minor steps are too long for: the one of the largest energy in all steps so far. */
struct unresolved {
    double energy;     /* twice its own, at least [J]; 0: there is none */
    double motion;     /* twice the largest kinetic energy so far [J] */
    double omega_h, t; /* its frequency times the minor step; when */
    int coordinate;
};

struct stepper {
    const struct stepper_kind *kind;
    struct ode2 *ode; /* charts change between steps, see ode2_chart */
    struct step_options options;
    struct effort effort;
    double work[POWER_CHANNELS]; /* of the last accepted step [J] */
    double lost;   /* energy taken by numerical damping in the last step [J]; some schemes give a part of it
                                  * back within a vibration */
    double struck; /* energy taken by impacts in the last step [J] */
    double left;   /* size of the work of the residual that Newton's method left in the last step [J] */
    double swing;  /* largest sum of |work| within the last major step, where that was many steps [J] */
    struct unresolved unresolved; /* two rates by fixed steps without damping */
    int last_sweeps;              /* sweeps (iterations) of the last step */
    int fresh;                    /* no history: predictors and factors must not be used */
    struct guess guess;
    bool natural;  /* adaptive schemes: step() ends after one of the scheme's own steps, at a new x->t */
    double due;    /* then: time of the first record behind its start, which adaptive_between() is to interpolate */
    int unstarted; /* accelerations were not found in a new chart: the next step solves for them again */
    struct accel *accel;     /* solves (2-4) for a */
    struct missed *missed;   /* sums of local errors; NULL: not wanted */
    struct strikes *strikes; /* NULL: no force bends or jumps by the state, or they are not looked at */
    struct tangent *tangent; /* with one degree of freedom: errors propagated; NULL: not wanted */
    struct touch *touch;     /* rigid contacts; NULL: there are none */
    /* Two rates with rigid contacts: takes the minor steps for all coordinates where a contact is closed or near;
     * NULL: not so. */
    struct stepper *plain;
    bool was_plain;         /* it took the last step */
    long plainly;           /* major steps that it has taken */
    struct stepper *damped; /* the same scheme with rho_infinity below 1, by stepper_may_damp(); NULL: none */
    bool damps;             /* it takes the steps, by stepper_damp() */
    struct single *keep;    /* v, a before a corner */
    struct single *whole;   /* the state before a step that is taken in parts */
    struct arena *life;
    void *self; /* the scheme's memory */
};

/* Opens s on ode with options; the memory is life's. */
void stepper_open(struct stepper *s, const struct stepper_kind *kind, struct ode2 *ode,
                  const struct step_options *options, struct arena *life);

/* Right after it: prepares for steps damped by rho_infinity rho, if they become necessary.  false: the scheme has no
 * rho_infinity, damps already, or there are contacts. */
bool stepper_may_damp(struct stepper *s, double rho);
/* From here on steps are damped. */
static inline void stepper_damp(struct stepper *s)
{
    s->damps = true;
    s->damped->fresh = 1;
}

/* Moves the counts of a stepper inside another one to the outer one, which counts major and minor steps itself. */
void effort_hand_on(struct effort *to, struct effort *from);

/* One major step; counts effort.  x->a must hold the accelerations at x->t at the first call
 * (stepper_start makes them). */
enum status stepper_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why);

/* All that is carried from step to step besides the state: base/recall.h. */
enum status stepper_recall(struct stepper *s, struct recall *r);

/* x->a := consistent accelerations (2-4) at x, and forgets predictors and stale factors: for the start, and after
 * anything outside changed the state. */
enum status stepper_start(struct stepper *s, struct state *x, struct trouble *why);

#endif
