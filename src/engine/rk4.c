/* rk4.c -- the classical Runge-Kutta method of order 4 (Kutta 1901), steps of h; see rk.h */
#include "engine/rk.h"
#include "engine/single.h"

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
    return OK;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct rk4 *m = s->self;
    return single_steps(&m->keep, s, x, h, ratio, to, one, why);
}

const struct stepper_kind step_rk4 = {
    .name = "rk4",
    .brief = "classical Runge-Kutta, explicit, one rate",
    .points = 1,
    .order = 4,
    .open = open,
    .step = step,
};
