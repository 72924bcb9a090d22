/* ledger.h -- the energy balance, kept on every run:
 *
 *     |W_kin + W_int - W_ext| <= delta ||W||                                 (2-26)
 *
 * counted from the start: W_kin the change of kinetic energy; W_int the change of elastic energy and
 * what dampers, friction and the scheme's own damping took; W_ext the work of external forces, drives and gravity.
 * ||W|| is the largest |W_kin| + |W_int| + |W_ext| of the run, the drives' share in W_ext for itself, also of what works
 * come to between two looks, at least 1e-2 of the energy at the start, 200 times a scheme's tolerance of the kinetic one, and
 * what round-off leaves of a difference of energies, or moves of a mechanism at rest: print (2-26*) leaves it undefined.  A scheme's own damping may only take: what it has put in, on the whole, breaks the
 * balance, too, as where a start that the step does not resolve makes it swing over.
 * The works come from the integrator, summed by its own quadrature. */
#ifndef FMDSUB_LEDGER_LEDGER_H
#define FMDSUB_LEDGER_LEDGER_H

#include <stdbool.h>

enum { LEDGER_EXTERNAL, LEDGER_DRIVE, LEDGER_DAMPER, LEDGER_FRICTION, LEDGER_CHANNELS };

struct ledger {
    double delta;
    double least;                        /* energy of what round-off moves [J] */
    double motion;                       /* of the kinetic energy at the start: ||W|| at least */
    double kinetic0, elastic0, gravity0; /* at the start [J] */
    double kinetic, elastic, gravity;    /* now [J] */
    double work[LEDGER_CHANNELS];        /* done on the system so far [J] */
    double lost;                         /* taken by the scheme's own damping so far [J] */
    double burst;          /* of that, in steps that took a ten thousandth of what there was, and more [J] */
    double gained;         /* the most that it has put in at any time, on the whole [J] */
    double struck;         /* taken by impacts so far [J] */
    double left;           /* sum of what Newton left over, a size [J] */
    double residual;       /* W_kin + W_int - W_ext now [J] */
    double norm;           /* ||W|| [J] */
    double worst, t_worst; /* largest |residual| so far and when */
};

void ledger_open(struct ledger *o, double delta, double least, double kinetic, double elastic, double gravity);

/* Steps are chosen by that tolerance. */
void ledger_tolerate(struct ledger *o, double tolerance);

/* The end of an accepted step: its works [LEDGER_CHANNELS]; each step's. */
void ledger_add(struct ledger *o, const double *work, double lost, double left);
void ledger_strike(struct ledger *o, double struck);
/* On the way to it works since the last end have come to `swing` in sum, and may have gone back: what the balance is
 * measured against. */
void ledger_swing(struct ledger *o, double swing);
/* The balance there, at t, by the energies: where somebody looks, but always at the end. */
void ledger_look(struct ledger *o, double t, double kinetic, double elastic, double gravity);

/* *o, the end of a step, to the part x of it, with the energies there: from what was `before` it, works and residual go on
 * evenly. */
void ledger_between(struct ledger *o, const struct ledger *before, double x, double kinetic, double elastic,
                    double gravity);

struct recall;
void ledger_recall(struct ledger *o, struct recall *r);

/* What is wrong most, and what it is measured against [J]: the worst residual and the norm, or what the scheme's damping has
 * put in and the norm or the energy at the start, if that is more.  By its share, above delta, the balance is broken. */
struct ledger_verdict {
    bool gained;
    double wrong, of;
};
struct ledger_verdict ledger_judge(const struct ledger *o);
double ledger_share(const struct ledger *o);
bool ledger_broken(const struct ledger *o);

#endif
