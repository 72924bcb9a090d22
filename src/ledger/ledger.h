/* ledger.h -- the energy balance, kept on every run:
 *
 *     |W_kin + W_int - W_ext| <= delta ||W||                                 (2-26)
 *
 * counted from the start of the run.  W_kin is the change of kinetic energy; W_int the change of elastic energy and
 * what dampers, friction, impacts and the numerical damping of the scheme have taken; W_ext the work of external
 * forces, drives and gravity.  Works come from the integrator, which sums them by its own quadrature.
 *
 * The paper leaves ||W|| undefined (2-26*).  Here it is the largest |W_kin| + |W_int| + |W_ext| + |W_drive| of the
 * run, the drives counted apart from the rest of W_ext, and at least
 *
 *     what works come to within a step (ledger_swing()),
 *     1e-2 of the kinetic and elastic energy at the start,
 *     200 times a scheme's tolerance, of the kinetic energy at the start,
 *     the round-off of differences of energies, and the energy that round-off moves in a mechanism at rest.
 *
 * Numerical damping may only take energy.  Where on the whole it has put some in, as a start that the step does not
 * resolve can make it, the balance is broken, too. */
#ifndef FMDSUB_LEDGER_LEDGER_H
#define FMDSUB_LEDGER_LEDGER_H

#include <stdbool.h>

enum { LEDGER_EXTERNAL, LEDGER_DRIVE, LEDGER_DAMPER, LEDGER_FRICTION, LEDGER_CHANNELS };

struct ledger {
    double delta;                        /* of (2-26) */
    double least;                        /* energy that round-off moves, a floor of ||W|| [J] */
    double motion;                       /* times kinetic0: a floor of ||W||; 0 with fixed steps */
    double kinetic0, elastic0, gravity0; /* at the start [J] */
    double kinetic, elastic, gravity;    /* at the last look [J] */
    double work[LEDGER_CHANNELS];        /* done on the system so far [J] */
    double lost;                         /* taken by numerical damping so far [J] */
    double burst;                        /* of that, in steps that took 1e-4 or more of the energy that there was [J] */
    double gained;                       /* the most by which -lost has been above 0: energy that damping put in [J] */
    double struck;                       /* taken by impacts so far [J] */
    double left;                         /* sum of the sizes of works of residuals that Newton's method has left [J] */
    double residual;                     /* W_kin + W_int - W_ext at the last look [J] */
    double norm;                         /* ||W|| [J] */
    double worst, t_worst;               /* largest |residual| so far [J], and when [s] */
};

/* delta of (2-26); least: energy that round-off moves [J]; then the energies at the start [J]. */
void ledger_open(struct ledger *o, double delta, double least, double kinetic, double elastic, double gravity);

/* Steps are chosen by this tolerance, relative: raises the floor of ||W||. */
void ledger_tolerate(struct ledger *o, double tolerance);

/* With every accepted step: its works [LEDGER_CHANNELS], what numerical damping took, what Newton's method left [J]. */
void ledger_add(struct ledger *o, const double *work, double lost, double left);
/* Energy taken by impacts [J]. */
void ledger_strike(struct ledger *o, double struck);
/* Somewhere within the step that ends here the sizes of its works came to `swing` in sum [J], though some of that
 * may have gone back by its end: ||W|| takes it in. */
void ledger_swing(struct ledger *o, double swing);
/* The balance at time t by the energies there [J].  Not needed with every step, but with the last. */
void ledger_look(struct ledger *o, double t, double kinetic, double elastic, double gravity);
/* Has hardly anything been done so far: less than a few millionths of the energies that are there? */
bool ledger_stands(const struct ledger *o);

/* *o, the ledger at the end of a step, taken back to the fraction x of the step, where the energies are these;
 * `before` is the ledger at its start.  Works and residual are interpolated linearly. */
void ledger_between(struct ledger *o, const struct ledger *before, double x, double kinetic, double elastic,
                    double gravity);

struct recall;
void ledger_recall(struct ledger *o, struct recall *r);

/* The larger of two errors relative to their measures [J]: the worst residual, of ||W||; what numerical damping has
 * put in (gained), of ||W|| or the energy at the start, whichever is more. */
struct ledger_verdict {
    bool gained;
    double wrong, of;
};
struct ledger_verdict ledger_judge(const struct ledger *o);
/* wrong/of; 0 where there is no energy. */
double ledger_share(const struct ledger *o);
/* Is that above delta, or not a number? */
bool ledger_broken(const struct ledger *o);

#endif
