/* solve.h -- the equations of the loops at a posture, solved for the dependents.
 *
 * With C_q = [C_qd C_qi] of each component, its rows cut down to the rank,
 *
 *     v_d = -C_qd^-1 (C_qi v_i + C_t)                      velocities
 *     a_d = -C_qd^-1 (C_qi a_i + (C_q v)_q v + C_tt)       accelerations
 *     G = -C_qd^-1 C_qi,   lambda = -C_qd^-T r_d           multipliers          (2-4)
 *
 * C_qd is factored once for a posture and a split, G made once: they are good while both have the same number.  What is
 * asked of them where the tree stands elsewhere, or after another split, is a bug: asserted. */
#ifndef FMDSUB_LOOP_SOLVE_H
#define FMDSUB_LOOP_SOLVE_H

#include "loop/factor.h"

struct block {
    struct factor C_qd;
    double *G; /* [nr x ni] */
    struct store store;
};

/* The drive of a coordinate that no other row reads: its motion is known.  scale: C_q, the only number of its row. */
struct known {
    int row, at, iq; /* places in C, v, q */
    double scale;
};

/* What a cache was made of; posture 0: of none. */
struct made {
    long posture, split;
};

struct solve {
    struct rows *rows;
    const struct split *split;
    struct block *block; /* of each component */
    int nknown;          /* of all rows, or 0: then there is nothing to solve */
    struct known *known; /* [nknown] */
    struct made factored, G;
    double *at;     /* [nq] where C_qd is factored, if that is of a posture */
    double *x;      /* [of a component's rows] */
    double *second; /* [rows] C'' */
    struct arena *life;
};

void solve_build(struct solve *o, struct rows *rows, const struct split *split, struct arena *life);
/* Room for the split of component i as it is now. */
void solve_fit(struct solve *o, int i);

/* The known coordinates of q1 where drives are; -1, or the number of one that is not finite. */
int solve_known(const struct solve *o, double *q1);

/* The tree at q, C_qd factored there; G as well.  E_NUMERIC: singular or not finite. */
enum status solve_factor(struct solve *o, const double *q, double t, struct trouble *why);
enum status solve_G(struct solve *o, const double *q, double t, struct trouble *why);
/* Is C_qd factored where the tree stands, for the split as it is? */
bool solve_at_hand(const struct solve *o);
/* Is C_qd factored, for the split as it is, at a posture no farther from q than that, in scales?  dx [of the tree]: work. */
bool solve_is_near(const struct solve *o, double *dx, const double *q, double far);
/* G [nr x ni] of component i there. */
const double *solve_G_of(const struct solve *o, int i);
/* C_qd factored of C_q as it stands in rows; of component i only: its pivot ratio, 0 if it is singular. */
enum status solve_as_it_is(struct solve *o, double t, struct trouble *why);
double solve_try(struct solve *o, int i);

/* Least pivot ratio, lengths scaled, where solve_factor() has been; split_gain() of component i as factored last. */
double solve_ratio(const struct solve *o);
double solve_gain(struct solve *o, int i);

/* xt [of the tree]: dependents := -C_qd^-1 (C_qi x_i - drive), where solve_factor() has been; drive [rows]: rates of
 * the drives. */
void solve_follow(const struct solve *o, double *xt, const double *drive);
/* Velocities, accelerations (at NULL: not wanted) of the whole tree, of the independent v, a (NULL: zero), with drives
 * as they have been set for t; where accelerations are wanted the tree's bodies then move with vt. */
enum status solve_motion(struct solve *o, double *vt, double *at, const double *q, const double *v, const double *a,
                         double t, struct trouble *why);
/* Where solve_factor() has been, of the tree's rt: lambda [rows], redundant rows 0; r [n] = r_i + C_qi' lambda. */
void solve_multipliers(const struct solve *o, double *lambda, const double *rt);
void solve_reduce(const struct solve *o, double *restrict r, double *lambda, const double *restrict rt);

#endif
