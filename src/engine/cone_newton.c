/* cone_newton.c -- what cone.h asks for by Newton's method, where Gauss-Seidel is slow: stacks, large ratios of masses,
 * many points that touch.
 *
 * Each law is an equation that has a slope almost everywhere (Alart & Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991)
 * 353): with z = p - u/w and the diagonal w of W
 *
 *     u_n = 0 where z_n > 0, else p_n = 0;   u_t = 0 where |z_t| < mu p_n, else p_t = mu p_n z_t / |z_t|
 *
 * W may be singular.  So W + E is taken in its place, with the rates u + E (p - c) about a centre c, which then is moved to
 * the solution (Rockafellar's proximal points): E is so small that a few such moves end at round-off. */
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/cone_parts.h"
#include "engine/motion.h"
#include "la/dense.h"

enum { NEWTON = 60, MOVES = 8, HALVINGS = 8, STALLED = 12 };
static const double SHARE = 1e-8;                     /* of the diagonal */
static const double ROUND_OFF = 1e-15, SMALL = 1e-13; /* of the rates */

struct problem {
    const double *W, *u0;
    const struct cone *cone;
    struct cone_work *work;
    int n, rows;
    double rough; /* of u0 */
};

static double diagonal(const struct problem *o, int i)
{
    return o->W[i + i * o->rows];
}

/* The larger one of two rows across. */
static double across_diagonal(const struct problem *o, const struct cone *c)
{
    const double w = diagonal(o, c->row + 1);
    return c->across > 1 ? larger(w, diagonal(o, c->row + 2)) : w;
}

/* work->u := the rates of p about the centre. */
static void rates(const struct problem *o, const double *p)
{
    struct cone_work *k = o->work;
    for (int i = 0; i < o->rows; i++) {
        double u = o->u0[i] + SHARE * larger(0, diagonal(o, i)) * (p[i] - k->centre[i]);
        for (int j = 0; j < o->rows; j++) u += o->W[i + j * o->rows] * p[j];
        k->u[i] = u;
    }
}

/* Row i of the matrix: that of the rates. */
static void take_row(const struct problem *o, int i)
{
    const int rows = o->rows;
    if (!o->work->slopes) return;
    for (int j = 0; j < rows; j++) o->work->A[i + j * rows] = o->W[i + j * rows];
    o->work->A[i + i * rows] += SHARE * diagonal(o, i);
}

static void put(const struct problem *o, int i, int j, double x)
{
    if (o->work->slopes) o->work->A[i + j * o->rows] += x;
}

static void hold(const struct problem *o, int i)
{
    take_row(o, i);
    o->work->r[i] = -o->work->u[i];
    o->work->off += o->work->r[i] * o->work->r[i];
}

/* p_i := x, which changes with p_n by `slope`. */
static void give(const struct problem *o, const double *p, int i, double x, int n, double slope)
{
    put(o, i, i, 1);
    if (n != i) put(o, i, n, -slope);
    const double off = (o->work->r[i] = x - p[i]) * larger(0, diagonal(o, i));
    o->work->off += off * off;
}

static void normal(const struct problem *o, const double *p, const struct cone *c)
{
    const int i = c->row;
    const double w = diagonal(o, i);
    if (!(w > 0))
        give(o, p, i, p[i], i, 0);
    else if (c->held || p[i] - o->work->u[i] / w > 0)
        hold(o, i);
    else
        give(o, p, i, 0, i, 0);
}

/* Slides along d = z/|z|: |z| turns with the rates, too. */
static void slide(const struct problem *o, const double *p, const struct cone *c, const double *z, double size,
                  double most, double w)
{
    double d[2] = {z[0] / size, z[1] / size};
    for (int k = 0; k < c->across; k++) {
        const int i = c->row + 1 + k;
        give(o, p, i, most * d[k], c->row, c->mu * d[k]);
        for (int l = 0; c->across > 1 && l < 2; l++) {
            const double P = most / size * ((k == l) - d[k] * d[l]);
            put(o, i, c->row + 1 + l, -P);
            for (int j = 0; o->work->slopes && j < o->rows; j++)
                put(o, i, j, P / w * o->W[c->row + 1 + l + j * o->rows]);
        }
    }
}

static void across(const struct problem *o, const double *p, const struct cone *c)
{
    const double w = across_diagonal(o, c), *u = o->work->u + c->row + 1, *pt = p + c->row + 1;
    const bool bound = c->slides || !(c->held || c->sticks);
    const double push = c->held ? p[c->row] : larger(0, p[c->row]);
    const double most = bound ? c->mu * push + c->preload : INFINITY;
    double z[2] = {0};
    for (int k = 0; k < c->across; k++) z[k] = w > 0 ? pt[k] - u[k] / w : -u[k];
    const double size = hypot(z[0], z[1]);
    for (int k = 0; k < c->across; k++)
        if (c->slides)
            give(o, p, c->row + 1 + k, -most * c->slide[k], c->row, -c->mu * c->slide[k]);
        else if (!(w > 0))
            give(o, p, c->row + 1 + k, size > 0 && bound ? most * z[k] / size : 0, c->row + 1 + k, 0);
        else if (size <= most)
            hold(o, c->row + 1 + k);
    if (!c->slides && w > 0 && size > most) slide(o, p, c, z, size, most, w);
}

/* The equations at p, with their slopes or without; the sum of squares of what they are off, as rates. */
static double equations(const struct problem *o, const double *p, bool slopes)
{
    o->work->off = 0;
    o->work->slopes = slopes;
    rates(o, p);
    if (slopes) zero(o->work->A, o->rows * o->rows);
    for (int i = 0; i < o->n; i++) {
        normal(o, p, &o->cone[i]);
        if (o->cone[i].across) across(o, p, &o->cone[i]);
    }
    return o->work->off;
}

/* One correction of p about the centre, of which a share is gone if all of it leads nowhere.  false: singular. */
static bool correct(const struct problem *o, double *p)
{
    struct cone_work *k = o->work;
    const double off = equations(o, p, true);
    double share = 1;
    if (dense_lu(k->A, k->swap, o->rows, o->rows) >= 0) return false;
    copy(k->dp, k->r, o->rows);
    dense_lu_solve(k->A, k->swap, k->dp, o->rows, o->rows);
    copy(k->from, p, o->rows);
    for (int i = 0; i < HALVINGS; i++, share /= 2) {
        for (int j = 0; j < o->rows; j++) p[j] = k->from[j] + share * k->dp[j];
        if (equations(o, p, false) <= (1 - 1e-4 * share) * off) break;
    }
    return true;
}

/* What round-off of its terms makes of a rate. */
static double noise(const struct problem *o, const double *p)
{
    double most = 0;
    for (int i = 0; i < o->rows; i++) {
        double sum = 0;
        for (int j = 0; j < o->rows; j++) sum += fabs(o->W[i + j * o->rows] * p[j]);
        most = larger(most, sum);
    }
    return 8 * DBL_EPSILON * most + o->rough;
}

/* p about the centre. */
static bool settle(const struct problem *o, double *p, double size)
{
    double least = INFINITY;
    for (int i = 0, since = 0; i < NEWTON && since < STALLED; i++) {
        if (!correct(o, p)) return false;
        const double off = sqrt(o->work->off);
        if (off <= ROUND_OFF * size) return true;
        if (off <= noise(o, p)) return true;
        since = off < .5 * least ? 0 : since + 1;
        least = smaller(least, off);
    }
    return sqrt(o->work->off) <= SMALL * size + o->rough;
}

/* Pushes that pull by round-off. */
static void clip(const struct problem *o, double *p)
{
    for (int i = 0; i < o->n; i++) {
        const struct cone *c = &o->cone[i];
        if (!c->held && diagonal(o, c->row) > 0) p[c->row] = larger(0, p[c->row]);
    }
}

bool cone_newton(double *p, const double *W, const double *u0, const struct cone *cone, int n, int rows, double size,
                 double rough, struct cone_work *work)
{
    const struct problem o = {W, u0, cone, work, n, rows, rough};
    double far = INFINITY;
    copy(work->centre, p, rows);
    for (int k = 0; k < MOVES && far > ROUND_OFF * size; k++) {
        const double last = far;
        if (!settle(&o, p, size)) return false;
        clip(&o, p);
        far = 0;
        for (int i = 0; i < rows; i++) {
            far = larger(far, SHARE * larger(0, W[i + i * rows]) * fabs(p[i] - work->centre[i]));
            work->centre[i] = p[i];
        }
        if (far <= noise(&o, p) || (far <= SMALL * size && !(far < .5 * last))) return true;
    }
    return far <= SMALL * size + rough;
}
