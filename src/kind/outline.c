/* outline.c -- see outline.h.
 *
 * The nearest point c(u) to p is where (c - p) . c' = 0.  It is no farther than the point of the same x, or angle, so that it
 * lies within a window about that one: |u - x| <= |y(x) - p_y| of a profile, |u - phi| <= arcsin(|r(phi) - |p||/|p|) of a cam.
 * The nearest of its samples there begins Newton's iteration, kept between its neighbours. */
#include "kind/outline.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/ascending.h"
#include "base/scalar.h"
#include "la/vec3.h"

static const double TURN = 2 * 3.14159265358979323846;

/* ---- the spline ---- */

/* Solves the tridiagonal system of rows (a, b, c) for x, its right side before; b is lost. */
static void sweep_out(double *x, const double *a, double *b, const double *c, int n)
{
    for (int i = 1; i < n; i++) {
        const double w = a[i] / b[i - 1];
        b[i] -= w * c[i - 1];
        x[i] -= w * x[i - 1];
    }
    x[n - 1] /= b[n - 1];
    for (int i = n - 2; i >= 0; i--) x[i] = (x[i] - c[i] * x[i + 1]) / b[i];
}

static double step_of(const struct outline *o, int i)
{
    return o->x[i + 1] - o->x[i];
}

static double slope_of(const struct outline *o, int i)
{
    return (o->y[i + 1] - o->y[i]) / step_of(o, i);
}

/* Rows i = 1 ... of the second derivatives M: h_- M_- + 2 (h_- + h) M + h M_+ = 6 (change of slope). */
static void fill(double *m, double *a, double *b, double *c, const struct outline *o, int i, int before)
{
    a[i] = step_of(o, before);
    c[i] = step_of(o, i);
    b[i] = 2 * (a[i] + c[i]);
    m[i] = 6 * (slope_of(o, i) - slope_of(o, before));
}

/* M = 0 at both ends. */
static void bend_open(double *m, const struct outline *o, double *a, double *b, double *c)
{
    const int n = o->n;
    for (int i = 1; i + 1 < n; i++) fill(m, a, b, c, o, i, i - 1);
    if (n > 2) sweep_out(m + 1, a + 1, b + 1, c + 1, n - 2);
    m[0] = m[n - 1] = 0;
}

/* The first row's a and the last row's c are corners of the matrix: two solutions together (Sherman & Morrison, 1950). */
static void bend_closed(double *m, double *z, const struct outline *o, double *a, double *b, double *c, double *d)
{
    const int n = o->n;
    for (int i = 0; i < n; i++) fill(m, a, b, c, o, i, i ? i - 1 : n - 1);
    const double corner = a[0], gamma = -b[0];
    b[0] -= gamma;
    b[n - 1] -= corner * corner / gamma;
    memcpy(d, b, (size_t)n * sizeof *d);
    memset(z, 0, (size_t)n * sizeof *z);
    z[0] = gamma;
    z[n - 1] = corner;
    sweep_out(m, a, b, c, n);
    sweep_out(z, a, d, c, n);
    const double share = (m[0] + corner * m[n - 1] / gamma) / (1 + z[0] + corner * z[n - 1] / gamma);
    for (int i = 0; i < n; i++) m[i] -= share * z[i];
    m[n] = m[0];
}

/* The piece from the i-th point to the next that holds u. */
static int piece(const struct outline *o, double u)
{
    return ascending_piece(o->x, o->closed ? o->n + 1 : o->n, u);
}

/* An angle within the turn of the table. */
static double within(const struct outline *o, double u)
{
    return o->closed ? u - TURN * floor((u - o->x[0]) / TURN) : u;
}

/* y and its two derivatives at u. */
static void value(const struct outline *o, double *y, double u)
{
    u = within(o, u);
    const int i = piece(o, u);
    const double h = step_of(o, i), m0 = o->bend[i], m1 = o->bend[i + 1];
    const bool before = !o->closed && u < o->x[0], behind = !o->closed && u > o->x[o->n - 1];
    const double end = before ? o->x[i] : behind ? o->x[i + 1] : u;
    const double s = (end - o->x[i]) / h, r = 1 - s;
    y[0] = r * o->y[i] + s * o->y[i + 1] - h * h / 6 * (r * (1 - r * r) * m0 + s * (1 - s * s) * m1);
    y[1] = slope_of(o, i) + h / 6 * ((3 * s * s - 1) * m1 - (3 * r * r - 1) * m0);
    y[2] = before || behind ? 0 : r * m0 + s * m1;
    y[0] += y[1] * (u - end);
}

/* ---- the curve ---- */

struct spot {
    double c[2], d[2], dd[2]; /* the curve and its derivatives with u */
};

static void spot_at(struct spot *o, const struct outline *curve, double u)
{
    double y[3];
    value(curve, y, u);
    if (!curve->closed) {
        *o = (struct spot){{u, y[0]}, {1, y[1]}, {0, y[2]}};
        return;
    }
    const double c = cos(u), s = sin(u), r = y[0], e = y[2] - y[0];
    *o = (struct spot){
        {r * c, r * s}, {y[1] * c - r * s, y[1] * s + r * c}, {e * c - 2 * y[1] * s, e * s + 2 * y[1] * c}};
}

void outline_point(const struct outline *o, double *c, double u)
{
    struct spot s;
    spot_at(&s, o, u);
    c[0] = s.c[0];
    c[1] = s.c[1];
}

/* To the free side: on the left of growing x, on the right of growing angle. */
static void normal_of(double *n, const struct spot *o, bool closed)
{
    const double size = hypot(o->d[0], o->d[1]), side = closed ? -1 : 1;
    n[0] = -side * o->d[1] / size;
    n[1] = side * o->d[0] / size;
}

/* ---- its samples ---- */

/* Where the k-th is; those of a cam go on from turn to turn. */
static double sample_u(const struct outline *o, int k)
{
    const int turn = o->closed ? (k >= 0 ? k : k - o->samples + 1) / o->samples : 0, of_turn = k - turn * o->samples,
              i = of_turn / 2;
    return turn * TURN + (of_turn % 2 ? o->x[i] + .5 * step_of(o, i) : o->x[i]);
}

static const double *sample_point(const struct outline *o, int k)
{
    const int of_turn = o->closed ? k % o->samples : k;
    return o->sample + 2 * (of_turn < 0 ? of_turn + o->samples : of_turn);
}

/* The first one behind u. */
static int sample_behind(const struct outline *o, double u)
{
    const double from = within(o, u);
    int k = 2 * piece(o, from) + (o->closed ? o->samples * (int)round((u - from) / TURN) : 0);
    while ((o->closed || k < o->samples) && sample_u(o, k) <= u) k++;
    return k;
}

static void take_samples(struct outline *o, struct arena *life)
{
    const int samples = o->closed ? 2 * o->n : 2 * o->n - 1;
    double *c = TAKE(life, double, 2 * samples);
    o->samples = samples;
    o->sample = c;
    for (int k = 0; k < samples; k++) outline_point(o, c + 2 * k, sample_u(o, k));
}

const struct outline *outline_make(const struct points *table, bool closed, struct arena *life)
{
    struct outline *o = TAKE(life, struct outline, 1);
    const int n = table->n, room = n + 1;
    double *x = TAKE(life, double, room), *y = TAKE(life, double, room), *m = TAKE(life, double, room),
           *work = TAKE(life, double, 5 * room);
    memcpy(x, table->x, (size_t)n * sizeof *x);
    memcpy(y, table->y, (size_t)n * sizeof *y);
    x[n] = x[0] + TURN;
    y[n] = y[0];
    *o = (struct outline){closed, n, x, y, m, 0, NULL};
    if (closed)
        bend_closed(m, work, o, work + room, work + 2 * room, work + 3 * room, work + 4 * room);
    else
        bend_open(m, o, work, work + room, work + 2 * room);
    take_samples(o, life);
    return o;
}

/* ---- the nearest point ---- */

/* Where p would be if the curve were flat, and how far from there the nearest point may be. */
static double window(double *reach, const struct outline *o, const double *p)
{
    double y[3];
    if (!o->closed) {
        value(o, y, p[0]);
        *reach = fabs(p[1] - y[0]);
        return p[0];
    }
    const double far = hypot(p[0], p[1]), phi = far > 0 ? atan2(p[1], p[0]) : 0;
    value(o, y, phi);
    const double share = fabs(far - y[0]) / far;
    *reach = share < 1 ? asin(share) : TURN / 2;
    return phi;
}

/* The root of (c - p) . c' next to u, within [lo, hi]. */
static double settle(struct spot *at, const struct outline *o, const double *p, double u, double lo, double hi)
{
    enum { MOST = 60 };
    for (int i = 0; i < MOST; i++) {
        spot_at(at, o, u);
        const double e[2] = {at->c[0] - p[0], at->c[1] - p[1]};
        const double f = e[0] * at->d[0] + e[1] * at->d[1];
        const double slope = at->d[0] * at->d[0] + at->d[1] * at->d[1] + e[0] * at->dd[0] + e[1] * at->dd[1];
        if (f > 0)
            hi = u;
        else
            lo = u;
        double to = slope > 0 ? u - f / slope : NAN;
        if (!(to > lo && to < hi)) to = .5 * (lo + hi);
        if (fabs(to - u) <= 2 * DBL_EPSILON * (1 + fabs(u))) break;
        u = to;
    }
    return u;
}

static double square_from(const double *p, const double *c)
{
    const double ex = c[0] - p[0], ey = c[1] - p[1];
    return ex * ex + ey * ey;
}

static double square_at(const struct outline *o, const double *p, double u)
{
    double c[2];
    outline_point(o, c, u);
    return square_from(p, c);
}

void outline_nearest(const struct outline *o, double *at, double *normal, const double *p)
{
    double reach;
    struct spot spot;
    const double middle = window(&reach, o, p), from = middle - reach, to = middle + reach;
    const int first = sample_behind(o, from),
              end = sample_behind(o, to); /* before them and behind them: the window's ends */
    double least = square_at(o, p, from);
    int best = first - 1;
    for (int k = first; k < end; k++) {
        const double square = square_from(p, sample_point(o, k));
        if (square >= least) continue;
        least = square;
        best = k;
    }
    if (square_at(o, p, to) < least) best = end;
    const double lo = best <= first ? from : sample_u(o, best - 1), hi = best + 1 >= end ? to : sample_u(o, best + 1);
    settle(&spot, o, p, best < first ? from : best < end ? sample_u(o, best) : to, lo, hi);
    at[0] = spot.c[0];
    at[1] = spot.c[1];
    normal_of(normal, &spot, o->closed);
}

double outline_meet(const struct outline *o, double *normal, const double *ex, const double *d)
{
    const double p[2] = {v3_dot(ex, d), ex[0] * d[1] - ex[1] * d[0]};
    double c[2], n[2], at[3];
    outline_nearest(o, c, n, p);
    v3_set(at, c[0] * ex[0] - c[1] * ex[1], c[0] * ex[1] + c[1] * ex[0], 0);
    v3_set(normal, n[0] * ex[0] - n[1] * ex[1], n[0] * ex[1] + n[1] * ex[0], 0);
    return v3_dot(normal, d) - v3_dot(normal, at);
}

/* ---- what it is like ---- */

enum { SAMPLES = 8 }; /* of a piece */

double outline_hollow(const struct outline *o, double *where)
{
    double most = 0;
    for (int i = 0; i < SAMPLES * (o->closed ? o->n : o->n - 1); i++) {
        const double u = o->x[i / SAMPLES] + step_of(o, i / SAMPLES) * (i % SAMPLES) / SAMPLES;
        struct spot s;
        double n[2];
        spot_at(&s, o, u);
        normal_of(n, &s, o->closed);
        const double curvature = (n[0] * s.dd[0] + n[1] * s.dd[1]) / (s.d[0] * s.d[0] + s.d[1] * s.d[1]);
        if (curvature <= most) continue;
        most = curvature;
        *where = u;
    }
    return most;
}

double outline_least(const struct outline *o)
{
    double least = INFINITY, y[3];
    for (int i = 0; i < SAMPLES * (o->closed ? o->n : o->n - 1); i++) {
        value(o, y, o->x[i / SAMPLES] + step_of(o, i / SAMPLES) * (i % SAMPLES) / SAMPLES);
        least = smaller(least, y[0]);
    }
    return least;
}
