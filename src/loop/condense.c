/* condense.c -- see condense.h: residuals, building, and what others ask.
 *
 *     r = r_i + G' r_d                                                        (2-4)
 *
 * Where C_qd is nearly singular, r and M^ are found from postures on either side. */
#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "loop/condense_parts.h"

/* --- residuals ---------------------------------------------------------------------------------- */

enum status condense_rates(struct condense *o, double *vt, double *at, const double *q, const double *v,
                           const double *a, double t, struct trouble *why)
{
    condense_time(o, t, t, t);
    return solve_motion(&o->solve, vt, at, q, v, a, t, why);
}

enum status condense_own_rows(const struct condense *o, enum status status, struct trouble *why)
{
    if (status != OK && why && why->code == TROUBLE_NOT_FINITE) TRY(condense_driven(o, true, why->t, why));
    if (status != OK && why && why->code != TROUBLE_LAW && why->index >= 0) why->index = o->split.slot[why->index];
    return status;
}

/* The velocities of the whole tree at the ends of the interval, if they are asked for. */
static enum status end_velocities(struct condense *o, struct instant *whole, const struct instant *x,
                                  struct trouble *why)
{
    if (!x->va) return OK;
    TRY(condense_rates(o, o->va, NULL, x->qa, x->va, NULL, x->ta, why));
    TRY(condense_rates(o, o->vb, NULL, x->qb, x->vb, NULL, x->tb, why));
    whole->va = o->va;
    whole->vb = o->vb;
    return OK;
}

/* E_NUMERIC where a redundant row no longer holds. */
static enum status check_redundant_rows(struct condense *o, const double *q, double t, struct trouble *why)
{
    if (o->holds == 0) return OK;
    rows_values_at(o->C, &o->rows, q);
    for (const struct part *p = o->split.part; p < o->split.part + o->split.npart; p++)
        for (int r = p->nr; r < p->of->nrow; r++) {
            const double miss = fabs(o->C[p->row[r]]);
            const int loop = o->rows.loops->row[p->row[r]].loop;
            if (miss <= o->holds && miss > o->missed) o->missed = miss, o->missed_by = loop;
            if (miss <= o->holds) continue;
            const enum status status = trouble_set(why, TROUBLE_CLOSURE, loop, miss, t);
            if (why) why->kind = CLOSURE_REDUNDANT;
            return status;
        }
    return OK;
}

static enum status resid_there(struct condense *o, double *r, double *w, double *dk, const struct instant *x,
                               unsigned cls, struct trouble *why)
{
    struct instant whole = *x;
    if (o->tree->floating.n) TRY(end_velocities(o, &whole, x, why));
    condense_time(o, x->t, x->ta, x->tb);
    whole.jump = condense_jumps(o);
    TRY(condense_driven(o, false, x->t, why));
    TRY(solve_motion(&o->solve, o->vt, o->at, x->q, x->v, x->a, x->t, why));
    o->moving = o->solve.factored.posture;
    TRY(check_redundant_rows(o, x->q, x->t, why));
    whole.v = o->vt;
    whole.a = o->at;
    TRY(condense_own_rows(o, open_resid(o->tree, o->rt, w, dk, &whole, (enum rate)cls, why), why));
    solve_reduce(&o->solve, r, o->lambda, o->rt);
    if (w) condense_power(o, w, o->lambda);
    for (int i = 0; i < o->ode.n; i++)
        if (!isfinite(r[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i, r[i], x->t);
    return OK;
}

const double condense_share[SIDES] = {4. / 5, 4. / 5, -2. / 5, -2. / 5, 4. / 35, 4. / 35, -1. / 70, -1. / 70};

/* Is C_qd, as it is factored, singular but for a small way, against what it was when it was chosen? */
static bool nearly_singular(const struct condense *o)
{
    static const double NEARLY = 2e-2, SURELY = 3e-4;
    for (int i = 0; i < o->split.npart; i++)
        if (factor_ratio(&o->solve.block[i].C_qd, o->rows.size) < fmax(SURELY, NEARLY * o->split.part[i].chosen))
            return true;
    return false;
}

static bool go_beside(struct condense *o, double *const side[SIDES], const double *q, double t, double aside,
                      double here)
{
    for (int k = 0; k < SIDES; k++) {
        const int far = 1 + k / 2;
        const double way = (k % 2 ? aside : -aside) * far;
        for (int i = 0; i < o->ode.n; i++) o->beside[i] = way * o->rows.size[o->split.ind[i]];
        condense_point(o, side[k], q, o->beside, 1, t, o->holds == 0 ? way : 0);
        if (solve_factor(&o->solve, side[k], t, NULL) != OK || solve_ratio(&o->solve) < 2 * here) return false;
    }
    return true;
}

/* Where C_qd is nearly singular, round-off eps of the closure would come into r as eps/ratio^3.  r and M^ pass smoothly
 * through such a posture: there they are interpolated, by a polynomial of seventh degree, from eight postures beside it.
 * Drives, too, have their mechanism beside where it is; not where they must agree with each other. */
int condense_sides(struct condense *o, double *const side[SIDES], const double *q, double t)
{
    static const double ASIDE = 3e-2, LEAST = 1e-3; /* rad, or of the mechanism's length */
    if (o->solve.nknown || !nearly_singular(o)) return 0;
    const double here = solve_ratio(&o->solve);
    for (double aside = ASIDE; aside > LEAST; aside /= 4)
        if (go_beside(o, side, q, t, aside, here)) return 1;
    return 0;
}

static enum status resid(const struct ode2 *ode, double *r, double *w, double *dk, const struct instant *x,
                         unsigned cls, struct trouble *why)
{
    struct condense *o = ode->self;
    if (isnan(x->q[0])) return condense_lost(o, x->t, why);
    TRY(resid_there(o, r, w, dk, x, cls, why));
    if (!condense_sides(o, o->side, x->q, x->t)) return OK;
    double w_side[POWER_CHANNELS] = {0};
    memset(r, 0, sizeof *r * (size_t)ode->n);
    if (w) memset(w, 0, sizeof w_side);
    for (int k = 0; k < SIDES; k++) {
        struct instant there = *x;
        there.q = o->side[k];
        TRY(resid_there(o, o->mean, w ? w_side : NULL, dk, &there, cls, why));
        for (int i = 0; i < ode->n; i++) r[i] += condense_share[k] * o->mean[i];
        for (int i = 0; w && i < POWER_CHANNELS; i++) w[i] += condense_share[k] * w_side[i];
    }
    return OK;
}

static enum status settle(const struct ode2 *ode, double *q1, double *v1, const struct instant *x, struct trouble *why)
{
    struct condense *o = ode->self;
    struct instant whole = *x;
    whole.qb = q1;
    TRY(end_velocities(o, &whole, &whole, why));
    TRY(o->tree->ode.settle(&o->tree->ode, q1, o->vb, &whole, why));
    for (int i = 0; i < ode->n; i++) v1[i] = o->vb[o->split.ind[i]];
    return OK;
}

enum status condense_multipliers(struct condense *o, double *vt, double *at, double *lambda, const struct instant *x,
                                 struct trouble *why)
{
    const struct instant whole = {.t = x->t, .q = x->q, .v = vt, .a = at};
    TRY(condense_rates(o, vt, at, x->q, x->v, x->a, x->t, why));
    TRY(open_resid(o->tree, o->rt, NULL, NULL, &whole, ALL, why));
    solve_multipliers(&o->solve, lambda, o->rt);
    return OK;
}

enum status condense_accel(struct condense *o, double *vt, double *at, double *lambda, const double *q, const double *v,
                           double t, struct trouble *why)
{
    const struct ode2 *ode = &o->ode;
    const struct instant x = {.t = t, .q = q, .v = v};
    TRY(resid(ode, o->a, NULL, NULL, &x, ALL, why));
    TRY(condense_mass(ode, o->M_solve, q, t, ALL, why));
    const int pivot = dense_cholesky(o->M_solve, ode->n, ode->n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, t);
    dense_cholesky_solve(o->M_solve, o->a, ode->n, ode->n);
    for (int i = 0; i < ode->n; i++) o->a[i] = -o->a[i];
    const struct instant there = {.t = t, .q = q, .v = v, .a = o->a};
    return condense_multipliers(o, vt, at, lambda, &there, why);
}

void condense_reduce(struct condense *o, double *r, const double *rt, const double *q, double t)
{
    memset(r, 0, sizeof *r * (size_t)o->ode.n);
    condense_time(o, t, t, t);
    if (solve_factor(&o->solve, q, t, NULL) == OK) solve_reduce(&o->solve, r, o->lambda, rt);
}

/* --- building ----------------------------------------------------------------------------------- */

/* Of a state in between its place alone is looked at. */
static enum met passed(const struct ode2 *ode, const struct instant *a, const struct instant *between,
                       const struct instant *b)
{
    struct condense *o = ode->self;
    struct instant x = *a, y = *b, z = {0};
    struct trouble none = {0};
    if (condense_rates(o, o->va, NULL, a->q, a->v, NULL, a->t, &none) != OK) return MET_NOT;
    if (condense_rates(o, o->vb, NULL, b->q, b->v, NULL, b->t, &none) != OK) return MET_NOT;
    x.v = o->va;
    y.v = o->vb;
    if (between) z = (struct instant){.t = between->t, .q = between->q, .v = o->va};
    return o->tree->ode.passed(&o->tree->ode, &x, between ? &z : NULL, &y);
}

static double edge(const struct ode2 *ode, enum edge_kind *kind)
{
    const struct condense *o = ode->self;
    return o->tree->ode.edge(&o->tree->ode, kind);
}

static void sides(const struct ode2 *ode, double *side, double *force, const struct instant *x)
{
    struct condense *o = ode->self;
    struct instant y = *x;
    struct trouble none = {0};
    y.v = o->va;
    if (condense_rates(o, o->va, NULL, x->q, x->v, NULL, x->t, &none) == OK) {
        o->tree->ode.sides(&o->tree->ode, side, force, &y);
        return;
    }
    for (int i = 0; i < ode->nside; i++) side[i] = force[i] = NAN;
}

static void build_workspace(struct condense *o, struct arena *life)
{
    double **of_rows[] = {&o->C, &o->lambda, &o->jump};
    double **of_tree[] = {&o->vt, &o->at,    &o->rt, &o->va, &o->vb,     &o->zero, &o->dx,
                          &o->to, &o->still, &o->Tx, &o->a,  &o->beside, &o->mean, &o->v};
    double **of_places[] = {&o->q, &o->qtry};
    for (size_t i = 0; i < sizeof of_rows / sizeof *of_rows; i++) *of_rows[i] = TAKE(life, double, o->rows.loops->nrow);
    for (size_t i = 0; i < sizeof of_tree / sizeof *of_tree; i++) *of_tree[i] = TAKE(life, double, o->rows.n);
    for (size_t i = 0; i < sizeof of_places / sizeof *of_places; i++) *of_places[i] = TAKE(life, double, o->model->nq);
    for (int k = 0; k < SIDES; k++) o->side[k] = TAKE(life, double, o->model->nq);
}

/* Are columns by momentum cheaper than the tree's matrix and its congruence?  In flops, from timings; slopes of
 * flexible bodies are not of elements, which they need. */
static bool are_few(const struct condense *o)
{
    static const double COLUMN = 100; /* for each coordinate of the tree */
    const double n = o->ode.n, nt = o->rows.n;
    double matrix = nt * nt;
    for (const struct part *p = o->split.part; p < o->split.part + o->split.npart; p++)
        matrix += (double)p->ni * p->nr * (nt + n) / 2;
    return o->tree->elastic.n == 0 && matrix > COLUMN * (n + 1) * nt;
}

/* The number of independents is known. */
static void build_matrices(struct condense *o, struct arena *life)
{
    const size_t n = (size_t)o->ode.n, nt = (size_t)o->rows.n;
    o->few = are_few(o);
    if (!o->few) o->M = TAKE_MATRIX(life, double, nt, nt);
    o->M_side = TAKE_MATRIX(life, double, n, n);
    o->M_solve = TAKE_MATRIX(life, double, n, n);
    o->Ty = TAKE(life, double, 2 * n);
    o->driven = TAKE(life, double, n);
}

static double next_kink(const struct ode2 *ode, double t)
{
    const struct condense *o = ode->self;
    const struct model *m = o->model;
    double next = o->tree->ode.breaks ? o->tree->breaks.next(&o->tree->ode, t) : INFINITY;
    for (int l = model_first_drive(m); l < m->nloop; l++) next = fmin(next, signal_next(m->loop[l].drive, t));
    return next;
}

static int has_sides(const struct ode2 *ode, double t)
{
    const struct condense *o = ode->self;
    const struct model *m = o->model;
    for (int l = model_first_drive(m); l < m->nloop; l++)
        if (signal_has_sides(m->loop[l].drive, t)) return 1;
    return o->tree->ode.breaks && o->tree->breaks.sides(&o->tree->ode, t);
}

static double kinetic(const struct ode2 *ode, const double *q, const double *v, double t)
{
    struct condense *o = ode->self;
    const struct ode2 *tree = &o->tree->ode;
    return condense_rates(o, o->vt, NULL, q, v, NULL, t, NULL) == OK ? tree->kinetic(tree, q, o->vt, t) : 0;
}

static double size_of(const struct ode2 *ode, int i)
{
    const struct condense *o = ode->self;
    return o->rows.size[o->split.ind[i]];
}

static const struct ode2_ops ops = {
    .resid = resid, .mass = condense_mass, .slopes = condense_slopes, .turning = condense_turning};

struct condense *condense_build(struct open_tree *tree, const double *q0, const double *v0, struct arena *life)
{
    struct condense *o = TAKE(life, struct condense, 1);
    const struct model *m = o->model = tree->model;
    o->nearest = (struct nearest){.ratio = 1, .place = -1};
    o->tree = tree;
    o->chart = (struct ode2_chart){.rechart = condense_rechart};
    o->breaks = (struct ode2_breaks){.next = next_kink,
                                     .sides = has_sides,
                                     .jump = m->ndrive ? condense_jump : NULL,
                                     .corner = m->ndrive ? condense_corner : NULL,
                                     .power = m->ndrive ? condense_power_of : NULL};
    o->ode = (struct ode2){.nq = m->nq,
                           .ops = &ops,
                           .move = &condense_move,
                           .chart = &o->chart,
                           .kinetic = kinetic,
                           .size = size_of,
                           .driven = m->ndrive ? condense_fastest : NULL,
                           .breaks = tree->ode.breaks || m->ndrive ? &o->breaks : NULL,
                           .passed = tree->ode.passed ? passed : NULL,
                           .edge = edge,
                           .nside = tree->ode.nside,
                           .sides = sides,
                           .settle = tree->ode.settle ? settle : NULL,
                           .bends = tree->ode.bends,
                           .steep = tree->ode.steep,
                           .straight = tree->moves.nturn == 0,
                           .pointwise = tree->ode.pointwise,
                           .self = o};
    rows_build(&o->rows, tree, life);
    split_build(&o->split, &o->rows, life);
    solve_build(&o->solve, &o->rows, &o->split, life);
    closing_build(&o->closing, &o->solve, life);
    build_workspace(o, life);
    o->start.blamed = BLAME_NOTHING;
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
    return c->rows.loops;
}

double condense_worst(struct condense *c, const double *q, double t)
{
    int row;
    loops_when(c->rows.loops, t, 0);
    return rows_misfit(c->C, &row, &c->rows, q);
}

int condense_place(const struct condense *c, int i)
{
    return c->split.ind[i];
}

long condense_charts(const struct condense *c)
{
    return c->charts;
}

bool condense_dropped(const struct condense *c, int row)
{
    return split_drops(&c->split, row);
}

double condense_missed(const struct condense *c, int *loop)
{
    *loop = c->missed_by;
    return c->missed;
}

struct nearest condense_nearest(const struct condense *c)
{
    return c->nearest;
}

double condense_ratio(struct condense *c)
{
    return solve_factor(&c->solve, c->q, 0, NULL) == OK ? solve_ratio(&c->solve) : 0;
}
