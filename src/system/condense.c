/* condense.c -- see condense.h: building, and what others ask. */
#include <math.h>

#include "la/vec3.h"
#include "system/condense_parts.h"

static void build_component(struct condense *o, int i, struct arena *life)
{
    const struct model *m = o->model;
    struct component *c = &o->component[i];
    c->k = TAKE(life, int, o->nt);
    c->row = TAKE(life, int, o->loops->nrow);
    for (int r = 0; r < o->loops->nrow; r++)
        if (m->loop[o->loops->row[r].loop].component == i) c->row[c->nrow++] = r;
    for (int k = 0; k < o->nt; k++) {
        if (o->owner[k] != i) continue;
        o->column[k] = c->nk;
        c->k[c->nk++] = k;
    }
    const int most = c->nrow > c->nk ? c->nrow : c->nk, size = c->nrow * c->nk;
    int drives = 0;
    for (int r = 0; r < c->nrow; r++) drives += m->loop[o->loops->row[c->row[r]].loop].drive != NULL;
    c->lead = TAKE(life, int, drives);
    c->s0 = TAKE(life, double, drives);
    c->T0 = TAKE(life, double, drives * c->nrow);
    double **of[] = {&c->F, &c->G, &c->G0, &c->whole};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) *of[k] = TAKE(life, double, size);
    c->A = TAKE(life, double, c->nrow * c->nrow);
    c->kept = TAKE(life, int, c->nrow);
    c->dep = TAKE(life, int, most);
    c->ind = TAKE(life, int, c->nk);
    c->prow = TAKE(life, int, most);
    c->pcol = TAKE(life, int, most);
    c->x = TAKE(life, double, most);
    c->weight = TAKE(life, double, c->nk);
    c->dependent = TAKE(life, bool, c->nk);
    c->loop_of = TAKE(life, int, c->nk);
    for (int l = o->model->nloop - 1; l >= 0; l--)
        for (int k = 0; m->loop[l].component == i && k < o->loops->nk[l]; k++)
            c->loop_of[o->column[o->loops->k[l][k]]] = l;
}

/* The farthest that elastic coordinate k moves a node of its body, per unit [m]. */
static double reach(const struct flex_body *f, int k)
{
    double most = 0;
    for (int i = 0; i < f->nnode; i++) most = fmax(most, v3_norm(f->node[i].phi + 3 * k));
    return most;
}

/* A usual change of each coordinate: one radian, or what moves something by the mechanism's length. */
static void build_sizes(struct condense *o)
{
    const struct model *m = o->model;
    for (int i = 0; i < o->nt; i++) o->size[i] = 1;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        int slides = j->type == JOINT_PRISMATIC || j->type == JOINT_CYLINDRICAL ? 1
                     : j->type == JOINT_PLANAR                                  ? 2
                     : j->type == JOINT_FREE                                    ? m->space
                                                                                : 0;
        int from = j->type == JOINT_CYLINDRICAL ? 1 : 0;
        for (int k = from; k < from + slides; k++) o->size[j->iv[k]] = o->loops->length;
    }
    for (int i = 1; i < m->nbody; i++)
        for (int k = 0; k < m->body[i].nmode; k++) {
            double per_unit = reach(m->body[i].flex, k);
            if (per_unit > 0) o->size[m->body[i].mode_v[k]] = o->loops->length / per_unit;
        }
}

static void build_components(struct condense *o, struct arena *life)
{
    const struct model *m = o->model;
    o->ncomponent = m->ncomponent;
    o->component = TAKE(life, struct component, m->ncomponent);
    o->column = TAKE(life, int, o->nt);
    o->owner = TAKE(life, int, o->nt);
    o->size = TAKE(life, double, o->nt);
    for (int i = 0; i < o->nt; i++) o->owner[i] = -1;
    for (int l = 0; l < m->nloop; l++)
        for (int k = 0; k < o->loops->nk[l]; k++) o->owner[o->loops->k[l][k]] = m->loop[l].component;
    build_sizes(o);
    for (int i = 0; i < o->ncomponent; i++) build_component(o, i, life);
}

static void build_workspace(struct condense *o, struct arena *life)
{
    double **of[] = {&o->vt, &o->at, &o->rt, &o->zero, &o->dx, &o->dxs, &o->v, &o->way, &o->aside, &o->mean};
    double **places[] = {&o->q, &o->base, &o->G0_at, &o->qtry, &o->side[0], &o->side[1]};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) *of[i] = TAKE(life, double, o->nt + 1);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) *places[i] = TAKE(life, double, o->model->nq + 1);
    o->C = TAKE(life, double, o->loops->nrow);
    o->C2 = TAKE(life, double, o->loops->nrow);
    o->M = TAKE(life, double, o->nt * o->nt);
    o->M_side = TAKE(life, double, o->nt * o->nt);
    o->ind = TAKE(life, int, o->nt);
    o->slot = TAKE(life, int, o->nt);
    o->split = TAKE(life, int, 2 * o->nt + o->loops->nrow);
    o->bound = TAKE(life, bool, o->moves->nturn);
}

static double next_kink(const struct ode2 *ode, double t)
{
    const struct condense *o = ode->self;
    const struct model *m = o->model;
    double next = o->tree->breaks ? o->tree->breaks->next(o->tree, t) : INFINITY;
    for (int l = m->nloop - m->ndrive; l < m->nloop; l++) next = fmin(next, signal_next(m->loop[l].drive, t));
    return next;
}

struct condense *condense_build(const struct model *m, const struct sweep_ops *sweep, const struct ode2 *tree,
                                const struct moves *moves, const double *q0, const double *v0, struct arena *life)
{
    struct condense *o = TAKE(life, struct condense, 1);
    o->model = m;
    o->ops = sweep;
    o->tree = tree;
    o->moves = moves;
    o->nt = m->n;
    o->sweep = sweep->build(m, life);
    o->loops = loops_build(m, sweep, life);
    o->seen = loops_build(m, sweep, life);
    o->chart = (struct ode2_chart){.rechart = condense_rechart};
    o->breaks = (struct ode2_breaks){
        .next = next_kink, .jump = m->ndrive ? condense_jump : NULL, .corner = m->ndrive ? condense_corner : NULL};
    o->ode = (struct ode2){.nq = m->nq,
                           .ops = &condense_ops,
                           .move = &condense_move,
                           .chart = &o->chart,
                           .breaks = tree->breaks || m->ndrive ? &o->breaks : NULL,
                           .self = o};
    build_components(o, life);
    build_workspace(o, life);
    o->start.status = condense_begin(o, q0, v0);
    return o;
}

/* --- what others ask ------------------------------------------------------------------------------ */

const struct condense_start *condense_started(const struct condense *c)
{
    return &c->start;
}

const double *condense_q(const struct condense *c)
{
    return c->q;
}

const double *condense_v(const struct condense *c)
{
    return c->v;
}

const struct ode2 *condense_ode2(const struct condense *c)
{
    return &c->ode;
}

const struct loops *condense_loops(const struct condense *c)
{
    return c->loops;
}

void condense_push(struct condense *c, struct sweep *s, const double *q, const double *v, double t,
                   const double *lambda)
{
    loops_when(c->seen, t);
    loops_look(c->seen, s, q, v);
    loops_push(c->seen, s, lambda);
}

void condense_drive(const struct condense *c, double *force, double *power, int loop, const double *lambda)
{
    loops_drive(c->seen, force, power, loop, lambda);
}

void condense_reaction(const struct condense *c, double *f, double *n, int loop, const double *lambda)
{
    loops_reaction(c->seen, f, n, loop, lambda);
}

double condense_worst(struct condense *c, const double *q, double t)
{
    int row;
    loops_when(c->loops, t);
    return condense_misfit(c, &row, q);
}

int condense_place(const struct condense *c, int i)
{
    return c->ind[i];
}

bool condense_independent(const struct condense *c, int iv)
{
    return c->slot[iv] >= 0;
}

long condense_charts(const struct condense *c)
{
    return c->charts;
}

bool condense_dropped(const struct condense *o, int row)
{
    for (int i = 0; i < o->ncomponent; i++) {
        const struct component *c = &o->component[i];
        for (int r = c->nr; r < c->nrow; r++)
            if (c->row[c->kept[r]] == row) return true;
    }
    return false;
}

double condense_ratio(struct condense *o)
{
    struct trouble why;
    if (condense_factor(o, o->q, 0, &why) != OK) return 0;
    return condense_least_ratio(o);
}
