/* potential.c -- f(s) as an expression: V = - integral of f over s, whatever the expression.
 *
 * Its mean over a step is taken piece by piece between corners and jumps (expr/way.c), so that a step across one, as that
 * of a stop, if(gap < 0, -k*gap, 0), does the work -(V1 - V0) to round-off. */
#include "kind/potential.h"

#include <math.h>

#include "expr/expr.h"

static void potential_law(struct law *o, const void *par, double s, double v, double t)
{
    const struct potential *p = par;
    const double slot[2] = {0, s};
    const int which = 1;
    (void)v, (void)t;
    *o = (struct law){0};
    o->f = expr_slopes(p->expr, &o->ks, slot, &which, 1);
    o->ks = 0 - o->ks;
}

static void potential_mean(struct law *o, const void *par, double s0, double s1)
{
    const struct potential *p = par;
    const double a[2] = {0, s0}, b[2] = {0, s1};
    o->f = expr_mean(&o->ks, &(struct expr_way){p->expr, a, b, 2}, 1);
    o->ks *= -2;
}

static bool potential_bends(const void *par, double s0, double s1)
{
    const struct potential *p = par;
    const double a[2] = {0, s0}, b[2] = {0, s1};
    return expr_bends(&(struct expr_way){p->expr, a, b, 2});
}

static int potential_sides(double *side, const void *par, double s)
{
    const struct potential *p = par;
    const double slot[2] = {0, s};
    return expr_sides(side, p->expr, side ? slot : NULL);
}

const struct force_kind force_potential = {.name = "potential",
                                           .brief = "an expression of the measure that it acts along",
                                           .size = sizeof(struct potential),
                                           .law = potential_law,
                                           .mean = potential_mean,
                                           .sides = potential_sides,
                                           .bends = potential_bends};
