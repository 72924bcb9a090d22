/* law.c -- laws along a measure.
 *
 * Over an interval of length h between q_a and q_b that is passed with velocity v (the midpoint rule), a
 * stored energy V is kept to round-off when the force does the work -(V_b - V_a):
 *
 *  - along a measure, f = -(V(s_b) - V(s_a))/(s_b - s_a); the midpoint force if V is quadratic;
 *  - a distance's direction is scaled by 2 s/(s_a + s_b), s at the middle: of two points that move on straight
 *    lines, s (s_b^2 - s_a^2)/2 = (x_b - x_a) . (change of x_b - x_a) s, the work is exact so, and the
 *    force stays on the line of the points, which keeps both momenta;
 *  - what is left is of third order and made by rotations: a remainder E of work, see remainder.c.
 *
 * With g the row of a measure, r = ... - g' f gives
 *
 *     K += g' ks g,   C += g' kv g
 *
 * exactly for joint coordinates.  For other measures the change of g itself is left out (it counts
 * with the force, not with the stiffness), but for the part of a pulled distance that holds the string taut,
 * with J the rows of the relative velocity of its points, u its direction, L its length:
 *
 *     K += J' (-f/L) (I - u u') J,   f < 0. */
#include <float.h>
#include <math.h>

#include "force/parts.h"
#include "la/vec3.h"

/* A law's force and slopes at the measure s and rate of the instant, or over the interval between the ends. */
static void law_over(struct law *o, double *dissipative, const struct force_kind *kind, const void *par, bool linear,
                     double s, double rate, const double *end, double t)
{
    if (end && linear) s = .5 * (end[0] + end[1]);
    kind->law(o, par, s, rate, t);
    *dissipative = kind->dissipative ? kind->dissipative(par, s, rate, t) : 0;
    if (!end || linear) return;
    kind->mean(o, par, end[0], end[1]);
    if (kind->beside) *dissipative = kind->beside(par, o->f, s, rate);
    o->f += *dissipative;
}

void tell_change(double *dk, const struct part_of *p, double ks, bool sharp)
{
    const double size = fmax(fabs(ks), fabs(p->kref));
    if (size > 0) *dk = fmax(*dk, fabs(ks - p->kref) / size);
    if (sharp && *dk < SHARP) *dk += SHARP;
}

/* An angle in space that came round from pi to -pi. */
static bool past_half_turn(const struct elements *e, const struct model_measure *def, const double *end)
{
    return def->type == MEASURE_ANGLE && e->model->space == 3 && fabs(end[1] - end[0]) > 3;
}

/* The measure at both ends of the step, of a law that stores; else NULL. A coordinate's are read here, into at[2]. */
static const double *ends_of_step(double *at, const struct part_of *p, const struct model_measure *def,
                                  const struct instant *x)
{
    if (!x->qa || !x->qb || !p->stores) return NULL;
    if (def->type != MEASURE_COORDINATE) return p->ends ? p->end : NULL;
    at[0] = x->qa[def->iq], at[1] = x->qb[def->iq];
    return at;
}

static void load(struct elements *e, struct sweep *s, struct part_of *p, const struct loading *to,
                 const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct model_measure *def = &e->model->measure[f->measure];
    const bool along = def->type == MEASURE_COORDINATE;
    struct action act;
    struct law law;
    double lost, coordinate_end[2];
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    const double *end = ends_of_step(coordinate_end, p, def, x);
    if (end && past_half_turn(e, def, end)) end = NULL;
    law_over(&law, &lost, f->kind, f->par, p->linear, act.s, act.rate, end, x->t);
    if (along) {
        to->r[def->iv] -= law.f;
    } else {
        double kept = law.f - lost, stretch = 1;
        if (end && def->type == MEASURE_DISTANCE && end[0] + end[1] > 0) stretch = 2 * act.s / (end[0] + end[1]);
        action_push(&e->measures, s, &act, stretch * kept + lost);
        if (end)
            give_remainder(e, s, to->r, p, kept * (end[1] - end[0] - stretch * act.rate * (x->tb - x->ta)),
                           fabs(kept) * (fabs(end[0]) + fabs(end[1])), act.at_a, act.at_b, x);
    }
    if (to->w) {
        to->w[POWER_DAMPER] += lost * act.rate;
        if (!p->stores) to->w[POWER_EXTERNAL] += (law.f - lost) * act.rate;
    }
    if (to->dk && !p->linear) tell_change(to->dk, p, law.ks, end && f->kind->sharp && law.f != 0);
    if (to->effect) *to->effect = (struct effect){.force = law.f, .elongation = act.s, .power = law.f * act.rate};
}

/* (I - u u') as the sum of two squares of directions across u. */
static void across(double *x, double *y, const double *u, int space)
{
    const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int least = space == 2                ? 2
                : fabs(u[0]) < fabs(u[1]) ? (fabs(u[0]) < fabs(u[2]) ? 0 : 2)
                                          : (fabs(u[1]) < fabs(u[2]) ? 1 : 2);
    v3_cross(x, axis[least], u);
    v3_scale(x, 1 / v3_norm(x), x);
    v3_cross(y, u, x);
}

static void taut(struct elements *e, const struct sweep *s, double *K, const struct action *act, double f)
{
    double dir[2][3];
    if (!K || !(f < 0) || !(act->s > 0)) return;
    across(dir[0], dir[1], act->dir, e->model->space);
    for (int i = 0; i < e->model->space - 1; i++) {
        row_between(&e->row, e, s, act->body_a, act->at_a, act->body_b, act->at_b, dir[i]);
        outer(e, K, &e->row, &e->row, -f / act->s);
    }
}

static void slopes(struct elements *e, struct sweep *s, struct part_of *p, double *K, double *C,
                   const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct model_measure *def = &e->model->measure[f->measure];
    struct action act;
    struct law law;
    double lost, coordinate_end[2];
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    const double *end = ends_of_step(coordinate_end, p, def, x);
    law_over(&law, &lost, f->kind, f->par, p->linear, act.s, act.rate, end, x->t);
    if (!x->looks) p->kref = law.ks;
    row_clear(&e->row);
    row_add_measure(&e->row, &e->measures, s, &act, f->measure);
    outer(e, K, &e->row, &e->row, law.ks);
    outer(e, C, &e->row, &e->row, law.kv);
    if (def->type == MEASURE_DISTANCE) taut(e, s, K, &act, law.f);
}

static void diagonal(struct elements *e, struct part_of *p, double *d, double cc, double ck, const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct model_measure *def = &e->model->measure[f->measure];
    const double end[2] = {x->qa && x->qb ? x->qa[def->iq] : 0, x->qa && x->qb ? x->qb[def->iq] : 0};
    struct law law;
    double lost;
    law_over(&law, &lost, f->kind, f->par, p->linear, x->q[def->iq], x->v ? x->v[def->iv] : 0,
             x->qa && x->qb && p->stores ? end : NULL, x->t);
    p->kref = law.ks;
    d[def->iv] += cc * law.kv + ck * law.ks;
}

static double measured(const struct elements *e, const struct sweep *s, const struct model_force *f, const double *q,
                       const double *v)
{
    struct action act;
    measure_at(&act, &e->measures, s, f->measure, q, v);
    return act.s;
}

static double at_end(const struct elements *e, const struct sweep *there, const struct model_force *f, const double *q,
                     const double *v, double *strain)
{
    (void)strain;
    return measured(e, there, f, q, v);
}

/* What the measure takes out of the energy on its way from p->stood to s. */
static double taken(const struct part_of *p, const struct model_force *f, double s)
{
    struct law mean;
    f->kind->mean(&mean, f->par, p->stood, s);
    return mean.f * (s - p->stood);
}

static double stored(const struct elements *e, const struct sweep *s, const struct part_of *p, const double *q,
                     const double *v)
{
    const struct model_force *f = &e->model->force[p->force];
    const double x = measured(e, s, f, q, v);
    return p->sums ? p->V - taken(p, f, x) : f->kind->stored(f->par, x);
}

/* Energy is counted from where the measure is 0, or from the start where that is out of reach. */
static void follow(struct elements *e, const struct sweep *s, struct part_of *p, const struct instant *x, bool begins)
{
    const struct model_force *f = &e->model->force[p->force];
    const double to = measured(e, s, f, x->q, x->v);
    if (begins) p->stood = p->V = 0;
    if (p->sums) {
        const double V = p->V - taken(p, f, to);
        p->pole = !begins && (p->pole || !isfinite(V));
        if (isfinite(V)) p->V = V;
    }
    p->came = begins ? to : p->stood;
    p->stood = to;
}

static bool pole(struct elements *e, const struct sweep *s, const struct part_of *p, const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    return !isfinite(taken(p, f, measured(e, s, f, x->q, x->v)));
}

bool law_bent(const struct elements *e, const struct part_of *p)
{
    const struct model_force *f = &e->model->force[p->force];
    return p->bends && f->kind->bends(f->par, p->came, p->stood);
}

static void sort(struct part_of *p, const struct model *m, const struct model_force *f)
{
    const struct model_measure *def = &m->measure[f->measure];
    const bool along = def->type == MEASURE_COORDINATE;
    const bool straight = along || (def->type == MEASURE_ANGLE && m->space == 2);
    struct affine law;
    p->stores = f->kind->mean;
    p->sums = p->stores && !f->kind->stored;
    p->poles = p->sums;
    p->bends = f->kind->bends;
    p->follows = p->sums || p->bends;
    p->linear = f->kind->affine && f->kind->affine(&law, f->par);
    p->diagonal = along;
    p->ends = p->stores && !along && !(straight && p->linear);
    p->nside = f->kind->sides ? f->kind->sides(NULL, f->par, 0) : 0;
}

static double place(double *rate, const struct elements *e, const struct sweep *s, const struct model_force *f,
                    const double *q, const double *v)
{
    struct action act;
    measure_at(&act, &e->measures, s, f->measure, q, v);
    *rate = act.rate;
    return act.s;
}

static void sides(double *side, double *force, struct elements *e, const struct sweep *s, const struct part_of *p,
                  const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    double rate;
    const double at = place(&rate, e, s, f, x->q, x->v);
    struct law law;
    f->kind->law(&law, f->par, at, rate, x->t);
    (void)f->kind->sides(side, f->par, f->kind->rate ? rate : at);
    for (int i = 0; i < p->nside; i++) force[i] = law.f;
}

const struct element_kind element_law = {.sort = sort,
                                         .sides = sides,
                                         .load = load,
                                         .slopes = slopes,
                                         .diagonal = diagonal,
                                         .stored = stored,
                                         .end = at_end,
                                         .place = place,
                                         .follow = follow,
                                         .pole = pole};
