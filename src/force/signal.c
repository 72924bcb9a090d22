/* signal.c -- forces given as values: along a measure, or as components at a point or on a body.
 *
 * A value that reads x_j puts -g' (df/dx_j) (dx_j/dq) into K, or C for a rate: unsymmetric as it is.  Columns are along
 * quasi-displacements: of a quaternion, x' = (w u + x cross u)/2, w' = -x.u/2. */
#include <string.h>

#include "force/parts.h"
#include "la/vec3.h"

/* --- loads --------------------------------------------------------------------------------------- */

/* The time as one of the values that has a corner there wants it. */
static double time_of(const struct model_force *f, double t)
{
    double there = t;
    for (int i = 0; i < 3 && there == t; i++) there = signal_time(&f->value[i], t);
    return there;
}

/* Values of the slots of a force. */
static void read_slots(struct elements *e, const struct sweep *s, const struct model_force *f, const struct instant *x)
{
    struct action act;
    e->slot[0] = f->corners ? time_of(f, x->t) : x->t;
    for (int i = 1; i < f->nslot; i++) {
        const struct model_slot *slot = &f->slot[i];
        switch (slot->type) {
        case SLOT_TIME:
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

static void load_value(struct elements *e, struct sweep *s, struct part_of *p, const struct loading *to,
                       const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct model_measure *def = &e->model->measure[f->measure];
    struct action act;
    read_slots(e, s, f, x);
    double value = signal_value(&f->value[0], e->slot);
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    if (def->type == MEASURE_COORDINATE)
        to->r[def->iv] -= value;
    else
        action_push(&e->measures, s, &act, value);
    if (to->w) to->w[POWER_EXTERNAL] += value * act.rate;
    if (to->effect) *to->effect = (struct effect){.force = value, .elongation = act.s, .power = value * act.rate};
}

static void load_body(struct elements *e, struct sweep *s, struct part_of *p, const struct loading *to,
                      const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
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
    if (to->w) to->w[POWER_EXTERNAL] += power;
    if (to->effect) *to->effect = (struct effect){.force = v3_norm(value), .power = power};
}

/* --- slopes -------------------------------------------------------------------------------------- */

/* Row of a position along quasi-displacements. */
static void row_position(struct row *o, const struct model *m, const double *q, int iq)
{
    const struct model_coordinate *c = &m->coordinate[iq];
    const struct model_joint *j = &m->joint[c->joint];
    if (c->iv >= 0) {
        row_add(o, c->iv, 1);
        return;
    }
    const int part = c->k - (j->nq - 4), *iv = j->iv + j->nv - 3, *at = j->iq + j->nq - 4;
    const double w = q[at[0]], x[3] = {q[at[1]], q[at[2]], q[at[3]]};
    for (int k = 0; k < 3; k++) {
        double unit[3] = {0, 0, 0}, d[3];
        unit[k] = 1;
        v3_cross(d, x, unit);
        row_add(o, iv[k], part == 0 ? -.5 * x[k] : .5 * (w * unit[part - 1] + d[part - 1]));
    }
}

/* K or C -= row' slope (what slot i reads)'; row holds the measure's or the load's row. */
static void add_slot(struct elements *e, const struct sweep *s, double *K, double *C, const struct model_slot *slot,
                     double slope, const struct instant *x)
{
    struct action act;
    row_clear(&e->column);
    switch (slot->type) {
    case SLOT_TIME:
        return;
    case SLOT_Q:
        row_position(&e->column, e->model, x->q, slot->index);
        break;
    case SLOT_V:
        row_add(&e->column, slot->index, 1);
        break;
    case SLOT_MEASURE:
    case SLOT_MEASURE_RATE:
        measure_at(&act, &e->measures, s, slot->index, x->q, x->v);
        row_add_measure(&e->column, &e->measures, s, &act, slot->index);
        break;
    }
    bool rate = slot->type == SLOT_V || slot->type == SLOT_MEASURE_RATE;
    outer(e, rate ? C : K, &e->row, &e->column, -slope);
}

static void slopes_value(struct elements *e, struct sweep *s, struct part_of *p, double *K, double *C,
                         const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    struct action act;
    if (f->nslot <= 1) return;
    read_slots(e, s, f, x);
    signal_slopes(&f->value[0], e->slope, e->slot, e->which, f->nslot - 1);
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    row_clear(&e->row);
    row_add_measure(&e->row, &e->measures, s, &act, f->measure);
    for (int i = 1; i < f->nslot; i++) add_slot(e, s, K, C, &f->slot[i], e->slope[i - 1], x);
}

static void slopes_body(struct elements *e, struct sweep *s, struct part_of *p, double *K, double *C,
                        const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    double at[3], v[3];
    struct pose b;
    if (f->nslot <= 1) return;
    e->ops->point(s, at, v, f->b.body, f->b.p);
    e->ops->pose(s, &b, f->b.body);
    for (int c = 0; c < 3; c++) {
        double unit[3] = {c == 0, c == 1, c == 2}, dir[3];
        read_slots(e, s, f, x);
        signal_slopes(&f->value[c], e->slope, e->slot, e->which, f->nslot - 1);
        m3_mul(dir, b.R, unit);
        row_clear(&e->row);
        row_add_body(&e->row, &e->measures, s, f->b.body, f->torque ? NULL : at, f->body_axes ? dir : unit, 1);
        for (int i = 1; i < f->nslot; i++) add_slot(e, s, K, C, &f->slot[i], e->slope[i - 1], x);
    }
}

/* --- poles and jumps ----------------------------------------------------------------------------- */

void value_read(struct elements *e, const struct sweep *s, struct part_of *p, const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    read_slots(e, s, f, x);
    memcpy(p->last, p->now, sizeof(double) * (size_t)f->nslot);
    memcpy(p->now, e->slot, sizeof(double) * (size_t)f->nslot);
}

static void sides(double *side, double *force, struct elements *e, const struct sweep *s, const struct part_of *p,
                  const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    read_slots(e, s, f, x);
    for (int i = 0; i < 3; i++) {
        if (p->sided[i] == 0) continue;
        const double value = signal_value(&f->value[i], e->slot);
        (void)signal_sides(side, &f->value[i], e->slot);
        side += p->sided[i];
        for (int k = 0; k < p->sided[i]; k++) *force++ = value;
    }
}

/* Does one of the values grow without bound on the straight way to x? */
static bool pole(struct elements *e, const struct sweep *s, const struct part_of *p, const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    bool met = false;
    read_slots(e, s, f, x);
    for (int i = 0; i < 3; i++) met |= signal_pole(&f->value[i], p->now, e->slot, f->nslot);
    return met;
}

static void follow(struct elements *e, const struct sweep *s, struct part_of *p, const struct instant *x, bool begins)
{
    if (begins) value_read(e, s, p, x);
    p->pole = !begins && (p->pole || pole(e, s, p, x));
    value_read(e, s, p, x);
}

/* Of time alone there are no slopes. */
static void sort(struct part_of *p, const struct model *m, const struct model_force *f)
{
    (void)m;
    p->diagonal = true;
    for (int k = 0; k < f->nslot; k++)
        if (f->slot[k].type != SLOT_TIME) p->diagonal = false;
    for (int i = 0; i < 3; i++) {
        p->poles |= signal_may_have_poles(&f->value[i]);
        p->reads |= signal_may_leap(&f->value[i]);
        p->sided[i] = signal_sides(NULL, &f->value[i], NULL);
        p->nside += p->sided[i];
    }
    p->follows = p->poles;
    p->reads |= p->poles;
}

const struct element_kind element_value = {
    .sort = sort, .sides = sides, .load = load_value, .slopes = slopes_value, .follow = follow, .pole = pole};
const struct element_kind element_load = {
    .sort = sort, .sides = sides, .load = load_body, .slopes = slopes_body, .follow = follow, .pole = pole};
