/* condense.c -- see condense.h: building, and what others ask. */
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "loop/condense_parts.h"
#include "tree/sizes.h"

/* Rows and coordinates of each component, in order. */
static void list_parts(struct condense *o, struct arena *life)
{
    const struct model *m = o->model;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < o->ncomponent; i++) {
            struct component *c = &o->component[i];
            if (pass) c->row = TAKE(life, int, c->nrow), c->k = TAKE(life, int, c->nk);
            c->nrow = c->nk = 0;
        }
        for (int r = 0; r < o->loops->nrow; r++) {
            struct component *c = &o->component[m->loop[o->loops->row[r].loop].component];
            if (pass) c->row[c->nrow] = r;
            c->nrow++;
        }
        for (int k = 0; k < o->nt; k++) {
            if (o->owner[k] < 0) continue;
            struct component *c = &o->component[o->owner[k]];
            if (pass) c->k[o->column[k] = c->nk] = k;
            c->nk++;
        }
    }
}

static int loop_of_row(const struct condense *o, const struct component *c, int r)
{
    return o->loops->row[c->row[r]].loop;
}

/* The coordinates of each row. */
static void build_rows(struct condense *o, struct component *c, struct arena *life)
{
    const struct loops *l = o->loops;
    c->start = TAKE(life, int, c->nrow + 1);
    for (int r = 0; r < c->nrow; r++) c->start[r + 1] = c->start[r] + l->nk[loop_of_row(o, c, r)];
    c->at = TAKE(life, int, c->start[c->nrow]);
    c->F = TAKE(life, double, c->start[c->nrow]);
    c->of_dep = TAKE(life, struct entry, c->start[c->nrow]);
    c->of_ind = TAKE(life, struct entry, c->start[c->nrow]);
    c->from = TAKE(life, int, c->nrow + 1);
    for (int r = 0; r < c->nrow; r++) {
        const int loop = loop_of_row(o, c, r);
        for (int k = 0; k < l->nk[loop]; k++) c->at[c->start[r] + k] = o->column[l->k[loop][k]];
        if (c->row[r] > l->first[loop]) continue;
        const size_t n = (size_t)(l->nk[loop] * (l->first[loop + 1] - l->first[loop]));
        memcpy(c->F + c->start[r], l->Cq[loop], sizeof *c->F * n); /* sums have theirs for good */
        l->Cq[loop] = c->F + c->start[r];
    }
}

/* turn [nt]: which rotation begins with a coordinate; -1: none.  A path has its three one behind the other. */
static void build_spins(struct condense *o, struct component *c, const int *turn, struct arena *life)
{
    for (int pass = 0; pass < 2; pass++) {
        if (pass) c->spin = TAKE(life, struct spin, c->nspin);
        c->nspin = 0;
        for (int e = 0; e < c->start[c->nrow]; e++) {
            const int i = turn[c->k[c->at[e]]], *iv = i < 0 ? NULL : o->moves->turn[i].iv;
            if (!iv || e + 2 >= c->start[c->nrow] || c->k[c->at[e + 1]] != iv[1] || c->k[c->at[e + 2]] != iv[2])
                continue;
            if (pass) c->spin[c->nspin] = (struct spin){i, {e, e + 1, e + 2}};
            c->nspin++;
        }
    }
}

static void build_component(struct condense *o, struct component *c, struct arena *life)
{
    enum { SMALL = 4096 }; /* numbers of C_q: below, dense is no slower, and there is room for any split */
    const int most = c->nrow > c->nk ? c->nrow : c->nk;
    const size_t size = (size_t)c->nrow * (size_t)c->nk;
    int drives = 0;
    for (int r = 0; r < c->nrow; r++) drives += o->model->loop[loop_of_row(o, c, r)].drive != NULL;
    build_rows(o, c, life);
    c->loop_of = TAKE(life, int, c->nk);
    c->row_order = TAKE(life, int, c->nrow);
    component_order(o, c);
    c->lead = TAKE(life, int, drives);
    c->s0 = TAKE(life, double, drives);
    c->T0 = TAKE(life, double, drives * c->nrow);
    c->kept = TAKE(life, int, c->nrow);
    c->dep = TAKE(life, int, most);
    c->ind = TAKE(life, int, c->nk);
    c->place = TAKE(life, int, c->nk);
    c->prow = TAKE(life, int, most);
    c->pcol = TAKE(life, int, most);
    c->pivot = TAKE(life, double, most);
    c->x = TAKE(life, double, most);
    c->weight = TAKE(life, double, c->nk);
    if (size > SMALL) {
        c->base.F = TAKE(life, double, c->start[c->nrow]);
        c->base.swap = TAKE(life, int, c->nrow);
        c->probe = TAKE(life, double, c->nk);
        return;
    }
    c->whole = TAKE(life, double, size);
    c->A_room.size = 2 * (size_t)c->nrow * (size_t)c->nrow;
    c->G_room.size = c->G0_room.size = size;
    struct room *of[] = {&c->A_room, &c->G_room, &c->G0_room};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) of[i]->store = TAKE(life, double, of[i]->size);
}

static void build_components(struct condense *o, struct arena *life)
{
    const struct model *m = o->model;
    int *turn = TAKE(life, int, o->nt);
    o->ncomponent = m->ncomponent;
    o->component = TAKE(life, struct component, m->ncomponent);
    o->column = TAKE(life, int, o->nt);
    o->owner = TAKE(life, int, o->nt);
    o->size = TAKE(life, double, o->nt);
    o->per = TAKE(life, double, o->nt);
    for (int i = 0; i < o->nt; i++) o->owner[i] = turn[i] = -1;
    for (int l = 0; l < m->nloop; l++)
        for (int k = 0; k < o->loops->nk[l]; k++) o->owner[o->loops->k[l][k]] = m->loop[l].component;
    for (int i = 0; i < o->moves->nturn; i++) turn[o->moves->turn[i].iv[0]] = i;
    sizes_fill(o->size, m);
    for (int i = 0; i < o->nt; i++) o->per[i] = 1 / o->size[i];
    list_parts(o, life);
    for (int i = 0; i < o->ncomponent; i++) {
        build_component(o, &o->component[i], life);
        build_spins(o, &o->component[i], turn, life);
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
    for (int i = 0; i < o->ncomponent; i++) matrix += (double)o->component[i].ni * o->component[i].nr * (nt + n) / 2;
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
    return o->size[o->ind[i]];
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
    o->loops = loops_build(m, o->ops, life);
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
    build_components(o, life);
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
    return condense_misfit(c, &row, q);
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
