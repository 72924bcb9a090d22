/* augmented.h -- the augmented system (2-3) in absolute coordinates, solved densely: M a + J' lambda = Q, J a = -C''.
 *
 * The includer has MOST, the most unknowns, and the rows J and C'' of its own formulation. */
#ifndef FMDSUB_TESTS_AUGMENTED_H
#define FMDSUB_TESTS_AUGMENTED_H

#include <math.h>
#include <string.h>

#include "model/model.h"
#include "unit/trees.h"

/* A body: centre, body to world by column, velocities. */
struct place {
    double r[3], R[9], v[3], w[3];
};

static double S[MOST][MOST + 1];

static inline void cross(double *o, const double *a, const double *b)
{
    o[0] = a[1] * b[2] - a[2] * b[1], o[1] = a[2] * b[0] - a[0] * b[2], o[2] = a[0] * b[1] - a[1] * b[0];
}

/* S x = last column with full pivoting; what is left over must vanish. */
static inline double solve(double *x, int *found, int n)
{
    int col[MOST], rank = 0;
    double top = 0, left = 0;
    for (int j = 0; j < n; j++) col[j] = j, x[j] = 0;
    for (; rank < n; rank++) {
        int pi = rank, pj = rank;
        for (int i = rank; i < n; i++)
            for (int j = rank; j < n; j++)
                if (fabs(S[i][col[j]]) > fabs(S[pi][col[pj]])) pi = i, pj = j;
        double pivot = fabs(S[pi][col[pj]]);
        if (rank == 0) top = pivot;
        if (pivot < 1e-9 * top) break;
        int c = col[rank];
        col[rank] = col[pj], col[pj] = c;
        for (int j = 0; j <= n; j++) {
            double y = S[pi][j];
            S[pi][j] = S[rank][j], S[rank][j] = y;
        }
        for (int i = rank + 1; i < n; i++) {
            double f = S[i][col[rank]] / S[rank][col[rank]];
            for (int j = 0; f != 0 && j <= n; j++) S[i][j] -= f * S[rank][j];
        }
    }
    *found = rank;
    for (int i = rank; i < n; i++) left = fmax(left, fabs(S[i][n]));
    for (int i = rank - 1; i >= 0; i--) {
        double sum = S[i][n];
        for (int j = i + 1; j < rank; j++) sum -= S[i][col[j]] * x[col[j]];
        x[col[i]] = sum / S[i][col[i]];
    }
    return left;
}

/* Tensor about the centre in world axes. */
static inline void tensor(double *I, const struct model_body *b, const double *R)
{
    const double *t = b->inertia, T[9] = {t[0], t[3], t[4], t[3], t[1], t[5], t[4], t[5], t[2]};
    double RT[9], Rt[9];
    tree_mm(RT, R, T);
    for (int i = 0; i < 9; i++) Rt[i] = R[i % 3 * 3 + i / 3];
    tree_mm(I, RT, Rt);
}

/* w x I w */
static inline void gyroscopic(double *n, const double *I, const double *w)
{
    double L[3];
    tree_mv(L, I, w);
    cross(n, w, L);
}

static inline void put_body(const struct model *m, int b, const struct place *p, int n)
{
    double I[9], gyro[3];
    const int at = 6 * (b - 1);
    tensor(I, &m->body[b], p->R);
    gyroscopic(gyro, I, p->w);
    for (int i = 0; i < 3; i++) {
        S[at + i][at + i] = m->body[b].mass;
        S[at + i][n] = m->body[b].mass * m->gravity[i];
        S[at + 3 + i][n] = -gyro[i];
        for (int j = 0; j < 3; j++) S[at + 3 + i][at + 3 + j] = I[i + 3 * j];
    }
}

/* x: accelerations of body b (from 1) at 6 (b - 1), of the centre and angular, then multipliers; C2: C'' at a = 0. */
static inline double augmented_solve(double *x, const struct model *m, const struct place *p, double (*J)[MOST],
                                     const double *C2, int rows)
{
    const int nb = 6 * (m->nbody - 1), n = nb + rows;
    memset(S, 0, sizeof S);
    for (int i = 0; i < rows; i++) {
        for (int k = 0; k < nb; k++) S[nb + i][k] = S[k][nb + i] = J[i][k];
        S[nb + i][n] = -C2[i];
    }
    for (int b = 1; b < m->nbody; b++) put_body(m, b, &p[b], n);
    for (int k = 0; m->space == 2 && k < nb; k++) /* out of the plane: nothing moves */
        if (k % 6 == 2 || k % 6 == 3 || k % 6 == 4) {
            for (int i = 0; i < n; i++) S[k][i] = S[i][k] = 0;
            S[k][k] = 1;
            S[k][n] = 0;
        }
    int rank;
    return solve(x, &rank, n);
}

#endif
