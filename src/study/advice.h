/* advice.h -- the step and the tolerance that a deck needs for an error of 1e-2, 1e-4 and 1e-6, from trial runs of it.
 *
 * Trial runs go through the whole motion, or as much of it as they may take, so that drives, loads and spin count:
 * one evaluation to a step of the deck's own run, or a fifth of a run by a tolerance (trial.c), at most half a
 * second of computing. A scheme of high order at a tight tolerance is the reference; the same at a loose tolerance
 * gives the error over the tolerance. The scheme of fixed steps runs with at most a hundredth of the motion to a
 * step, then with half of that, until its error falls as its order says. Errors are those of the deck's columns
 * relative to their ranges, as in a study, both over the part that was tried.
 *
 * From there errors are extrapolated to other steps with the order that was seen, where corners of forces or drives
 * may come at unknown times with order 1, where they only bend with order 2, and to the whole run in proportion to time, or as the errors of the loose
 * run grow. A step is advised only if all known corners of loads and drives are ends of its steps: one inside a
 * step makes any scheme one of first order, and a pulse may be missed.
 *
 * Of a part in which forces may come on by the state, in which a load bends, or where errors have grown quickly before it,
 * nothing is promised, and fixed steps, which step over what comes on, are not advised.
 *
 * All decisions are by counts of evaluations, so that the same deck always gets the same advice. */
#ifndef FMDSUB_STUDY_ADVICE_H
#define FMDSUB_STUDY_ADVICE_H

#include "sim/sim.h"

enum { ADVICE_MOST = 6 };

struct advice {
    int n;
    struct advised {
        double error;           /* aimed at, relative to the ranges of the columns */
        const char *scheme;     /* deck word */
        int ratio;              /* 1 with a tolerance */
        double step, tolerance; /* one of them; the other is NAN */
        double work;            /* of the whole run with it, predicted [evaluations] */
        bool dear;              /* told, not advised: nobody takes so many, or round-off shows */
    } entry[ADVICE_MOST];       /* [n] by error, largest first; for one error the fixed step first */
    double work;                /* of the trial runs [evaluations] */
    double whole;               /* of a run with the fixed steps advised for the smallest error; NAN: none are */
    double until;               /* end of the part of the motion that was tried [s] */
    bool parted;                /* it ends there because two runs at a tight tolerance part: chaos */
    int nwithout;               /* columns that trial runs differ in too much for any promise, */
    const char *without;        /* the first of them: a name of sim's; NULL: none */
    const char *only;           /* why errors are promised up to there only; NULL: of the whole run */
    double steps_until;         /* end of the part tried with fixed steps [s]; NAN: none are advised */
    const char *no_steps;       /* why none are advised; NULL: some are, or they resolve nothing */
    double corner;              /* time of the corner that this is about [s]; NAN: it is about none */
    const char *why;            /* why there is no advice at all; NULL: there is some */
    struct report stop;         /* then, if trial runs stopped, the message of the first; "": they did not */
};

/* Advice for the scene of sim, which is open and at its start.  diags: not the deck's, since what other schemes
 * think of its keys is not for the user.  Fails only where it is interrupted (base/stop.h); if trials cannot run,
 * o->why says so. */
enum status advice_find(struct advice *o, const struct sim *sim, struct diags *diags, struct report *report);

/* The entry with a step for this error, one of those aimed at, that is advised; NULL: none. */
const struct advised *advice_step(const struct advice *o, double error);

#endif
