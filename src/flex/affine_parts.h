/* affine_parts.h -- what affine.c and affine_slopes.c share: the tables, and a vector's acceleration. */
#ifndef FMDSUB_FLEX_AFFINE_PARTS_H
#define FMDSUB_FLEX_AFFINE_PARTS_H

#include "flex/affine.h"
#include "la/sift.h"
#include "la/vec3.h"

struct affine {
    const struct flex_body *body;
    int n, na;               /* coordinates, vectors c_a */
    double root;             /* of the mass */
    double weight[4][3];     /* c_a = int p (x . weight_a) dm, a > 0 */
    double c[4][3], J[6];    /* undeformed; J^ = rot */
    int rows, fixed;         /* rows of base, and of these the first that do not change: without s */
    double *base;            /* [rows]: dc_a/dq [3 x n] each, dJ^/dq [6 x n], G^ [3 x n] of the undeformed body */
    double *change;          /* [rows - fixed, by n] its rate with q */
    int nfast;               /* 3 n, with s and xs more */
    double *fast;            /* [nfast by n]: 2 Y, d2c_a/dq2 */
    double *second;          /* [n x 3, by a and j] the rows of `change` of c_a by component; NULL: fixed */
    double *Me;              /* [n x n] M^ */
    struct sift by_q, by_q1; /* change, fast */
};

/* o [m] += A x, A [m x n] of so few rows that they stay in registers. */
static inline void add3(double *o, const double *A, const double *x, int n)
{
    double s0 = o[0], s1 = o[1], s2 = o[2];
    for (int j = 0; j < n; j++, A += 3) {
        s0 += x[j] * A[0];
        s1 += x[j] * A[1];
        s2 += x[j] * A[2];
    }
    v3_set(o, s0, s1, s2);
}

static inline void add6(double *o, const double *A, const double *x, int n)
{
    double sum[6] = {0};
    for (int j = 0; j < n; j++)
        for (int i = 0; i < 6; i++) sum[i] += x[j] * A[6 * j + i];
    for (int i = 0; i < 6; i++) o[i] += sum[i];
}

/* The acceleration of vector a, [sqrt(m) a0] + w' x c + w x (w x c) + 2 w x c' + c''; work is that of q1. */
static inline void affine_vector(double *g, const struct affine *k, const struct affine_shape *o, int a,
                                 const double *a0, const double *w, const double *al, const double *q1,
                                 const double *q2)
{
    const int n = k->n;
    const double *c = o->c[a], *C = o->C + 3 * n * a;
    double v[3] = {0, 0, 0}, x[3];
    v3_set(g, 0, 0, 0);
    if (a == 0) v3_axpy(g, k->root, a0);
    v3_cross_add(g, al, c);
    v3_cross(x, w, c);
    if (q1) {
        add3(v, C, q1, n);
        v3_axpy(x, 2, v);
    }
    v3_cross_add(g, w, x);
    if (q1 && !k->fixed) add3(g, o->work + 3 * n * (a + 1), q1, n);
    if (q2) add3(g, C, q2, n);
}

#endif
