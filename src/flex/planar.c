/* planar.c -- see planar.h.
 *
 * Everything linear in q is one product: the blocks that are not zero stand below each other in one table by column,
 * the zero ones of a beam along an axis take no time.  The same with q' and q''. */
#include <math.h>

#include "flex/planar_parts.h"
#include "la/tiles.h"
#include "la/turned.h"
#include "la/vec2.h"
#include "la/wide.h"

/* --- products ----------------------------------------------------------------------------------- */

static inline void panel_at(double *out, const struct panel *o, const double *x)
{
    tiles_times(out, o->base, o->A, x, o->rows, o->n);
}

static inline void form_add(double *restrict y, const struct form *o, const double *restrict x, int n)
{
    if (!o->diagonal)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < n; i++) y[i] += o->A[i + n * j] * x[j];
    else
        for (int i = 0; i < n; i++) y[i] += o->A[i] * x[i];
}

INTO static inline double dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * y[i];
    return sum;
}

/* Sums of x and of y times q. */
INTO static inline void two_sums(double *xq, double *yq, const double *restrict x, const double *restrict y,
                                 const double *restrict q, int n)
{
    double sx = 0, sy = 0;
    for (int i = 0; i < n; i++) {
        sx += x[i] * q[i];
        sy += y[i] * q[i];
    }
    *xq = sx, *yq = sy;
}

/* The sums of x, y and z times q: a node's motion by the coordinates'. */
static inline void three_sums(double *xy, double *angle, const double *restrict x, const double *restrict y,
                              const double *restrict z, const double *restrict q, int n)
{
    double sx = 0, sy = 0, sz = 0;
    for (int i = 0; i < n; i++) {
        sx += x[i] * q[i];
        sy += y[i] * q[i];
        sz += z[i] * q[i];
    }
    xy[0] = sx, xy[1] = sy, *angle = sz;
}

/* --- shape -------------------------------------------------------------------------------------- */

INTO static inline void core_at(struct flex_planar_core *o, const struct flex_planar *k, const double *q)
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

/* Rates of the body's own affine motion: h', rho', tau' by q' and, in b, their q''-terms; of the rest W^ q . q' and
 * (rpsi + P^'q) . q''. */
struct affine {
    double h[2], rho, tau, b[4], W, G;
};

INTO static inline struct affine affine_rates(const struct flex_planar *k, const struct flex_planar_core *o,
                                              const double *q1, const double *q2)
{
    const double *sx = o->rates + k->rates.at[1], *sy = o->rates + k->rates.at[2];
    const double *se = o->rates + k->rates.at[3], *sc = o->rates + k->rates.at[4];
    struct affine x = {0};
    for (int i = 0; i < k->n; i++) {
        const double v = q1[i], a = q2[i], Hx = o->Hx[i], Hy = o->Hy[i], E = o->E[i], C = o->C[i];
        x.h[0] += Hx * v;
        x.h[1] += Hy * v;
        x.rho += E * v;
        x.tau += C * v;
        x.b[0] += Hx * a + sx[i] * v;
        x.b[1] += Hy * a + sy[i] * v;
        x.b[2] += E * a + se[i] * v;
        x.b[3] += C * a + sc[i] * v;
        x.W += o->W[i] * v;
        x.G += (o->P[i] + k->rpsi[i]) * a;
    }
    return x;
}

/* The coordinates' rows, for the acceleration a of the mass, A and B of the turns. */
INTO static inline void core_rows(double *restrict Q, const struct flex_planar *k, const struct flex_planar_core *o,
                                  const double *a, double A, double B, double w, double al)
{
    const double *restrict Hx = o->Hx, *restrict Hy = o->Hy, *restrict E = o->E, *restrict C = o->C;
    const double *restrict rpsi = k->rpsi, *restrict P = o->P, *restrict W = o->W;
    const double *restrict P1 = o->rates + k->rates.at[0], *restrict M = o->rates + k->rates.size;
    const double ax = a[0], ay = a[1], w2 = 2 * w, ww = w * w;
    for (int i = 0; i < k->n; i++)
        Q[i] =
            (Hx[i] * ax + Hy[i] * ay) + (E[i] * A + C[i] * B) + al * (rpsi[i] + P[i]) + (w2 * P1[i] - ww * W[i]) + M[i];
}

INTO static inline void core_inertia(double *F, double *N, double *Q, const struct flex_planar *k,
                                     struct flex_planar_core *o, const double *a, double w, double al, const double *q1,
                                     const double *q2)
{
    const double ww = w * w;
    panel_at(o->rates, &k->rates, q1);
    panel_at(o->rates + k->rates.size, &k->M, q2);
    const struct affine x = affine_rates(k, o, q1, q2);
    F[0] = k->mass * a[0] - al * o->h[1] - ww * o->h[0] - 2 * w * x.h[1] + x.b[0];
    F[1] = k->mass * a[1] + al * o->h[0] - ww * o->h[1] + 2 * w * x.h[0] + x.b[1];
    const double A = k->j_inv * (x.b[2] - al * o->tau - ww * o->rho - 2 * w * x.tau);
    const double B = k->j_inv * (x.b[3] + al * o->rho - ww * o->tau + 2 * w * x.rho);
    core_rows(Q, k, o, (double[]){k->m_inv * F[0], k->m_inv * F[1]}, A, B, w, al);
    o->now = (struct flex_planar_now){.a = {a[0], a[1]},
                                      .w = w,
                                      .al = al,
                                      .F = {F[0], F[1]},
                                      .A = A,
                                      .B = B,
                                      .h = {x.h[0], x.h[1]},
                                      .rho = x.rho,
                                      .tau = x.tau,
                                      .W = x.W};
    *N = k->m_inv * (o->h[0] * F[1] - o->h[1] * F[0]) + (o->rho * B - o->tau * A) + al * o->rest + 2 * w * x.W + x.G;
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
    double *Mq1 = o->rates + k->rates.size;
    panel_at(Mq1, &k->M, q1);
    const double sum = o->rest * w * w + 2 * w * rest + dot(Mq1, q1, n);
    *T = .5 * (k->m_inv * (P[0] * P[0] + P[1] * P[1]) + k->j_inv * (x * x + y * y) + sum);
}

/* --- the second extent of a body as in space, which has E and C and nothing else; after the first - */

INTO static inline void across_at(struct flex_planar_core *o, const struct flex_planar *k, const double *q)
{
    double rho = 0, tau = 0;
    for (int i = 0; i < k->n; i++) {
        rho += (k->e[i] + o->E[i]) * q[i];
        tau += (k->g[i] + o->C[i]) * q[i];
    }
    o->rho = k->jx + .5 * rho;
    o->tau = .5 * tau;
    o->J = k->j_inv * (o->rho * o->rho + o->tau * o->tau);
}

INTO static inline void add_inertia(double *N, double *Q, const struct flex_planar *k, struct flex_planar_core *o,
                                    double w, double al, const double *q1, const double *q2)
{
    const double ww = w * w, *E = o->E, *C = o->C, *se = o->se, *sc = o->sc;
    double rho = 0, tau = 0, a = 0, b = 0;
    for (int i = 0; i < k->n; i++) {
        rho += E[i] * q1[i];
        tau += C[i] * q1[i];
        a += E[i] * q2[i] + se[i] * q1[i];
        b += C[i] * q2[i] + sc[i] * q1[i];
    }
    const double A = k->j_inv * (a - al * o->tau - ww * o->rho - 2 * w * tau);
    const double B = k->j_inv * (b + al * o->rho - ww * o->tau + 2 * w * rho);
    for (int i = 0; i < k->n; i++) Q[i] += E[i] * A + C[i] * B;
    *N += o->rho * B - o->tau * A;
    o->now = (struct flex_planar_now){.w = w, .al = al, .A = A, .B = B, .rho = rho, .tau = tau};
}

static void add_momentum(double *L, double *T, const struct flex_planar *k, const struct flex_planar_core *o, double w,
                         const double *q1)
{
    double P[2], more, energy;
    core_momentum(P, &more, T ? &energy : NULL, k, o, (double[]){0, 0}, w, q1);
    *L += more;
    if (T) *T += energy;
}

/* Its part of G_j, and of row i of column j of the masses. */
static double turn_of(const struct flex_planar *k, const struct flex_planar_core *o, int j)
{
    return k ? k->j_inv * (o->rho * o->C[j] - o->tau * o->E[j]) : 0;
}

static void add_masses(double *M, const struct flex_planar *k, const struct flex_planar_core *o)
{
    for (int j = 0; j < k->n; j++)
        for (int i = j; i < k->n; i++) M[i + k->n * j] += k->j_inv * (o->E[i] * o->E[j] + o->C[i] * o->C[j]);
}

/* --- the mean frame ----------------------------------------------------------------------------- */

WIDE void flex_planar_shape_at(struct flex_planar_shape *o, const struct flex_planar *k, const double *q)
{
    struct flex_planar_core *c = &o->core;
    double h[2];
    core_at(c, k, q);
    if (k->across) {
        across_at(&o->across, k->across, q);
        c->J += o->across.J;
    }
    turned(dot(k->mean, q, k->n), &o->cs[1], &o->cs[0]);
    v2_turn(o->y, o->cs, (double[]){-k->pivot[0], -k->pivot[1]});
    v2_turn(h, o->cs, c->h);
    for (int i = 0; i < 2; i++) {
        o->d[i] = k->pivot[i] + o->y[i];
        o->h[i] = h[i] + k->mass * o->d[i];
    }
    o->J = c->J + o->d[0] * (h[0] + o->h[0]) + o->d[1] * (h[1] + o->h[1]);
}

WIDE void flex_planar_inertia(double *F, double *N, double *Q, const struct flex_planar *k, struct flex_planar_shape *o,
                              const double *a, double w, double al, const double *q1, const double *q2)
{
    double t1, t2;
    two_sums(&t1, &t2, q1, q2, k->mean, k->n);
    const double *y = o->y, *d = o->d, ww = w * w, cent = t1 * (t1 + 2 * w);
    const double am[2] = {a[0] - al * d[1] - ww * d[0] - t2 * y[1] - cent * y[0],
                          a[1] + al * d[0] - ww * d[1] + t2 * y[0] - cent * y[1]};
    double ai[2], Fi[2];
    v2_turn_back(ai, o->cs, am);
    core_inertia(Fi, N, Q, k, &o->core, ai, w + t1, al + t2, q1, q2);
    if (k->across) add_inertia(N, Q, k->across, &o->across, w + t1, al + t2, q1, q2);
    v2_turn(F, o->cs, Fi);
    const double moment = *N + y[0] * F[1] - y[1] * F[0];
    for (int i = 0; i < k->n; i++) Q[i] += k->mean[i] * moment;
    *N += d[0] * F[1] - d[1] * F[0];
}

void flex_planar_momentum(double *P, double *L, double *T, const struct flex_planar *k,
                          const struct flex_planar_shape *o, const double *v, double w, const double *q1)
{
    const double t1 = dot(k->mean, q1, k->n);
    double vi[2], Pi[2];
    v2_turn_back(vi, o->cs, (double[]){v[0] - w * o->d[1] - t1 * o->y[1], v[1] + w * o->d[0] + t1 * o->y[0]});
    core_momentum(Pi, L, T, k, &o->core, vi, w + t1, q1);
    if (k->across) add_momentum(L, T, k->across, &o->across, w + t1, q1);
    v2_turn(P, o->cs, Pi);
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
            k->rpsi[j] + c->P[j] + (h[0] * y - h[1] * x) + turn_of(k, c, j) + turn_of(k->across, &o->across, j);
        double H[2], *u = U + 3 * j;
        v2_turn(H, o->cs, (double[]){c->Hx[j] - t * (h[1] - k->mass * p[1]), c->Hy[j] + t * (h[0] - k->mass * p[0])});
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
    if (k->across) add_masses(M, k->across, &o->across);
    for (int j = 0; j < n; j++) {
        double *u = U + 3 * j; /* about the origin */
        u[0] += J * k->mean[j] + p[0] * u[2] - p[1] * u[1];
    }
}

/* --- nodes -------------------------------------------------------------------------------------- */

/* w = c theta', c = 1/(1 + theta^2/4) = (1 + cos)/2. */
static void turn_by_cayley(struct flex_planar_place *o, const double *psi, int n)
{
    const double theta = o->theta = o->angle, c = 1 / (1 + .25 * theta * theta);
    o->angle = 2 * atan(.5 * theta);
    o->cs[0] = 2 * c - 1;
    o->cs[1] = c * theta;
    for (int i = 0; i < n; i++) o->turn[i] = c * psi[i];
}

void flex_planar_place_at(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q)
{
    const struct node *d = &k->node[node];
    const double *base = d->d.base, *px = base + d->d.at[0], *py = base + d->d.at[1];
    double x = 0, y = 0, angle = 0;
    panel_at(o->work, &d->d, q);
    for (int i = 0; i < k->n; i++) {
        x += (px[i] + o->dx[i]) * q[i];
        y += (py[i] + o->dy[i]) * q[i];
        angle += d->psi[i] * q[i];
    }
    o->x[0] = d->x[0] + .5 * x;
    o->x[1] = d->x[1] + .5 * y;
    o->angle = angle;
    if (o->turn)
        turn_by_cayley(o, d->psi, k->n);
    else
        turned(angle, &o->cs[1], &o->cs[0]);
}

void flex_planar_place_move(struct flex_planar_place *o, const struct flex_planar *k, const double *q1)
{
    three_sums(o->v, &o->w, o->dx, o->dy, o->dw, q1, k->n);
}

void flex_planar_place_bias(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q1)
{
    const struct node *d = &k->node[node];
    o->bias[0] = o->bias[1] = 0;
    o->turning = o->turn ? -.5 * o->theta * o->w * o->w : 0; /* c' theta' = -theta (c theta')^2/2 */
    if (d->S.rows == 0) return;
    double *S = o->work + d->d.size;
    panel_at(S, &d->S, q1);
    two_sums(&o->bias[0], &o->bias[1], S + d->S.at[0], S + d->S.at[1], q1, k->n);
}

void flex_planar_place_accelerate(struct flex_planar_place *o, const struct flex_planar *k, const double *q2)
{
    three_sums(o->a, &o->al, o->dx, o->dy, o->dw, q2, k->n);
    for (int i = 0; i < 2; i++) o->a[i] += o->bias[i];
    if (o->turn) o->al += o->turning;
}

WIDE void flex_planar_place_row(double *restrict g, const struct flex_planar_place *o, const struct flex_planar *k,
                                const double *f, double moment)
{
    const double *restrict dx = o->dx, *restrict dy = o->dy, *restrict dw = o->dw;
    const double fx = f[0], fy = f[1];
    const int n = k->n;
    for (int i = 0; i < n; i++) g[i] = dx[i] * fx + dy[i] * fy + dw[i] * moment;
}

WIDE void flex_planar_place_load(double *restrict Q, const struct flex_planar_place *o, const struct flex_planar *k,
                                 const double *f, double moment)
{
    const double *restrict dx = o->dx, *restrict dy = o->dy, *restrict dw = o->dw;
    const double fx = f[0], fy = f[1];
    const int n = k->n;
    for (int i = 0; i < n; i++) Q[i] += dx[i] * fx + dy[i] * fy + dw[i] * moment;
}
