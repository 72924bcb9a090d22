/* matrix.h -- the iteration matrix J = M^ + cc C + ck K of implicit schemes, factored and kept. */
#ifndef FMDSUB_ENGINE_MATRIX_H
#define FMDSUB_ENGINE_MATRIX_H

#include "base/arena.h"
#include "engine/stepper.h"

enum matrix_form { MATRIX_NONE, MATRIX_CHOLESKY, MATRIX_LU, MATRIX_DIRECT };

struct matrix {
    const struct ode2 *ode;
    struct effort *effort;
    enum matrix_form form;
    int structured;    /* the owner's solver works here */
    double *J, *K, *C; /* [n x n] */
    int *swap;         /* [n] */
    void *F;           /* the owner's factor */
};

void matrix_open(struct matrix *m, const struct ode2 *ode, struct effort *effort, struct arena *life);
/* Forms and factors J at x. */
enum status matrix_factor(struct matrix *m, double cc, double ck, const struct instant *x, struct trouble *why);
/* x := J^-1 x. */
void matrix_solve(const struct matrix *m, double *x);

/* Factors any J [n x n] in place: Cholesky where it is symmetric and positive, LU else; spare [n x n].
 * Returns -1 or the column without a pivot. */
int factor_dense(double *J, int *swap, double *spare, enum matrix_form *form, int n);
void solve_dense(const double *J, const int *swap, enum matrix_form form, double *x, int n);

#endif
