/* trial.h -- the trial runs behind an advice; private to study/. */
#ifndef FMDSUB_STUDY_TRIAL_H
#define FMDSUB_STUDY_TRIAL_H

#include "study/corners.h"
#include "study/reference.h"

enum { LEAST_STEPS = 100 };          /* major ones to a run: nobody wants fewer */
enum { MOST_LEVELS = 24 };           /* halvings */
static const double UNRESOLVED = .5; /* an error from which nothing follows */
static const double COVERED = .05;   /* of the run, without which nothing is said of fixed steps */

/* Errors of one scheme at two settings, and what these cost. */
struct tried {
    const char *scheme;
    int ratio;
    int n;                           /* settings that were seen: 0, 1 or 2 */
    double at[2], error[2], work[2]; /* coarse, fine: major steps to an interval of records; of a
                                      * tolerance the one given, and the one it was as good as */
    double energy[2];                /* what the balance is off by, relative */
    double fine;                     /* of a tolerance: the tight one, which work[1] is of */
    double share;                    /* of the run that errors and work are of */
    double growth;                   /* of errors from the end of that part to where all trials have come, at least */
    int nlevel;                      /* of fixed steps: all settings that were tried in the same part of the run */
    struct level {
        double at, error;
    } level[MOST_LEVELS]; /* [nlevel] from the coarsest */
};

struct trial {
    struct scene scene; /* with records of the trial's own */
    struct subject subject;
    int n; /* coordinates */
    double start, until;
    double every;           /* [s] between its records */
    double multiple;        /* of the deck's interval: a whole number, or one over a whole number */
    double most, used;      /* [s] that counts may stand for, and stand for */
    double stiff;           /* [rad] that the quickest small motion turns by in the run; 0: not known */
    double opening;         /* [s] of a run */
    double work;            /* in evaluations */
    struct corners corners; /* of loads and drives in time */
    double base;            /* major steps to an interval are a multiple of this: a whole number */
    bool unseen;            /* there may be corners that are not known */
    bool comes_on;          /* forces may come on, bend or jump by the state */
    double delta;           /* that the energy balance may be off by */
    int falls;              /* errors at these fall with the step to this power */
    struct reference reference;
    struct outcome loose; /* that is compared with it: how errors grow in time */
    double steps,
        freely; /* that the loose run takes to the end, and would if records did not keep it short; 0: not known */
    struct tried own, fixed; /* a scheme that chooses its steps; one of fixed steps, the deck's if it is that */
    struct arena *life;
    struct report *report;
    const char *only;           /* why errors are told up to the end of that part only; NULL: of the whole run */
    const char *why;            /* it gives nothing */
    struct report stop;         /* of the first run that stops on the way */
    const char *no_steps;       /* why fixed steps give nothing; NULL: they do, or nothing has come of them */
    double tried_until, corner; /* [s] that is said with it: how far they were tried, a corner; NAN: not */
};

/* The least number from x on of the form 2^a 5^b, so that what it divides ends with its figures. */
double trial_handy(double x);

/* All runs of the scene that sim has opened; E_...: ended from outside. */
enum status trial_run(struct trial *o, const struct sim *sim, struct diags *diags, struct arena *life,
                      struct report *report);

/* A run within `most` seconds and until watch (or NULL) has enough; one that cannot be made, and one that stops, has no
 * rows. */
enum status trial_attempt(struct outcome *o, struct trial *t, const struct setting *setting, double most,
                          const struct outcome_watch *watch, struct arena *life);

/* trial_fixed.c: steps are halved until what is missed falls as it should; where that takes too long, over a shorter part
 * of the run, if no corner is beyond it.  All corners are ends of steps. */
enum status trial_fixed(struct trial *t);

/* Do these errors tell those of the whole run?  From a part of it in which nothing is missed nothing follows for the rest. */
bool trial_tells(const struct tried *f);

#endif
