/* motion.c -- see motion.h
 *
 * All that is linear in the coordinates stands in one table, [dJ/dx; G] = base + change x with a column for each
 * coordinate, so that a shape costs one product.  With Y_kj = int phi_k x phi_j dm, antisymmetric,
 *
 *     G_j = int x x phi_j dm + rpsi_j + Y_kj x_k,      G' x' = 0,
 *
 * and from (dG_j/dx_k - dG_k/dx_j) x_k' = 2 Y_kj x_k' comes the gyroscopic term of Q.  J is quadratic, so the mean of
 * its slopes at 0 and x takes it there: J = J(0) + (dJ/dx(0) + dJ/dx) x / 2.
 */
#include "flex/motion.h"

#include <string.h>

#include "flex/second.h"
#include "la/dense.h"
#include "la/vec3.h"

struct flex_kernel {
    const struct flex_body *body;
    const struct flex_second *second;
    int n, N;       /* coordinates of the body; with those that follow */
    double J[6];    /* undeformed */
    double *H;      /* [3 x N] */
    double *base;   /* [9 N]: dJ/dx [6 x N], G [3 x N] of the undeformed body */
    double *change; /* [9 N by N] its rate with x */
    double *fast;   /* [3 N by N]: 2 Y */
    double *Me;     /* [N x N] */
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
    const int N = k->N;
    const double rot[6] = {o->rot[0], o->rot[4], o->rot[8], o->rot[3], o->rot[6], o->rot[7]};
    memcpy(k->J, rot, sizeof k->J);
    add_inertia(k->J, 1, o->xx);
    for (int j = 0; j < N; j++) {
        double *G = k->base + 6 * N + 3 * j;
        add_inertia(k->base + 6 * j, 2, o->xf + 9 * j);
        v3_copy(G, o->rpsi + 3 * j);
        add_axial(G, 1, o->xf + 9 * j);
    }
}

/* The pair of coordinates j and k. */
static void fill_pair(struct flex_kernel *o, const struct flex_body *b, int j, int k)
{
    const int N = o->N, jk = j + N * k, kj = k + N * j;
    double *change = o->change + 9 * N * k;
    add_inertia(change + 6 * j, 1, b->ff + 9 * jk);
    add_inertia(change + 6 * j, 1, b->ff + 9 * kj);
    add_axial(change + 6 * N + 3 * j, 1, b->ff + 9 * kj);
    add_axial(o->fast + 3 * N * k + 3 * j, 2, b->ff + 9 * kj);
}

struct flex_kernel *flex_kernel_build(const struct flex_body *o, struct arena *life)
{
    struct flex_kernel *k = TAKE(life, struct flex_kernel, 1);
    const struct flex_second *second = flex_second_build(o, life);
    const int N = o->n + second->m;
    *k = (struct flex_kernel){.body = o, .second = second, .n = o->n, .N = N, .H = second->whole->f};
    k->base = TAKE(life, double, 9 * N);
    k->change = TAKE(life, double, 9 * N * N);
    k->fast = TAKE(life, double, 3 * N * N);
    k->Me = TAKE(life, double, N *N);
    undeformed(k, second->whole);
    flex_mass(k->Me, second->whole);
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) fill_pair(k, second->whole, i, j);
    return k;
}

/* --- shape -------------------------------------------------------------------------------------- */

void flex_shape_take(struct flex_shape *o, const struct flex_kernel *k, struct arena *life)
{
    const int n = k->n, N = k->N;
    *o = (struct flex_shape){.H = TAKE(life, double, 3 * n),
                             .G = TAKE(life, double, 3 * n),
                             .x = TAKE(life, double, N),
                             .Bq = TAKE(life, double, flex_second_room(k->second)),
                             .all = TAKE(life, double, 9 * N),
                             .work = TAKE(life, double, 6 * N)};
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
    const int N = k->N, m = 9 * N;
    double J[6] = {0};
    flex_second_at(o->x, o->Bq, k->second, q);
    memcpy(o->all, k->base, sizeof *o->all * (size_t)m);
    dense_gemv(o->all, 1, k->change, o->x, m, N, m);
    v3_set(o->h, 0, 0, 0);
    add3(o->h, k->H, o->x, N);
    add6(J, k->base, o->x, N);
    add6(J, o->all, o->x, N);
    for (int i = 0; i < 6; i++) o->J[i] = k->J[i] + .5 * J[i];
    flex_second_fold(o->H, k->H, k->second, o->Bq, 3);
    flex_second_fold(o->G, o->all + 6 * N, k->second, o->Bq, 3);
}

void flex_shape_mass(double *Me, const struct flex_kernel *k, const struct flex_shape *shape)
{
    flex_second_mass(Me, k->second, shape->Bq, k->Me);
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

/* What x' adds: 2 w x h',  J' w + w x G x',  2 w . Y x'. */
static void carried(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *o,
                    const double *w, const double *x1, double *y)
{
    const int n = k->N;
    double h1[3] = {0}, Gq[3] = {0}, J1[6] = {0}, J1w[3];
    memset(y, 0, sizeof *y * 3 * (size_t)n);
    dense_gemv(y, 1, k->fast, x1, 3 * n, n, 3 * n);
    add3(h1, k->H, x1, n);
    v3_scale(h1, 2, h1);
    v3_cross_add(F, w, h1);
    add6(J1, o->all, x1, n);
    s3_mul(J1w, J1, w);
    v3_add(N, J1w);
    add3(Gq, o->all + 6 * n, x1, n);
    v3_cross_add(N, w, Gq);
    for (int j = 0; j < n; j++) Q[j] += v3_dot(w, y + 3 * j);
}

/* H^T a + G^T w' - 1/2 w . dJ/dx w. */
static void follow(double *Q, const struct flex_kernel *k, const struct flex_shape *o, const double *a, const double *w,
                   const double *al)
{
    const double ww[6] = {.5 * w[0] * w[0], .5 * w[1] * w[1], .5 * w[2] * w[2], w[0] * w[1], w[0] * w[2], w[1] * w[2]};
    for (int j = 0; j < k->N; j++) {
        const double *dJ = o->all + 6 * j;
        Q[j] = v3_dot(k->H + 3 * j, a) + v3_dot(o->all + 6 * k->N + 3 * j, al) -
               (dJ[0] * ww[0] + dJ[1] * ww[1] + dJ[2] * ww[2] + dJ[3] * ww[3] + dJ[4] * ww[4] + dJ[5] * ww[5]);
    }
}

void flex_inertia(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *shape,
                  const double *a, const double *w, const double *al, const double *q, const double *q1,
                  const double *q2, bool elastic)
{
    const int n = k->n, all = k->N;
    double *Qx = shape->work, *x1 = Qx + all, *x2 = x1 + all;
    frame(F, N, k->body->mass, shape, a, w, al);
    follow(Qx, k, shape, a, w, al);
    if (q1) {
        flex_second_rate(x1, k->second, shape->Bq, q1);
        carried(F, N, Qx, k, shape, w, x1, x2 + all);
    }
    if (q2 || (q1 && all > n)) {
        flex_second_acceleration(x2, k->second, shape->Bq, q1, q2);
        add3(F, k->H, x2, all);
        add3(N, shape->all + 6 * all, x2, all);
        dense_gemv(Qx, 1, k->Me, x2, all, all, all);
    }
    flex_second_fold(Q, Qx, k->second, shape->Bq, 1);
    if (!elastic) return;
    dense_gemv(Q, 1, k->body->K, q, n, n, n);
    if (k->body->D && q1) dense_gemv(Q, 1, k->body->D, q1, n, n, n);
}

/* --- momentum and energy ------------------------------------------------------------------------ */

void flex_moment_rates(double *h1, double *h2, const struct flex_kernel *k, const struct flex_shape *shape,
                       const double *q1, const double *q2)
{
    double *x2 = shape->work;
    v3_set(h1, 0, 0, 0);
    v3_set(h2, 0, 0, 0);
    add3(h1, shape->H, q1, k->n);
    flex_second_acceleration(x2, k->second, shape->Bq, q1, q2);
    add3(h2, k->H, x2, k->N);
}

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
    double P[3], L[3], x[3] = {0}, y[3] = {0}, *x1 = shape->work;
    flex_momentum(P, L, k, shape, v, w, q1);
    add3(x, shape->H, q1, k->n);
    add3(y, shape->G, q1, k->n);
    flex_second_rate(x1, k->second, shape->Bq, q1);
    return .5 * (v3_dot(v, P) + v3_dot(w, L) + v3_dot(v, x) + v3_dot(w, y) + square(k->Me, x1, k->N));
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
