/* unilateral.c -- a spring that only pushes: beyond a place, on one side of it.
 *
 * With d = s - from above, from - s below, and F the push against it,
 *
 *     F = k d^n,   V = k d^(n+1) / (n+1)   where d > 0, else both 0;   n = 1 or 1.5
 *
 * and a damper that acts while it pushes and never makes it pull: the whole push is max(0, F (1 + l d') + c d').  With c = 0
 * and l = D/v a mass that comes with the speed v leaves with e v, of any n, if
 *
 *     (1 + e) D = ln((1 + D)/(1 - e D)),   0 <= D < 1/e
 *
 * (the law: Hunt & Crossley, J. Appl. Mech. 42 (1975) 440, who take D = 3 (1 - e)/2, good for e near 1; as Lankarani &
 * Nikravesh, J. Mech. Des. 112 (1990) 369, 3 (1 - e^2)/4; the equation: with u = d'/v and w the energy of F over m v^2,
 * u du = -(1 + D u) dw from u = 1 to -e, w back to 0).  As D < 1/e it does not pull on its way back.  At another speed v e
 * is another, the nearer to 1 the slower.  The mean of F over a
 * step from d0 to d1 is (V1 - V0)/(d1 - d0) in closed form, without a difference of energies, so that a step over the kink
 * keeps the energy to round-off at any stiffness:
 *
 *     both closed, n = 1        k (d0 + d1)/2
 *     both closed, n = 1.5      (2k/5) (x^4 + x^3 y + x^2 y^2 + x y^3 + y^4)/(x + y),   x, y the roots of d0, d1
 *     one closed, d its depth   V(d)/|d1 - d0|,   which is at least d. */
#include <math.h>

#include "kind/force.h"
#include "kind/unilateral.h"

/* How deep it is at s. */
static double depth(const struct unilateral *p, double s)
{
    return p->side == UNILATERAL_ABOVE ? s - p->from : p->from - s;
}

static double push(const struct unilateral *p, double d)
{
    if (!(d > 0)) return 0;
    return p->root ? p->k * d * sqrt(d) : p->k * d;
}

static double energy(const struct unilateral *p, double d)
{
    if (!(d > 0)) return 0;
    return p->root ? .4 * p->k * d * d * sqrt(d) : .5 * p->k * d * d;
}

static double slope(const struct unilateral *p, double d)
{
    if (!(d > 0)) return 0;
    return p->root ? 1.5 * p->k * sqrt(d) : p->k;
}

/* Where it is closed at both ends: the mean push, and twice its change with d1. */
static double closed_mean(double *ks, const struct unilateral *p, double d0, double d1)
{
    *ks = p->k;
    if (!p->root) return .5 * p->k * (d0 + d1);
    const double x = sqrt(d0), y = sqrt(d1), sum = x + y;
    *ks = .4 * p->k * (((2 * x + 4 * y) * x + 6 * y * y) * x + 3 * y * y * y) / (sum * sum);
    return .4 * p->k * ((((x + y) * x + y * y) * x + y * y * y) * x + y * y * y * y) / sum;
}

static double mean_push(double *ks, const struct unilateral *p, double d0, double d1)
{
    *ks = 0;
    if (!(d0 > 0) && !(d1 > 0)) return 0;
    if (d0 > 0 && d1 > 0) return closed_mean(ks, p, d0, d1);
    const double mean = (energy(p, d1) - energy(p, d0)) / (d1 - d0);
    *ks = 2 * (push(p, d1) - mean) / (d1 - d0);
    return mean;
}

/* What the damper adds to the push F at rate d' of the depth: not less than -F. */
static double damping(const struct unilateral *p, double F, double rate)
{
    return F > 0 ? fmax((p->c + p->loss * F) * rate, -F) : 0;
}

static double sign_of(const struct unilateral *p)
{
    return p->side == UNILATERAL_ABOVE ? 1 : -1;
}

double unilateral_push(const struct unilateral *p, double s, double v)
{
    const double F = push(p, depth(p, s));
    return F + damping(p, F, sign_of(p) * v);
}

double unilateral_whole(double *at_once, const struct unilateral *p, double s, double v)
{
    const double F = push(p, depth(p, s)), rate = sign_of(p) * v;
    *at_once = p->c * rate;
    return F * (1 + p->loss * rate) + *at_once;
}

double unilateral_resistance(const struct unilateral *p, double s)
{
    return p->c + p->loss * push(p, depth(p, s));
}

double unilateral_loss(double e, double v)
{
    double low = 0, high = 1 / e; /* there the logarithm is infinite, and near 0 the difference is below 0 */
    if (!(e < 1)) return 0;
    for (int i = 0; i < 100; i++) {
        const double D = .5 * (low + high);
        if (log1p(D) - log1p(-e * D) > (1 + e) * D)
            high = D;
        else
            low = D;
    }
    return low / v;
}

double unilateral_energy(const struct unilateral *p, double s)
{
    return energy(p, depth(p, s));
}

double unilateral_slope(const struct unilateral *p, double s)
{
    return slope(p, depth(p, s));
}

static void unilateral_law(struct law *o, const void *par, double s, double v, double t)
{
    const struct unilateral *p = par;
    const double d = depth(p, s), F = push(p, d), sign = sign_of(p), more = damping(p, F, sign * v);
    (void)t;
    *o = (struct law){0 - sign * (F + more), slope(p, d), F > 0 && more > -F ? p->c + p->loss * F : 0};
}

static double unilateral_stored(const void *par, double s)
{
    return unilateral_energy(par, s);
}

double unilateral_mean_push(double *ks, const struct unilateral *p, double s0, double s1)
{
    return mean_push(ks, p, depth(p, s0), depth(p, s1));
}

static void unilateral_mean(struct law *o, const void *par, double s0, double s1)
{
    o->f = 0 - sign_of(par) * unilateral_mean_push(&o->ks, par, s0, s1);
}

static double unilateral_dissipative(const void *par, double s, double v, double t)
{
    const struct unilateral *p = par;
    const double sign = sign_of(p);
    (void)t;
    return 0 - sign * damping(p, push(p, depth(p, s)), sign * v);
}

/* What goes with the push goes with its mean. */
static double unilateral_beside(const void *par, double f, double s, double v)
{
    const struct unilateral *p = par;
    const double sign = sign_of(p);
    if (!(p->loss > 0)) return unilateral_dissipative(par, s, v, 0);
    return 0 - sign * damping(p, fabs(f), sign * v);
}

static bool unilateral_bends(const void *par, double s0, double s1)
{
    return (depth(par, s0) > 0) != (depth(par, s1) > 0);
}

static double unilateral_clear(const void *par, double s)
{
    return 0 - depth(par, s);
}

/* Of one with a damper, whose push may begin and end elsewhere, whole() tells. */
static int unilateral_sides(double *side, const void *par, double s)
{
    const struct unilateral *p = par;
    if (p->c > 0 || p->loss > 0) return 0;
    if (side) side[0] = depth(p, s);
    return 1;
}

static double free_to_pull(double *at_once, const void *par, double s, double v)
{
    return unilateral_whole(at_once, par, s, v);
}

static const struct key unilateral_keys[] = {
    PARAM_REAL(struct unilateral, k, "stiffness", "N/m^n or N m/rad^n", 0, INFINITY,
               KEY_REQUIRED | KEY_ABOVE | KEY_BELOW, NULL, "push per depth to the power of n"),
    PARAM_WORD(struct unilateral, root, "exponent", "1|1.5", 0, "1", "n: 1 for stops, 1.5 for balls (Hertz)"),
    PARAM_REAL(struct unilateral, from, "from", "m or rad", -INFINITY, INFINITY, KEY_ABOVE | KEY_BELOW | KEY_DRAWN,
               NULL, "where it begins to push; default: 0, between two points their distance when drawn"),
    PARAM_WORD(struct unilateral, side, "side", "above|below", 0, "above", "on which side of that it pushes back"),
    PARAM_REAL(struct unilateral, c, "damping", "N s/m or N m s/rad", 0, INFINITY, KEY_BELOW, "0",
               "push per rate while it pushes; it never pulls"),
    KEYS_END};

const struct force_kind force_unilateral = {.name = "unilateral",
                                            .brief = "stop: a spring that only pushes, on one side of a place",
                                            .keys = unilateral_keys,
                                            .size = sizeof(struct unilateral),
                                            .law = unilateral_law,
                                            .stored = unilateral_stored,
                                            .mean = unilateral_mean,
                                            .clear = unilateral_clear,
                                            .whole = free_to_pull,
                                            .sides = unilateral_sides,
                                            .bends = unilateral_bends,
                                            .sharp = true,
                                            .dissipative = unilateral_dissipative,
                                            .beside = unilateral_beside};
