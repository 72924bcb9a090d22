/* affine.c -- see affine.h
 *
 * All that is linear in q stands in one table, base + change q with a column for each coordinate: the slopes of the
 * c_a, dJ^/dq and G^; so a shape costs one product.  In the same way `fast` holds what is multiplied by q': twice
 * Y_kj = int phi^_k x phi^_j dm, antisymmetric, and the second slopes of the c_a.
 *
 *     G^_j = rpsi_j + Y_kj q_k,     G^' q' = 0,
 *
 * and from (dG^_j/dq_k - dG^_k/dq_j) q_k' = 2 Y_kj q_k' comes the gyroscopic term of Q.  The c_a are quadratic and J^
 * is without a linear term, so that the mean of their slopes at 0 and q takes them there. */
#include "flex/affine.h"

#include <math.h>
#include <string.h>

#include "flex/affine_parts.h"
#include "la/dense.h"
#include "la/eigen.h"

static const double THIN = 1e-12; /* of the largest principal moment: no extension */

/* --- tables ------------------------------------------------------------------------------------- */

/* o += s (int a x b) for B = int a b'. */
static void add_axial(double *o, double s, const double *B)
{
    o[0] += s * (B[7] - B[5]);
    o[1] += s * (B[2] - B[6]);
    o[2] += s * (B[3] - B[1]);
}

/* J += s (tr B 1 - sym B) in six numbers. */
static void add_inertia(double *J, double s, const double *B)
{
    J[0] += s * (B[4] + B[8]);
    J[1] += s * (B[0] + B[8]);
    J[2] += s * (B[0] + B[4]);
    J[3] -= .5 * s * (B[1] + B[3]);
    J[4] -= .5 * s * (B[2] + B[6]);
    J[5] -= .5 * s * (B[5] + B[7]);
}

/* Principal axes of xx, those along which the body extends. */
static void axes(struct affine *k)
{
    double xx[9], X[9], lambda[3];
    memcpy(xx, k->body->xx, sizeof xx);
    eigen_symmetric(lambda, X, xx, 3);
    k->root = sqrt(k->body->mass);
    k->na = 1;
    for (int i = 2; i >= 0; i--) {
        if (!(lambda[i] > THIN * lambda[2])) continue;
        v3_scale(k->weight[k->na], 1 / sqrt(lambda[i]), X + 3 * i);
        v3_scale(k->c[k->na++], sqrt(lambda[i]), X + 3 * i);
    }
}

/* The part of vector a in a field with the first moments one = int phi dm and x = int x phi' dm. */
static void moment(double *o, const struct affine *k, int a, const double *one, const double *x)
{
    if (a)
        m3_tmul(o, x, k->weight[a]);
    else
        v3_scale(o, 1 / k->root, one);
}

static void undeformed(struct affine *k)
{
    const struct flex_body *o = k->body;
    const int n = k->n;
    const double rot[6] = {o->rot[0], o->rot[4], o->rot[8], o->rot[3], o->rot[6], o->rot[7]};
    memcpy(k->J, rot, sizeof k->J);
    for (int j = 0; j < n; j++) {
        for (int a = 0; a < k->na; a++) moment(k->base + 3 * (j + n * a), k, a, o->f + 3 * j, o->xf + 9 * j);
        v3_copy(k->base + k->rows - 3 * n + 3 * j, o->rpsi + 3 * j);
    }
}

/* The pair of coordinates j and k. */
static void fill_pair(struct affine *o, int j, int k)
{
    const struct flex_body *b = o->body;
    const int n = o->n, jk = j + n * k, rows = o->rows - o->fixed;
    double *change = o->change + (long)rows * k - o->fixed, *fast = o->fast + (long)o->nfast * k, rest[9];
    double *J = change + o->rows - 9 * n + 6 * j, *G = change + o->rows - 3 * n + 3 * j;
    for (int i = 0; i < 9; i++) rest[i] = .5 * (b->ff[i + 9 * jk] + b->ff[i / 3 + 3 * (i % 3) + 9 * (k + n * j)]);
    for (int a = 0; a < o->na; a++)
        for (int i = 0; i < 9; i++) rest[i] -= o->base[3 * (j + n * a) + i % 3] * o->base[3 * (k + n * a) + i / 3];
    add_inertia(J, 2, rest);
    add_axial(G, -1, rest);
    add_axial(fast + 3 * j, -2, rest);
    o->Me[jk] = rest[0] + rest[4] + rest[8] + .5 * (b->ppsi[jk] + b->ppsi[k + n * j]);
    if (o->fixed) return;
    for (int a = 0; a < o->na; a++) {
        double *s = change + 3 * (j + n * a);
        moment(s, o, a, b->s + 3 * jk, b->xs + 9 * jk);
        v3_copy(fast + 3 * (j + n * (a + 1)), s);
    }
}

static void by_component(struct affine *k, struct arena *life)
{
    const int n = k->n;
    if (k->fixed) return;
    double *to = k->second = TAKE(life, double, (long)k->na * 3 * n * n);
    for (int a = 0; a < k->na; a++)
        for (int j = 0; j < n; j++)
            for (int c = 0; c < 3; c++)
                for (int i = 0; i < n; i++) *to++ = k->change[3 * (i + n * a) + c + (long)k->rows * j];
}

struct affine *affine_build(const struct flex_body *o, struct arena *life)
{
    struct affine *k = TAKE(life, struct affine, 1);
    const int n = o->n;
    *k = (struct affine){.body = o, .n = n};
    axes(k);
    k->rows = (9 + 3 * k->na) * n;
    k->fixed = o->s ? 0 : 3 * k->na * n;
    k->nfast = o->s ? 3 * (1 + k->na) * n : 3 * n;
    k->base = TAKE(life, double, k->rows);
    k->change = TAKE(life, double, (long)(k->rows - k->fixed) * n);
    k->fast = TAKE(life, double, (long)k->nfast *n);
    k->Me = TAKE(life, double, n *n);
    undeformed(k);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) fill_pair(k, i, j);
    by_component(k, life);
    sift_build(&k->by_q, k->change, k->base + k->fixed, k->rows - k->fixed, n, life);
    sift_build(&k->by_q1, k->fast, NULL, k->nfast, n, life);
    return k;
}

/* --- shape -------------------------------------------------------------------------------------- */

void affine_take(struct affine_shape *o, const struct affine *k, struct arena *life)
{
    double *all = TAKE(life, double, k->rows);
    *o = (struct affine_shape){.C = all, .dJ = all + k->rows - 9 * k->n, .rest = all + k->rows - 3 * k->n};
    o->work = TAKE(life, double, k->nfast);
    o->later = TAKE(life, double, k->nfast);
    o->aside = TAKE(life, double, 9 * k->n);
    memcpy(all, k->base, sizeof *all * (size_t)k->rows);
}

void affine_at(struct affine_shape *o, const struct affine *k, const double *q)
{
    const int n = k->n;
    double J[6] = {0};
    sift_at(o->C + k->fixed, &k->by_q, q);
    add6(J, o->dJ, q, n);
    for (int i = 0; i < 6; i++) o->J[i] = o->Jrest[i] = k->J[i] + .5 * J[i];
    for (int a = 0; a < k->na; a++) {
        const double *C = o->C + 3 * n * a;
        double *c = o->c[a], d[3] = {0};
        add3(d, k->base + 3 * n * a, q, n);
        add3(d, C, q, n);
        v3_copy(c, k->c[a]);
        v3_axpy(c, .5, d);
        const double cc[9] = {c[0] * c[0], 0, 0, c[0] * c[1], c[1] * c[1], 0, c[0] * c[2], c[1] * c[2], c[2] * c[2]};
        add_inertia(o->J, 1, (double[]){cc[0], cc[3], cc[6], cc[3], cc[4], cc[7], cc[6], cc[7], cc[8]});
    }
    v3_scale(o->h, k->root, o->c[0]);
}

void affine_mass_column(double *M, double *H, double *G, const struct affine *k, const struct affine_shape *o, int j)
{
    const int n = k->n;
    v3_copy(G, o->rest + 3 * j);
    for (int a = 0; a < k->na; a++) v3_cross_add(G, o->c[a], o->C + 3 * (j + n * a));
    v3_scale(H, k->root, o->C + 3 * j);
    for (int i = 0; i <= j; i++) {
        M[i] = k->Me[i + n * j];
        for (int a = 0; a < k->na; a++) M[i] += v3_dot(o->C + 3 * (i + n * a), o->C + 3 * (j + n * a));
    }
}

/* --- inertia ------------------------------------------------------------------------------------ */

/* Vector a, a particle of mass 1: what its acceleration takes. */
static void particle(double *F, double *N, double *Q, const struct affine *k, const struct affine_shape *o, int a,
                     const double *a0, const double *w, const double *al, const double *q1, const double *q2)
{
    const int n = k->n;
    const double *c = o->c[a], *C = o->C + 3 * n * a;
    double g[3];
    affine_vector(g, k, o, a, a0, w, al, q1, q2);
    if (a == 0) v3_scale(F, k->root, g);
    v3_cross_add(N, c, g);
    for (int j = 0; j < n; j++) Q[j] += v3_dot(C + 3 * j, g);
}

/* The rest: J^ w' + w x J^ w + J^' w + G^ q'' + w x G^ q',  G^T w' + M^ q'' + 2 w . Y q' - 1/2 w . dJ^/dq w. */
static void rest(double *N, double *Q, const struct affine *k, const struct affine_shape *o, const double *w,
                 const double *al, const double *q1, const double *q2)
{
    const int n = k->n;
    const double ww[6] = {.5 * w[0] * w[0], .5 * w[1] * w[1], .5 * w[2] * w[2], w[0] * w[1], w[0] * w[2], w[1] * w[2]};
    double L[3], J1[6] = {0}, J1w[3];
    s3_mul(N, o->Jrest, al);
    s3_mul(L, o->Jrest, w);
    if (q1) {
        add3(L, o->rest, q1, n);
        add6(J1, o->dJ, q1, n);
        s3_mul(J1w, J1, w);
        v3_add(N, J1w);
    }
    v3_cross_add(N, w, L);
    if (q2) add3(N, o->rest, q2, n);
    for (int j = 0; j < n; j++) {
        const double *dJ = o->dJ + 6 * j;
        Q[j] = v3_dot(o->rest + 3 * j, al) -
               (dJ[0] * ww[0] + dJ[1] * ww[1] + dJ[2] * ww[2] + dJ[3] * ww[3] + dJ[4] * ww[4] + dJ[5] * ww[5]);
        if (q1) Q[j] += v3_dot(w, o->work + 3 * j);
    }
    if (q2) dense_gemv(Q, 1, k->Me, q2, n, n, n);
}

void affine_inertia(double *F, double *N, double *Q, const struct affine *k, const struct affine_shape *shape,
                    const double *a, const double *w, const double *al, const double *q1, const double *q2)
{
    if (q1) sift_times(shape->work, &k->by_q1, q1);
    rest(N, Q, k, shape, w, al, q1, q2);
    for (int i = 0; i < k->na; i++) particle(F, N, Q, k, shape, i, a, w, al, q1, q2);
}

/* --- momentum and energy ------------------------------------------------------------------------ */

/* Velocity of vector a. */
static void moves(double *u, const struct affine *k, const struct affine_shape *o, int a, const double *v,
                  const double *w, const double *q1)
{
    v3_scale(u, a ? 0 : k->root, v);
    v3_cross_add(u, w, o->c[a]);
    add3(u, o->C + 3 * k->n * a, q1, k->n);
}

/* x'A x. */
static double square(const double *A, const double *x, int n)
{
    double sum = 0;
    for (int j = 0; j < n; j++) {
        double Ax = 0;
        for (int i = 0; i < n; i++) Ax += A[i + n * j] * x[i];
        sum += Ax * x[j];
    }
    return sum;
}

void affine_momentum(double *P, double *L, double *T, const struct affine *k, const struct affine_shape *o,
                     const double *v, const double *w, const double *q1)
{
    double rest[3] = {0, 0, 0}, sum = 0;
    s3_mul(L, o->Jrest, w);
    add3(rest, o->rest, q1, k->n);
    if (T) sum = v3_dot(w, L) + 2 * v3_dot(w, rest) + square(k->Me, q1, k->n);
    v3_add(L, rest);
    for (int a = 0; a < k->na; a++) {
        double u[3];
        moves(u, k, o, a, v, w, q1);
        if (a == 0) v3_scale(P, k->root, u);
        v3_cross_add(L, o->c[a], u);
        sum += v3_dot(u, u);
    }
    if (T) *T = .5 * sum;
}
