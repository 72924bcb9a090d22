/* elements.c -- loads and powers of the elements, Q_F of (2-1).
 *
 * Over an interval of length h between q_a and q_b that is passed with velocity v (the midpoint rule), a
 * stored energy V is kept to round-off when the force does the work -(V_b - V_a):
 *
 *  - along a measure, f = -(V(s_b) - V(s_a))/(s_b - s_a); the midpoint force if V is quadratic;
 *  - a distance's direction is scaled by 2 s/(s_a + s_b), s at the middle: of two points that move on straight
 *    lines, s (s_b^2 - s_a^2)/2 = (x_b - x_a) . (change of x_b - x_a) s, the work is exact so, and the
 *    force stays on the line of the points, which keeps both momenta;
 *  - what is left is of third order and made by rotations: a remainder E of work goes to the rotations u_k that
 *    change the measure, Q_k += E u_k / (h u.u); where only flexible bodies change it, to their coordinates.
 *
 * Gonzalez, J. Nonlinear Sci. 6 (1996) 449, with this choice of the direction dq. */
#include "force/elements.h"

#include <float.h>
#include <math.h>

#include "force/parts.h"
#include "la/vec3.h"

/* --- laws -------------------------------------------------------------------------------------- */

/* Ends closer than this, relative to the measure, leave more round-off than digits in V_b - V_a. */
static const double near = 1e-5;

/* The mean of -dV/ds over the interval, and its slope along the middle, s_b = 2 s - s_a: the difference quotient,
 * 2 (f_b - f)/(s_b - s_a); between near ends Simpson's rule, (f_a + 4 f + f_b)/6, which meets it. */
static void mean_force(struct law *o, const struct force_kind *kind, const void *par, const double *end, double t)
{
    struct law a, m, b;
    const double ds = end[1] - end[0];
    kind->law(&b, par, end[1], 0, t);
    if (fabs(ds) > near * (fabs(end[0]) + fabs(end[1]))) {
        o->f = -(kind->stored(par, end[1]) - kind->stored(par, end[0])) / ds;
        o->ks = -2 * (b.f - o->f) / ds;
        return;
    }
    kind->law(&a, par, end[0], 0, t);
    kind->law(&m, par, end[0] + .5 * ds, 0, t);
    o->f = (a.f + 4 * m.f + b.f) / 6;
    o->ks = (2 * m.ks + b.ks) / 3;
}

void law_over(struct law *o, double *dissipative, const struct force_kind *kind, const void *par, bool linear, double s,
              double rate, const double *end, double t)
{
    if (end && linear) s = .5 * (end[0] + end[1]);
    kind->law(o, par, s, rate, t);
    *dissipative = kind->dissipative ? kind->dissipative(par, s, rate, t) : 0;
    if (!end || linear) return;
    mean_force(o, kind, par, end, t);
    o->f += *dissipative;
}

/* Relative change of a slope. */
static double change(double k, double kref)
{
    double size = fmax(fabs(k), fabs(kref));
    return size > 0 ? fabs(k - kref) / size : 0;
}

void give_to_rotations(double *r, const struct part_of *p, double E, double scale, const struct instant *x)
{
    double h = x->tb - x->ta, vv = 0;
    if (fabs(E) <= 64 * DBL_EPSILON * scale) return;
    for (int i = 0; i < p->nturn; i++) vv += x->v[p->turn[i]] * x->v[p->turn[i]];
    if (!(vv > 0) || h == 0) return;
    for (int i = 0; i < p->nturn; i++) r[p->turn[i]] -= E / (h * vv) * x->v[p->turn[i]];
}

/* An angle in space that came round from pi to -pi. */
static bool past_half_turn(const struct elements *e, const struct model_measure *def, const double *end)
{
    return def->type == MEASURE_ANGLE && e->model->space == 3 && fabs(end[1] - end[0]) > 3;
}

static void load_law(struct elements *e, struct sweep *s, struct part_of *p, double *r, double *w, double *dk,
                     struct effect *effect, const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct model_measure *def = &e->model->measure[f->measure];
    const double *end = NULL,
                 coordinate_end[2] = {x->qa && x->qb ? x->qa[def->iq] : 0, x->qa && x->qb ? x->qb[def->iq] : 0};
    struct action act;
    struct law law;
    double lost;
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    bool along = def->type == MEASURE_COORDINATE;
    if (x->qa && x->qb && f->kind->stored) end = along ? coordinate_end : p->ends ? p->end : NULL;
    if (end && past_half_turn(e, def, end)) end = NULL;
    law_over(&law, &lost, f->kind, f->par, p->linear, act.s, act.rate, end, x->t);
    if (along) {
        r[def->iv] -= law.f;
    } else {
        double kept = law.f - lost, stretch = 1;
        if (end && def->type == MEASURE_DISTANCE && end[0] + end[1] > 0) stretch = 2 * act.s / (end[0] + end[1]);
        action_push(&e->measures, s, &act, stretch * kept + lost);
        if (end)
            give_to_rotations(r, p, kept * (end[1] - end[0] - stretch * act.rate * (x->tb - x->ta)),
                              fabs(kept) * (fabs(end[0]) + fabs(end[1])), x);
    }
    if (w) {
        w[POWER_DAMPER] += lost * act.rate;
        if (!f->kind->stored) w[POWER_EXTERNAL] += (law.f - lost) * act.rate;
    }
    if (dk && !p->linear) *dk = fmax(*dk, change(law.ks, p->kref));
    if (effect) *effect = (struct effect){law.f, act.s, law.f * act.rate};
}

static void load_plain(const struct plain *p, double *r, double *w, struct effect *effect, const struct instant *x)
{
    double s = x->q[p->iq], v = x->v[p->iv], f = p->preload - p->k * (s - p->rest) - p->c * v;
    r[p->iv] -= f;
    if (w) w[POWER_DAMPER] -= p->c * v * v;
    if (effect) effect[p->force] = (struct effect){f, s, f * v};
}

/* --- signals and loads -------------------------------------------------------------------------- */

void read_slots(struct elements *e, const struct sweep *s, const struct model_force *f, const struct instant *x)
{
    struct action act;
    e->slot[0] = x->t;
    for (int i = 0; i < f->nslot; i++) {
        const struct model_slot *slot = &f->slot[i];
        switch (slot->type) {
        case SLOT_TIME:
            e->slot[i] = x->t;
            break;
        case SLOT_Q:
            e->slot[i] = x->q[slot->index];
            break;
        case SLOT_V:
            e->slot[i] = x->v[slot->index];
            break;
        case SLOT_MEASURE:
        case SLOT_MEASURE_RATE:
            measure_at(&act, &e->measures, s, slot->index, x->q, x->v);
            e->slot[i] = slot->type == SLOT_MEASURE ? act.s : act.rate;
            break;
        }
    }
}

static void load_value(struct elements *e, struct sweep *s, const struct model_force *f, double *r, double *w,
                       struct effect *effect, const struct instant *x)
{
    const struct model_measure *def = &e->model->measure[f->measure];
    struct action act;
    read_slots(e, s, f, x);
    double value = signal_value(&f->value[0], e->slot);
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    if (def->type == MEASURE_COORDINATE)
        r[def->iv] -= value;
    else
        action_push(&e->measures, s, &act, value);
    if (w) w[POWER_EXTERNAL] += value * act.rate;
    if (effect) *effect = (struct effect){value, act.s, value * act.rate};
}

static void load_body(struct elements *e, struct sweep *s, const struct model_force *f, double *w,
                      struct effect *effect, const struct instant *x)
{
    double value[3], at[3], v[3], power;
    struct pose b;
    read_slots(e, s, f, x);
    for (int i = 0; i < 3; i++) value[i] = signal_value(&f->value[i], e->slot);
    if (f->torque || f->body_axes) e->ops->pose(s, &b, f->b.body);
    if (f->body_axes) {
        double turned[3];
        m3_mul(turned, b.R, value);
        v3_copy(value, turned);
    }
    if (f->torque) {
        e->ops->twist(s, f->b.body, value);
        power = v3_dot(value, b.w);
    } else {
        e->ops->point(s, at, v, f->b.body, f->b.p);
        e->ops->push(s, f->b.body, at, value);
        power = v3_dot(value, v);
    }
    if (w) w[POWER_EXTERNAL] += power;
    if (effect) *effect = (struct effect){v3_norm(value), 0, power};
}

/* --- all of a class ----------------------------------------------------------------------------- */

void look_at_end(struct elements *e, const struct instant *x, int end, enum rate cls)
{
    const double *q = end ? x->qb : x->qa;
    e->ops->move(e->there, q, x->v, FAST);
    for (int i = first_of(e->nother, cls); i < last_of(e->nother, cls); i++) {
        struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        if (!p->ends) continue;
        if (f->type == FORCE_BUSHING) {
            struct bush b;
            bushing_at(&b, e, e->there, f);
            p->end[end] = bushing_stored(&b, f->par);
        } else {
            struct action act;
            measure_at(&act, &e->measures, e->there, f->measure, q, x->v);
            p->end[end] = act.s;
        }
    }
}

void elements_load(struct elements *e, struct sweep *s, double *r, double *w, double *dk, struct effect *effect,
                   const struct instant *x, enum rate cls)
{
    for (int i = first_of(e->nplain, cls); i < last_of(e->nplain, cls); i++) load_plain(&e->plain[i], r, w, effect, x);
    if (x->qa && x->qb && e->ends[cls]) {
        look_at_end(e, x, 0, cls);
        look_at_end(e, x, 1, cls);
    }
    for (int i = first_of(e->nother, cls); i < last_of(e->nother, cls); i++) {
        struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        struct effect *seen = effect ? &effect[p->force] : NULL;
        switch (f->type) {
        case FORCE_LAW:
            load_law(e, s, p, r, w, dk, seen, x);
            break;
        case FORCE_VALUE:
            load_value(e, s, f, r, w, seen, x);
            break;
        case FORCE_LOAD:
            load_body(e, s, f, w, seen, x);
            break;
        case FORCE_BUSHING:
            bushing_load(e, s, p, r, w, seen, x);
            break;
        }
    }
}

double elements_stored(const struct elements *e, const struct sweep *s, const double *q, const double *v)
{
    double V = 0;
    for (int i = 0; i < e->nplain[ALL]; i++) {
        const struct plain *p = &e->plain[i];
        double d = q[p->iq] - p->rest;
        V += d * (.5 * p->k * d - p->preload);
    }
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct model_force *f = &e->model->force[e->other[i].force];
        if (f->type == FORCE_BUSHING) {
            struct bush b;
            bushing_at(&b, e, s, f);
            V += bushing_stored(&b, f->par);
        } else if (f->type == FORCE_LAW && f->kind->stored) {
            struct action act;
            measure_at(&act, &e->measures, s, f->measure, q, v);
            V += f->kind->stored(f->par, act.s);
        }
    }
    return V;
}

void elements_measure(const struct elements *e, const struct sweep *s, double *value, double *rate, int measure,
                      const double *q, const double *v)
{
    struct action act;
    measure_at(&act, &e->measures, s, measure, q, v);
    *value = act.s;
    *rate = act.rate;
}

bool elements_turn(const struct elements *e)
{
    return e->measures.turns;
}

void elements_stand(struct elements *e, int measure, double x)
{
    measures_stand(&e->measures, measure, x);
}

void elements_turned(struct elements *e, const struct sweep *s, double t)
{
    measures_turned(&e->measures, s, t);
}
