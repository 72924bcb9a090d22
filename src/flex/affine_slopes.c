/* affine_slopes.c -- how the inertia of affine.h changes with the coordinates and their rates, the motion of the frame
 * given.
 *
 * The tables are quadratic in q, so that the slopes of the c_a and of J^, G^ change at constant rates, S_a kj =
 * d2c_a/dq_k dq_j and so on.  From g_a of affine.h and Q, N there
 *
 *     dg_a/dq_j = w' x C_j + w x (w x C_j + 2 (S q')_j) + (S q'')_j,    dg_a/dq'_j = 2 w x C_j + 2 (S q')_j
 *     dQ_k/dq_j = sum S_kj . g_a + C_k . dg_a/dq_j + dG^_k/dq_j . w' - 1/2 w . d2J^/dq_k dq_j w
 *     dQ_k/dq'_j = sum C_k . dg_a/dq'_j + 2 w . Y_kj
 *     dN/dq_j = sum C_j x g_a + c_a x dg_a/dq_j + dJ^_j w' + w x dJ^_j w + (dJ^_j)' w + dG^/dq_j q'' + w x dG^/dq_j q'
 *     dN/dq'_j = sum c_a x dg_a/dq'_j + dJ^_j w + w x G^_j,
 *
 * C = dc_a/dq, dJ^_j = dJ^/dq_j. */
#include <string.h>

#include "flex/affine_parts.h"
#include "la/dense.h"
#include "la/wide.h"

/* Rates with q_j of all that changes, by its place in the rows. */
static const double *rates_with(const struct affine *k, int j)
{
    return k->change + (long)(k->rows - k->fixed) * j - k->fixed;
}

/* From p to vector a, as far as forces have moments. */
static void lever(double *o, const struct affine *k, const struct affine_shape *shape, int a, const double *p)
{
    v3_copy(o, shape->c[a]);
    if (a == 0) v3_axpy(o, -k->root, p);
}

/* Column j of K += C gK_j + S_j g and of C += C gC_j, C and S_j [n x 3] by component, S NULL: zero. */
WIDE static void columns(double *restrict K, double *restrict C, const double *restrict dc, const double *restrict S,
                         const double *restrict gK, const double *restrict gC, const double *restrict g, int n)
{
    const double *restrict dy = dc + n, *restrict dz = dy + n;
    for (int j = 0; j < n; j++, K += n, C += n, gK += 3, gC += 3) {
        const double kx = gK[0], ky = gK[1], kz = gK[2], cx = gC[0], cy = gC[1], cz = gC[2];
        for (int i = 0; i < n; i++) C[i] += dc[i] * cx + dy[i] * cy + dz[i] * cz;
        if (!S) {
            for (int i = 0; i < n; i++) K[i] += dc[i] * kx + dy[i] * ky + dz[i] * kz;
            continue;
        }
        const double *restrict Sx = S + 3L * n * j, *restrict Sy = Sx + n, *restrict Sz = Sy + n;
        const double gx = g[0], gy = g[1], gz = g[2];
        for (int i = 0; i < n; i++)
            K[i] += (dc[i] * kx + dy[i] * ky + dz[i] * kz) + (Sx[i] * gx + Sy[i] * gy + Sz[i] * gz);
    }
}

static void particle(double *K, double *C, double *mK, double *mC, const struct affine *k, const struct affine_shape *o,
                     int a, const double *arm, const double *g, const double *w, const double *al)
{
    const int n = k->n;
    const double *dc = o->C + 3 * n * a, *S1 = o->work + 3 * n * (a + 1), *S2 = o->later + 3 * n * (a + 1);
    const bool second = !k->fixed;
    double *by = o->aside, *gK = by + 3 * n, *gC = gK + 3 * n;
    for (int j = 0; j < n; j++, gK += 3, gC += 3) {
        double x[3];
        for (int c = 0; c < 3; c++) by[j + n * c] = dc[3 * j + c];
        v3_cross(x, w, dc + 3 * j);
        v3_scale(gC, 2, x);
        if (second) v3_axpy(gC, 2, S1 + 3 * j);
        if (second) v3_axpy(x, 2, S1 + 3 * j);
        v3_cross(gK, w, x);
        v3_cross_add(gK, al, dc + 3 * j);
        if (second) v3_add(gK, S2 + 3 * j);
        v3_cross_add(mK + 3 * j, dc + 3 * j, g);
        v3_cross_add(mK + 3 * j, arm, gK);
        v3_cross_add(mC + 3 * j, arm, gC);
    }
    columns(K, C, by, second ? k->second + 3L * n * n * a : NULL, by + 3 * n, by + 6 * n, g, n);
}

static double form(const double *J, const double *ww)
{
    return J[0] * ww[0] + J[1] * ww[1] + J[2] * ww[2] + J[3] * ww[3] + J[4] * ww[4] + J[5] * ww[5];
}

static void rest(double *K, double *C, double *mK, double *mC, const struct affine *k, const struct affine_shape *o,
                 const double *w, const double *al, const double *q1, const double *q2)
{
    const int n = k->n;
    const double ww[6] = {.5 * w[0] * w[0], .5 * w[1] * w[1], .5 * w[2] * w[2], w[0] * w[1], w[0] * w[2], w[1] * w[2]};
    for (int j = 0; j < n; j++) {
        const double *ddJ = rates_with(k, j) + k->rows - 9 * n, *dG = rates_with(k, j) + k->rows - 3 * n;
        const double *Y = k->fast + (long)k->nfast * j, *dJ = o->dJ + 6 * j;
        double J1[6] = {0}, x[3];
        for (int i = 0; i < n; i++) {
            K[i + n * j] += v3_dot(dG + 3 * i, al) - form(ddJ + 6 * i, ww);
            C[i + n * j] += v3_dot(w, Y + 3 * i);
        }
        add6(J1, ddJ, q1, n);
        s3_mul(x, J1, w);
        v3_add(mK + 3 * j, x);
        s3_mul(x, dJ, al);
        v3_add(mK + 3 * j, x);
        add3(mK + 3 * j, dG, q2, n);
        s3_mul(x, dJ, w);
        v3_add(mC + 3 * j, x);
        add3(x, dG, q1, n);
        v3_cross_add(mK + 3 * j, w, x);
        v3_cross_add(mC + 3 * j, w, o->rest + 3 * j);
    }
}

void affine_slopes(double *K, double *C, double *mK, double *mC, const struct affine *k,
                   const struct affine_shape *shape, const double *p, const double *a, const double *w,
                   const double *al, const double *q1, const double *q2)
{
    double arm[3], g[3];
    sift_times(shape->work, &k->by_q1, q1);
    sift_times(shape->later, &k->by_q1, q2);
    memset(mK, 0, sizeof *mK * 3 * (size_t)k->n);
    memset(mC, 0, sizeof *mC * 3 * (size_t)k->n);
    for (int i = 0; i < k->na; i++) {
        affine_vector(g, k, shape, i, a, w, al, q1, q2);
        lever(arm, k, shape, i, p);
        particle(K, C, mK, mC, k, shape, i, arm, g, w, al);
    }
    rest(K, C, mK, mC, k, shape, w, al, q1, q2);
}

void affine_along(double *Q, double *m, const struct affine *k, const struct affine_shape *shape, const double *p,
                  const double *da, const double *dw, const double *dal, const double *w, const double *q1)
{
    const int n = k->n;
    double L[3], dL[3], J1[6] = {0}, x[3];
    s3_mul(L, shape->Jrest, w);
    add3(L, shape->rest, q1, n);
    s3_mul(dL, shape->Jrest, dw);
    add6(J1, shape->dJ, q1, n);
    s3_mul(m, J1, dw);
    s3_mul(x, shape->Jrest, dal);
    v3_add(m, x);
    v3_cross_add(m, dw, L);
    v3_cross_add(m, w, dL);
    for (int j = 0; j < n; j++) {
        s3_mul(x, shape->dJ + 6 * j, w);
        Q[j] = v3_dot(shape->rest + 3 * j, dal) - v3_dot(x, dw) + v3_dot(dw, shape->work + 3 * j);
    }
    for (int i = 0; i < k->na; i++) {
        const double *c = shape->c[i], *dc = shape->C + 3 * n * i;
        double v[3], g[3] = {0, 0, 0};
        v3_cross(v, w, c);
        add3(v, dc, q1, n);
        add3(v, dc, q1, n);
        v3_cross_add(g, dw, v);
        v3_cross(v, dw, c);
        v3_cross_add(g, w, v);
        v3_cross_add(g, dal, c);
        if (i == 0) v3_axpy(g, k->root, da);
        lever(v, k, shape, i, p);
        v3_cross_add(m, v, g);
        for (int j = 0; j < n; j++) Q[j] += v3_dot(dc + 3 * j, g);
    }
}
