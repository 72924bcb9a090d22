/* matrix.h -- matrices from files, rows put in the body's order */
#ifndef FMDSUB_REDUCE_MATRIX_H
#define FMDSUB_REDUCE_MATRIX_H

#include "reduce/sparse.h"

/* What row i of the file is. */
struct matrix_rows {
    int n;
    const int *to; /* [n] row of the result */
    int size;      /* rows of the result */
    double scale;  /* values are multiplied by it */
};

/* Lines `i j value`, one triangle (CalculiX .sti, .mas). */
enum status matrix_read_triples(struct sparse *o, const char *path, const struct matrix_rows *rows, struct arena *life,
                                struct report *report);
/* Matrix Market coordinate, real or integer, symmetric or general (Boisvert, Pozo & Remington, NISTIR 5935, 1996). */
enum status matrix_read_market(struct sparse *o, const char *path, const struct matrix_rows *rows, struct arena *life,
                               struct report *report);

#endif
