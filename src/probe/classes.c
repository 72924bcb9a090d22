/* classes.c -- see classes.h */
#include "probe/classes.h"

#include <string.h>

#include "probe/linear.h"

static const unsigned class_of[CLASSES] = {FAST, SLOW};

static void add(double *y, const double *A, const double *x, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) y[i] += A[i + (long)n * j] * x[j];
}

static enum status resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x, unsigned cls,
                         struct trouble *why)
{
    const struct classes *c = o->self;
    (void)why;
    memset(r, 0, sizeof *r * (size_t)c->n);
    for (int i = 0; w && i < POWER_CHANNELS; i++) w[i] = 0;
    if (dk) *dk = 0;
    for (int k = 0; k < CLASSES; k++) {
        if (!(cls & class_of[k])) continue;
        if (x->a) add(r, c->M[k], x->a, c->n);
        add(r, c->C[k], x->v, c->n);
        add(r, c->K[k], x->q, c->n);
    }
    return OK;
}

static void pick(double *A, double *const part[CLASSES], int n, unsigned cls)
{
    for (long i = 0; i < (long)n * n; i++) A[i] = (cls & FAST ? part[0][i] : 0) + (cls & SLOW ? part[1][i] : 0);
}

void classes_sum(double *A, double *const part[CLASSES], int n)
{
    pick(A, part, n, ALL);
}

static enum status mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    const struct classes *c = o->self;
    (void)q, (void)t, (void)why;
    pick(M, c->M, c->n, cls);
    return OK;
}

static enum status slopes(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why)
{
    const struct classes *c = o->self;
    (void)x, (void)why;
    if (K) pick(K, c->K, c->n, cls);
    if (C) pick(C, c->C, c->n, cls);
    return OK;
}

/* A system of n coordinates, the last ns of them slow, with matrices of zeros. */
static void open_empty(struct classes *o, int n, int ns, struct arena *life)
{
    static const struct ode2_ops ops = {.resid = resid, .mass = mass, .slopes = slopes};
    *o = (struct classes){.n = n, .ode = {.n = n, .ns = ns, .nq = n, .ops = &ops, .pointwise = 1, .self = o}};
    for (int k = 0; k < CLASSES; k++) {
        o->M[k] = TAKE_MATRIX(life, double, n, n);
        o->C[k] = TAKE_MATRIX(life, double, n, n);
        o->K[k] = TAKE_MATRIX(life, double, n, n);
    }
}

enum status classes_find(struct classes *o, const struct sim *sim, struct arena *life, struct trouble *why)
{
    const struct ode2 *ode = sim->stepper.ode;
    open_empty(o, ode->n, ode->ns, life);
    for (int k = 0; k < CLASSES; k++) {
        struct linear l = {.ode = ode, .q = sim->x.q, .t = sim->x.t, .n = ode->n, .cls = class_of[k]};
        TRY(linearise(&l, life, why));
        double *const of[] = {l.K, l.C, l.G, l.N};
        for (size_t i = 0; i < sizeof of / sizeof *of; i++) sim_clear_idle(sim, of[i]);
        o->M[k] = l.M;
        for (long i = 0; i < (long)l.n * l.n; i++) {
            o->K[k][i] = l.K[i] + l.N[i];
            o->C[k][i] = l.C[i] + l.G[i];
        }
    }
    return OK;
}
