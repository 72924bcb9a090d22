/* way.c -- an expression along a straight way of its slots: smooth pieces of it, poles between them, its mean.
 *
 * With u in [0, 1] along the way, a piece is as long as span.c calls it smooth; behind its end lies a sliver of the size
 * of round-off with the corner in it.  Over a piece of low degree the mean is by a Gauss rule that is exact for it, else
 * by those of Gauss and Kronrod (7 and 15 points; Piessens et al., QUADPACK, 1983), halving until they agree: where
 * the former is right to 1e-9, the latter is to round-off.  What is noise, as next to a pole, is given up in time.
 *
 * A pole in a sliver: d |f| at the distance d from it falls with d where the integral has an end (as d, as the root of d
 * for 1/sqrt), and does not for 1/x and all that is worse. */
#include <float.h>
#include <math.h>

#include "expr/expr.h"

enum { MOST_PIECES = 256, MOST_EMPTY = 4, MOST_HALVINGS = 40, MOST_PANELS = 500 };
static const double SLIVER = 2 * DBL_EPSILON;

static void place(double *x, const struct expr_way *o, double u)
{
    for (int i = 0; i < o->n; i++) x[i] = o->a[i] + u * (o->b[i] - o->a[i]);
}

static double value_at(const struct expr_way *o, double u)
{
    double x[EXPR_SLOTS];
    place(x, o, u);
    return expr_value(o->e, x);
}

/* ---- pieces ---- */

static bool smooth(int *degree, const struct expr_way *o, double u, double v)
{
    double lo[EXPR_SLOTS], hi[EXPR_SLOTS];
    struct expr_span span;
    place(lo, o, u);
    place(hi, o, v);
    const bool is = expr_span(&span, o->e, lo, hi);
    *degree = span.degree;
    return is;
}

/* The end of the smooth piece that begins at u; u: there is none. */
static double piece_end(int *degree, const struct expr_way *o, double u)
{
    double end = u, beyond = 1;
    int there;
    if (smooth(degree, o, u, 1)) return 1;
    *degree = EXPR_NO_POLYNOMIAL;
    while (beyond - end > SLIVER) {
        const double middle = end + (beyond - end) / 2;
        if (!(middle > end && middle < beyond)) break;
        if (smooth(&there, o, u, middle))
            end = middle, *degree = there;
        else
            beyond = middle;
    }
    return end;
}

bool expr_bends(const struct expr_way *o)
{
    int degree;
    return !expr_is_smooth(o->e) && !smooth(&degree, o, 0, 1);
}

/* ---- poles ---- */

/* The least of the way that slots which move can tell from nothing: the one that can best, and the one that can worst. */
static void grains(double *fine, double *coarse, const struct expr_way *o)
{
    *fine = INFINITY;
    *coarse = 0;
    for (int i = 0; i < o->n; i++) {
        if (o->a[i] == o->b[i]) continue;
        const double x = DBL_EPSILON * fmax(fabs(o->a[i]), fabs(o->b[i])) / fabs(o->b[i] - o->a[i]);
        *fine = fmin(*fine, fmax(SLIVER, x));
        *coarse = fmax(*coarse, fmax(SLIVER, x));
    }
}

/* On the side of u to which `far` leads, as seen from places `least` apart; there is no room, or nothing. */
static bool unbounded(const struct expr_way *o, double u, double far, double least)
{
    const double near = copysign(64 * least, far), away = copysign(fmin(fabs(far), 0x1p20 * fabs(near)), far);
    if (!(fabs(away) > 16 * fabs(near))) return false;
    const double f = value_at(o, u + near), g = value_at(o, u + away);
    return isinf(f) || fabs(near * f) > .5 * fabs(away * g);
}

static bool beside(const struct expr_way *o, double u, double v, double w, double least)
{
    return unbounded(o, v, (u - v) / 2, least) || unbounded(o, w, (1 - w) / 2, least);
}

/* In the sliver [v, w] behind a piece from u, whichever of the slots has it. */
static bool pole_in(const struct expr_way *o, double u, double v, double w)
{
    double fine, coarse;
    grains(&fine, &coarse, o);
    return beside(o, u, v, w, fine) || (coarse > fine && beside(o, u, v, w, coarse));
}

bool expr_pole(double *at, const struct expr_way *o)
{
    double u = 0;
    int empty = 0;
    if (expr_is_smooth(o->e)) return false;
    for (int i = 0, degree; i < MOST_PIECES; i++) {
        *at = piece_end(&degree, o, u);
        if (*at >= 1) return false;
        const double behind = fmin(1, *at + SLIVER);
        if (pole_in(o, u, *at, behind)) return true;
        if ((empty += *at == u) > MOST_EMPTY) return false; /* no pieces: nothing is known */
        u = behind;
    }
    return false;
}

/* ---- jumps ---- */

/* A jump has the same height at 1e-9 of the way from it as next to it, a steep slope has not. */
static bool leap_at(double *before, double *behind, const struct expr_way *o, double v, double w)
{
    static const double NEAR = 8 * DBL_EPSILON, FAR = 1e-9, SAME = .5;
    const double a = value_at(o, fmax(0, v - NEAR)), b = value_at(o, fmin(1, w + NEAR));
    const double far = value_at(o, fmin(1, w + FAR)) - value_at(o, fmax(0, v - FAR)), size = fabs(a) + fabs(b);
    *before = a;
    *behind = b;
    return fabs(b - a) > 1e-6 * size && fabs(b - a) > SAME * fabs(far);
}

bool expr_leap(double *before, double *behind, const struct expr_way *o)
{
    double u = 0, most = 0;
    for (int i = 0, degree, empty = 0; u < 1 && i < MOST_PIECES; i++) {
        double a, b;
        const double v = piece_end(&degree, o, u), w = fmin(1, v + SLIVER);
        if (v >= 1 || (empty += v == u) > MOST_EMPTY) break;
        if (!pole_in(o, u, v, w) && leap_at(&a, &b, o, v, w) && fabs(b - a) > most) {
            *before = a;
            *behind = b;
            most = fabs(b - a);
        }
        u = w;
    }
    return most > 0;
}

/* ---- rules, on [-1, 1]; those that are symmetric by their half ---- */

static const double gauss_at[3][3] = {
    {0}, {-0.57735026918962576, 0.57735026918962576}, {-0.77459666924148338, 0, 0.77459666924148338}};
static const double gauss_weight[3][3] = {{2}, {1, 1}, {5. / 9, 8. / 9, 5. / 9}};
static const double kronrod_at[8] = {0,
                                     0.20778495500789847,
                                     0.40584515137739717,
                                     0.58608723546769113,
                                     0.74153118559939444,
                                     0.86486442335976907,
                                     0.94910791234275852,
                                     0.99145537112081264};
static const double kronrod_weight[8] = {0.20948214108472783, 0.20443294007529889, 0.19035057806478541,
                                         0.16900472663926790, 0.14065325971552592, 0.10479001032225018,
                                         0.06309209262997855, 0.02293532201052922};
static const double seven_weight[4] = {0.41795918367346939, 0.38183005050511894, 0.27970539148927667,
                                       0.12948496616886969};

/* Integrals over u of f, of u f' (f' along the slot, per its own unit), and of their sizes. */
struct sums {
    double f, uf, size, usize;
    int panels; /* of the rules that are halved */
};

/* What has been asked for: the way and the slot that moves on it. */
struct asked {
    const struct expr_way *way;
    int slot;
    double reach; /* largest |slot| */
};

static void add(struct sums *o, const struct asked *q, double u, double weight, double seventh, double *seven)
{
    double x[EXPR_SLOTS], slope;
    place(x, q->way, u);
    const double f = expr_slopes(q->way->e, &slope, x, &q->slot, 1);
    o->f += weight * f;
    o->uf += weight * u * slope;
    o->size += weight * fabs(f);
    o->usize += weight * u * fabs(slope);
    if (!seven) return;
    seven[0] += seventh * f;
    seven[1] += seventh * u * slope;
}

static void gauss(struct sums *o, const struct asked *q, double u, double v, int n)
{
    const double half = (v - u) / 2, middle = u + half;
    for (int i = 0; i < n; i++) add(o, q, middle + half * gauss_at[n - 1][i], half * gauss_weight[n - 1][i], 0, NULL);
}

/* Do both rules agree, but for round-off of what f is asked for?  The slope need not be as good, nor have an end. */
static bool agree(const struct sums *o, const struct asked *q, const double *seven, double whole, int depth)
{
    enum { DEEP = 8 };
    if (!isfinite(o->f)) return true;
    const double noise = DBL_EPSILON * (whole + 8 * q->reach * o->usize);
    if (!(fabs(seven[0] - o->f) <= fmax(1e-9 * o->size, noise))) return false;
    return depth > DEEP || !(fabs(seven[1] - o->uf) > 1e-6 * o->usize);
}

static void kronrod(struct sums *o, const struct asked *q, double u, double v, int depth)
{
    const double half = (v - u) / 2, middle = u + half;
    struct sums here = {0};
    double seven[2] = {0, 0};
    for (int i = 0; i < 8; i++)
        for (int side = i ? -1 : 1; side <= 1; side += 2)
            add(&here, q, middle + side * half * kronrod_at[i], half * kronrod_weight[i],
                i % 2 ? 0 : half * seven_weight[i / 2], seven);
    if (!agree(&here, q, seven, o->size, depth) && depth < MOST_HALVINGS && o->panels++ < MOST_PANELS) {
        kronrod(o, q, u, middle, depth + 1);
        kronrod(o, q, middle, v, depth + 1);
        return;
    }
    o->f += here.f;
    o->uf += here.uf;
    o->size += here.size;
}

static void over_piece(struct sums *o, const struct asked *q, double u, double v, int degree)
{
    if (v <= u) return;
    if (degree < 6)
        gauss(o, q, u, v, degree / 2 + 1);
    else
        kronrod(o, q, u, v, 0);
}

/* A jump at u counts in the slope as its height there. */
static double jump_at(const struct expr_way *o, double v, double w)
{
    return value_at(o, fmin(1, w + 4 * SLIVER)) - value_at(o, fmax(0, v - 4 * SLIVER));
}

double expr_mean(double *slope, const struct expr_way *o, int slot)
{
    const struct asked q = {o, slot, fmax(fabs(o->a[slot]), fabs(o->b[slot]))};
    const double length = o->b[slot] - o->a[slot];
    struct sums sums = {0};
    double u = 0, jumps = 0;
    int empty = 0;
    if (length == 0) {
        const double f = expr_slopes(o->e, slope, o->a, &slot, 1);
        *slope /= 2;
        return f;
    }
    for (int i = 0, degree; u < 1; i++) {
        const double v = piece_end(&degree, o, u), w = fmin(1, v + SLIVER);
        if ((empty += v == u) > MOST_EMPTY || i == MOST_PIECES) { /* no pieces: as if it were smooth */
            over_piece(&sums, &q, u, 1, EXPR_NO_POLYNOMIAL);
            break;
        }
        over_piece(&sums, &q, u, v, degree);
        if (v >= 1) break;
        if (pole_in(o, u, v, w)) return *slope = INFINITY;
        jumps += v * jump_at(o, v, w);
        u = w;
    }
    *slope = sums.uf + jumps / length;
    return sums.f;
}
