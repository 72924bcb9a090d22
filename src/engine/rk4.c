/* rk4.c -- the classical Runge-Kutta method of order 4 (Kutta 1901), steps of h; see rk.h */
#include <math.h>

#include "base/scalar.h"
#include "engine/adaptive.h"
#include "engine/single.h"
#include "engine/stepped.h"

static const struct rk_table table = {
    .stages = 4,
    .c = {0, .5, .5, 1},
    .a = {{0}, {.5}, {0, .5}, {0, 0, 1}},
    .b = {1. / 6, 1. / 3, 1. / 3, 1. / 6},
};

struct rk4 {
    struct rk rk;
    struct single keep;
};

static void open(struct stepper *s, struct arena *life)
{
    struct rk4 *m = TAKE(life, struct rk4, 1);
    rk_open(&m->rk, table.stages, s->ode, s->accel, life);
    single_open(&m->keep, s->ode, life);
    s->self = m;
}

static enum status one(struct stepper *s, struct state *x, double h, double t1, struct trouble *why)
{
    struct rk4 *m = s->self;
    for (int i = 0; i < table.stages; i++) TRY(rk_stage(&m->rk, &table, i, x->q, x->v, x->t, h, why));
    rk_end(&m->rk, &table, x->q, x->v, s->work, x->t, h);
    copy(x->a, m->rk.dv[3], s->ode->n);
    x->t = t1;
    s->fresh = 0;
    return OK;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct rk4 *m = s->self;
    return single_steps(&m->keep, s, x, h, ratio, to, one, why);
}

/* ---- by its error: a step, and once more in two halves --------------------------------------------------------- */

struct doubled {
    double *q, *v, *a, *dx; /* the end in one step; accelerations at the end in two; difference of both */
    double work[POWER_CHANNELS];
    double before[POWER_CHANNELS], after[POWER_CHANNELS]; /* power at both ends */
};

static void open_doubled(struct stepper *s, struct adaptive *m, struct arena *life)
{
    struct doubled *o = m->own = TAKE(life, struct doubled, 1);
    o->q = TAKE(life, double, s->ode->nq);
    double **vector[] = {&o->v, &o->a, &o->dx};
    for (int i = 0; i < 3; i++) *vector[i] = TAKE(life, double, s->ode->n);
    m->ahead = o->a;
}

/* From q, v in place, with the accelerations a there. */
static enum status part(struct adaptive *m, double *q, double *v, const double *a, double *work, double t, double h,
                        struct trouble *why)
{
    const struct ode2 *o = m->rk.ode;
    copy(m->rk.dv[0], a, o->n);
    zero(m->rk.u, o->n);
    motion_rate(o, m->rk.du[0], q, q, m->rk.u, v, t);
    for (int i = 1; i < table.stages; i++) TRY(rk_stage(&m->rk, &table, i, q, v, t, h, why));
    rk_end(&m->rk, &table, q, v, work, t, h);
    return OK;
}

/* The slopes at q, v: accelerations, and the power of the next step's first stage. */
static enum status slopes(struct adaptive *m, double *a, const double *q, const double *v, double t,
                          struct trouble *why)
{
    TRY(rk_stage(&m->rk, &table, 0, q, v, t, 0, why));
    copy(a, m->rk.dv[0], m->rk.ode->n);
    return OK;
}

static enum status both(struct adaptive *m, double t, double h, struct trouble *why)
{
    struct doubled *o = m->own;
    const struct ode2 *ode = m->rk.ode;
    zero(o->work, POWER_CHANNELS);
    copy(o->q, m->q, ode->nq);
    copy(o->v, m->v, ode->n);
    copy(m->q1, m->q, ode->nq);
    copy(m->v1, m->v, ode->n);
    TRY(part(m, o->q, o->v, m->a, NULL, t, h, why));
    TRY(part(m, m->q1, m->v1, m->a, o->work, t, h / 2, why));
    TRY(slopes(m, o->a, m->q1, m->v1, t + h / 2, why));
    TRY(part(m, m->q1, m->v1, o->a, o->work, t + h / 2, h / 2, why));
    return slopes(m, o->a, m->q1, m->v1, t + h, why);
}

/* The two halves are off by a 15th of what the whole is off from them. */
static double difference(const struct stepper *s, struct adaptive *m)
{
    struct doubled *o = m->own;
    double most = 0;
    motion_diff(s->ode, o->dx, m->q1, o->q);
    for (int i = 0; i < s->ode->n; i++) {
        const double eq = fabs(o->dx[i]) / 15 / adaptive_scale_q(s, i);
        const double ev = fabs(m->v1[i] - o->v[i]) / 15 / adaptive_scale_v(s, i);
        most = worse(worse(most, eq), ev);
    }
    return most;
}

static enum status attempt_doubled(struct stepper *s, struct adaptive *m, double *err, double t, double h,
                                   struct trouble *why)
{
    struct doubled *o = m->own;
    double *power = m->rk.w[0];
    copy(o->before, power, POWER_CHANNELS);
    const enum status status = both(m, t, h, why);
    copy(o->after, power, POWER_CHANNELS);
    copy(power, o->before, POWER_CHANNELS); /* those of the start, for another trial */
    TRY(status);
    *err = difference(s, m);
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
}

static void take_doubled(struct stepper *s, struct adaptive *m, double h)
{
    struct doubled *o = m->own;
    (void)h;
    for (int c = 0; c < POWER_CHANNELS; c++) m->work[c] += o->work[c];
    adaptive_travel(s, m, o->dx);
    copy(m->a, o->a, s->ode->n);
    copy(m->rk.w[0], o->after, POWER_CHANNELS);
}

static void off_doubled(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h)
{
    const struct doubled *o = m->own;
    (void)h;
    for (int i = 0; i < s->ode->n; i++) {
        position[i] = o->dx[i] / 15;
        velocity[i] = (m->v1[i] - o->v[i]) / 15;
    }
}

static double shrink_doubled(const struct adaptive *m, double err)
{
    (void)m;
    return larger(.2, .8 * pow(err, -.25));
}

static double grow_doubled(const struct adaptive *m, double err)
{
    return smaller(4, larger(.2, .9 * pow(larger(err, 1e-8), -.7 / 4) * pow(m->old, .4 / 4)));
}

/* Cubics of Hermite. */
static void between_doubled(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x)
{
    const struct doubled *o = m->own;
    const double h = m->t1 - m->t0, y = 1 - x, part = x * x * (3 - 2 * x);
    adaptive_cubic(s, m, u, o->dx, o->v, x);
    for (int i = 0; i < s->ode->n; i++)
        v[i] = m->v0[i] + part * (m->v[i] - m->v0[i]) + h * x * y * (y * m->a0[i] - x * o->a[i]);
}

static const struct adaptive_scheme doubling = {.stages = 4,
                                                .order = 5,
                                                .plain = true,
                                                .open = open_doubled,
                                                .attempt = attempt_doubled,
                                                .take = take_doubled,
                                                .shrink = shrink_doubled,
                                                .grow = grow_doubled,
                                                .between = between_doubled,
                                                .off = off_doubled,
                                                .drifts = 1};

/* The sixth term of exp(i omega h). */
static double late(const struct step_options *o)
{
    (void)o;
    return 1. / 120;
}

#define RK4                                                                                                            \
    .name = "rk4", .brief = "classical Runge-Kutta, explicit, one rate", .order = 4, .late = late, .keys = adaptive_keys
static const struct stepper_kind tolerant = {
    RK4, .formulas = &doubling, .adaptive = 1, .open = adaptive_open, .step = adaptive_step, .recall = adaptive_recall};
const struct stepper_kind step_rk4 = {RK4, .tolerant = &tolerant, .points = 1, .open = open, .step = step};
