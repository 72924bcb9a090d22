/* advice.h -- what step and what tolerance the motion of a deck asks for, from trial runs of it.
 *
 * Trial runs go through the whole motion, or as much of it as half a second is good for, so that drives, loads and spin
 * count.  Two schemes of high order at a tight tolerance, against each other, are the reference; one of them at a loose
 * tolerance gives errors over tolerance.  The scheme of fixed steps runs with at most a hundredth of the motion to a
 * step, then half of that, until what it misses falls as its order says.  Errors are those of the deck's columns over
 * their ranges, as in a study, both of the part that was tried.  That has all known corners of loads and drives in it, and
 * a step is advised by which they are ends of steps; one in the middle makes a scheme one of first order, or a pulse is
 * missed.  From what was seen errors go on with the order that was seen, and with time as its share; where there may be
 * corners that are not known, with order 1.
 * All is decided by counts of evaluations. */
#ifndef FMDSUB_STUDY_ADVICE_H
#define FMDSUB_STUDY_ADVICE_H

#include "sim/sim.h"

enum { ADVICE_MOST = 6 };

struct advice {
    int n;
    struct advised {
        double error;           /* of the columns' ranges, promised */
        const char *scheme;     /* deck word */
        int ratio;              /* 1 with a tolerance */
        double step, tolerance; /* one of them; the other is NAN */
        double work;            /* evaluations of such a run, predicted */
    } entry[ADVICE_MOST];       /* [n] by error, largest first; of one error the fixed step first */
    double work;                /* evaluations of the trial runs */
    double whole;               /* of a run by the fixed steps advised to the smallest error; NAN: there is none */
    double until;               /* [s] the motion was looked at up to here */
    bool parted;                /* where two runs at a tight tolerance part: chaos */
    double steps_until;         /* [s] fixed steps were tried up to here; NAN: none is advised */
    const char *no_steps;       /* why none is advised; NULL: some are, or they resolve nothing */
    double corner;              /* [s] that is said with it; NAN: none is */
    const char *why;            /* why there is no advice; NULL: there is some */
    struct report stop;         /* and with it, where trial runs stop, what the first of them says; "": they do not */
};

/* Of the scene that sim has opened, which stands at its start.  diags: of its own, for what the deck's keys are to other
 * schemes is nobody's concern.  Fails only where it is ended from outside (base/stop.h); what keeps a trial from running
 * is told in why. */
enum status advice_find(struct advice *o, const struct sim *sim, struct diags *diags, struct report *report);

/* The first entry for such an error with a step; NULL: none. */
const struct advised *advice_step(const struct advice *o, double error);

#endif
