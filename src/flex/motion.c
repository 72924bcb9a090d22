/* motion.c -- see motion.h */
#include "flex/motion.h"

#include <math.h>
#include <string.h>

#include "flex/motion_parts.h"
#include "la/dense.h"
#include "la/eigen.h"

enum { SERIES = 12 };             /* terms, for turns up to pi */
static const double THIN = 1e-12; /* of the largest moment of inertia: no turn about that axis */

/* --- the mean frame ----------------------------------------------------------------------------- */

/* Theta = J^-1 (int (x - x0) x phi dm + rpsi), without turns about axes of no inertia. */
static void mean_turn(double *psi, const struct flex_body *o, const double *x0)
{
    double J[9], X[9], lambda[3], size = o->xx[0] + o->xx[4] + o->xx[8] + o->mass * v3_dot(x0, x0);
    for (int i = 0; i < 9; i++) J[i] = o->rot[i] - o->xx[i] - o->mass * x0[i % 3] * x0[i / 3] + (i % 4 == 0 ? size : 0);
    eigen_symmetric(lambda, X, J, 3);
    for (int j = 0; j < o->n; j++) {
        const double *B = o->xf + 9 * j;
        double G[3] = {B[7] - B[5], B[2] - B[6], B[3] - B[1]}, arm[3];
        v3_add(G, o->rpsi + 3 * j);
        v3_cross(arm, x0, o->f + 3 * j);
        v3_take(G, arm);
        v3_set(psi + 3 * j, 0, 0, 0);
        for (int i = 0; i < 3; i++)
            if (lambda[i] > THIN * lambda[2]) v3_axpy(psi + 3 * j, v3_dot(X + 3 * i, G) / lambda[i], X + 3 * i);
    }
}

static void second_order(struct flex_kernel *k, struct arena *life)
{
    const struct flex_body *o = k->body;
    k->node = TAKE(life, struct second, o->nnode);
    for (int i = 0; i < o->nnode; i++) {
        if (o->node[i].S) sift_build(&k->node[i].S, o->node[i].S, o->node[i].phi, 3 * o->n, o->n, life);
        if (o->node[i].T) sift_build(&k->node[i].T, o->node[i].T, o->node[i].psi, 3 * o->n, o->n, life);
    }
}

static bool is_diagonal(const double *A, int n)
{
    for (int j = 0; A && j < n; j++)
        for (int i = 0; i < n; i++)
            if (i != j && A[i + n * j] != 0) return false;
    return true;
}

struct flex_kernel *flex_kernel_build(const struct flex_body *o, struct arena *life)
{
    struct flex_kernel *k = TAKE(life, struct flex_kernel, 1);
    *k = (struct flex_kernel){.body = o, .n = o->n};
    k->K_diagonal = is_diagonal(o->K, o->n);
    k->D_diagonal = is_diagonal(o->D, o->n);
    v3_copy(k->pivot, o->node[o->reference].x);
    v3_copy(k->mean.x, k->pivot);
    k->mean.phi = TAKE(life, double, 3 * o->n);
    k->mean.psi = TAKE(life, double, 3 * o->n);
    if (o->s) {
        struct flex_body single = *o;
        mean_turn(k->mean.psi, o, k->pivot);
        single.node = &k->mean;
        single.nnode = 1;
        o = flex_refer(&single, 0, life);
    }
    k->in = affine_build(o, life);
    second_order(k, life);
    return k;
}

void flex_shape_take(struct flex_shape *o, const struct flex_kernel *k, struct arena *life)
{
    *o = (struct flex_shape){.dw = TAKE(life, double, 3 * k->n), .lever = TAKE(life, double, 3 * k->n)};
    o->work = TAKE(life, double, 7 * k->n);
    affine_take(&o->in, k->in, life);
}

/* The turn by theta = Theta q: R = exp(theta x), wt = T theta'.  With s = theta.theta, a = (1 - cos)/s and
 * b = (1 - sin/sqrt(s))/s as power series,
 *
 *     R = 1 + (1 - s b) theta x + a theta x theta x,    T = 1 + a theta x + b theta x theta x. */
void flex_turn(struct flex_shape *o, const double *pivot)
{
    const double *t = o->theta, s = v3_dot(t, t);
    double term = .5;
    o->a = o->b = o->a1 = o->b1 = 0;
    for (int i = 0; i < SERIES; i++) { /* term = s^i / (2 i + 2)!, of alternating sign; its slope by s takes i/s */
        o->a += term;
        o->b += term / (2 * i + 3);
        o->a1 -= term * (i + 1) / ((2 * i + 3) * (2 * i + 4));
        o->b1 -= term * (i + 1) / ((2 * i + 3) * (2 * i + 4) * (double)(2 * i + 5));
        term *= -s / ((2 * i + 3) * (2 * i + 4));
    }
    for (int i = 0; i < 3; i++) {
        const double e[3] = {i == 0, i == 1, i == 2};
        double x[3], y[3];
        v3_cross(x, t, e);
        v3_cross(y, t, x);
        v3_copy(o->R + 3 * i, e);
        v3_axpy(o->R + 3 * i, 1 - s * o->b, x);
        v3_axpy(o->R + 3 * i, o->a, y);
    }
    m3_mul(o->y, o->R, pivot);
    v3_scale(o->y, -1, o->y);
    v3_sum(o->d, pivot, o->y);
}

void flex_turned(double *y, const struct flex_shape *o, const double *x)
{
    double u[3], v[3];
    v3_cross(u, o->theta, x);
    v3_cross(v, o->theta, u);
    v3_copy(y, x);
    v3_axpy(y, o->a, u);
    v3_axpy(y, o->b, v);
}

static void turn_mean(struct flex_shape *o, const struct flex_kernel *k, const double *q)
{
    v3_set(o->theta, 0, 0, 0);
    add3(o->theta, k->mean.psi, q, k->n);
    flex_turn(o, k->pivot);
    for (int j = 0; j < k->n; j++) flex_turned(o->dw + 3 * j, o, k->mean.psi + 3 * j);
}

/* T' theta'. */
static void turn_rate(double *o, const struct flex_shape *x, const double *t1)
{
    const double *t = x->theta, s1 = 2 * v3_dot(t, t1);
    double u[3], v[3];
    v3_cross(u, t, t1);
    v3_cross(v, t, u);
    v3_axpy(o, s1 * x->a1, u);
    v3_axpy(o, s1 * x->b1, v);
    v3_cross(v, t1, u);
    v3_axpy(o, x->b, v);
}

/* J of the particles moved by d: + 2 d.h 1 - d h' - h d' + m (d.d 1 - d d'), h before. */
static void move_inertia(double *J, const double *d, const double *h, double m)
{
    double x[3];
    v3_copy(x, h);
    v3_axpy(x, .5 * m, d);
    const double dx = 2 * v3_dot(d, x);
    for (int i = 0; i < 3; i++) J[i] += dx - 2 * d[i] * x[i];
    J[3] -= d[0] * x[1] + d[1] * x[0];
    J[4] -= d[0] * x[2] + d[2] * x[0];
    J[5] -= d[1] * x[2] + d[2] * x[1];
}

void flex_shape_at(struct flex_shape *o, const struct flex_kernel *k, const double *q)
{
    double h[3];
    affine_at(&o->in, k->in, q);
    turn_mean(o, k, q);
    m3_mul(h, o->R, o->in.h);
    v3_copy(o->h, h);
    v3_axpy(o->h, k->body->mass, o->d);
    s3_turn(o->J, o->R, o->in.J);
    move_inertia(o->J, o->d, h, k->body->mass);
}

/* --- inertia ------------------------------------------------------------------------------------ */

void flex_carry(double *a1, double *w1, double *al1, const struct flex_shape *o, const double *a, const double *w,
                const double *al, const double *t1, const double *t2)
{
    double wt[3], at[3], x[3], acc[3], spin[3];
    flex_turned(wt, o, t1);
    flex_turned(at, o, t2);
    turn_rate(at, o, t1);
    v3_copy(acc, a);
    v3_cross_add(acc, al, o->d);
    v3_cross_add(acc, at, o->y);
    v3_cross(x, w, o->d);
    v3_cross_add(acc, w, x);
    v3_cross(x, wt, o->y);
    v3_cross_add(acc, wt, x);
    v3_scale(x, 2, x);
    v3_cross_add(acc, w, x);
    v3_sum(spin, al, at);
    v3_cross_add(spin, w, wt);
    v3_add(wt, w);
    m3_tmul(a1, o->R, acc);
    m3_tmul(w1, o->R, wt);
    m3_tmul(al1, o->R, spin);
}

/* Q += A x */
static void add_product(double *Q, const double *A, const double *x, int n, bool diagonal)
{
    if (!diagonal) dense_gemv(Q, 1, A, x, n, n, n);
    for (int i = 0; diagonal && i < n; i++) Q[i] += A[i + n * i] * x[i];
}

void flex_inertia(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *shape,
                  const double *a, const double *w, const double *al, const double *q, const double *q1,
                  const double *q2, bool elastic)
{
    const int n = k->n;
    double a1[3], w1[3], al1[3], f[3], moment[3], t1[3] = {0, 0, 0}, t2[3] = {0, 0, 0};
    if (q1) add3(t1, k->mean.psi, q1, n);
    if (q2) add3(t2, k->mean.psi, q2, n);
    flex_carry(a1, w1, al1, shape, a, w, al, t1, t2);
    affine_inertia(f, moment, Q, k->in, &shape->in, a1, w1, al1, q1, q2);
    m3_mul(F, shape->R, f);
    m3_mul(N, shape->R, moment);
    v3_copy(moment, N);
    v3_cross_add(moment, shape->y, F);
    v3_cross_add(N, shape->d, F);
    for (int j = 0; j < n; j++) Q[j] += v3_dot(shape->dw + 3 * j, moment);
    if (!elastic) return;
    add_product(Q, k->body->K, q, n, k->K_diagonal);
    if (k->body->D && q1) add_product(Q, k->body->D, q1, n, k->D_diagonal);
}

/* With unit rate of coordinate j: H and its moment about the pivot G from those against the mean frame and those that
 * its turn brings; the rows of others are dw_i.G + dw_j.(moment of i against the mean frame). */
void flex_mass_column(double *M, double *H, double *G, const struct flex_kernel *k, struct flex_shape *o, int j)
{
    const double *dw = o->dw + 3 * j;
    double h[3], x[3], v[3], turned[3], *lever = o->lever + 3 * j;
    affine_mass_column(M, h, x, k->in, &o->in, j);
    m3_mul(H, o->R, h);
    m3_mul(lever, o->R, x);
    v3_cross_add(lever, o->y, H);
    m3_mul(h, o->R, o->in.h);
    v3_cross(v, dw, o->y);
    v3_cross_add(H, dw, h);
    v3_axpy(H, k->body->mass, v);
    m3_tmul(turned, o->R, dw);
    s3_mul(x, o->in.J, turned);
    m3_mul(G, o->R, x);
    v3_cross_add(G, h, v);
    v3_cross(x, dw, h);
    v3_axpy(x, k->body->mass, v);
    v3_cross_add(G, o->y, x);
    v3_add(G, lever);
    for (int i = 0; i <= j; i++) M[i] += v3_dot(o->dw + 3 * i, G) + v3_dot(dw, o->lever + 3 * i);
    v3_cross_add(G, k->pivot, H);
}

/* --- momentum and energy ------------------------------------------------------------------------ */

static void carry_velocity(double *v1, double *w1, const struct flex_kernel *k, const struct flex_shape *o,
                           const double *v, const double *w, const double *q1)
{
    double wt[3] = {0, 0, 0}, x[3];
    add3(wt, o->dw, q1, k->n);
    v3_copy(x, v);
    v3_cross_add(x, w, o->d);
    v3_cross_add(x, wt, o->y);
    v3_add(wt, w);
    m3_tmul(v1, o->R, x);
    m3_tmul(w1, o->R, wt);
}

void flex_momentum(double *P, double *L, double *T, const struct flex_kernel *k, const struct flex_shape *shape,
                   const double *v, const double *w, const double *q1)
{
    double v1[3], w1[3], p[3], l[3];
    carry_velocity(v1, w1, k, shape, v, w, q1);
    affine_momentum(p, l, T, k->in, &shape->in, v1, w1, q1);
    m3_mul(P, shape->R, p);
    m3_mul(L, shape->R, l);
    v3_cross_add(L, shape->d, P);
}

double flex_kinetic(const struct flex_kernel *k, const struct flex_shape *shape, const double *v, const double *w,
                    const double *q1)
{
    double P[3], L[3], T;
    flex_momentum(P, L, &T, k, shape, v, w, q1);
    return T;
}

double flex_elastic(const struct flex_kernel *k, const double *q)
{
    double sum = 0;
    for (int j = 0; j < k->n; j++)
        for (int i = 0; i < k->n; i++) sum += q[i] * k->body->K[i + k->n * j] * q[j];
    return .5 * sum;
}

/* --- nodes -------------------------------------------------------------------------------------- */

void flex_place_take(struct flex_place *o, const struct flex_kernel *k, struct arena *life)
{
    *o = (struct flex_place){.dx = TAKE(life, double, 3 * k->n),
                             .dw = TAKE(life, double, 3 * k->n),
                             .turn = TAKE(life, double, 3 * k->n),
                             .work = TAKE(life, double, 3 * k->n)};
}

/* o += q1' A q1. */
static void add_square(double *o, const struct sift *A, const double *q1, int n, double *work)
{
    if (sift_empty(A)) return;
    memset(work, 0, sizeof *work * 3 * (size_t)n);
    sift_times(work, A, q1);
    add3(o, work, q1, n);
}

/* x + phi q + q S q/2 and its slopes phi + S q. */
static void shift(struct flex_place *o, const struct flex_node *node, const struct sift *S, const double *q, int n)
{
    double u[3] = {0};
    memcpy(o->dx, node->phi, sizeof *o->dx * 3 * (size_t)n);
    sift_at(o->dx, S, q);
    add3(u, node->phi, q, n);
    add3(u, o->dx, q, n);
    v3_copy(o->x, node->x);
    v3_axpy(o->x, .5, u);
}

/* R = cay(theta), theta = psi q + q'Tq/2; in frame axes w = c (theta' + theta x theta'/2), c = 1/(1 + theta.theta/4).
 * R's column i is e_i + c (theta x e_i + theta x (theta x e_i)/2). */
static void turn(struct flex_place *o, const struct flex_node *node, const struct sift *T, const double *q, int n)
{
    double *theta = o->theta;
    v3_set(theta, 0, 0, 0);
    memcpy(o->turn, node->psi, sizeof *o->turn * 3 * (size_t)n);
    sift_at(o->turn, T, q);
    add3(theta, node->psi, q, n);
    add3(theta, o->turn, q, n);
    v3_scale(theta, .5, theta);
    const double c = o->c = 1 / (1 + .25 * v3_dot(theta, theta));
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
        v3_scale(half, .5, o->turn + 3 * j);
        v3_copy(dw, o->turn + 3 * j);
        v3_cross_add(dw, theta, half);
        v3_scale(dw, c, dw);
    }
}

void flex_place_at(struct flex_place *o, const struct flex_kernel *k, int node, const double *q)
{
    const struct flex_node *at = &k->body->node[node];
    shift(o, at, &k->node[node].S, q, k->n);
    turn(o, at, &k->node[node].T, q, k->n);
}

/* The bias of accelerations is what they are with q'' = 0: v' = q'S q', and (theta' + theta x theta'/2)' has no
 * theta' x theta'. */
void flex_place_move(struct flex_place *o, const struct flex_kernel *k, int node, const double *q1)
{
    const int n = k->n;
    const struct second *at = &k->node[node];
    double theta1[3] = {0}, theta2[3] = {0}, half[3];
    v3_set(o->v, 0, 0, 0);
    v3_set(o->w, 0, 0, 0);
    v3_set(o->bias, 0, 0, 0);
    add3(o->v, o->dx, q1, n);
    add3(o->w, o->dw, q1, n);
    add_square(o->bias, &at->S, q1, n, o->work);
    add3(theta1, o->turn, q1, n); /* (theta' + theta x theta'/2)' has no theta' x theta' */
    v3_scale(o->turning, -.5 * o->c * v3_dot(o->theta, theta1), o->w);
    if (sift_empty(&at->T)) return;
    add_square(theta2, &at->T, q1, n, o->work); /* of theta'' what q'' does not bring */
    v3_axpy(o->turning, o->c, theta2);
    v3_cross(half, o->theta, theta2);
    v3_axpy(o->turning, .5 * o->c, half);
}

void flex_place_accelerate(struct flex_place *o, const struct flex_kernel *k, const double *q2)
{
    v3_copy(o->a, o->bias);
    add3(o->a, o->dx, q2, k->n);
    v3_copy(o->al, o->turning);
    add3(o->al, o->dw, q2, k->n);
}
