/* planar.c -- see planar.h.
 *
 * Everything linear in q is one product: the blocks that are not zero stand below each other in one table by column,
 * the zero ones of a beam along an axis take no time.  The same with q'.  Me is a diagonal for modes, so that M^ q'' is
 * Me q'' less the similar part of the fields at rest. */
#include "flex/planar.h"

#include <math.h>
#include <string.h>

enum { BLOCKS = 6, RATES = 5 };

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
    int n;
    double pivot[2];      /* of the mean frame: the reference node */
    double *mean;         /* [n] its turn by coordinate */
    double mass, jx, rot; /* jx = tr xx */
    double m_inv, j_inv;  /* 1/mass, 1/jx; 0 for a particle */
    double *f, *e, *g;    /* [n x 2], [n], [n]: of the body at rest */
    double *rpsi;         /* [n] */
    struct panel shape;   /* of q: H (x, y), E, C, W^ q, P^' q */
    struct panel rates;   /* of q': P^' q', sx, sy, tr xs, X */
    struct form Me, K, D;
    double *rest; /* [n x n] M^ */
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

static void core_at(struct flex_planar_core *o, const struct flex_planar *k, const double *q)
{
    const double *fx = k->f, *fy = k->f + k->n;
    double hx = 0, hy = 0, rho = 0, tau = 0, W = 0;
    panel_at(o->work, &k->shape, q);
    for (int i = 0; i < k->n; i++) {
        hx += (fx[i] + o->Hx[i]) * q[i];
        hy += (fy[i] + o->Hy[i]) * q[i];
        rho += (k->e[i] + o->E[i]) * q[i];
        tau += (k->g[i] + o->C[i]) * q[i];
        W += o->W[i] * q[i];
    }
    o->h[0] = .5 * hx;
    o->h[1] = .5 * hy;
    o->rho = k->jx + .5 * rho;
    o->tau = .5 * tau;
    o->rest = k->rot + W;
    o->J =
        o->rest + k->m_inv * (o->h[0] * o->h[0] + o->h[1] * o->h[1]) + k->j_inv * (o->rho * o->rho + o->tau * o->tau);
}

/* Rates of the body's own affine motion: h', rho', tau' by q' and, in b, their q''-terms. */
struct affine {
    double h[2], rho, tau, b[4];
};

static inline struct affine affine_rates(const struct flex_planar *k, const struct flex_planar_core *o,
                                         const double *q1, const double *q2)
{
    const double *sx = o->rates + k->rates.at[1], *sy = o->rates + k->rates.at[2];
    const double *se = o->rates + k->rates.at[3], *sc = o->rates + k->rates.at[4];
    struct affine x = {0};
    for (int i = 0; i < k->n; i++) {
        x.h[0] += o->Hx[i] * q1[i];
        x.h[1] += o->Hy[i] * q1[i];
        x.rho += o->E[i] * q1[i];
        x.tau += o->C[i] * q1[i];
        x.b[0] += o->Hx[i] * q2[i] + sx[i] * q1[i];
        x.b[1] += o->Hy[i] * q2[i] + sy[i] * q1[i];
        x.b[2] += o->E[i] * q2[i] + se[i] * q1[i];
        x.b[3] += o->C[i] * q2[i] + sc[i] * q1[i];
    }
    return x;
}

static void core_inertia(double *F, double *N, double *Q, const struct flex_planar *k, struct flex_planar_core *o,
                         const double *a, double w, double al, const double *q1, const double *q2)
{
    const double *P = o->rates + k->rates.at[0], *fx = k->f, *fy = k->f + k->n, ww = w * w;
    double u[4] = {0, 0, 0, 0}, rest = al * o->rest;
    panel_at(o->rates, &k->rates, q1);
    const struct affine x = affine_rates(k, o, q1, q2);
    F[0] = k->mass * a[0] - al * o->h[1] - ww * o->h[0] - 2 * w * x.h[1] + x.b[0];
    F[1] = k->mass * a[1] + al * o->h[0] - ww * o->h[1] + 2 * w * x.h[0] + x.b[1];
    const double A = k->j_inv * (x.b[2] - al * o->tau - ww * o->rho - 2 * w * x.tau);
    const double B = k->j_inv * (x.b[3] + al * o->rho - ww * o->tau + 2 * w * x.rho);
    const double ax = k->m_inv * F[0], ay = k->m_inv * F[1];
    for (int i = 0; i < k->n; i++) {
        u[0] += fx[i] * q2[i];
        u[1] += fy[i] * q2[i];
        u[2] += k->e[i] * q2[i];
        u[3] += k->g[i] * q2[i];
        rest += 2 * w * o->W[i] * q1[i] + (o->P[i] + k->rpsi[i]) * q2[i];
    }
    u[0] *= k->m_inv, u[1] *= k->m_inv, u[2] *= k->j_inv, u[3] *= k->j_inv;
    for (int i = 0; i < k->n; i++)
        Q[i] = (o->Hx[i] * ax + o->Hy[i] * ay) + (o->E[i] * A + o->C[i] * B) + al * (k->rpsi[i] + o->P[i]) +
               (2 * w * P[i] - ww * o->W[i]) - (fx[i] * u[0] + fy[i] * u[1]) - (k->e[i] * u[2] + k->g[i] * u[3]);
    form_add(Q, &k->Me, q2, k->n);
    *N = k->m_inv * (o->h[0] * F[1] - o->h[1] * F[0]) + (o->rho * B - o->tau * A) + rest;
}

void flex_planar_elastic(double *Q, const struct flex_planar *k, const double *q, const double *q1)
{
    form_add(Q, &k->K, q, k->n);
    if (k->D.A) form_add(Q, &k->D, q1, k->n);
}

static void core_momentum(double *P, double *L, double *T, const struct flex_planar *k,
                          const struct flex_planar_core *o, const double *v, double w, const double *q1)
{
    const int n = k->n;
    const double x = dot(o->E, q1, n) - w * o->tau, y = dot(o->C, q1, n) + w * o->rho;
    const double rest = dot(k->rpsi, q1, n) + dot(o->P, q1, n);
    P[0] = k->mass * v[0] - w * o->h[1] + dot(o->Hx, q1, n);
    P[1] = k->mass * v[1] + w * o->h[0] + dot(o->Hy, q1, n);
    *L = k->m_inv * (o->h[0] * P[1] - o->h[1] * P[0]) + k->j_inv * (o->rho * y - o->tau * x) + o->rest * w + rest;
    if (!T) return;
    double sum = o->rest * w * w + 2 * w * rest;
    for (int j = 0; j < n; j++) sum += q1[j] * dot(k->rest + (long)n * j, q1, n);
    *T = .5 * (k->m_inv * (P[0] * P[0] + P[1] * P[1]) + k->j_inv * (x * x + y * y) + sum);
}

/* --- the mean frame ----------------------------------------------------------------------------- */

static inline void turn2(double *y, const double *cs, const double *x)
{
    y[0] = cs[0] * x[0] - cs[1] * x[1];
    y[1] = cs[1] * x[0] + cs[0] * x[1];
}

static inline void turn_back(double *y, const double *cs, const double *x)
{
    y[0] = cs[0] * x[0] + cs[1] * x[1];
    y[1] = cs[0] * x[1] - cs[1] * x[0];
}

void flex_planar_shape_at(struct flex_planar_shape *o, const struct flex_planar *k, const double *q)
{
    struct flex_planar_core *c = &o->core;
    double h[2];
    core_at(c, k, q);
    sincos(dot(k->mean, q, k->n), &o->cs[1], &o->cs[0]);
    turn2(o->y, o->cs, (double[]){-k->pivot[0], -k->pivot[1]});
    turn2(h, o->cs, c->h);
    for (int i = 0; i < 2; i++) {
        o->d[i] = k->pivot[i] + o->y[i];
        o->h[i] = h[i] + k->mass * o->d[i];
    }
    o->J = c->J + o->d[0] * (h[0] + o->h[0]) + o->d[1] * (h[1] + o->h[1]);
}

void flex_planar_inertia(double *F, double *N, double *Q, const struct flex_planar *k, struct flex_planar_shape *o,
                         const double *a, double w, double al, const double *q1, const double *q2)
{
    const double t1 = dot(k->mean, q1, k->n), t2 = dot(k->mean, q2, k->n), ww = w * w;
    const double *y = o->y, *d = o->d, cent = t1 * (t1 + 2 * w);
    const double am[2] = {a[0] - al * d[1] - ww * d[0] - t2 * y[1] - cent * y[0],
                          a[1] + al * d[0] - ww * d[1] + t2 * y[0] - cent * y[1]};
    double ai[2], Fi[2];
    turn_back(ai, o->cs, am);
    core_inertia(Fi, N, Q, k, &o->core, ai, w + t1, al + t2, q1, q2);
    turn2(F, o->cs, Fi);
    const double moment = *N + y[0] * F[1] - y[1] * F[0];
    for (int i = 0; i < k->n; i++) Q[i] += k->mean[i] * moment;
    *N += d[0] * F[1] - d[1] * F[0];
}

void flex_planar_momentum(double *P, double *L, double *T, const struct flex_planar *k,
                          const struct flex_planar_shape *o, const double *v, double w, const double *q1)
{
    const double t1 = dot(k->mean, q1, k->n);
    double vi[2], Pi[2];
    turn_back(vi, o->cs, (double[]){v[0] - w * o->d[1] - t1 * o->y[1], v[1] + w * o->d[0] + t1 * o->y[0]});
    core_momentum(Pi, L, T, k, &o->core, vi, w + t1, q1);
    turn2(P, o->cs, Pi);
    *L += o->d[0] * P[1] - o->d[1] * P[0];
}

double flex_planar_kinetic(const struct flex_planar *k, const struct flex_planar_shape *o, const double *v, double w,
                           const double *q1)
{
    double P[2], L, T;
    flex_planar_momentum(P, &L, &T, k, o, v, w, q1);
    return T;
}

void flex_planar_mass(double *M, double *U, const struct flex_planar *k, const struct flex_planar_shape *o)
{
    const struct flex_planar_core *c = &o->core;
    const int n = k->n;
    const double *p = k->pivot, *h = c->h;
    const double J = c->J - 2 * (p[0] * h[0] + p[1] * h[1]) + k->mass * (p[0] * p[0] + p[1] * p[1]);
    for (int j = 0; j < n; j++) {
        const double t = k->mean[j], x = k->m_inv * c->Hx[j], y = k->m_inv * c->Hy[j];
        const double G =
            k->rpsi[j] + c->P[j] + (h[0] * y - h[1] * x) + k->j_inv * (c->rho * c->C[j] - c->tau * c->E[j]);
        double H[2], *u = U + 3 * j;
        turn2(H, o->cs, (double[]){c->Hx[j] - t * (h[1] - k->mass * p[1]), c->Hy[j] + t * (h[0] - k->mass * p[0])});
        u[0] = G - (p[0] * c->Hy[j] - p[1] * c->Hx[j]); /* about the pivot, without the turn */
        u[1] = H[0];
        u[2] = H[1];
    }
    for (int j = 0; j < n; j++) {
        const double *rest = k->rest + (long)n * j, t = k->mean[j], g = U[3 * j] + J * t;
        const double x = k->m_inv * c->Hx[j], y = k->m_inv * c->Hy[j], e = k->j_inv * c->E[j], r = k->j_inv * c->C[j];
        for (int i = j; i < n; i++)
            M[i + n * j] =
                rest[i] + (c->Hx[i] * x + c->Hy[i] * y) + (c->E[i] * e + c->C[i] * r) + k->mean[i] * g + U[3 * i] * t;
    }
    for (int j = 0; j < n; j++) {
        double *u = U + 3 * j; /* about the origin */
        u[0] += J * k->mean[j] + p[0] * u[2] - p[1] * u[1];
    }
}

/* --- nodes -------------------------------------------------------------------------------------- */

void flex_planar_place_at(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q)
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
}

void flex_planar_place_rates(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q1,
                             const double *q2)
{
    const struct node *d = &k->node[node];
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

static void build_linear(struct flex_planar *k, const struct flex_body *o, struct arena *life)
{
    const int n = o->n;
    k->mass = o->mass;
    k->jx = trace2(o->xx);
    k->rot = o->rot[8];
    k->m_inv = 1 / k->mass;
    k->j_inv = k->jx > 0 ? 1 / k->jx : 0;
    k->f = TAKE(life, double, 2 * n);
    k->e = TAKE(life, double, n);
    k->g = TAKE(life, double, n);
    k->rpsi = TAKE(life, double, n);
    for (int j = 0; j < n; j++) {
        k->f[j] = o->f[3 * j];
        k->f[j + n] = o->f[3 * j + 1];
        k->e[j] = trace2(o->xf + 9 * j);
        k->g[j] = cross2(o->xf + 9 * j);
        k->rpsi[j] = o->rpsi[3 * j + 2];
    }
}

/* Of a_i b_j over the similar parts of the fields: their scalar product (W) and cross product (P). */
static void similar(double *W, double *P, const struct flex_planar *k, int i, int j)
{
    const double *fx = k->f, *fy = k->f + k->n, *e = k->e, *g = k->g;
    *W = k->m_inv * (fx[i] * fx[j] + fy[i] * fy[j]) + k->j_inv * (e[i] * e[j] + g[i] * g[j]);
    *P = k->m_inv * (fx[i] * fy[j] - fy[i] * fx[j]) + k->j_inv * (e[i] * g[j] - g[i] * e[j]);
}

/* Symmetric parts of s and xs: the antisymmetric ones do no harm anywhere, if there are any. */
static void build_square(struct flex_planar *k, const struct flex_body *o, struct arena *life)
{
    const int n = o->n, nn = n * n;
    double *W = TAKE(life, double, nn), *P = TAKE(life, double, nn), *sx = TAKE(life, double, nn);
    double *sy = TAKE(life, double, nn), *se = TAKE(life, double, nn), *sc = TAKE(life, double, nn);
    double *Me = TAKE(life, double, nn);
    k->rest = TAKE(life, double, nn);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            const int ij = i + n * j, ji = j + n * i;
            double w, p;
            similar(&w, &p, k, j, i);
            const double both = .5 * (trace2(o->ff + 9 * ij) + trace2(o->ff + 9 * ji));
            const double turns = .5 * (o->ppsi[ij] + o->ppsi[ji]);
            Me[ij] = both + turns;
            W[ij] = both - w;
            k->rest[ij] = Me[ij] - w;
            P[ij] = .5 * (cross2(o->ff + 9 * ji) - cross2(o->ff + 9 * ij)) - p; /* P^_ji */
            if (o->s) {
                sx[ij] = .5 * (o->s[3 * ij] + o->s[3 * ji]);
                sy[ij] = .5 * (o->s[3 * ij + 1] + o->s[3 * ji + 1]);
            }
            if (o->xs) {
                se[ij] = .5 * (trace2(o->xs + 9 * ij) + trace2(o->xs + 9 * ji));
                sc[ij] = .5 * (cross2(o->xs + 9 * ij) + cross2(o->xs + 9 * ji));
            }
        }
    double *const base[BLOCKS] = {k->f, k->f + n, k->e, k->g, NULL, NULL};
    panel_build(&k->shape, n, BLOCKS, (double *const[]){sx, sy, se, sc, W, P}, base, life);
    panel_build(&k->rates, n, RATES, (double *const[]){P, sx, sy, se, sc}, NULL, life);
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

/* The body in its mean frame, which stands on the reference node and turns by that much with q: no angular momentum
 * about the node but that of the turn, to first order.  Without S the fields mean what they say, and so does the
 * frame. */
static const struct flex_body *to_mean(double *mean, const struct flex_body *o, struct arena *life)
{
    const struct flex_node *at = &o->node[o->reference];
    struct flex_node turning = {.phi = TAKE(life, double, 3 * o->n), .psi = TAKE(life, double, 3 * o->n)};
    struct flex_body single = *o;
    const double J = trace2(o->xx) + o->rot[8] + o->mass * (at->x[0] * at->x[0] + at->x[1] * at->x[1]);
    if (!o->s) return o;
    memcpy(turning.x, at->x, sizeof turning.x);
    for (int j = 0; j < o->n; j++) {
        const double *f = o->f + 3 * j;
        mean[j] = (cross2(o->xf + 9 * j) + o->rpsi[3 * j + 2] - (at->x[0] * f[1] - at->x[1] * f[0])) / J;
        turning.psi[3 * j + 2] = mean[j];
    }
    single.node = &turning;
    single.nnode = 1;
    return flex_refer(&single, 0, life);
}

struct flex_planar *flex_planar_build(const struct flex_body *body, struct arena *life)
{
    struct flex_planar *k = TAKE(life, struct flex_planar, 1);
    k->n = body->n;
    k->mean = TAKE(life, double, k->n);
    k->pivot[0] = body->node[body->reference].x[0];
    k->pivot[1] = body->node[body->reference].x[1];
    const struct flex_body *o = to_mean(k->mean, body, life);
    build_linear(k, o, life);
    build_square(k, o, life);
    form_build(&k->K, o->K, o->n, life);
    if (o->D) form_build(&k->D, o->D, o->n, life);
    k->node = TAKE(life, struct node, body->nnode);
    for (int i = 0; i < body->nnode; i++) build_node(&k->node[i], &body->node[i], k->n, life);
    return k;
}

void flex_planar_shape_take(struct flex_planar_shape *shape, const struct flex_planar *k, struct arena *life)
{
    struct flex_planar_core *o = &shape->core;
    o->work = TAKE(life, double, BLOCKS * k->n);
    o->rates = TAKE(life, double, RATES * k->n);
    o->Hx = o->work + k->shape.at[0];
    o->Hy = o->work + k->shape.at[1];
    o->E = o->work + k->shape.at[2];
    o->C = o->work + k->shape.at[3];
    o->W = o->work + k->shape.at[4];
    o->P = o->work + k->shape.at[5];
}

void flex_planar_place_take(struct flex_planar_place *o, const struct flex_planar *k, int node, struct arena *life)
{
    o->work = TAKE(life, double, 4 * k->n);
    o->dx = o->work + k->node[node].d.at[0];
    o->dy = o->work + k->node[node].d.at[1];
    o->dw = k->node[node].psi;
}
