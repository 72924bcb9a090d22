/* sparse.h -- a symmetric sparse matrix, by rows, both triangles stored. */
#ifndef FMDSUB_REDUCE_SPARSE_H
#define FMDSUB_REDUCE_SPARSE_H

#include "reduce/text.h"

struct sparse {
    int n;
    size_t *row; /* [n + 1] where rows start */
    int *col;    /* [row[n]] ascending in a row */
    double *v;
};

/* Entries as a file gives them. */
struct triplets {
    int n; /* rows and columns */
    int count, capacity;
    int *i, *j; /* [count] from 0 */
    double *v;
    int *line; /* where each stands */
    bool half; /* only one of (i,j), (j,i) is given; false: both are, and must agree */
};

/* text: where the entries stand, for messages.  An entry given twice, or two that disagree, is refused. */
enum status sparse_build(struct sparse *o, const struct triplets *from, struct text *text, struct arena *life);

/* y = A x. */
void sparse_mul(double *y, const struct sparse *A, const double *x);
/* Place of (i,j); NULL: zero. */
double *sparse_at(const struct sparse *A, int i, int j);

#endif
