/* stage_matrix.h -- the matrix of all stages of a collocation step, taken apart.
 *
 *     M da_i + h sum A_ij C da_j + h^2 sum (A^2)_ij K da_j = -r_i
 *
 * with M, C, K of one point: T^-1 A T = diag(lambda) makes of the s n equations real and complex ones of n,
 *
 *     (M + h lambda C + h^2 lambda^2 K) (T^-1 da) = -T^-1 r
 *
 * (Hairer & Wanner, Solving Ordinary Differential Equations II, IV.8, for systems of second order).  Full matrices: a scene may
 * be too large for them. */
#ifndef FMDSUB_ENGINE_STAGE_MATRIX_H
#define FMDSUB_ENGINE_STAGE_MATRIX_H

#include "engine/collocation.h"
#include "engine/matrix.h"

struct stage_matrix {
    const struct collocation *table;
    const struct ode2 *ode;
    struct effort *effort;
    double *M, *C, *K;                                     /* [n x n] */
    double *E, *spare;                                     /* [n x n] of the real eigenvalue, factored */
    double *re[COLLOCATION_MODES], *im[COLLOCATION_MODES]; /* [n x n] of the complex ones */
    int *swap[COLLOCATION_MODES];
    enum matrix_form form;
    double h;                       /* factored for this one; 0: not */
    double *x, *y;                  /* [n] */
    double *da[COLLOCATION_STAGES]; /* [n] */
    enum status had;                /* have the matrices been had? */
    struct trouble why;             /* if not */
};

/* All memory; where that is too much, form() says so. */
void stage_matrix_open(struct stage_matrix *o, const struct collocation *table, const struct ode2 *ode,
                       struct effort *effort, struct arena *life);
/* M, C, K at x. */
enum status stage_matrix_form(struct stage_matrix *o, const struct instant *x, struct trouble *why);
/* For the step h from t. */
enum status stage_matrix_factor(struct stage_matrix *o, double h, double t, struct trouble *why);
/* r_i := da_i. */
void stage_matrix_solve(struct stage_matrix *o, double *const *r);
/* e := (M + h lambda C + h^2 lambda^2 K)^-1 (M gv - h lambda K gu), lambda the real eigenvalue. */
void stage_matrix_error(struct stage_matrix *o, double *e, const double *gu, const double *gv);
/* M, C and K: what is factored follows from them. */
enum status stage_matrix_recall(struct stage_matrix *o, struct recall *r);

#endif
