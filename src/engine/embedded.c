/* embedded.c -- see embedded.h */
#include "engine/embedded.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"

static const struct embedded_pair *pair_of(const struct adaptive *m)
{
    return (const struct embedded_pair *)m->scheme;
}

void embedded_open(struct stepper *s, struct adaptive *m, struct arena *life)
{
    const struct embedded_pair *p = pair_of(m);
    (void)life;
    m->ahead = m->rk.dv[p->table.stages - 1];
    if (p->part > 0)
        m->tolerance = smaller(1, p->part * pow(s->options.tolerance, p->power - 1)) * s->options.tolerance;
}

/* Mean square of h sum e_j k_j in scales, of so many slopes. */
static double mean_square(const struct stepper *s, const struct adaptive *m, const double *e, int stages, double h)
{
    const int n = s->ode->n;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double eq = 0, ev = 0;
        for (int j = 0; j < stages; j++) {
            eq += e[j] * m->rk.du[j][i];
            ev += e[j] * m->rk.dv[j][i];
        }
        eq *= h / adaptive_scale_q(s, i);
        ev *= h / adaptive_scale_v(s, i);
        sum += eq * eq + ev * ev;
    }
    return sum / (2 * n);
}

/* x := h sum e_j w_j of the powers. */
static void sum_works(double *x, const struct adaptive *m, const double *e, double h)
{
    double sum[POWER_CHANNELS] = {0}; /* nothing else is in it: a half of the instructions */
    for (int j = 0; j < pair_of(m)->table.stages; j++) {
        const double *w = m->rk.w[j], by = h * e[j];
        for (int c = 0; c < POWER_CHANNELS; c++) sum[c] += by * w[c];
    }
    copy(x, sum, POWER_CHANNELS);
}

static double error_of_works(struct stepper *s, const struct adaptive *m, double t, double h)
{
    const struct embedded_pair *p = pair_of(m);
    double e[POWER_CHANNELS], e2[POWER_CHANNELS], work[POWER_CHANNELS];
    sum_works(work, m, p->table.b, h);
    sum_works(e, m, p->e, h);
    if (p->e2) sum_works(e2, m, p->e2, h);
    for (int c = 0; p->e2 && c < POWER_CHANNELS; c++) {
        const double square = e[c] * e[c] + .01 * e2[c] * e2[c];
        e[c] = square > 0 ? e[c] * (fabs(e[c]) / sqrt(square)) : 0; /* they may underflow */
    }
    return adaptive_works(s, e, work, t, h);
}

static double error(const struct stepper *s, const struct adaptive *m, double h)
{
    const struct embedded_pair *p = pair_of(m);
    const int stages = p->table.stages;
    const double square = mean_square(s, m, p->e, stages, h);
    if (!p->e2) return sqrt(square);
    const double lower = mean_square(s, m, p->e2, stages, h),
                 own = square > 0 ? square / sqrt(square + .01 * lower) : 0;
    return larger(own, p->harmonic * m->tolerance * lower);
}

enum status embedded_attempt(struct stepper *s, struct adaptive *m, double *err, double t, double h,
                             struct trouble *why)
{
    const struct rk_table *table = &pair_of(m)->table;
    copy(m->rk.dv[0], m->a, s->ode->n); /* first same as last; w[0] is kept likewise */
    zero(m->rk.u, s->ode->n);
    motion_rate(s->ode, m->rk.du[0], m->q, m->q, m->rk.u, m->v, t);
    for (int i = 1; i < table->stages; i++) TRY(rk_stage(&m->rk, table, i, m->q, m->v, t, h, why));
    copy(m->q1, m->q, s->ode->nq);
    copy(m->v1, m->v, s->ode->n);
    rk_end(&m->rk, table, m->q1, m->v1, NULL, t, h);
    *err = larger(error(s, m, h), error_of_works(s, m, t, h));
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
}

void embedded_take(struct stepper *s, struct adaptive *m, double h)
{
    const struct rk_table *table = &pair_of(m)->table;
    const int n = s->ode->n, last = table->stages - 1;
    for (int j = 0; j < table->stages; j++)
        for (int c = 0; c < POWER_CHANNELS; c++) m->work[c] += h * table->b[j] * m->rk.w[j][c];
    for (int i = 0; i < n; i++) m->span[i] += m->rk.u[i];
    copy(m->a, m->rk.dv[last], n);
    copy(m->rk.w[0], m->rk.w[last], POWER_CHANNELS);
}

/* What component i of y, of slopes k[1]... and k0 at the start, has come to at x. */
static double dense(const struct embedded_pair *p, double *const *k, double k0, int i, double h, double x)
{
    const int stages = p->table.stages;
    const double y = 1 - x;
    double change = p->table.b[0] * k0, bent = 0;
    for (int j = 1; j < stages; j++) change += p->table.b[j] * k[j][i];
    for (int r = p->bends - 1; r >= 0; r--) {
        double bend = p->d[r][0] * k0;
        for (int j = 1; j < p->scheme.stages; j++) bend += p->d[r][j] * k[j][i];
        bent = (r % 2 ? x : y) * (bend + bent);
    }
    const double lead = k0 - change;
    return h * x * (change + y * (lead + x * (change - k[stages - 1][i] - lead + bent)));
}

enum status embedded_ready(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why)
{
    const struct embedded_pair *p = pair_of(m);
    for (int i = p->table.stages; i < p->scheme.stages; i++) TRY(rk_stage(&m->rk, &p->table, i, m->q, m->v, t, h, why));
    static const double MOST = .0084; /* the largest x^4 y^3 */
    const double bend = MOST * sqrt(mean_square(s, m, p->d[p->bends - 1], p->scheme.stages, h));
    *err = bend * pow(bend * s->options.tolerance, 1. / 7);
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
}

void embedded_between(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x)
{
    const double h = m->t1 - m->t0;
    for (int i = 0; i < s->ode->n; i++) {
        u[i] = dense(pair_of(m), m->rk.du, m->v0[i], i, h, x);
        v[i] = m->v0[i] + dense(pair_of(m), m->rk.dv, m->a0[i], i, h, x);
    }
}

void embedded_off(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h)
{
    const struct embedded_pair *p = pair_of(m);
    const double all = p->e2 ? sqrt(mean_square(s, m, p->e, p->table.stages, h)) : 0;
    const double by = p->less * h * (all > 0 ? error(s, m, h) / all : 1);
    for (int i = 0; i < s->ode->n; i++) {
        double du = 0, dv = 0;
        for (int j = 0; j < p->table.stages; j++) {
            du += p->e[j] * m->rk.du[j][i];
            dv += p->e[j] * m->rk.dv[j][i];
        }
        position[i] = by * du;
        velocity[i] = by * dv;
    }
}

double embedded_shrink(const struct adaptive *m, double err)
{
    const struct embedded_pair *p = pair_of(m);
    return fmax(p->least, .9 * pow(err, -p->fail));
}

double embedded_grow(const struct adaptive *m, double err)
{
    const struct embedded_pair *p = pair_of(m);
    return fmin(p->most, fmax(p->least, .9 * pow(fmax(err, 1e-10), -p->here) * pow(m->old, p->before)));
}
