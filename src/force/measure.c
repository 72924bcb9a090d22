/* measure.c -- see measure.h */
#include "force/measure.h"

#include <math.h>
#include <string.h>

#include "la/rot.h"
#include "la/vec3.h"

void measures_build(struct measures *o, const struct model *m, const struct sweep_ops *ops, struct arena *life)
{
    o->model = m;
    o->ops = ops;
    o->drawn = arena_take(life, (size_t)m->nmeasure, sizeof *o->drawn);
    o->stood = TAKE(life, double, m->nmeasure);
    o->ahead = TAKE(life, double, m->nmeasure);
    o->went = TAKE(life, double, m->nmeasure);
    o->seen = TAKE(life, double, m->nmeasure);
    o->passed = TAKE(life, double, m->nmeasure);
    for (int i = 0; i < m->nmeasure; i++) {
        o->went[i] = o->passed[i] = NAN;
        if (m->measure[i].type != MEASURE_ANGLE) continue;
        m3_tmulm(o->drawn[i], m->body[m->measure[i].a.body].R, m->body[m->measure[i].b.body].R);
        o->turns = o->turns || m->space == 3;
    }
}

/* x_b - x_a and its rate; the points are the action's. */
static void apart(double *d, double *rate, struct action *o, const struct measures *m, const struct sweep *s,
                  const struct model_measure *def)
{
    double va[3], vb[3];
    m->ops->point(s, o->at_a, va, def->a.body, def->a.p);
    m->ops->point(s, o->at_b, vb, def->b.body, def->b.p);
    v3_diff(d, o->at_b, o->at_a);
    v3_diff(rate, vb, va);
}

static void distance(struct action *o, const struct measures *m, const struct sweep *s, const struct model_measure *def)
{
    double d[3], rate[3];
    apart(d, rate, o, m, s, def);
    o->s = v3_norm(d);
    v3_scale(o->dir, o->s > 0 ? 1 / o->s : 0, d);
    o->rate = v3_dot(o->dir, rate);
}

static void displacement(struct action *o, const struct measures *m, const struct sweep *s,
                         const struct model_measure *def)
{
    double d[3], rate[3], turned[3];
    struct pose a;
    apart(d, rate, o, m, s, def);
    m->ops->pose(s, &a, def->a.body);
    m3_mul(o->dir, a.R, def->axis);
    v3_cross(turned, a.w, d);
    v3_take(rate, turned);
    o->s = v3_dot(o->dir, d);
    o->rate = v3_dot(o->dir, rate);
    v3_copy(o->at_a, o->at_b);
}

/* The twist of `turn`, by the quaternion (w, x), about e, and its gradient in the axes that e is in. */
static double twist_angle(double *dir, const double *turn, const double *e)
{
    double q[4];
    quat_of_matrix(q, turn);
    const double w = q[0], *x = q + 1;
    double y = v3_dot(e, x), across[3], size = 1 / (w * w + y * y);
    v3_cross(across, x, e);
    for (int i = 0; i < 3; i++) dir[i] = (w * w * e[i] + w * across[i] + y * x[i]) * size;
    return 2 * atan2(y, w);
}

/* Of b in axes of a. */
static void angle_on(struct action *o, const struct pose *a, const struct pose *b, const double *drawn,
                     const double *axis)
{
    double R[9], turn[9], dir[3];
    m3_tmulm(R, a->R, b->R);
    m3_mulmt(turn, R, drawn);
    o->s = twist_angle(dir, turn, axis);
    m3_mul(o->dir, a->R, dir);
    v3_copy(o->dir_a, o->dir);
}

/* Of Q = R_b (R_a drawn)', in the world. */
static void angle_in_world(struct action *o, const struct pose *a, const struct pose *b, const double *drawn,
                           const double *axis)
{
    double R[9], Q[9];
    m3_mulm(R, a->R, drawn);
    m3_mulmt(Q, b->R, R);
    o->s = twist_angle(o->dir, Q, axis);
    m3_tmul(o->dir_a, Q, o->dir);
}

static void angle(struct action *o, const struct measures *m, const struct sweep *s, const struct model_measure *def,
                  const double *drawn, double stood, double ahead)
{
    struct pose a, b;
    m->ops->pose(s, &a, def->a.body);
    m->ops->pose(s, &b, def->b.body);
    o->turning = true;
    if (m->model->space == 2) {
        v3_copy(o->dir, def->axis);
        v3_copy(o->dir_a, o->dir);
        o->s = def->axis[2] * (b.angle - a.angle) + ahead;
    } else {
        (def->in_world ? angle_in_world : angle_on)(o, &a, &b, drawn, def->axis);
        o->s = angle_near(o->s, stood);
    }
    o->rate = v3_dot(o->dir, b.w) - v3_dot(o->dir_a, a.w);
}

void measure_at(struct action *o, const struct measures *m, const struct sweep *s, int i, const double *q,
                const double *v)
{
    const struct model_measure *def = &m->model->measure[i];
    o->turning = false;
    o->body_a = def->a.body;
    o->body_b = def->b.body;
    switch (def->type) {
    case MEASURE_COORDINATE:
        o->s = q[def->iq];
        o->rate = v[def->iv];
        break;
    case MEASURE_DISTANCE:
        distance(o, m, s, def);
        break;
    case MEASURE_DISPLACEMENT:
        displacement(o, m, s, def);
        break;
    case MEASURE_ANGLE:
        angle(o, m, s, def, m->drawn[i], s == m->view ? m->seen[i] : m->stood[i], m->ahead[i]);
        break;
    }
}

void measures_begin(struct measures *o, const struct sweep *s)
{
    for (int i = 0; i < o->model->nmeasure && o->model->flattened; i++) {
        struct action act;
        if (o->model->measure[i].type != MEASURE_ANGLE) continue;
        measure_at(&act, o, s, i, NULL, NULL);
        o->ahead[i] += angle_near(act.s, o->stood[i]) - act.s;
    }
}

void measures_turned(struct measures *o, const struct sweep *s, double dt)
{
    double *stood = s == o->view ? o->seen : o->stood, *went = s == o->view ? o->passed : o->went;
    for (int i = 0; i < o->model->nmeasure; i++) {
        struct action act;
        if (o->model->measure[i].type != MEASURE_ANGLE || o->model->space == 2) continue;
        measure_at(&act, o, s, i, NULL, NULL);
        const double before = isnan(went[i]) ? act.rate : went[i];
        const double now = angle_near(act.s, stood[i] + dt * (before + act.rate) / 2);
        if (!isfinite(now)) continue;
        stood[i] = now;
        went[i] = act.rate;
    }
}

void measures_look(struct measures *o, const struct sweep *view)
{
    o->view = view;
    memcpy(o->seen, o->stood, sizeof *o->seen * (size_t)o->model->nmeasure);
    memcpy(o->passed, o->went, sizeof *o->passed * (size_t)o->model->nmeasure);
}

void measures_set(struct measures *o, int i, double x)
{
    o->stood[i] = x;
}

void measures_recall(struct measures *o, struct recall *r)
{
    if (!o->turns) return;
    recall_list(r, "stood", o->stood, o->model->nmeasure);
    recall_list(r, "went", o->went, o->model->nmeasure);
}

void action_push(const struct measures *m, struct sweep *s, const struct action *o, double f)
{
    double on_a[3], on_b[3];
    v3_scale(on_a, -f, o->turning ? o->dir_a : o->dir);
    v3_scale(on_b, f, o->dir);
    if (o->turning) {
        m->ops->twist(s, o->body_a, on_a);
        m->ops->twist(s, o->body_b, on_b);
    } else {
        m->ops->push(s, o->body_a, o->at_a, on_a);
        m->ops->push(s, o->body_b, o->at_b, on_b);
    }
}

struct row row_make(int n, struct arena *life)
{
    return (struct row){
        .k = TAKE(life, int, n), .on = TAKE(life, bool, n), .x = TAKE(life, double, n), .g = TAKE(life, double, n)};
}

void row_clear(struct row *o)
{
    for (int i = 0; i < o->n; i++) {
        o->x[o->k[i]] = 0;
        o->on[o->k[i]] = false;
    }
    o->n = 0;
}

void row_add_body(struct row *o, const struct measures *m, const struct sweep *s, int body, const double *at,
                  const double *dir, double scale)
{
    static const double nowhere[3];
    const int *path;
    int n = m->ops->path(s, &path, body);
    m->ops->row(s, o->g, body, 0, at ? at : nowhere, at ? dir : NULL, at ? NULL : dir);
    for (int i = 0; i < n; i++) row_add(o, path[i], scale * o->g[i]);
}

void row_add_measure(struct row *o, const struct measures *m, const struct sweep *s, const struct action *act, int i)
{
    if (m->model->measure[i].type == MEASURE_COORDINATE) {
        row_add(o, m->model->measure[i].iv, 1);
        return;
    }
    row_add_body(o, m, s, act->body_b, act->turning ? NULL : act->at_b, act->dir, 1);
    row_add_body(o, m, s, act->body_a, act->turning ? NULL : act->at_a, act->turning ? act->dir_a : act->dir, -1);
}
