/* planar.c -- see planar.h.
 *
 * Everything linear in the coordinates is one product: the blocks that are not zero (of W and P' for the shape, of Sx
 * and Sy for a node) stand below each other in one table by column, the zero ones of a beam along an axis take no
 * time. */
#include "flex/planar.h"

#include <string.h>

#include "flex/second.h"

enum { BLOCKS = 2 };

/* out = base + A x; block b of out begins at at[b]. */
struct panel {
    int n, size, rows; /* size of out; rows of A, whose other blocks are zero */
    int at[BLOCKS];
    double *base; /* [size] */
    double *A;    /* [rows x n] */
};

/* y += A x; where A is diagonal, as for modes, [n] numbers will do. */
struct form {
    bool diagonal;
    double *A;
};

struct node {
    double x[2];
    double *psi; /* [n] */
    struct panel d, S;
};

struct flex_planar {
    const struct flex_second *second;
    int n, N; /* coordinates of the body; with those that follow */
    double mass, j0;
    double *f, *e;        /* [N x 2], [N] */
    struct panel shape;   /* W, P' */
    struct panel rates;   /* 2 P' */
    struct form Me, K, D; /* of the n */
    double *whole;        /* Me of all [N x N] */
    struct node *node;
};

/* --- products ----------------------------------------------------------------------------------- */

/* y [rows] += A x, four columns at a time; the order of sums is that of the text. */
static inline void multiply(double *restrict y, const double *restrict A, const double *restrict x, int rows, int n)
{
    int j = 0;
    for (; j + 4 <= n; j += 4, A += 4 * (long)rows) {
        const double *A1 = A + rows, *A2 = A1 + rows, *A3 = A2 + rows;
        double x0 = x[j], x1 = x[j + 1], x2 = x[j + 2], x3 = x[j + 3];
        for (int i = 0; i < rows; i++) y[i] += (A[i] * x0 + A1[i] * x1) + (A2[i] * x2 + A3[i] * x3);
    }
    for (; j < n; j++, A += rows)
        for (int i = 0; i < rows; i++) y[i] += A[i] * x[j];
}

static inline void panel_at(double *restrict out, const struct panel *o, const double *restrict x)
{
    for (int i = 0; i < o->size; i++) out[i] = o->base[i];
    multiply(out, o->A, x, o->rows, o->n);
}

static inline void form_add(double *restrict y, const struct form *o, const double *restrict x, int n)
{
    if (!o->diagonal)
        multiply(y, o->A, x, n, n);
    else
        for (int i = 0; i < n; i++) y[i] += o->A[i] * x[i];
}

static inline double dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * y[i];
    return sum;
}

/* --- shape -------------------------------------------------------------------------------------- */

void flex_planar_shape_at(struct flex_planar_shape *o, const struct flex_planar *k, const double *q)
{
    const double *fx = k->f, *fy = k->f + k->N, *y = o->work + k->shape.at[0], *G = o->work + k->shape.at[1];
    double hx = 0, hy = 0, J = 0;
    flex_second_at(o->x, o->Bq, k->second, q);
    panel_at(o->work, &k->shape, o->x);
    for (int i = 0; i < k->N; i++) {
        hx += fx[i] * o->x[i];
        hy += fy[i] * o->x[i];
        J += (k->e[i] + y[i]) * o->x[i];
    }
    o->h[0] = hx;
    o->h[1] = hy;
    o->J = k->j0 + J;
    flex_second_fold(o->Hx, fx, k->second, o->Bq, 1);
    flex_second_fold(o->Hy, fy, k->second, o->Bq, 1);
    flex_second_fold(o->G, G, k->second, o->Bq, 1);
}

/* Q += Me x2 of all: that of the n, then what the others have with all. */
static inline void add_mass(double *Q, const struct flex_planar *k, const double *x2)
{
    const int n = k->n, N = k->N;
    form_add(Q, &k->Me, x2, n);
    for (int h = n; h < N; h++) {
        const double *C = k->whole + (long)N * h;
        double sum = 0;
        for (int i = 0; i < n; i++) {
            Q[i] += C[i] * x2[h];
            sum += C[i] * x2[i];
        }
        for (int i = n; i < N; i++) sum += C[i] * x2[i];
        Q[h] += sum;
    }
}

void flex_planar_inertia(double *F, double *N, double *Q, const struct flex_planar *k, struct flex_planar_shape *o,
                         const double *a, double w, double al, const double *q1, const double *q2)
{
    const int all = k->N;
    const double *fx = k->f, *fy = k->f + all, *y = o->work + k->shape.at[0], *G = o->work + k->shape.at[1], ww = w * w;
    double *P = o->rates, *x1 = P + all, *x2 = x1 + all, *Qx = x2 + all;
    double h1x = 0, h1y = 0, bx = 0, by = 0, g = 0, yx = 0;
    flex_second_rate(x1, k->second, o->Bq, q1);
    flex_second_acceleration(x2, k->second, o->Bq, q1, q2);
    panel_at(P, &k->rates, x1);
    for (int i = 0; i < all; i++) {
        h1x += fx[i] * x1[i];
        h1y += fy[i] * x1[i];
        yx += y[i] * x1[i];
        bx += fx[i] * x2[i];
        by += fy[i] * x2[i];
        g += G[i] * x2[i];
    }
    for (int i = 0; i < all; i++) Qx[i] = (fx[i] * a[0] + fy[i] * a[1]) + (G[i] * al - y[i] * ww) + P[i] * w;
    add_mass(Qx, k, x2);
    flex_second_fold(Q, Qx, k->second, o->Bq, 1);
    F[0] = k->mass * a[0] - al * o->h[1] - ww * o->h[0] - 2 * w * h1y + bx;
    F[1] = k->mass * a[1] + al * o->h[0] - ww * o->h[1] + 2 * w * h1x + by;
    *N = o->h[0] * a[1] - o->h[1] * a[0] + o->J * al + 2 * w * yx + g;
}

void flex_planar_elastic(double *Q, const struct flex_planar *k, const double *q, const double *q1)
{
    form_add(Q, &k->K, q, k->n);
    if (k->D.A) form_add(Q, &k->D, q1, k->n);
}

double flex_planar_kinetic(const struct flex_planar *k, const struct flex_planar_shape *o, const double *v, double w,
                           const double *q1)
{
    const int n = k->n, N = k->N;
    double p[2] = {dot(o->Hx, q1, n) - w * o->h[1], dot(o->Hy, q1, n) + w * o->h[0]}, T = 0, *x1 = o->rates;
    flex_second_rate(x1, k->second, o->Bq, q1);
    for (int j = 0; j < N; j++) T += x1[j] * dot(k->whole + (long)N * j, x1, N);
    T += k->mass * (v[0] * v[0] + v[1] * v[1]) + o->J * w * w;
    return .5 * T + v[0] * p[0] + v[1] * p[1] + w * dot(o->G, q1, n);
}

void flex_planar_mass(double *Me, const struct flex_planar *k, const struct flex_planar_shape *o)
{
    flex_second_mass(Me, k->second, o->Bq, k->whole);
}

/* --- nodes -------------------------------------------------------------------------------------- */

void flex_planar_place_at(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q,
                          const double *q1, const double *q2)
{
    const struct node *d = &k->node[node];
    const double *base = d->d.base, *px = base + d->d.at[0], *py = base + d->d.at[1];
    double x = 0, y = 0, angle = 0;
    panel_at(o->work, &d->d, q);
    for (int i = 0; i < k->n; i++) {
        x += (px[i] + o->dx[i]) * q[i];
        y += (py[i] + o->dy[i]) * q[i];
        angle += o->dw[i] * q[i];
    }
    o->x[0] = d->x[0] + .5 * x;
    o->x[1] = d->x[1] + .5 * y;
    o->angle = angle;
    if (!q1) return;
    o->v[0] = dot(o->dx, q1, k->n);
    o->v[1] = dot(o->dy, q1, k->n);
    o->w = dot(o->dw, q1, k->n);
    if (!q2) return;
    o->a[0] = dot(o->dx, q2, k->n);
    o->a[1] = dot(o->dy, q2, k->n);
    o->al = dot(o->dw, q2, k->n);
    if (d->S.rows == 0) return;
    double *S = o->work + 2 * (long)k->n;
    panel_at(S, &d->S, q1);
    o->a[0] += dot(S + d->S.at[0], q1, k->n);
    o->a[1] += dot(S + d->S.at[1], q1, k->n);
}

/* --- building ----------------------------------------------------------------------------------- */

static bool all_zero(const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (x[i] != 0) return false;
    return true;
}

/* Tables [n x n] and bases [n] (NULL: zero) by block. */
static void panel_build(struct panel *o, int n, int blocks, double *const *table, double *const *base,
                        struct arena *life)
{
    bool zero[BLOCKS];
    int next = 0;
    o->n = n;
    o->size = blocks * n;
    o->base = TAKE(life, double, o->size);
    for (int b = 0; b < blocks; b++) {
        zero[b] = all_zero(table[b], n * n);
        if (!zero[b]) o->rows += n;
    }
    for (int pass = 0; pass < 2; pass++) /* those that are not zero first */
        for (int b = 0; b < blocks; b++)
            if (zero[b] == pass) o->at[b] = next, next += n;
    o->A = TAKE(life, double, (long)o->rows *n);
    for (int b = 0; b < blocks; b++) {
        if (base && base[b]) memcpy(o->base + o->at[b], base[b], sizeof(double) * (size_t)n);
        for (int j = 0; !zero[b] && j < n; j++)
            memcpy(o->A + o->at[b] + (long)o->rows * j, table[b] + (long)n * j, sizeof(double) * (size_t)n);
    }
}

static void form_build(struct form *o, const double *A, int n, struct arena *life)
{
    o->diagonal = true;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            if (i != j && A[i + n * j] != 0) o->diagonal = false;
    o->A = TAKE(life, double, o->diagonal ? n : n *n);
    if (!o->diagonal) memcpy(o->A, A, sizeof *A * (size_t)(n * n));
    for (int i = 0; o->diagonal && i < n; i++) o->A[i] = A[i + n * i];
}

/* Trace and scalar cross product of a 3 x 3 product a b' in the plane. */
static double trace2(const double *ab)
{
    return ab[0] + ab[4];
}

static double cross2(const double *ab)
{
    return ab[3] - ab[1];
}

static void build_linear(struct flex_planar *k, double *g, const struct flex_body *o, struct arena *life)
{
    const int n = o->n;
    k->f = TAKE(life, double, 2 * n);
    k->e = TAKE(life, double, n);
    for (int j = 0; j < n; j++) {
        k->f[j] = o->f[3 * j];
        k->f[j + n] = o->f[3 * j + 1];
        k->e[j] = trace2(o->xf + 9 * j);
        g[j] = cross2(o->xf + 9 * j) + o->rpsi[3 * j + 2];
    }
}

static void build_square(struct flex_planar *k, const double *g, const struct flex_body *o, struct arena *life)
{
    const int N = o->n, NN = N * N, n = k->n;
    double *W = TAKE(life, double, NN), *B = TAKE(life, double, NN), *P = TAKE(life, double, NN);
    double *Me = TAKE(life, double, n *n);
    k->whole = TAKE(life, double, NN);
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            const int ij = i + N * j, ji = j + N * i;
            W[ij] = .5 * (trace2(o->ff + 9 * ij) + trace2(o->ff + 9 * ji));
            k->whole[ij] = W[ij] + .5 * (o->ppsi[ij] + o->ppsi[ji]);
            P[ij] = cross2(o->ff + 9 * ji) - cross2(o->ff + 9 * ij); /* 2 P_ji */
            B[ij] = .5 * P[ij];
            if (i < n && j < n) Me[i + n * j] = k->whole[ij];
        }
    panel_build(&k->shape, N, 2, (double *const[]){W, B}, (double *const[]){k->e, (double *)g}, life);
    panel_build(&k->rates, N, 1, (double *const[]){P}, NULL, life);
    form_build(&k->Me, Me, n, life);
}

static void build_node(struct node *o, const struct flex_node *from, int n, struct arena *life)
{
    double *phi = TAKE(life, double, 2 * n), *Sx = TAKE(life, double, n *n), *Sy = TAKE(life, double, n *n);
    o->psi = TAKE(life, double, n);
    o->x[0] = from->x[0];
    o->x[1] = from->x[1];
    for (int j = 0; j < n; j++) {
        phi[j] = from->phi[3 * j];
        phi[j + n] = from->phi[3 * j + 1];
        o->psi[j] = from->psi[3 * j + 2];
    }
    for (int ij = 0; from->S && ij < n * n; ij++) {
        Sx[ij] = from->S[3 * ij];
        Sy[ij] = from->S[3 * ij + 1];
    }
    panel_build(&o->d, n, 2, (double *const[]){Sx, Sy}, (double *const[]){phi, phi + n}, life);
    panel_build(&o->S, n, 2, (double *const[]){Sx, Sy}, NULL, life);
}

struct flex_planar *flex_planar_build(const struct flex_body *o, struct arena *life)
{
    struct flex_planar *k = TAKE(life, struct flex_planar, 1);
    k->second = flex_second_build(o, life);
    const struct flex_body *whole = k->second->whole;
    double *g = TAKE(life, double, whole->n);
    k->n = o->n;
    k->N = whole->n;
    k->mass = o->mass;
    k->j0 = trace2(o->xx) + o->rot[8];
    build_linear(k, g, whole, life);
    build_square(k, g, whole, life);
    form_build(&k->K, o->K, o->n, life);
    if (o->D) form_build(&k->D, o->D, o->n, life);
    k->node = TAKE(life, struct node, o->nnode);
    for (int i = 0; i < o->nnode; i++) build_node(&k->node[i], &o->node[i], o->n, life);
    return k;
}

void flex_planar_shape_take(struct flex_planar_shape *o, const struct flex_planar *k, struct arena *life)
{
    *o = (struct flex_planar_shape){.Hx = TAKE(life, double, k->n),
                                    .Hy = TAKE(life, double, k->n),
                                    .G = TAKE(life, double, k->n),
                                    .x = TAKE(life, double, k->N),
                                    .Bq = TAKE(life, double, flex_second_room(k->second)),
                                    .work = TAKE(life, double, 2 * k->N),
                                    .rates = TAKE(life, double, 4 * k->N)};
}

void flex_planar_place_take(struct flex_planar_place *o, const struct flex_planar *k, int node, struct arena *life)
{
    o->work = TAKE(life, double, 4 * k->n);
    o->dx = o->work + k->node[node].d.at[0];
    o->dy = o->work + k->node[node].d.at[1];
    o->dw = k->node[node].psi;
}
