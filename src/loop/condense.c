/* condense.c -- see condense.h: building, and what others ask. */
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "loop/condense_parts.h"

static int loop_of_row(const struct condense *o, const struct part *c, int r)
{
    return o->loops->row[c->of->row[r]].loop;
}

static void build_part(struct condense *o, struct part *c, struct arena *life)
{
    enum { SMALL = 4096 }; /* numbers of C_q: below, dense is no slower, and there is room for any split */
    const int most = c->of->nrow > c->of->nk ? c->of->nrow : c->of->nk;
    const size_t size = (size_t)c->of->nrow * (size_t)c->of->nk;
    int drives = 0;
    for (int r = 0; r < c->of->nrow; r++) drives += o->model->loop[loop_of_row(o, c, r)].drive != NULL;
    c->of_dep = TAKE(life, struct entry, c->of->start[c->of->nrow]);
    c->of_ind = TAKE(life, struct entry, c->of->start[c->of->nrow]);
    c->from = TAKE(life, int, c->of->nrow + 1);
    c->loop_of = TAKE(life, int, c->of->nk);
    c->row_order = TAKE(life, int, c->of->nrow);
    component_order(o, c);
    c->lead = TAKE(life, int, drives);
    c->s0 = TAKE(life, double, drives);
    c->T0 = TAKE(life, double, drives * c->of->nrow);
    c->kept = TAKE(life, int, c->of->nrow);
    c->dep = TAKE(life, int, most);
    c->ind = TAKE(life, int, c->of->nk);
    c->place = TAKE(life, int, c->of->nk);
    c->prow = TAKE(life, int, most);
    c->pcol = TAKE(life, int, most);
    c->pivot = TAKE(life, double, most);
    c->x = TAKE(life, double, most);
    c->weight = TAKE(life, double, c->of->nk);
    if (size > SMALL) {
        c->base.F = TAKE(life, double, c->of->start[c->of->nrow]);
        c->base.swap = TAKE(life, int, c->of->nrow);
        c->probe = TAKE(life, double, c->of->nk);
        return;
    }
    c->whole = TAKE(life, double, size);
    c->A_room.size = 2 * (size_t)c->of->nrow * (size_t)c->of->nrow;
    c->G_room.size = c->G0_room.size = size;
    struct room *of[] = {&c->A_room, &c->G_room, &c->G0_room};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) of[i]->store = TAKE(life, double, of[i]->size);
}

static void build_parts(struct condense *o, struct arena *life)
{
    o->npart = o->rows.ncomponent;
    o->part = TAKE(life, struct part, o->npart);
    for (int i = 0; i < o->npart; i++) {
        o->part[i].of = &o->rows.component[i];
        build_part(o, &o->part[i], life);
    }
}

static void build_workspace(struct condense *o, struct arena *life)
{
    double **of[] = {&o->vt,  &o->at,   &o->rt, &o->va,  &o->vb,    &o->zero, &o->dx,
                     &o->dxs, &o->last, &o->v,  &o->way, &o->aside, &o->mean};
    double **places[] = {&o->q, &o->base.q, &o->qtry, &o->side[0], &o->side[1]};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) *of[i] = TAKE(life, double, o->nt + 1);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) *places[i] = TAKE(life, double, o->model->nq + 1);
    o->C = TAKE(life, double, o->loops->nrow);
    o->C2 = TAKE(life, double, o->loops->nrow);
    o->still = TAKE(life, double, o->nt);
    o->Tx = TAKE(life, double, o->nt);
    o->ind = TAKE(life, int, o->nt);
    o->slot = TAKE(life, int, o->nt);
    o->split = TAKE(life, int, 2 * o->nt + o->loops->nrow);
    o->work = TAKE(life, int, o->nt + o->loops->nrow);
    o->bound = TAKE(life, bool, o->moves->nturn);
}

/* Are columns by momentum cheaper than the tree's matrix and its congruence?  In flops, from timings; slopes of
 * flexible bodies are not of elements, which they need. */
static bool are_few(const struct condense *o)
{
    static const double COLUMN = 100; /* for each coordinate of the tree */
    const double n = o->ode.n, nt = o->nt;
    double matrix = nt * nt;
    for (int i = 0; i < o->npart; i++) matrix += (double)o->part[i].ni * o->part[i].nr * (nt + n) / 2;
    return o->elastic->n == 0 && matrix > COLUMN * (n + 1) * nt;
}

/* The number of independents is known. */
static void build_matrices(struct condense *o, struct arena *life)
{
    const size_t n = (size_t)o->ode.n, nt = (size_t)o->nt;
    o->few = are_few(o);
    if (!o->few) o->M = TAKE(life, double, nt *nt);
    o->M_side = TAKE(life, double, n *n);
    o->M_jump = TAKE(life, double, n *n);
    o->Ty = TAKE(life, double, 2 * n);
}

static void close_scratch(void *scratch)
{
    arena_close(scratch);
}

static double next_kink(const struct ode2 *ode, double t)
{
    const struct condense *o = ode->self;
    const struct model *m = o->model;
    double next = o->tree->ode.breaks ? o->tree->breaks.next(&o->tree->ode, t) : INFINITY;
    for (int l = model_first_drive(m); l < m->nloop; l++) next = fmin(next, signal_next(m->loop[l].drive, t));
    return next;
}

static double size_of(const struct ode2 *ode, int i)
{
    const struct condense *o = ode->self;
    return o->rows.size[o->ind[i]];
}

struct condense *condense_build(struct open_tree *tree, const double *q0, const double *v0, struct arena *life)
{
    struct condense *o = TAKE(life, struct condense, 1);
    const struct model *m = o->model = tree->model;
    o->tree = tree;
    o->ops = tree->ops;
    o->sweep = tree->sweep;
    o->elements = tree->elements;
    o->moves = &tree->moves;
    o->elastic = &tree->elastic;
    o->nt = m->n;
    rows_build(&o->rows, tree, life);
    o->loops = o->rows.loops;
    o->shown = loops_build(m, o->ops, life);
    o->chart = (struct ode2_chart){.rechart = condense_rechart};
    o->breaks = (struct ode2_breaks){
        .next = next_kink, .jump = m->ndrive ? condense_jump : NULL, .corner = m->ndrive ? condense_corner : NULL};
    o->ode = (struct ode2){.nq = m->nq,
                           .ops = &condense_ops,
                           .move = &condense_move,
                           .chart = &o->chart,
                           .size = size_of,
                           .breaks = tree->ode.breaks || m->ndrive ? &o->breaks : NULL,
                           .settle = tree->ode.settle ? condense_settle : NULL,
                           .pointwise = tree->ode.pointwise,
                           .self = o};
    o->life = life;
    o->scratch = arena_open();
    arena_defer(life, close_scratch, o->scratch);
    build_parts(o, life);
    build_workspace(o, life);
    o->start.status = condense_begin(o, q0, v0);
    build_matrices(o, life);
    if (o->start.status == OK) o->ode.price = condense_price(o);
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

struct ode2 *condense_ode2(struct condense *c)
{
    return &c->ode;
}

const struct loops *condense_loops(const struct condense *c)
{
    return c->loops;
}

void condense_push(struct condense *c, struct sweep *s, const double *q, double t, const double *lambda)
{
    loops_when(c->shown, t);
    loops_look(c->shown, s, q);
    loops_push(c->shown, s, lambda);
}

void condense_drive(const struct condense *c, double *force, double *power, int loop, const double *lambda)
{
    loops_drive(c->shown, force, power, loop, lambda);
}

void condense_reaction(const struct condense *c, double *f, double *n, int loop, const double *lambda)
{
    loops_reaction(c->shown, f, n, loop, lambda);
}

double condense_worst(struct condense *c, const double *q, double t)
{
    int row;
    loops_when(c->loops, t);
    return rows_misfit(c->C, &row, &c->rows, q);
}

int condense_place(const struct condense *c, int i)
{
    return c->ind[i];
}

long condense_charts(const struct condense *c)
{
    return c->charts;
}

bool condense_dropped(const struct condense *o, int row)
{
    for (int i = 0; i < o->npart; i++) {
        const struct part *c = &o->part[i];
        for (int r = c->nr; r < c->of->nrow; r++)
            if (c->of->row[c->kept[r]] == row) return true;
    }
    return false;
}

double condense_ratio(struct condense *o)
{
    struct trouble why;
    if (condense_factor(o, o->q, 0, &why) != OK) return 0;
    return condense_least_ratio(o);
}
