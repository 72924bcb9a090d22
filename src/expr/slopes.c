/* slopes.c -- slopes of an expression by forward differentiation, in WIDE directions at a time. */
#include <string.h>

#include "expr/expr.h"

enum { WIDE = 4 };

struct number {
    double x, d[WIDE]; /* value, slopes */
};

static struct number constant(double x)
{
    return (struct number){.x = x};
}

static struct number variable(const double *slot, int index, const int *which, int n)
{
    struct number x = {.x = slot[index]};
    for (int i = 0; i < n; i++) x.d[i] = which[i] == index;
    return x;
}

static bool still(const struct number *x)
{
    for (int i = 0; i < WIDE; i++)
        if (x->d[i] != 0) return false;
    return true;
}

static void slope(struct number *x, double f, double f1)
{
    x->x = f;
    for (int i = 0; i < WIDE; i++) x->d[i] = x->d[i] == 0 ? 0 : f1 * x->d[i];
}

static void slope2(struct number *x, const struct number *y, double f, double fa, double fb)
{
    x->x = f;
    for (int i = 0; i < WIDE; i++) x->d[i] = (x->d[i] == 0 ? 0 : fa * x->d[i]) + (y->d[i] == 0 ? 0 : fb * y->d[i]);
}

#define chain(x, f, f1, f2) slope(x, f, f1)
#define chain2(x, y, f, fa, fb, faa, fab, fbb) slope2(x, y, f, fa, fb)
#include "expr/pass.h"

double expr_slopes(const struct expr *e, double *d, const double *slot, const int *which, int n)
{
    if (n == 0) return expr_value(e, slot);
    struct number stack[EXPR_STACK + 1];
    int i = 0;
    do {
        int m = n - i < WIDE ? n - i : WIDE;
        pass(stack, e, slot, which + i, m);
        memcpy(d + i, stack[0].d, (size_t)m * sizeof *d);
        i += WIDE;
    } while (i < n);
    return stack[0].x;
}
