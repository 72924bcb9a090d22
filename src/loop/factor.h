/* factor.h -- C_qd of a component, factored: C_qd = P L U.
 *
 * A is banded: rows and dependent columns go from loop to loop.  What follows speaks of C_q = [C_qd C_qi] as it was
 * when C_qd was factored. */
#ifndef FMDSUB_LOOP_FACTOR_H
#define FMDSUB_LOOP_FACTOR_H

#include "la/pivot.h"
#include "loop/split.h"

/* Memory for what has another size after a new split; it grows where that is needed. */
struct store {
    double *x;
    size_t size;
};
double *store_for(struct store *o, size_t size, struct arena *life);

struct factor {
    const struct part *part;
    double *F; /* C_q, as in struct component */
    double *A; /* A(i,j) = A[i + j ld] inside the band */
    int *swap; /* [nr] */
    struct store store;
};

void factor_build(struct factor *o, const struct part *p, double *F, struct arena *life);
/* Room for the part's split as it is now. */
void factor_fit(struct factor *o, struct arena *life);

/* 0: singular or not finite. */
int factor_make(struct factor *o);
void factor_copy(struct factor *to, const struct factor *from);
/* Least over largest pivot; size: the scales of the tree's coordinates. */
double factor_ratio(const struct factor *o, const double *size);
/* The place in v of the dependent coordinate whose pivot is the least. */
int factor_weakest(const struct factor *o, const double *size);

/* x [nr] -= C_qi of the independent numbers of xt */
void factor_take(const struct factor *o, double *restrict x, const double *restrict xt);
/* r [all independents] += C_qi' x */
void factor_give(const struct factor *o, double *restrict r, const double *restrict x);
/* x [nr] := C_qd^-1 x, C_qd^-T x */
static inline void factor_solve(const struct factor *o, double *x)
{
    pivot_rows_solve(o->A, o->swap, o->part->band, x, o->part->nr, o->part->ld);
}

static inline void factor_tsolve(const struct factor *o, double *x)
{
    pivot_rows_tsolve(o->A, o->swap, o->part->band, x, o->part->nr, o->part->ld);
}

/* G [nr x ni] = -C_qd^-1 C_qi; y [nr] := G x; z [ni] := row `row` of G, y [nr] work */
void factor_G(const struct factor *o, double *G);
void factor_times_G(const struct factor *o, double *y, const double *x);
void factor_row_of_G(const struct factor *o, double *z, double *y, int row);

#endif
