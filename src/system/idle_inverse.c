/* idle_inverse.c -- M^-1 at a posture, by articulated bodies where these go; see idle.h */
#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "system/idle_parts.h"

static bool dense_inverse(struct inverse *o, const double *q, double t, struct arena *scratch)
{
    enum { MOST = 2000 };
    const int n = o->ode->n;
    struct trouble why;
    if (n > MOST) return false;
    o->L = TAKE_MATRIX(scratch, double, n, n);
    return o->ode->ops->mass(o->ode, o->L, q, t, ALL, &why) == OK && dense_cholesky(o->L, n, n) < 0;
}

bool inverse_build(struct inverse *o, const struct ode2 *ode, const double *q, double t, struct arena *scratch)
{
    struct trouble why;
    *o = (struct inverse){.ode = ode};
    if (ode->direct && ode->direct->stiffen) {
        o->F = arena_take(scratch, 1, ode->direct->factor_size);
        if (ode->direct->stiffen(ode, o->F, TAKE(scratch, double, ode->n), q, t, ALL, &why) == OK) return true;
    }
    return dense_inverse(o, q, t, scratch);
}

void inverse_apply(const struct inverse *o, double *x)
{
    if (o->L)
        dense_cholesky_solve(o->L, x, o->ode->n, o->ode->n);
    else
        o->ode->direct->solve(o->ode, o->F, x);
}

double idle_dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

double idle_scatter(unsigned i)
{
    unsigned x = (i + 1) * 2654435761u;
    x ^= x >> 15;
    x *= 2246822519u;
    x ^= x >> 13;
    return (double)(x >> 8) / 8388608 - 1;
}
