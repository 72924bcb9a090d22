/* jet.c -- value, first and second derivative of an expression along one slot, by Taylor arithmetic. */
#include "expr/expr.h"

struct number {
    double x, d, dd; /* value, first and second derivative */
};

static struct number constant(double x)
{
    return (struct number){.x = x};
}

static struct number variable(const double *slot, int index, const int *which, int n)
{
    (void)n; /* 1 */
    return (struct number){slot[index], index == *which, 0};
}

static bool still(const struct number *x)
{
    return x->d == 0 && x->dd == 0;
}

/* c d; where nothing moves, c may be as large as it likes. */
static double along(double c, double d)
{
    return d == 0 ? 0 : c * d;
}

static void chain(struct number *x, double f, double f1, double f2)
{
    double d = x->d;
    *x = (struct number){f, along(f1, d), along(f1, x->dd) + along(f2 * d, d)};
}

static void chain2(struct number *x, const struct number *y, double f, double fa, double fb, double faa, double fab,
                   double fbb)
{
    double dx = x->d, dy = y->d;
    double bend = along(faa * dx, dx) + along(along(2 * fab, dx), dy) + along(fbb * dy, dy);
    *x = (struct number){f, along(fa, dx) + along(fb, dy), along(fa, x->dd) + bend + along(fb, y->dd)};
}

#include "expr/pass.h"

double expr_jet(const struct expr *e, double *d, double *dd, const double *slot, int which)
{
    struct number stack[EXPR_STACK + 1];
    pass(stack, e, slot, &which, 1);
    *d = stack[0].d;
    *dd = stack[0].dd;
    return stack[0].x;
}
