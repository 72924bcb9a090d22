/* matrix.h -- the iteration matrix J = M^ + cc C + ck K of implicit schemes, factored and kept. */
#ifndef FMDSUB_ENGINE_MATRIX_H
#define FMDSUB_ENGINE_MATRIX_H

#include "base/arena.h"
#include "base/recall.h"
#include "engine/stepper.h"

enum matrix_form { MATRIX_NONE, MATRIX_CHOLESKY, MATRIX_LU, MATRIX_DIRECT };

struct live {
    int column, from, to;
};

struct matrix {
    const struct ode2 *ode;
    struct arena *life;
    struct effort *effort;
    enum matrix_form form;
    int structured;    /* the owner's solver works here */
    double *J, *K, *C; /* [n x n]; K and C as they are in J; NULL as long as the owner's solver serves */
    double *spare;     /* [n x n], as J: what it was before it was factored */
    int *swap;         /* [n] */
    int nlive;         /* columns of K and C that are not zero, as far as known, and their rows that are not */
    struct live *live; /* [n] */
    void *F;           /* the owner's factor */
};

/* *A [rows x columns], where it is not there yet: what only dense algebra reads is taken when it first serves, for n x n
 * is most of the memory of a large model and none of its work.  E_LIMIT: there is not so much. */
enum status matrix_need(double **A, int rows, int columns, struct arena *life, double t, struct trouble *why);

void matrix_open(struct matrix *m, const struct ode2 *ode, struct effort *effort, struct arena *life);
/* Forms and factors J at x, right after resid(ALL) there if x has an a. */
enum status matrix_factor(struct matrix *m, double cc, double ck, const struct instant *x, struct trouble *why);
/* The matrix as it was factored.  E_LIMIT as matrix_need(). */
enum status matrix_recall(struct matrix *m, struct recall *r);
/* x := J^-1 x. */
void matrix_solve(const struct matrix *m, double *x);
/* B := J^-1, as a dense one, [ld x n] with zeros behind its n rows. */
void matrix_inverse(const struct matrix *m, double *B, int ld);
/* x := h (K v + C a), what forces change by in a step h of velocity v: nothing where `nlive` is 0. */
void matrix_push(const struct matrix *m, double *x, double h, const double *v, const double *a);

/* Factors any J [n x n] in place: Cholesky where it is symmetric and positive, LU else; spare [n x n] keeps what it was.
 * Returns -1 or the column without a pivot. */
int factor_dense(double *J, int *swap, double *spare, enum matrix_form *form, int n);
void form_recall(enum matrix_form *form, struct recall *r);
void solve_dense(const double *J, const int *swap, enum matrix_form form, double *x, int n);

#endif
