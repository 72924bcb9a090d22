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
    double *gone;                                    /* [n] the way so far */
    double mu;
    int steps;                 /* taken */
    int neutral;               /* motions that nothing holds and nothing pushes, the first columns of N */
    double *N;                 /* [n x n] by column: these, N' N = 1 */
    double *lambda, *Z, *work; /* [n], [n x n], [2 n n + n]: K Z = M Z diag(lambda) */
};

static const double REST_TINY = 1e-11; /* a step of next to nothing [m], [rad] */

/* q1 := q (+) dx. */
void rest_displaced(const struct rest *s, double *q1, const double *dx);
/* r := r(q, 0, 0, t). */
enum status rest_resid(const struct rest *s, double *r, const double *q, struct trouble *why);

void rest_neutral_open(struct rest *s, struct arena *scratch);
/* Behind K's factorization in J, `held` if there is one: is there something that K all but does not hold? */
bool rest_suspects(const struct rest *s, bool held);
/* Is it an equilibrium but for neutral motions, stable in all else, and Newton's step, to q1, next to nothing?  N. */
bool rest_settles_neutral(struct rest *s);
/* Where the search has ended without: the coordinate that moves most as an equilibrium there is left, the one that falls fastest;
 * -1: it is none, or not known to be unstable. */
int rest_falls(struct rest *s);
/* J [n x n] += what holds neutral motions; dx [n] without them. */
void rest_hold_neutral(const struct rest *s, double *J);
void rest_leave_neutral(const struct rest *s, double *dx);
/* From q1, settled but for neutral motions, along these as near to the start as they lead: q, its residual.  false: it is there. */
bool rest_goes_back(struct rest *s);
/* Which coordinates they are, each by another one; N is used up. */
void rest_name_neutral(struct neutral *names, const struct rest *s);

#endif
