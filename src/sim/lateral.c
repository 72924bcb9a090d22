/* lateral.c -- see lateral.h */
#include "sim/lateral.h"

#include <math.h>
#include <string.h>

#include "engine/motion.h"
#include "la/eigen.h"
#include "sim/parts.h"

static const double SMALL = 1e-5; /* of usual sizes: differences */
static const double GROWN = 3;    /* a push has grown 20 times */
enum { SPARSE = 16 };             /* steps between two looks, at least */

void lateral_open(struct sim *sim, struct arena *life)
{
    struct lateral *o = &sim->lateral;
    o->t = NAN;
    o->last = -INFINITY;
    if (!sim->whole) return;
    o->whole = system_build(sim->whole, life);
    const struct ode2 *ode = system_ode2(o->whole);
    double **vector[] = {&o->v, &o->a, &o->r, &o->dx};
    o->from = sim->from_whole;
    o->at = TAKE(life, int, ode->n);
    for (int i = 0; i < ode->n; i++)
        if (o->from[system_place(o->whole, i)] < 0) o->at[o->n++] = i;
    o->q = TAKE(life, double, ode->nq);
    o->near = TAKE(life, double, ode->nq);
    for (int i = 0; i < 4; i++) *vector[i] = TAKE(life, double, ode->n);
    o->K = TAKE_MATRIX(life, double, o->n, o->n);
    o->M = TAKE_MATRIX(life, double, o->n, o->n);
    o->X = TAKE_MATRIX(life, double, o->n, o->n);
    o->all = TAKE_MATRIX(life, double, ode->n, ode->n);
    o->lambda = TAKE(life, double, o->n);
}

/* Independent rates and accelerations, of what is left out 0. */
static void gather(double *to, const struct lateral *o, const double *from)
{
    const struct ode2 *ode = system_ode2(o->whole);
    for (int i = 0; i < ode->n; i++) {
        const int k = o->from[system_place(o->whole, i)];
        to[i] = k < 0 ? 0 : from[k];
    }
}

/* The whole system where the run stands. */
static void follow(struct sim *sim)
{
    struct lateral *o = &sim->lateral;
    struct ode2 *ode = system_ode2(o->whole);
    for (int i = 0; i < sim->whole->n; i++) o->q[i] = o->from[i] < 0 ? 0 : sim->x.q[o->from[i]];
    for (int i = 0; i < sim->model->nmeasure; i++) {
        double x, rate;
        if (sim->model->measure[i].type != MEASURE_ANGLE) continue;
        system_measure(sim->system, &x, &rate, i);
        system_set_measure(o->whole, i, x);
    }
    gather(o->v, o, system_rates(sim->system));
    if (ode->chart && ode->chart->rechart(ode, o->q, o->v, sim->x.t)) gather(o->v, o, system_rates(sim->system));
    gather(o->a, o, system_accelerations(sim->system));
}

static bool fill_stiffness(struct sim *sim)
{
    struct lateral *o = &sim->lateral;
    const struct ode2 *ode = system_ode2(o->whole);
    const struct instant x = {.t = sim->x.t, .q = o->near, .v = o->v, .a = o->a, .ta = sim->x.t, .tb = sim->x.t};
    struct trouble why;
    for (int j = 0; j < o->n; j++)
        for (int side = -1; side <= 1; side += 2) {
            const double h = SMALL * ode2_usual(ode, o->at[j]);
            zero(o->dx, ode->n);
            o->dx[o->at[j]] = side * h;
            motion_point(ode, o->near, o->q, o->dx, 1, sim->x.t);
            if (ode->ops->resid(ode, o->r, NULL, NULL, &x, ALL, &why) != OK) return false;
            for (int i = 0; i < o->n; i++) {
                double *K = &o->K[i + (size_t)o->n * (size_t)j];
                *K = side < 0 ? -o->r[o->at[i]] : (*K + o->r[o->at[i]]) / (2 * h);
            }
        }
    return true;
}

static bool fill_masses(struct sim *sim)
{
    struct lateral *o = &sim->lateral;
    const struct ode2 *ode = system_ode2(o->whole);
    struct trouble why;
    if (ode->ops->mass(ode, o->all, o->q, sim->x.t, ALL, &why) != OK) return false;
    for (int j = 0; j < o->n; j++)
        for (int i = 0; i < o->n; i++) o->M[i + o->n * j] = o->all[o->at[i] + (size_t)ode->n * (size_t)o->at[j]];
    return true;
}

/* The least eigenvalue; *at: the coordinate that moves most there. */
static double least(struct lateral *o, int *at)
{
    const int n = o->n;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) o->K[j + n * i] = o->K[i + n * j] = .5 * (o->K[j + n * i] + o->K[i + n * j]);
    if (eigen_general(o->lambda, o->X, o->K, o->M, n) >= 0) return 0;
    *at = 0;
    for (int i = 1; i < n; i++)
        if (fabs(o->X[i]) > fabs(o->X[*at])) *at = i;
    return o->lambda[0];
}

static int body_of(const struct sim *sim, int place)
{
    const struct model *m = sim->whole;
    for (int i = 1; i < m->nbody; i++)
        for (int k = 0; k < m->body[i].nmode; k++)
            if (m->body[i].mode_v[k] == place) return i;
    return 0;
}

static void grow(struct sim *sim, double lambda, int at, double dt)
{
    struct lateral *o = &sim->lateral;
    if (!(lambda < 0)) {
        o->growth = 0;
        return;
    }
    if (o->growth == 0) o->since = sim->x.t;
    o->growth += sqrt(-lambda) * dt;
    if (!(o->growth > GROWN)) return;
    o->t = o->since;
    o->body = body_of(sim, system_place(o->whole, o->at[at]));
}

void lateral_note(struct sim *sim)
{
    struct lateral *o = &sim->lateral;
    const double dt = fabs(sim->x.t - o->last);
    int at = 0;
    if (!isnan(o->t) || dt < SPARSE * fabs(sim->last_h)) return;
    o->last = sim->x.t;
    if (record_evaluate(sim, EVALUATE_ACCELERATION) != OK) return;
    follow(sim);
    if (!fill_stiffness(sim) || !fill_masses(sim)) return;
    const double lambda = least(o, &at);
    grow(sim, lambda, at, isfinite(dt) ? dt : 0);
}

void lateral_recall(struct sim *sim, struct recall *r)
{
    if (!sim->whole) return;
    recall_within(r, "lateral");
    recall_one(r, "last", sim->lateral.last);
    recall_one(r, "growth", sim->lateral.growth);
    recall_one(r, "since", sim->lateral.since);
    recall_one(r, "t", sim->lateral.t);
    recall_one(r, "body", sim->lateral.body);
    recall_without(r);
}

void warn_of_lateral(struct sim *sim)
{
    const struct lateral *o = &sim->lateral;
    if (!sim->whole || isnan(o->t)) return;
    sim_warn(
        sim,
        "'%.60s' is stepped in the plane of the scene and does not stand there behind t = %.6g s: the least push out "
        "of the plane makes it buckle; 'effects: {out_of_plane: true}' and an imperfection show what it does then "
        "[W-effect]",
        sim->model->body[o->body].name, o->t);
}
