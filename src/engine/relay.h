/* relay.h -- schemes that choose their own steps, taking turns in one run: dopri5, dop853 and radau9, each where it gets furthest
 * for its work.
 *
 * All of them go on from a state and its accelerations alone, so any step may be any scheme's, and each is held against the same
 * share of the tolerance.  dopri5 begins, as its first steps grow soonest, with the step that the options know, if they do, or radau9
 * where they know of something stiff.  From time to time another one takes two or three steps, which count like all others; where
 * it is close, more of them, as long as half a percent of what is left can be lost by that, and the one before as many behind it,
 * so that both are seen on the same stretch.  The one that gets further in time for an evaluation goes on.  The clearer a scheme is behind, the longer it is until it
 * is looked at again, but sooner where what has decided has changed; where the rest of the run would not pay for it no one is.
 * Order 8 takes no part where forces bend or jump by the state, which it does not follow.  The implicit one is looked at where the
 * quickest that an explicit one meets is what keeps its steps short, or may be:
 *
 *     h |f(y1) - f(g)| / |y1 - g|,    g the last stage, at the end of the step like y1
 *
 * (Hairer & Wanner, Solving Ordinary Differential Equations II, IV.2).  Work is counted, never timed: the same deck takes the same
 * steps. */
#ifndef FMDSUB_ENGINE_RELAY_H
#define FMDSUB_ENGINE_RELAY_H

#include "engine/adaptive.h"

enum { RUNNERS = 3, LATEST = 4 };

struct runner {
    bool there; /* it takes part */
    void *own;  /* as in struct adaptive, like the next two */
    double *ahead;
    double tolerance;
    double reach;  /* time gained for an evaluation, as last seen [s]; 0: never */
    double beside; /* its step over that of the one that it took over from, as last seen; 0: never */
    double due;    /* work at which it is looked at again, and from there to the next look [evaluations] */
    double apart;
    double stiff; /* as in struct relay, when it was looked at last */
    bool known;   /* it has been looked at */
    long steps;   /* taken */
};

struct relay {
    int now;              /* who runs */
    int phase;            /* alone, on trial, or again behind the trial of another */
    int other;            /* on trial: who goes on if that one is no better; behind it: who was tried */
    int tried;            /* steps of the phase */
    double h_before;      /* step of the other one before the trial [s] */
    double gained, spent; /* sums of the phase; alone the older the less */
    double gained_before, spent_before;
    double rest;                   /* that the run was to take when the trial began [evaluations] */
    double won;                    /* what the one that runs gained for an evaluation when it took over [s] */
    int lasted;                    /* steps of the trial, behind it */
    double work;                   /* all [evaluations] */
    double stiff;                  /* radians of the quickest in a step of the explicit one, the older the less */
    double quick[LATEST];          /* in the latest ones, the last first */
    double cuts;                   /* share of steps that ended where they had to, likewise */
    double mark;                   /* work of the stepper where the step under way began */
    double last, took;             /* what the last step gained [s] and took; 0: there was none */
    bool cut;                      /* it ended where it had to */
    double lead[RUNNERS][RUNNERS]; /* logarithms of how much further one gets than another, as seen */
    struct runner of[RUNNERS];
};

/* For adaptive.c.  At the start of each of its own steps, at t: who takes it.  true: an explicit one that follows the implicit one,
 * whose accelerations are only as good as its iterations; with something stiff that is less than an explicit step can tell. */
bool relay_next(struct stepper *s, struct adaptive *m, double t);
/* A step was given up; one was taken, and may have ended where it had to. */
void relay_failed(struct stepper *s, struct adaptive *m);
void relay_took(struct stepper *s, struct adaptive *m, bool cut);
enum status relay_recall(struct stepper *s, struct adaptive *m, struct recall *r);

extern const struct stepper_kind step_relay;
/* Does a scheme of that kind take part, ever? */
bool relay_has(const struct stepper_kind *kind);
/* Who takes part by these options, number i: its name; NULL: it does not. */
const char *relay_name(const struct step_options *options, int i);
/* Steps that number i has taken. */
long relay_steps(const struct stepper *s, int i);

#endif
