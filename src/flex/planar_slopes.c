/* planar_slopes.c -- how the coordinates' rows of planar.h change with q and q', the motion of the frame given.
 *
 * Shapes are linear in q: of H, E, C, W^ q and P^'q the tables have the slopes.  The mean frame's turn theta, a number in
 * the plane, is a coordinate of its motion: with z = a + al J p - w2 p of the frame, in the axes of the mean frame, p to
 * the pivot, and y = -p from there,
 *
 *     a_mean = z + al_mean J y - w_mean^2 y,   da/dtheta = -J z,   da/dtheta' = -2 w_mean y,   dw_mean/dtheta' = 1,
 *
 * which adds to what F, A, B and the moment N + y x F change by along each coordinate, Theta times theirs. */
#include "flex/planar_parts.h"

/* The slopes with q_j of block b [n]; NULL: zero. */
static const double *slopes(const struct panel *o, int b, int j)
{
    return o->table[b] ? o->table[b] + (long)o->n * j : NULL;
}

static double along(const double *slope, const double *x, int n)
{
    double sum = 0;
    for (int i = 0; slope && i < n; i++) sum += slope[i] * x[i];
    return sum;
}

static void add(double *to, double by, const double *slope, int n)
{
    for (int i = 0; slope && i < n; i++) to[i] += by * slope[i];
}

/* What is the same for all coordinates: the body's motion, and of its force what it changes by with theta (turn) and
 * with theta' (rate). */
struct given {
    const double *mean, *q1, *q2;
    double y[2], turn[2], rate[2], A, B, N;
};

/* Of F, A, B and the moment along one coordinate. */
struct change {
    double F[2], A, B, m;
};

static void lever(struct change *d, const struct flex_planar *k, const struct flex_planar_core *o,
                  const struct given *x)
{
    d->m += k->m_inv * (o->h[0] * d->F[1] - o->h[1] * d->F[0]) + o->rho * d->B - o->tau * d->A;
    d->m += x->y[0] * d->F[1] - x->y[1] * d->F[0];
}

static struct change with_place(const struct flex_planar *k, const struct flex_planar_core *o, const struct given *x,
                                int j)
{
    const struct flex_planar_now *f = &o->now;
    const double *sx = slopes(&k->shape, 0, j), *sy = slopes(&k->shape, 1, j), *se = slopes(&k->shape, 2, j);
    const double *sc = slopes(&k->shape, 3, j), *W = slopes(&k->shape, 4, j), *P = slopes(&k->shape, 5, j);
    const double w = f->w, ww = w * w, al = f->al, *q1 = x->q1, *q2 = x->q2;
    const int n = k->n;
    struct change d;
    d.F[0] = along(sx, q2, n) - al * o->Hy[j] - ww * o->Hx[j] - 2 * w * along(sy, q1, n) + x->mean[j] * x->turn[0];
    d.F[1] = along(sy, q2, n) + al * o->Hx[j] - ww * o->Hy[j] + 2 * w * along(sx, q1, n) + x->mean[j] * x->turn[1];
    d.A = k->j_inv * (along(se, q2, n) - al * o->C[j] - ww * o->E[j] - 2 * w * along(sc, q1, n));
    d.B = k->j_inv * (along(sc, q2, n) + al * o->E[j] - ww * o->C[j] + 2 * w * along(se, q1, n));
    d.m = k->m_inv * (o->Hx[j] * f->F[1] - o->Hy[j] * f->F[0]) + o->E[j] * f->B - o->C[j] * f->A;
    d.m += 2 * al * o->W[j] + 2 * w * along(W, q1, n) + along(P, q2, n);
    lever(&d, k, o, x);
    return d;
}

static struct change with_rate(const struct flex_planar *k, const struct flex_planar_core *o, const struct given *x,
                               int j)
{
    const double *sx = slopes(&k->shape, 0, j), *sy = slopes(&k->shape, 1, j), *se = slopes(&k->shape, 2, j);
    const double *sc = slopes(&k->shape, 3, j), w2 = 2 * o->now.w, *q1 = x->q1;
    const int n = k->n;
    struct change d;
    d.F[0] = 2 * along(sx, q1, n) - w2 * o->Hy[j] + x->mean[j] * x->rate[0];
    d.F[1] = 2 * along(sy, q1, n) + w2 * o->Hx[j] + x->mean[j] * x->rate[1];
    d.A = k->j_inv * (2 * along(se, q1, n) - w2 * o->C[j]) + x->mean[j] * x->A;
    d.B = k->j_inv * (2 * along(sc, q1, n) + w2 * o->E[j]) + x->mean[j] * x->B;
    d.m = w2 * o->W[j] + x->mean[j] * x->N;
    lever(&d, k, o, x);
    return d;
}

static void add_change(double *Q, const struct flex_planar *k, const struct flex_planar_core *o, const double *mean,
                       const struct change *d)
{
    for (int i = 0; i < k->n; i++)
        Q[i] += k->m_inv * (o->Hx[i] * d->F[0] + o->Hy[i] * d->F[1]) + o->E[i] * d->A + o->C[i] * d->B + mean[i] * d->m;
}

/* Column j of K and of C. */
static void column(double *K, double *C, const struct flex_planar *k, const struct flex_planar_core *o,
                   const struct given *x, int j)
{
    const struct flex_planar_now *f = &o->now;
    const struct change place = with_place(k, o, x, j), rate = with_rate(k, o, x, j);
    const double w2 = 2 * f->w, by[BLOCKS] = {k->m_inv * f->F[0], k->m_inv * f->F[1], f->A, f->B, -f->w * f->w, f->al};
    add_change(K, k, o, x->mean, &place);
    for (int b = 0; b < BLOCKS; b++) add(K, by[b], slopes(&k->shape, b, j), k->n);
    add_change(C, k, o, x->mean, &rate);
    add(C, w2, slopes(&k->rates, 0, j), k->n);
    if (x->mean[j] == 0) return;
    add(C, 2 * x->mean[j], o->rates + k->rates.at[0], k->n); /* P^' q' */
    add(C, -w2 * x->mean[j], o->W, k->n);
}

static void core_slopes(double *K, double *C, const struct flex_planar *k, const struct flex_planar_core *o,
                        struct given x)
{
    const struct flex_planar_now *f = &o->now;
    const double w2 = 2 * f->w, ww = f->w * f->w;
    const double z[2] = {f->a[0] + f->al * x.y[1] + ww * x.y[0], f->a[1] - f->al * x.y[0] + ww * x.y[1]};
    x.turn[0] = k->mass * z[1];
    x.turn[1] = -k->mass * z[0];
    x.rate[0] = -w2 * (k->mass * x.y[0] + o->h[0]) - 2 * f->h[1];
    x.rate[1] = -w2 * (k->mass * x.y[1] + o->h[1]) + 2 * f->h[0];
    x.A = -k->j_inv * (w2 * o->rho + 2 * f->tau);
    x.B = k->j_inv * (2 * f->rho - w2 * o->tau);
    x.N = 2 * f->W;
    for (int j = 0; j < k->n; j++) column(K + (long)k->n * j, C + (long)k->n * j, k, o, &x, j);
}

void flex_planar_slopes(double *K, double *C, const struct flex_planar *k, const struct flex_planar_shape *o,
                        const double *q1, const double *q2)
{
    const struct given x = {.mean = k->mean, .q1 = q1, .q2 = q2, .y = {-k->pivot[0], -k->pivot[1]}};
    core_slopes(K, C, k, &o->core, x);
    if (k->across) core_slopes(K, C, k->across, &o->across, x);
}
