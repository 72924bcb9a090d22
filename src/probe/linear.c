/* linear.c -- see linear.h */
#include "probe/linear.h"

#include <math.h>
#include <string.h>

static void displaced(const struct linear *l, double *q1, const double *dx)
{
    if (l->ode->move)
        l->ode->move->point(l->ode, q1, l->q, dx, 1, l->t);
    else
        for (int i = 0; i < l->n; i++) q1[i] = l->q[i] + dx[i];
}

/* r at rest, displaced by dx.  Of rotations it goes with turns from there and is moved back to slopes by dx: with
 * dx' = (1 + [dx]x/2) v it is (1 + [dx]x/2) r, so that N is nothing where there is a potential. */
static enum status displaced_resid(double *r, const struct linear *l, double *q1, const double *dx, const double *zero,
                                   double *work, struct trouble *why)
{
    struct instant x = {.t = l->t, .q = q1, .v = zero, .ta = l->t, .tb = l->t};
    displaced(l, q1, dx);
    TRY(l->ode->ops->resid(l->ode, r, NULL, NULL, &x, l->cls, why));
    if (!l->ode->move) return OK;
    memcpy(work, r, sizeof *work * (size_t)l->n);
    l->ode->move->rate(l->ode, r, q1, l->q, dx, work, l->t);
    return OK;
}

/* K and N by central differences, exact for cubic r: the stretch of a beam held at both ends is one.  Steps are in
 * usual changes of the coordinates: a mode of a light beam, which has unit mass, moves far per unit. */
static enum status stiffness(struct linear *l, struct arena *life, struct trouble *why)
{
    static const double step = 1e-5; /* of a usual change */
    static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1. / 12, -2. / 3, 2. / 3, -1. / 12};
    int n = l->n;
    double *q1 = TAKE(life, double, l->ode->nq), *dx = TAKE(life, double, n), *zero = TAKE(life, double, n);
    double *r = TAKE(life, double, n), *work = TAKE(life, double, n);
    for (int j = 0; j < n; j++) {
        double *K = l->K + (long)n * j;
        const double h = step * ode2_usual(l->ode, j);
        memset(K, 0, (size_t)n * sizeof *K);
        for (int k = 0; k < 4; k++) {
            dx[j] = at[k] * h;
            TRY(displaced_resid(r, l, q1, dx, zero, work, why));
            for (int i = 0; i < n; i++) K[i] += weight[k] / h * r[i];
        }
        dx[j] = 0;
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) {
            const double upper = l->K[i + j * n], lower = l->K[j + i * n];
            l->K[i + j * n] = l->K[j + i * n] = (upper + lower) / 2;
            l->N[i + j * n] = (upper - lower) / 2;
            l->N[j + i * n] = -l->N[i + j * n];
        }
    return OK;
}

/* G at a time by central differences, exact since r is quadratic in v but for friction. */
static enum status gyroscopic(double *G, const struct linear *l, double t, struct arena *life, struct trouble *why)
{
    static const double rate = 1e-2; /* usual changes a second */
    int n = l->n;
    double *v = TAKE(life, double, n), *up = TAKE(life, double, n), *down = TAKE(life, double, n);
    struct instant x = {.t = t, .q = l->q, .v = v, .ta = t, .tb = t};
    for (int j = 0; j < n; j++) {
        const double step = rate * ode2_usual(l->ode, j);
        v[j] = step;
        TRY(l->ode->ops->resid(l->ode, up, NULL, NULL, &x, l->cls, why));
        v[j] = -step;
        TRY(l->ode->ops->resid(l->ode, down, NULL, NULL, &x, l->cls, why));
        v[j] = 0;
        for (int i = 0; i < n; i++) G[i + j * n] = (up[i] - down[i]) / (2 * step);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= j; i++) {
            double g = (G[i + j * n] - G[j + i * n]) / 2;
            G[i + j * n] = g;
            G[j + i * n] = -g;
        }
    return OK;
}

/* C loses what G has of it: slopes of a force by a rate along which it does not act have both parts. */
static void symmetric(double *C, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) C[i + j * n] = C[j + i * n] = (C[i + j * n] + C[j + i * n]) / 2;
}

/* N less G'/2. */
static enum status steady(struct linear *l, struct arena *life, struct trouble *why)
{
    static const double later = 1e-6; /* [s] */
    const int nn = l->n * l->n;
    double *G = TAKE(life, double, nn), most = 0;
    for (int k = 0; k < nn; k++) most = fmax(most, fabs(l->G[k]));
    if (most == 0) return OK;
    TRY(gyroscopic(G, l, l->t + later, life, why));
    for (int k = 0; k < nn; k++) l->N[k] -= (G[k] - l->G[k]) / (2 * later);
    return OK;
}

enum status linearise(struct linear *l, struct arena *life, struct trouble *why)
{
    int n = l->n;
    double *zero = TAKE(life, double, n);
    l->M = TAKE_MATRIX(life, double, n, n);
    l->K = TAKE_MATRIX(life, double, n, n);
    l->C = TAKE_MATRIX(life, double, n, n);
    l->G = TAKE_MATRIX(life, double, n, n);
    l->N = TAKE_MATRIX(life, double, n, n);
    struct instant x = {.t = l->t, .q = l->q, .v = zero, .ta = l->t, .tb = l->t};
    TRY(l->ode->ops->mass(l->ode, l->M, l->q, l->t, l->cls, why));
    TRY(l->ode->ops->slopes(l->ode, l->K, l->C, &x, l->cls, why));
    symmetric(l->C, n);
    TRY(stiffness(l, life, why));
    TRY(gyroscopic(l->G, l, l->t, life, why));
    return steady(l, life, why);
}
