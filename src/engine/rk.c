/* rk.c -- see rk.h */
#include "engine/rk.h"

#include "engine/motion.h"
#include "la/dense.h"

void rk_open(struct rk *k, int stages, const struct ode2 *ode, struct accel *accel, struct arena *life)
{
    k->stages = stages;
    k->ode = ode;
    k->accel = accel;
    for (int i = 0; i < stages; i++) {
        k->du[i] = TAKE(life, double, ode->n);
        k->dv[i] = TAKE(life, double, ode->n);
    }
    k->u = TAKE(life, double, ode->n);
    k->v = TAKE(life, double, ode->n);
    k->q = TAKE(life, double, ode->nq);
}

static void add(double *y, double s, const double *x, int n)
{
    if (s == 0) return;
    for (int i = 0; i < n; i++) y[i] += s * x[i];
}

enum status rk_stage(struct rk *k, const struct rk_table *table, int i, const double *q0, const double *v0, double t,
                     double h, struct trouble *why)
{
    int n = k->ode->n;
    zero(k->u, n);
    copy(k->v, v0, n);
    for (int j = 0; j < i; j++) {
        add(k->u, h * table->a[i][j], k->du[j], n);
        add(k->v, h * table->a[i][j], k->dv[j], n);
    }
    motion_point(k->ode, k->q, q0, k->u, 1, t + table->c[i] * h);
    motion_rate(k->ode, k->du[i], k->q, q0, k->u, k->v, t + table->c[i] * h);
    return accel_solve(k->accel, k->dv[i], k->w[i], k->q, k->v, t + table->c[i] * h, why);
}

void rk_end(struct rk *k, const struct rk_table *table, double *q, double *v, double *work, double t, double h)
{
    int n = k->ode->n;
    zero(k->u, n);
    for (int j = 0; j < table->stages; j++) {
        add(k->u, h * table->b[j], k->du[j], n);
        add(v, h * table->b[j], k->dv[j], n);
        for (int c = 0; work && c < POWER_CHANNELS; c++) work[c] += h * table->b[j] * k->w[j][c];
    }
    motion_point(k->ode, q, q, k->u, 1, t + h);
}
