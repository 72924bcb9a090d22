/* curve.c -- forces by a table: a spring's characteristic, F(x) of the measure, or a damper's, F(v) of its rate.
 *
 * F resists, as for a spring: f = -F(s - rest), f = -F(s').  It is linear between the table's points and goes on beyond
 * its ends as straight as in the outermost pieces.  A spring's curve stores V = integral of F from 0 to s - rest, and its
 * mean force over a step is a mean over pieces, so that a step across corners keeps the energy. */
#include <math.h>

#include "base/ascending.h"
#include "kind/force.h"

struct curve {
    struct points table; /* x [m], [m/s], [rad] or [rad/s]; F [N] or [N m] */
    double rest;
};

static int piece(const struct points *p, double x)
{
    return ascending_piece(p->x, p->n, x);
}

/* Of one point: the same everywhere. */
static double slope_of(const struct points *p, int i)
{
    return p->n > 1 ? (p->y[i + 1] - p->y[i]) / (p->x[i + 1] - p->x[i]) : 0;
}

static double on_piece(const struct points *p, int i, double x)
{
    return p->y[i] + slope_of(p, i) * (x - p->x[i]);
}

/* The mean of F from x0 to x1, and twice its change with x1. */
static double mean_of(double *slope, const struct points *p, double x0, double x1)
{
    const double lo = fmin(x0, x1), hi = fmax(x0, x1), per = 1 / (hi - lo);
    double F = 0, from = lo;
    int i = piece(p, lo);
    *slope = 0;
    if (!(hi > lo)) {
        *slope = slope_of(p, i);
        return on_piece(p, i, x0);
    }
    for (; from < hi; i++) {
        const double to = i + 2 < p->n ? fmin(hi, p->x[i + 1]) : hi;
        const double u = (x1 > x0 ? from - lo : hi - to) * per, v = (x1 > x0 ? to - lo : hi - from) * per;
        F += (v - u) * on_piece(p, i, .5 * (from + to));
        *slope += (v - u) * (v + u) * slope_of(p, i);
        from = to;
    }
    return F;
}

/* Of its points those where it bends by much: of a fine table of something smooth there are none, and errors of steps
 * tell what is left of it. */
static int sides_of(double *side, const struct points *p, double x)
{
    static const double MUCH = .05; /* of the steepest slope */
    double most = 0;
    int n = 0;
    for (int i = 0; i + 1 < p->n; i++) most = fmax(most, fabs(slope_of(p, i)));
    for (int i = 1; i + 1 < p->n; i++) {
        if (!(fabs(slope_of(p, i) - slope_of(p, i - 1)) > MUCH * most)) continue;
        if (side) side[n] = x - p->x[i];
        n++;
    }
    return n;
}

static int curve_sides(double *side, const void *par, double s)
{
    const struct curve *p = par;
    return sides_of(side, &p->table, s - p->rest);
}

static int rate_sides(double *side, const void *par, double v)
{
    return sides_of(side, &((const struct curve *)par)->table, v);
}

static void curve_law(struct law *o, const void *par, double s, double v, double t)
{
    const struct curve *p = par;
    const double x = s - p->rest;
    const int i = piece(&p->table, x);
    (void)v, (void)t;
    *o = (struct law){0 - on_piece(&p->table, i, x), slope_of(&p->table, i), 0};
}

static double curve_stored(const void *par, double s)
{
    const struct curve *p = par;
    double slope;
    return (s - p->rest) * mean_of(&slope, &p->table, 0, s - p->rest);
}

static void curve_mean(struct law *o, const void *par, double s0, double s1)
{
    const struct curve *p = par;
    o->f = -mean_of(&o->ks, &p->table, s0 - p->rest, s1 - p->rest);
}

static bool curve_bends(const void *par, double s0, double s1)
{
    const struct curve *p = par;
    return piece(&p->table, s0 - p->rest) != piece(&p->table, s1 - p->rest);
}

static void rate_law(struct law *o, const void *par, double s, double v, double t)
{
    const struct curve *p = par;
    const int i = piece(&p->table, v);
    (void)s, (void)t;
    *o = (struct law){0 - on_piece(&p->table, i, v), 0, slope_of(&p->table, i)};
}

static double rate_dissipative(const void *par, double s, double v, double t)
{
    struct law o;
    rate_law(&o, par, s, v, t);
    return o.f;
}

static const struct key curve_keys[] = {
    PARAM_TABLE(struct curve, table, "table", "[[x, F], ...]", 0,
                "points; F [N] or [N m] resists as a spring does: positive at positive x"),
    PARAM_CSV(struct curve, table, "file", 0, "CSV file of x, F beside the deck"),
    PARAM_REAL(struct curve, rest, "rest", "m or rad", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW | KEY_DRAWN, NULL,
               "where x is 0; default: 0, between two points their distance when drawn"),
    KEYS_END};

static const struct key rate_keys[] = {
    PARAM_TABLE(struct curve, table, "table", "[[v, F], ...]", 0,
                "points; F [N] or [N m] resists as a damper does: positive at positive v"),
    PARAM_CSV(struct curve, table, "file", 0, "CSV file of v, F beside the deck"), KEYS_END};

const struct force_kind force_curve = {.name = "curve",
                                       .brief = "spring by a table, straight between its points and beyond its ends",
                                       .keys = curve_keys,
                                       .size = sizeof(struct curve),
                                       .law = curve_law,
                                       .stored = curve_stored,
                                       .mean = curve_mean,
                                       .sides = curve_sides,
                                       .bends = curve_bends};

const struct force_kind force_curve_rate = {.name = "curve",
                                            .brief = "of a rate, NAME_rate: damper by a table, likewise",
                                            .keys = rate_keys,
                                            .size = sizeof(struct curve),
                                            .rate = true,
                                            .law = rate_law,
                                            .sides = rate_sides,
                                            .dissipative = rate_dissipative};
