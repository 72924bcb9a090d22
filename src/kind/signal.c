/* signal.c -- values given by an expression or by a table of time; see force.h
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/ascending.h"
#include "expr/expr.h"
#include "kind/force.h"

/* An empty table is 0. */
static double table_value(double *slope, const struct signal *s, double t)
{
    *slope = 0;
    if (s->n == 0) return 0;
    if (t <= s->t[0]) return s->x[0];
    if (t >= s->t[s->n - 1]) return s->x[s->n - 1];
    int i = ascending_piece(s->t, s->n, t);
    *slope = (s->x[i + 1] - s->x[i]) / (s->t[i + 1] - s->t[i]);
    return s->x[i] + *slope * (t - s->t[i]);
}

struct signal signal_of(const struct expr *expr, struct arena *life)
{
    struct expr_corner *corner = TAKE(life, struct expr_corner, expr_corners(NULL, expr, 0));
    return (struct signal){.expr = expr,
                           .ncorner = expr_corners(corner, expr, 0),
                           .corner = corner,
                           .cornered = expr_corners_are_all(expr, 0)};
}

double signal_time(const struct signal *s, double t)
{
    double before;
    for (int i = 0; i < s->ncorner; i++)
        if (expr_corner_meets(&before, &s->corner[i], t)) return t == 0 ? DBL_MIN : fmin(t, before);
    return t;
}

bool signal_has_sides(const struct signal *s, double t)
{
    double before;
    for (int i = 0; t != 0 && i < s->ncorner; i++)
        if (expr_corner_meets(&before, &s->corner[i], t)) return true;
    return false;
}

double signal_value(const struct signal *s, const double *slot)
{
    double slope;
    return s->expr ? expr_value(s->expr, slot) : table_value(&slope, s, slot[0]);
}

double signal_slopes(const struct signal *s, double *d, const double *slot, const int *which, int n)
{
    if (s->expr) return expr_slopes(s->expr, d, slot, which, n);
    double slope, x = table_value(&slope, s, slot[0]);
    for (int i = 0; i < n; i++) d[i] = which[i] == 0 ? slope : 0;
    return x;
}

/* Times of steps are products, those of tables were read: a point this near,
 * relative to t, is at t. */
static const double SAME = 4 * DBL_EPSILON;

static void go_on(double *x, double by)
{
    x[0] += by * x[1];
    x[1] += by * x[2];
}

void signal_motion(const struct signal *s, double *x, double t)
{
    const double same = SAME * fabs(t);
    x[1] = x[2] = 0;
    if (s->expr) {
        const double there = signal_time(s, t);
        x[0] = expr_jet(s->expr, &x[1], &x[2], &there, 0);
        if (there != t) go_on(x, t - there);
        return;
    }
    double slope;
    x[0] = table_value(&slope, s, t);
    if (s->n < 2 || t < s->t[0] || t - s->t[s->n - 1] > same) return;
    int i = ascending_piece(s->t, s->n, t);
    if (i == 0 && t != 0 && t - s->t[0] <= same) return; /* before its first point it stands; at the start it moves */
    if (i > 0 && t - s->t[i] <= same) i--;
    x[1] = (s->x[i + 1] - s->x[i]) / (s->t[i + 1] - s->t[i]);
}

enum { FINEST = 60 }; /* halvings down to round-off */

/* Motion within an interval that may be as short as round-off: no corner's side
 * is taken. */
static void inside(const struct signal *s, double *x, double t)
{
    if (s->expr)
        x[0] = expr_jet(s->expr, &x[1], &x[2], &t, 0);
    else
        signal_motion(s, x, t);
}

/* What the value (k = 0) or the rate (1) gains from ta to tb beyond the mean of
 * its own rate (Gauss, five points). */
static double excess(const struct signal *s, int k, double *size, double ta, double tb)
{
    static const double at[5] = {.046910077030668, .230765344947158, .5, .769234655052842, .953089922969332};
    static const double weight[5] = {.118463442528095, .239314335249683, .284444444444444, .239314335249683,
                                     .118463442528095};
    double a[3], b[3], x[3], sum = 0, most = 0;
    signal_motion(s, a, ta);
    signal_motion(s, b, tb);
    for (int i = 0; i < 5; i++) {
        inside(s, x, ta + at[i] * (tb - ta));
        sum += weight[i] * x[k + 1];
        most = fmax(most, fabs(x[k + 1]));
    }
    *size = fabs(a[k]) + fabs(b[k]) + (tb - ta) * most;
    return b[k] - a[k] - (tb - ta) * sum;
}

/* Of an expression: the part with the larger excess again and again; the last
 * excess.  Where a rate has a value of its own at the corner, like that of
 * abs(t), both parts may hold some of it.  The time is then that of the first
 * part, down to round-off; else there are no cuts in the middle, where corners
 * often are, nor within round-off. */
static double halve(const struct signal *s, int k, double *ta, double *tb, double here, int halvings)
{
    const bool whole = k == 1 && halvings < FINEST;
    double size;
    for (int i = 0; i < halvings; i++) {
        double mid = *ta + (*tb - *ta) * (whole ? .48 : .5);
        if (mid == *ta || mid == *tb || (whole && *tb - *ta <= 64 * DBL_EPSILON * fabs(*tb))) break;
        double left = excess(s, k, &size, *ta, mid), right = excess(s, k, &size, mid, *tb);
        if ((k == 1 ? 2 : 1) * fabs(left) > fabs(right))
            *tb = mid, here = left;
        else
            *ta = mid, here = right;
    }
    return here;
}

/* By how much the rate may be off for the round-off of t. */
static double late_rate(const struct signal *s, double ta, double tb)
{
    double a[3], b[3];
    signal_motion(s, a, ta);
    signal_motion(s, b, tb);
    return 64 * DBL_EPSILON * fmax(fabs(ta), fabs(tb)) * fmax(fabs(a[2]), fabs(b[2]));
}

double signal_clear(const struct signal *s, double t)
{
    double end = INFINITY, before;
    if (!s->cornered) return t;
    for (int i = 0; i < s->ncorner; i++) {
        const double next = expr_corner_next(&s->corner[i], t);
        if (expr_corner_meets(&before, &s->corner[i], t)) return t;
        end = fmin(end, next - 2 * SAME * fmax(fabs(next), s->corner[i].width));
    }
    return end;
}

/* That of a true corner stays, and returns; that of a mere jump of the
 * acceleration halves with the interval: 0. */
static double narrow(const struct signal *s, double *ta, double *tb, int halvings)
{
    if (signal_clear(s, *ta) > *tb) return 0;
    double size, first = excess(s, 1, &size, *ta, *tb);
    if (fabs(first) <= 1e-6 * size || fabs(first) <= late_rate(s, *ta, *tb)) return 0;
    double here = halve(s, 1, ta, tb, first, halvings);
    return fabs(here) > fabs(first) / 4 ? here : 0;
}

/* Slopes of a table whose points are on a line differ by round-off of their
 * times. */
static const double STRAIGHT = 1e-9;

double signal_corner(const struct signal *s, double ta, double tb)
{
    double a[3], b[3];
    if (s->expr) return narrow(s, &ta, &tb, 24);
    signal_motion(s, a, ta);
    signal_motion(s, b, tb);
    return fabs(b[1] - a[1]) > STRAIGHT * (fabs(a[1]) + fabs(b[1])) ? b[1] - a[1] : 0;
}

/* A table's corners are its points. */
static double table_corner(const struct signal *s, double ta, double tb)
{
    for (int i = s->n > 0 && s->t[0] != 0 ? 0 : 1; i < s->n && s->t[i] < tb; i++)
        if (ta - s->t[i] <= SAME * fabs(ta)) return fmax(ta, s->t[i]);
    return INFINITY;
}

/* The first known corner in [ta, tb) at which the rate jumps; infinity: there
 * is none. */
static double known_corner(const struct signal *s, double ta, double tb)
{
    double a[3], b[3];
    for (double t = signal_has_sides(s, ta) ? ta : signal_next(s, ta); t < tb; t = signal_next(s, t)) {
        signal_motion(s, a, t);
        signal_motion(s, b, t + 16 * DBL_EPSILON * fabs(t));
        if (fabs(b[1] - a[1]) > STRAIGHT * (fabs(a[1]) + fabs(b[1]))) return t;
    }
    return INFINITY;
}

double signal_corner_time(const struct signal *s, double ta, double tb)
{
    enum { PIECES = 16 };
    if (!s->expr) return table_corner(s, ta, tb);
    const double known = known_corner(s, ta, tb);
    tb = fmin(tb, known);
    for (int i = 0; i < PIECES; i++) {
        double a = ta + i * ((tb - ta) / PIECES), b = i + 1 < PIECES ? ta + (i + 1) * ((tb - ta) / PIECES) : tb;
        if (narrow(s, &a, &b, FINEST) != 0) return a;
    }
    return known;
}

/* Is an excess in [ta, tb] that of round-off, which is beside it, too? */
static bool is_noise(const struct signal *s, double by, double ta, double tb)
{
    double a[3], b[3], size;
    signal_motion(s, a, ta);
    signal_motion(s, b, tb);
    if (fabs(by) <= 64 * DBL_EPSILON * fmax(fabs(ta), fabs(tb)) * fmax(fabs(a[1]), fabs(b[1]))) return true; /* of t */
    const double left = excess(s, 0, &size, ta - (tb - ta), ta), right = excess(s, 0, &size, tb, tb + (tb - ta));
    return 16 * fabs(left) > fabs(by) || 16 * fabs(right) > fabs(by);
}

/* The excess of what merely bends, or moves steeply, still falls with the interval when that is near round-off; a
 * jump's has come to stay. */
bool signal_jump(const struct signal *s, double *at, double *before, double *behind, double ta, double tb)
{
    enum { LAST = 16 };
    double x[3], size, first;
    if (!s->expr || expr_is_smooth(s->expr)) return false;
    first = excess(s, 0, &size, ta, tb);
    if (!(fabs(first) > 1e-11 * size)) return false; /* pieces that meet but for round-off */
    int halvings = (int)fmin(FINEST, log2((tb - ta) / (DBL_EPSILON * fmax(fabs(ta), fabs(tb)))));
    double early = halve(s, 0, &ta, &tb, first, halvings - LAST), ea = ta, eb = tb;
    double late = halve(s, 0, &ta, &tb, early, LAST);
    if (!(fabs(late) > fabs(early) / 4) || is_noise(s, late, ea, eb)) return false;
    *at = ta;
    signal_motion(s, x, ta);
    *before = x[0];
    signal_motion(s, x, tb);
    *behind = x[0];
    return true;
}

bool signal_reads_time(const struct signal *s)
{
    int first = -1;
    return s->expr ? expr_reads(s->expr, &first, 1) > 0 && first == 0 : s->n > 0;
}

bool signal_is_zero(const struct signal *s)
{
    const double no_slot = 0;
    int first;
    for (int i = 0; !s->expr && i < s->n; i++)
        if (s->x[i] != 0) return false;
    return !s->expr || (expr_reads(s->expr, &first, 1) == 0 && signal_value(s, &no_slot) == 0);
}

void signal_stop_at_sudden(struct signal *s, double from, double to, struct arena *life)
{
    enum { MOST = 2000 };
    double at[MOST];
    if (!s->expr) return;
    s->nstop = expr_sudden(at, MOST, s->expr, s->corner, s->ncorner, from, to);
    double *stop = TAKE(life, double, s->nstop);
    memcpy(stop, at, (size_t)s->nstop * sizeof *at);
    s->stop = stop;
}

/* The first of ascending x [n] above t; infinity: none. */
static double above(const double *x, int n, double t)
{
    int lo = 0, hi = n;
    while (lo < hi) {
        const int middle = lo + (hi - lo) / 2;
        if (x[middle] > t)
            hi = middle;
        else
            lo = middle + 1;
    }
    return lo < n ? x[lo] : INFINITY;
}

double signal_next(const struct signal *s, double t)
{
    double next = above(s->stop, s->nstop, t);
    for (int i = 0; i < s->ncorner; i++) next = fmin(next, expr_corner_next(&s->corner[i], t));
    if (s->expr) return next;
    if (s->n == 0 || t >= s->t[s->n - 1]) return INFINITY;
    return t < s->t[0] ? s->t[0] : s->t[ascending_piece(s->t, s->n, t) + 1];
}

void signal_stop_within(struct signal *s, double from, double to, struct arena *life)
{
    enum { MOST = 4000 };
    static const double PART = .382; /* the middle of a smooth step has no curvature, either */
    double at[MOST + 1], x[3];
    int n = 0;
    if (!s->expr) return;
    for (double a = signal_next(s, from), b; a < to && n < MOST; a = b) {
        b = signal_next(s, a);
        if (a == above(s->stop, s->nstop, nextafter(a, from))) at[n++] = a;
        const double inside = a + PART * (b - a);
        if (!(b < INFINITY)) continue;
        signal_motion(s, x, inside);
        if (x[2] != 0) at[n++] = inside;
    }
    double *stop = TAKE(life, double, n);
    memcpy(stop, at, (size_t)n * sizeof *at);
    s->stop = stop;
    s->nstop = n;
}

bool signal_may_have_poles(const struct signal *s)
{
    return s->expr && expr_may_have_poles(s->expr);
}

bool signal_pole(const struct signal *s, const double *a, const double *b, int n)
{
    double at;
    return signal_may_have_poles(s) && expr_pole(&at, &(struct expr_way){s->expr, a, b, n});
}

int signal_sides(double *side, const struct signal *s, const double *slot)
{
    return s->expr ? expr_sides(side, s->expr, slot) : 0;
}

bool signal_may_leap(const struct signal *s)
{
    return s->expr && !expr_is_smooth(s->expr);
}

bool signal_leap(const struct signal *s, double *before, double *behind, const double *a, const double *b, int n)
{
    return signal_may_leap(s) && expr_leap(before, behind, &(struct expr_way){s->expr, a, b, n});
}
