/* motion.c -- see motion.h
 *
 * All that is linear in q stands in one table, [H; dJ/dq; G] = base + change q with a column for each coordinate, so
 * that a shape costs one product.  In the same way `fast` holds what is multiplied by q'.  With Y_kj = int phi_k x
 * phi_j dm, antisymmetric, and Z_kj = int x x S_kj dm, symmetric,
 *
 *     G_j = int x x phi_j dm + rpsi_j + (Y_kj + Z_kj) q_k,      G' q' = q' Z q'  (Y cancels in the sum),
 *
 * and from (dG_j/dq_k - dG_k/dq_j) q_k' = 2 Y_kj q_k' comes the gyroscopic term of Q.  h and J are quadratic, so the
 * mean of their slopes at 0 and q takes them there:
 *
 *     h = (f + H) q / 2,     J = J(0) + (dJ/dq(0) + dJ/dq) q / 2.
 */
#include "flex/motion.h"

#include <string.h>

#include "la/dense.h"
#include "la/vec3.h"

struct flex_kernel {
    const struct flex_body *body;
    int n;
    double J[6];    /* undeformed */
    int fixed;      /* rows of base that do not change: those of H where there is no s */
    double *base;   /* [12 n]: H [3 x n], dJ/dq [6 x n], G [3 x n] of the undeformed body */
    double *change; /* [12 n - fixed, by n] its rate with q */
    int nfast;      /* 3 n, or 9 n with s and xs */
    double *fast;   /* [nfast by n]: 2 Y, s, Z */
    double *Me;     /* [n x n] */
};

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

static void undeformed(struct flex_kernel *k, const struct flex_body *o)
{
    const int n = k->n;
    const double rot[6] = {o->rot[0], o->rot[4], o->rot[8], o->rot[3], o->rot[6], o->rot[7]};
    memcpy(k->J, rot, sizeof k->J);
    add_inertia(k->J, 1, o->xx);
    memcpy(k->base, o->f, sizeof *o->f * 3 * (size_t)n);
    for (int j = 0; j < n; j++) {
        double *G = k->base + 9 * n + 3 * j;
        add_inertia(k->base + 3 * n + 6 * j, 2, o->xf + 9 * j);
        v3_copy(G, o->rpsi + 3 * j);
        add_axial(G, 1, o->xf + 9 * j);
    }
}

/* The pair of coordinates j and k. */
static void fill_pair(struct flex_kernel *o, int j, int k)
{
    const struct flex_body *b = o->body;
    const int n = o->n, jk = j + n * k;
    double *change = o->change + (12 * n - o->fixed) * k - o->fixed, *fast = o->fast + o->nfast * k;
    add_inertia(change + 3 * n + 6 * j, 1, b->ff + 9 * jk);
    add_inertia(change + 3 * n + 6 * j, 1, b->ff + 9 * (k + n * j));
    add_axial(change + 9 * n + 3 * j, 1, b->ff + 9 * (k + n * j));
    add_axial(fast + 3 * j, 2, b->ff + 9 * (k + n * j));
    if (o->fixed) return;
    v3_copy(change + 3 * j, b->s + 3 * jk);
    add_inertia(change + 3 * n + 6 * j, 2, b->xs + 9 * jk);
    add_axial(change + 9 * n + 3 * j, 1, b->xs + 9 * jk);
    v3_copy(fast + 3 * n + 3 * j, b->s + 3 * jk);
    add_axial(fast + 6 * n + 3 * j, 1, b->xs + 9 * jk);
}

struct flex_kernel *flex_kernel_build(const struct flex_body *o, struct arena *life)
{
    struct flex_kernel *k = TAKE(life, struct flex_kernel, 1);
    const int n = o->n;
    *k = (struct flex_kernel){.body = o, .n = n, .fixed = o->s ? 0 : 3 * n, .nfast = o->s ? 9 * n : 3 * n};
    k->base = TAKE(life, double, 12 * n);
    k->change = TAKE(life, double, (12 * n - k->fixed) * n);
    k->fast = TAKE(life, double, k->nfast *n);
    k->Me = TAKE(life, double, n *n);
    undeformed(k, o);
    flex_mass(k->Me, o);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) fill_pair(k, i, j);
    return k;
}

const double *flex_kernel_mass(const struct flex_kernel *k)
{
    return k->Me;
}

/* --- shape -------------------------------------------------------------------------------------- */

void flex_shape_take(struct flex_shape *o, const struct flex_kernel *k, struct arena *life)
{
    double *all = TAKE(life, double, 12 * k->n);
    *o = (struct flex_shape){.H = all, .dJ = all + 3 * k->n, .G = all + 9 * k->n};
    o->work = TAKE(life, double, 9 * k->n);
    memcpy(all, k->base, sizeof *all * 12 * (size_t)k->n);
    memcpy(o->J, k->J, sizeof o->J);
}

/* o [m] += A x, A [m x n] of so few rows that they stay in registers. */
static inline void add3(double *o, const double *A, const double *x, int n)
{
    for (int j = 0; j < n; j++) v3_axpy(o, x[j], A + 3 * j);
}

static inline void add6(double *o, const double *A, const double *x, int n)
{
    double sum[6] = {0};
    for (int j = 0; j < n; j++)
        for (int i = 0; i < 6; i++) sum[i] += x[j] * A[6 * j + i];
    for (int i = 0; i < 6; i++) o[i] += sum[i];
}

void flex_shape_at(struct flex_shape *o, const struct flex_kernel *k, const double *q)
{
    const int n = k->n, m = 12 * n - k->fixed;
    double h[3] = {0}, J[6] = {0};
    memcpy(o->H + k->fixed, k->base + k->fixed, sizeof *o->H * (size_t)m);
    dense_gemv(o->H + k->fixed, 1, k->change, q, m, n, m);
    add3(h, k->base, q, n);
    add3(h, o->H, q, n);
    v3_scale(o->h, .5, h);
    add6(J, k->base + 3 * n, q, n);
    add6(J, o->dJ, q, n);
    for (int i = 0; i < 6; i++) o->J[i] = k->J[i] + .5 * J[i];
}

/* --- inertia ------------------------------------------------------------------------------------ */

/* Frame alone: m a + w' x h + w x (w x h),  h x a + J w' + w x J w. */
static void frame(double *F, double *N, double mass, const struct flex_shape *o, const double *a, const double *w,
                  const double *al)
{
    double wh[3], L[3];
    v3_scale(F, mass, a);
    v3_cross_add(F, al, o->h);
    v3_cross(wh, w, o->h);
    v3_cross_add(F, w, wh);
    s3_mul(N, o->J, al);
    v3_cross_add(N, o->h, a);
    s3_mul(L, o->J, w);
    v3_cross_add(N, w, L);
}

/* What q' adds: 2 w x h' + q' s q',  J' w + G' q' + w x G q',  2 w . Y q'. */
static void carried(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *o,
                    const double *w, const double *q1)
{
    const int n = k->n;
    double *y = o->work, h1[3] = {0}, Gq[3] = {0}, J1[6] = {0}, J1w[3];
    memset(y, 0, sizeof *y * (size_t)k->nfast);
    dense_gemv(y, 1, k->fast, q1, k->nfast, n, k->nfast);
    add3(h1, o->H, q1, n);
    v3_scale(h1, 2, h1);
    v3_cross_add(F, w, h1);
    add6(J1, o->dJ, q1, n);
    s3_mul(J1w, J1, w);
    v3_add(N, J1w);
    add3(Gq, o->G, q1, n);
    v3_cross_add(N, w, Gq);
    for (int j = 0; j < n; j++) Q[j] += v3_dot(w, y + 3 * j);
    if (k->fixed) return;
    add3(F, y + 3 * n, q1, n);
    add3(N, y + 6 * n, q1, n);
}

/* H^T a + G^T w' - 1/2 w . dJ/dq w. */
static void follow(double *Q, const struct flex_shape *o, const double *a, const double *w, const double *al, int n)
{
    const double ww[6] = {.5 * w[0] * w[0], .5 * w[1] * w[1], .5 * w[2] * w[2], w[0] * w[1], w[0] * w[2], w[1] * w[2]};
    for (int j = 0; j < n; j++) {
        const double *dJ = o->dJ + 6 * j;
        Q[j] = v3_dot(o->H + 3 * j, a) + v3_dot(o->G + 3 * j, al) -
               (dJ[0] * ww[0] + dJ[1] * ww[1] + dJ[2] * ww[2] + dJ[3] * ww[3] + dJ[4] * ww[4] + dJ[5] * ww[5]);
    }
}

void flex_inertia(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *shape,
                  const double *a, const double *w, const double *al, const double *q, const double *q1,
                  const double *q2, bool elastic)
{
    const int n = k->n;
    frame(F, N, k->body->mass, shape, a, w, al);
    follow(Q, shape, a, w, al, n);
    if (q1) carried(F, N, Q, k, shape, w, q1);
    if (q2) {
        add3(F, shape->H, q2, n);
        add3(N, shape->G, q2, n);
        dense_gemv(Q, 1, k->Me, q2, n, n, n);
    }
    if (!elastic) return;
    dense_gemv(Q, 1, k->body->K, q, n, n, n);
    if (k->body->D && q1) dense_gemv(Q, 1, k->body->D, q1, n, n, n);
}

/* --- momentum and energy ------------------------------------------------------------------------ */

void flex_momentum(double *P, double *L, const struct flex_kernel *k, const struct flex_shape *shape, const double *v,
                   const double *w, const double *q1)
{
    v3_scale(P, k->body->mass, v);
    v3_cross_add(P, w, shape->h);
    add3(P, shape->H, q1, k->n);
    s3_mul(L, shape->J, w);
    v3_cross_add(L, shape->h, v);
    add3(L, shape->G, q1, k->n);
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

double flex_kinetic(const struct flex_kernel *k, const struct flex_shape *shape, const double *v, const double *w,
                    const double *q1)
{
    double P[3], L[3], x[3] = {0}, y[3] = {0};
    flex_momentum(P, L, k, shape, v, w, q1);
    add3(x, shape->H, q1, k->n);
    add3(y, shape->G, q1, k->n);
    return .5 * (v3_dot(v, P) + v3_dot(w, L) + v3_dot(v, x) + v3_dot(w, y) + square(k->Me, q1, k->n));
}

double flex_elastic(const struct flex_kernel *k, const double *q)
{
    return .5 * square(k->body->K, q, k->n);
}

/* --- nodes -------------------------------------------------------------------------------------- */

void flex_place_take(struct flex_place *o, const struct flex_kernel *k, struct arena *life)
{
    *o = (struct flex_place){.dx = TAKE(life, double, 3 * k->n), .dw = TAKE(life, double, 3 * k->n)};
}

/* x + phi q + q S q/2 and its slopes phi + S q. */
static void shift(struct flex_place *o, const struct flex_node *node, const double *q, int n)
{
    double u[3] = {0};
    memcpy(o->dx, node->phi, sizeof *o->dx * 3 * (size_t)n);
    if (node->S) dense_gemv(o->dx, 1, node->S, q, 3 * n, n, 3 * n);
    add3(u, node->phi, q, n);
    add3(u, o->dx, q, n);
    v3_copy(o->x, node->x);
    v3_axpy(o->x, .5, u);
}

/* R = cay(theta), theta = psi q; in frame axes w = c (theta' + theta x theta'/2), c = 1/(1 + theta.theta/4).  R's
 * column i is e_i + c (theta x e_i + theta x (theta x e_i)/2). */
static double turn(struct flex_place *o, double *theta, const struct flex_node *node, const double *q, int n)
{
    v3_set(theta, 0, 0, 0);
    add3(theta, node->psi, q, n);
    const double c = 1 / (1 + .25 * v3_dot(theta, theta));
    for (int i = 0; i < 3; i++) {
        const double e[3] = {i == 0, i == 1, i == 2};
        double y[3], z[3];
        v3_cross(y, theta, e);
        v3_copy(z, y);
        v3_scale(z, .5, z);
        v3_cross_add(y, theta, z);
        v3_copy(o->R + 3 * i, e);
        v3_axpy(o->R + 3 * i, c, y);
    }
    for (int j = 0; j < n; j++) {
        double half[3], *dw = o->dw + 3 * j;
        v3_scale(half, .5, node->psi + 3 * j);
        v3_copy(dw, node->psi + 3 * j);
        v3_cross_add(dw, theta, half);
        v3_scale(dw, c, dw);
    }
    return c;
}

void flex_place_at(struct flex_place *o, const struct flex_kernel *k, int node, const double *q, const double *q1,
                   const double *q2)
{
    const int n = k->n;
    const struct flex_node *at = &k->body->node[node];
    double theta[3], theta1[3] = {0};
    shift(o, at, q, n);
    const double c = turn(o, theta, at, q, n);
    if (!q1) return;
    v3_set(o->v, 0, 0, 0);
    v3_set(o->w, 0, 0, 0);
    add3(o->v, o->dx, q1, n);
    add3(o->w, o->dw, q1, n);
    if (!q2) return;
    v3_set(o->a, 0, 0, 0);
    add3(o->a, o->dx, q2, n);
    for (int j = 0; at->S && j < n; j++)
        for (int i = 0; i < n; i++) v3_axpy(o->a, q1[i] * q1[j], at->S + 3 * (i + n * j));
    add3(theta1, at->psi, q1, n); /* (theta' + theta x theta'/2)' has no theta' x theta' */
    v3_scale(o->al, -.5 * c * v3_dot(theta, theta1), o->w);
    add3(o->al, o->dw, q2, n);
}
