/* newton.h -- the simplified Newton iteration of all implicit schemes, and when it may stop.
 *
 * The matrix is kept over iterations and steps until another pays (renewal.h), or until the contraction
 * theta = |dz_k| / |dz_k-1| is above 0.3, and in the norm of energy, too, where that is one.  An iterate is accepted
 * when the rest of the geometric series, theta/(1-theta) |dz|, is below the tolerance (Hairer & Wanner, Solving
 * Ordinary Differential Equations II, IV.8, (8.10)), with the theta that is to be expected next (contraction.h).
 *
 * Corrections are measured as velocities against the running maximum of |v_i| and |H a_i| of each
 * coordinate.  A coordinate at rest has no such scale; there the energy of the correction,
 * dz . J dz = dz . r, against twice the kinetic energy decides.  Where that is below the tolerance, too, a coordinate may be
 * left by ten of its own, unless the deck names one: the energy that a step gains or loses has the same bound.  A major step
 * of sub-cycling is judged by that energy throughout: it may leave what its minor steps would leave together, so that the
 * drift of a run stays bounded; as a stage of one of order 4 what they would leave by chance, one for and one against the other.
 * (All of it limits decks/satellite-instrument at 0.1 ms, 25:1 to 1.9e-7, which is 1.1e-8 else, 7.8e-8 with this; none of it
 * takes tests/bench/small-fast.yaml 3744 evaluations for 2209, this 2251.) */
#ifndef FMDSUB_ENGINE_NEWTON_H
#define FMDSUB_ENGINE_NEWTON_H

#include "base/arena.h"
#include "engine/contraction.h"
#include "engine/remainder.h"
#include "engine/renewal.h"
#include "engine/stepper.h"

enum verdict { CONVERGED, CONTINUE, REFRESH, FAILED };
enum { NEWTON_WAYS = 2 };

struct newton {
    const struct ode2 *ode;
    struct effort *effort;
    double tolerance; /* asked for; 0: from the error of the step */
    bool stage;       /* the step is a stage of one of order 4, whose error is what counts */
    int limit;
    double *scale, *per;                         /* [n] running maximum of velocity, 1 / scale with its floor */
    double *dz, *r;                              /* [n] last correction and residual */
    double *step, *before;                       /* [n] the ones before */
    double *energies;                            /* [n] work */
    double top;                                  /* largest scale */
    double energy;                               /* running maximum of v . M v */
    int age, life;                               /* steps since energy was looked at; after which it is due again */
    struct contraction contraction[NEWTON_WAYS]; /* of the largest correction */
    struct contraction norms[NEWTON_WAYS];       /* of pairs: of the norm of energy */
    int way, next;                               /* of pairs: of iterating, in this step and in the next one */
    double price;                                /* of a matrix, in evaluations */
    struct renewal renewal;
    struct remainder remainder; /* of newton_solve(), where all n coordinates are solved for with a matrix */
    int pairs; /* errors go round two blocks of unknowns: the norm of energy may decide, see little_energy(), and what a
                * matrix is worth shows over two iterations */
    double steps;     /* of pairs: small steps that one is worth; it may leave the energy that they would leave */
    int stale;        /* a fresh matrix is due at the next step */
    bool due;         /* and one at the next residual, newton_solve() sees to it */
    bool matrix_free; /* the iteration has no matrix: none is to blame, none is asked for */

    /* of the iteration under way */
    double tol, first, last, last2, remain; /* remain: what is left of the last residual, as a factor */
    double first_square, square;            /* energy of the first and of the last correction */
    double leaves;                          /* of pairs: of its own error, at least, an iteration like the last */
    double norm;                            /* of pairs: of the last correction, against that of the motion */
    double light;                           /* of pairs: the largest one against scales not far below the largest */
    int count;                              /* iterations done */
    int fresh;                              /* > 0: the matrix belongs to this or the last iterate */
    bool newest;                            /* no better matrix is to be had in this step */
    int bad, refreshed;
    int rounding; /* the last correction is of the size of round-off */
    int powered;  /* some power flows: its quadrature wants the last correction small too */
    bool
        one_way; /* what the matrix leaves of corrections goes one way from step to step, and works with it: it is foretold */
    double flow; /* of pairs: energy that powers bring and take in the step, all counted alike */
    int worst;   /* row of the largest correction */
};

/* What is solved: r(z) = 0, z and dz accelerations. */
struct equations {
    void *self;
    const struct instant *x; /* of the last residual */
    enum status (*resid)(void *self, double *r, double *dk, const double *z, struct trouble *why);
    enum status (*refresh)(void *self, const double *z, struct trouble *why); /* right after resid() there */
    void (*solve)(void *self, double *dz, const double *r);                   /* dz := J^-1 r */
    /* Optional.  The correction `step` that came of the residual `before` has led to r, dz is what solve() makes of it: what
     * that shows goes into solve(), and dz is made anew; false: it shows nothing. */
    bool (*learn)(void *self, double *dz, const double *step, const double *before, const double *r);
};

void newton_open(struct newton *nt, const struct ode2 *ode, struct effort *effort, const struct step_options *options,
                 struct arena *life);
void newton_forget(struct newton *nt);

void newton_recall(struct newton *nt, struct recall *r);

/* A state of the run: the scales grow. */
void newton_scale(struct newton *nt, const double *v, const double *a, double H);

/* A new step of local error `local` in units of the scales (negative: unknown). */
void newton_begin(struct newton *nt, double local);

/* err: largest correction against its scale; small: the same without scale; square: energy of the
 * correction at the instant x. */
enum verdict newton_judge(struct newton *nt, double err, double small, double square, const struct instant *x);
/* What each iteration of the step has left of the corrections, in the mean; 0 where there were no more than two. */
double newton_contraction(const struct newton *nt);
/* Looks at the energy scale, v . M v at x, when that is due; two evaluations then, not counted. */
void newton_energy(struct newton *nt, const struct instant *x);
/* The matrix was formed anew. */
void newton_refreshed(struct newton *nt);

/* z [m], the first m coordinates: solved; h [m]: what turns z into velocities. */
enum status newton_solve(struct newton *nt, double *z, const struct equations *eq, const double *h, int m,
                         struct trouble *why);

#endif
