/* slopes.c -- K = dr/dq and C = dr/dv of the elements.
 *
 * With g the row of a measure, r = ... - g' f gives
 *
 *     K += g' ks g,   C += g' kv g
 *
 * exactly for joint coordinates.  For other measures the change of g itself is left out (it counts
 * with the force, not with the stiffness), but for the part of a pulled distance that holds the string taut,
 * with J the rows of the relative velocity of its points, u its direction, L its length:
 *
 *     K += J' (-f/L) (I - u u') J,   f < 0.
 *
 * A value that reads x_j puts -g' (df/dx_j) (dx_j/dq) into K, or C for a rate: unsymmetric as it is.  A
 * bushing has the rows of d and W: K += Jd' k Jd + Jw' T kr T' Jw, C with c, cr.  Columns are along
 * quasi-displacements: of a quaternion, x' = (w u + x cross u)/2, w' = -x.u/2. */
#include <math.h>

#include "force/parts.h"
#include "la/vec3.h"

static void outer_reduced(const struct reduction *to, double *A, const struct row *row, const struct row *column,
                          double scale)
{
    const double *y = to->y, *z = row == column ? to->y : to->z;
    to->row(to->self, to->y, row);
    if (row != column) to->row(to->self, to->z, column);
    for (int j = 0; j < to->n; j++)
        for (int i = 0; z[j] != 0 && i < to->n; i++) A[i + (size_t)to->n * (size_t)j] += scale * y[i] * z[j];
}

/* A += scale row' column */
static void outer(const struct elements *e, double *A, const struct row *row, const struct row *column, double scale)
{
    const size_t n = (size_t)e->model->n;
    if (!A || scale == 0) return;
    if (e->to) {
        outer_reduced(e->to, A, row, column, scale);
        return;
    }
    for (int j = 0; j < column->n; j++)
        for (int i = 0; i < row->n; i++)
            A[row->k[i] + n * (size_t)column->k[j]] += scale * row->x[row->k[i]] * column->x[column->k[j]];
}

/* A += scale e_k e_k' */
static void along(struct elements *e, double *A, int k, double scale)
{
    if (A && !e->to) A[(size_t)k * (size_t)(e->model->n + 1)] += scale;
    if (!e->to) return;
    row_clear(&e->row);
    row_add(&e->row, k, 1);
    outer(e, A, &e->row, &e->row, scale);
}

/* Row of the relative velocity of two bodies along dir, at a point each or turning (NULL). */
static void row_between(struct row *o, const struct elements *e, const struct sweep *s, int a, const double *at_a,
                        int b, const double *at_b, const double *dir)
{
    row_clear(o);
    row_add_body(o, &e->measures, s, b, at_b, dir, 1);
    row_add_body(o, &e->measures, s, a, at_a, dir, -1);
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

static void slopes_law(struct elements *e, const struct sweep *s, struct part_of *p, double *K, double *C,
                       const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct model_measure *def = &e->model->measure[f->measure];
    const double coordinate_end[2] = {x->qa && x->qb ? x->qa[def->iq] : 0, x->qa && x->qb ? x->qb[def->iq] : 0};
    const bool along = def->type == MEASURE_COORDINATE;
    struct action act;
    struct law law;
    double lost;
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    const double *end = NULL;
    if (x->qa && x->qb && f->kind->stored) end = along ? coordinate_end : p->ends ? p->end : NULL;
    law_over(&law, &lost, f->kind, f->par, p->linear, act.s, act.rate, end, x->t);
    p->kref = law.ks;
    row_clear(&e->row);
    row_add_measure(&e->row, &e->measures, s, &act, f->measure);
    outer(e, K, &e->row, &e->row, law.ks);
    outer(e, C, &e->row, &e->row, law.kv);
    if (def->type == MEASURE_DISTANCE) taut(e, s, K, &act, law.f);
}

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

static void slopes_value(struct elements *e, const struct sweep *s, const struct model_force *f, double *K, double *C,
                         const struct instant *x)
{
    struct action act;
    if (f->nslot <= 1) return;
    read_slots(e, s, f, x);
    signal_slopes(&f->value[0], e->slope, e->slot, e->which, f->nslot - 1);
    measure_at(&act, &e->measures, s, f->measure, x->q, x->v);
    row_clear(&e->row);
    row_add_measure(&e->row, &e->measures, s, &act, f->measure);
    for (int i = 1; i < f->nslot; i++) add_slot(e, s, K, C, &f->slot[i], e->slope[i - 1], x);
}

static void slopes_load(struct elements *e, const struct sweep *s, const struct model_force *f, double *K, double *C,
                        const struct instant *x)
{
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

static void slopes_bushing(struct elements *e, const struct sweep *s, const struct model_force *f, double *K, double *C)
{
    const struct bushing *par = f->par;
    const int a = f->a.body, b = f->b.body;
    struct bush o;
    bushing_at(&o, e, s, f);
    for (int i = 0; i < 3; i++) {
        double dir[3];
        row_between(&e->row, e, s, a, o.at, b, o.at, o.E + 3 * i);
        outer(e, K, &e->row, &e->row, par->k[i]);
        outer(e, C, &e->row, &e->row, par->c[i]);
        row_between(&e->row, e, s, a, NULL, b, NULL, o.E + 3 * i);
        outer(e, C, &e->row, &e->row, par->cr[i]);
        m3_mul(dir, o.E, o.T + 3 * i); /* phi_i' = (column i of T) . W */
        row_between(&e->row, e, s, a, NULL, b, NULL, dir);
        outer(e, K, &e->row, &e->row, par->kr[i]);
    }
}

void elements_slopes(struct elements *e, struct sweep *s, double *K, double *C, const struct instant *x, enum rate cls)
{
    if (x->qa && x->qb && e->ends[cls]) {
        look_at_end(e, x, 0, cls);
        look_at_end(e, x, 1, cls);
    }
    for (int i = first_of(e->nplain, cls); i < last_of(e->nplain, cls); i++) {
        const struct plain *p = &e->plain[i];
        along(e, K, p->iv, p->k);
        along(e, C, p->iv, p->c);
    }
    for (int i = first_of(e->nother, cls); i < last_of(e->nother, cls); i++) {
        struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        if (f->type == FORCE_LAW) slopes_law(e, s, p, K, C, x);
        if (f->type == FORCE_VALUE) slopes_value(e, s, f, K, C, x);
        if (f->type == FORCE_LOAD) slopes_load(e, s, f, K, C, x);
        if (f->type == FORCE_BUSHING) slopes_bushing(e, s, f, K, C);
    }
    row_clear(&e->row);
    row_clear(&e->column);
}

void elements_slopes_reduced(struct elements *e, struct sweep *s, double *K, double *C, const struct instant *x,
                             enum rate cls, const struct reduction *to)
{
    e->to = to;
    elements_slopes(e, s, K, C, x, cls);
    e->to = NULL;
}

/* Loads and values of time alone have no slopes. */
bool elements_are_diagonal(const struct elements *e)
{
    for (int i = 0; i < e->nother[ALL]; i++) {
        const struct model_force *f = &e->model->force[e->other[i].force];
        if (f->type == FORCE_BUSHING) return false;
        if (f->type == FORCE_LAW && e->model->measure[f->measure].type != MEASURE_COORDINATE) return false;
        if (f->type != FORCE_LAW)
            for (int k = 0; k < f->nslot; k++)
                if (f->slot[k].type != SLOT_TIME) return false;
    }
    return true;
}

void elements_diagonal(struct elements *e, double *d, double cc, double ck, const struct instant *x)
{
    for (int i = 0; i < e->nplain[ALL]; i++) d[e->plain[i].iv] += cc * e->plain[i].c + ck * e->plain[i].k;
    for (int i = 0; i < e->nother[ALL]; i++) {
        struct part_of *p = &e->other[i];
        const struct model_force *f = &e->model->force[p->force];
        if (f->type != FORCE_LAW) continue;
        const struct model_measure *def = &e->model->measure[f->measure];
        const double end[2] = {x->qa && x->qb ? x->qa[def->iq] : 0, x->qa && x->qb ? x->qb[def->iq] : 0};
        struct law law;
        double lost;
        law_over(&law, &lost, f->kind, f->par, p->linear, x->q[def->iq], x->v ? x->v[def->iv] : 0,
                 x->qa && x->qb && f->kind->stored ? end : NULL, x->t);
        p->kref = law.ks;
        d[def->iv] += cc * law.kv + ck * law.ks;
    }
}
