/* rest_parts.h -- inside the search for rest: rest.c, rest_neutral.c */
#ifndef FMDSUB_SIM_REST_PARTS_H
#define FMDSUB_SIM_REST_PARTS_H

#include "sim/parts.h"

struct rest {
    const struct ode2 *ode;
    double t;
    int n;
    double *q, *q1, *r, *r1, *dx, *zero, *up, *down; /* [nq] [nq] [n]... */
    double *M, *K, *J;                               /* [n x n] */
    double *gone;                                    /* [n] displacement so far */
    double mu;                                       /* of (mu M^ + K) dx = -r: rest.c */
    int steps;                                       /* taken */
    int neutral;               /* neutral motions: without stiffness and without a force along them */
    double *N;                 /* [n x n] by column; the first `neutral` columns are these, N' N = 1 */
    double *lambda, *Z, *work; /* [n], [n x n], [2 n n + n]: K Z = M Z diag(lambda) */
};

static const double REST_TINY = 1e-11; /* a step of next to nothing [m], [rad] */

/* q1 := q (+) dx. */
void rest_displaced(const struct rest *s, double *q1, const double *dx);
/* r := r(q, 0, 0, t). */
enum status rest_resid(const struct rest *s, double *r, const double *q, struct trouble *why);

void rest_neutral_open(struct rest *s, struct arena *scratch);
/* After the factorization of K into J, `held` if it exists: may there be a motion with almost no stiffness? */
bool rest_suspects(const struct rest *s, bool held);
/* Is q an equilibrium, stable except for neutral motions, with a negligible Newton step to q1?  Fills N. */
bool rest_settles_neutral(struct rest *s);
/* After a search that has failed: the coordinate that moves most in the fastest instability of an equilibrium there;
 * -1: q is no equilibrium, or not known to be unstable. */
int rest_falls(struct rest *s);
/* J [n x n] += a stiffness for neutral motions; dx [n] := dx without its part along them. */
void rest_hold_neutral(const struct rest *s, double *J);
void rest_leave_neutral(const struct rest *s, double *dx);
/* From q1, where all but neutral motions has settled, moves along these as near to the start as possible: q and its
 * residual. false: it is there already. */
bool rest_goes_back(struct rest *s);
/* A coordinate for each neutral motion, all different; N is used up. */
void rest_name_neutral(struct neutral *names, const struct rest *s);

#endif
