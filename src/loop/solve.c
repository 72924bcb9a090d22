/* solve.c -- see solve.h */
#include "loop/solve.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "loop/loops_parts.h"

/* --- C_qd and G --------------------------------------------------------------------------------- */

static bool same(struct made a, struct made b)
{
    return a.posture == b.posture && a.split == b.split;
}

bool solve_at_hand(const struct solve *o)
{
    return same(o->factored, (struct made){rows_number(o->rows), o->split->number});
}

static enum status singular(const struct solve *o, int i, double t, struct trouble *why)
{
    const int row = o->rows->component[i].row[0];
    return trouble_set(why, TROUBLE_CLOSURE, o->rows->loops->row[row].loop, NAN, t);
}

enum status solve_as_it_is(struct solve *o, double t, struct trouble *why)
{
    if (o->rows->constant && solve_at_hand(o)) return OK;
    o->factored.posture = 0;
    for (int i = 0; i < o->split->npart; i++)
        if (!factor_make(&o->block[i].C_qd)) return singular(o, i, t, why);
    o->factored = (struct made){o->rows->linear, o->split->number};
    if (o->factored.posture) memcpy(o->at, o->rows->tree->posture.q, sizeof *o->at * (size_t)o->rows->tree->model->nq);
    return OK;
}

bool solve_is_near(const struct solve *o, double *dx, const double *q, double far)
{
    const double *per = o->rows->per;
    if (!o->factored.posture || o->factored.split != o->split->number) return false;
    if (o->rows->linear != o->factored.posture) return false; /* C_qi is in rows */
    moves_diff(&o->rows->tree->moves, dx, q, o->at);
    for (int i = 0; i < o->rows->n; i++)
        if (!(fabs(dx[i]) * per[i] <= far)) return false;
    return true;
}

enum status solve_factor(struct solve *o, const double *q, double t, struct trouble *why)
{
    rows_linearize(o->rows, q);
    return solve_at_hand(o) ? OK : solve_as_it_is(o, t, why);
}

enum status solve_G(struct solve *o, const double *q, double t, struct trouble *why)
{
    TRY(solve_factor(o, q, t, why));
    if (same(o->G, o->factored)) return OK;
    for (int i = 0; i < o->split->npart; i++) factor_G(&o->block[i].C_qd, o->block[i].G);
    o->G = o->factored;
    return OK;
}

const double *solve_G_of(const struct solve *o, int i)
{
    assert(solve_at_hand(o) && same(o->G, o->factored));
    return o->block[i].G;
}

double solve_try(struct solve *o, int i)
{
    o->factored.posture = 0;
    return factor_make(&o->block[i].C_qd) ? factor_ratio(&o->block[i].C_qd, o->rows->size) : 0;
}

double solve_ratio(const struct solve *o)
{
    double least = 1;
    assert(solve_at_hand(o));
    for (int i = 0; i < o->split->npart; i++) least = fmin(least, factor_ratio(&o->block[i].C_qd, o->rows->size));
    return least;
}

double solve_gain(struct solve *o, int i)
{
    struct block *b = &o->block[i];
    if (o->split->part[i].wide) return split_gain_estimate(o->split, &o->split->part[i], &b->C_qd);
    o->G.posture = 0;
    factor_G(&b->C_qd, b->G);
    return split_gain(o->split, &o->split->part[i], b->G);
}

/* --- motion ------------------------------------------------------------------------------------- */

/* Rates or accelerations `drive` [rows] of known coordinates. */
static void know(const struct solve *o, double *xt, const double *drive)
{
    for (int k = 0; k < o->nknown; k++) xt[o->known[k].at] = drive[o->known[k].row] / o->known[k].scale;
}

int solve_known(const struct solve *o, double *q1)
{
    for (int k = 0; k < o->nknown; k++) {
        const double x = o->rows->loops->c[o->known[k].row] / o->known[k].scale;
        if (!isfinite(x)) return k;
        q1[o->known[k].iq] = x;
    }
    return -1;
}

void solve_follow(const struct solve *o, double *xt, const double *drive)
{
    assert(solve_at_hand(o));
    know(o, xt, drive);
    for (int i = 0; !o->nknown && i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        memset(o->x, 0, sizeof *o->x * (size_t)p->nr);
        for (int k = 0; k < p->nlead; k++) o->x[p->lead[k]] = drive[p->row[p->lead[k]]];
        factor_take(&o->block[i].C_qd, o->x, xt);
        factor_solve(&o->block[i].C_qd, o->x);
        for (int r = 0; r < p->nr; r++) xt[p->dep[r]] = o->x[r];
    }
}

/* a_d := -C_qd^-1 C'', C'' with a_d = 0: (C_q v)_q v + C_qi a_i + C_tt. */
static void accelerate(struct solve *o, double *at)
{
    loops_second(o->second, o->rows->loops, o->rows->tree->sweep, at);
    for (int i = 0; i < o->split->npart; i++) {
        const struct part *p = &o->split->part[i];
        for (int r = 0; r < p->nr; r++) o->x[r] = -o->second[p->row[r]];
        factor_solve(&o->block[i].C_qd, o->x);
        for (int r = 0; r < p->nr; r++) at[p->dep[r]] = o->x[r];
    }
}

enum status solve_motion(struct solve *o, double *vt, double *at, const double *q, const double *v, const double *a,
                         double t, struct trouble *why)
{
    const struct open_tree *tree = o->rows->tree;
    assert(tree->model->ndrive == 0 || o->rows->loops->t == t);
    TRY(solve_factor(o, q, t, why));
    split_spread(o->split, vt, v);
    solve_follow(o, vt, o->rows->loops->c1);
    if (!at) return OK;
    if (a)
        split_spread(o->split, at, a);
    else
        memset(at, 0, sizeof *at * (size_t)o->rows->n);
    if (o->rows->constant)
        open_move(o->rows->tree, q, vt);
    else
        open_stir_up(o->rows->tree, vt, at);
    if (o->nknown)
        know(o, at, o->rows->loops->c2);
    else
        accelerate(o, at);
    return OK;
}

/* --- forces ------------------------------------------------------------------------------------- */

/* x [nr] = -C_qd^-T r_d of component i. */
static void multipliers(const struct solve *o, double *lambda, double *x, int i, const double *rt)
{
    const struct part *p = &o->split->part[i];
    for (int r = 0; r < p->nr; r++) x[r] = -rt[p->dep[r]];
    factor_tsolve(&o->block[i].C_qd, x);
    for (int r = 0; r < p->nr; r++) lambda[p->row[r]] = x[r];
    for (int r = p->nr; r < p->of->nrow; r++) lambda[p->row[r]] = 0;
}

void solve_multipliers(const struct solve *o, double *lambda, const double *rt)
{
    assert(solve_at_hand(o));
    for (const struct known *k = o->known; k < o->known + o->nknown; k++) lambda[k->row] = -rt[k->at] / k->scale;
    for (int i = 0; !o->nknown && i < o->split->npart; i++) multipliers(o, lambda, o->x, i, rt);
}

void solve_reduce(const struct solve *o, double *restrict r, double *lambda, const double *restrict rt)
{
    const int n = o->split->n, run = o->split->run, *ind = o->split->ind;
    assert(solve_at_hand(o));
    for (int i = 0; i < n; i++) r[i] = 0;
    if (o->nknown) solve_multipliers(o, lambda, rt);
    for (int i = 0; !o->nknown && i < o->split->npart; i++) {
        multipliers(o, lambda, o->x, i, rt);
        factor_give(&o->block[i].C_qd, r, o->x);
    }
    for (int i = 0; i < run; i++) r[i] += rt[ind[0] + i];
    for (int i = run; i < n; i++) r[i] += rt[ind[i]];
}

/* --- building ----------------------------------------------------------------------------------- */

static void find_known(struct solve *o, struct arena *life)
{
    const struct loops *l = o->rows->loops;
    if (!o->rows->constant || l->nrow != l->model->ndrive) return;
    for (int i = 0; i < o->rows->ncomponent; i++)
        if (o->rows->component[i].nrow != 1 || o->rows->component[i].nk != 1) return;
    o->known = TAKE(life, struct known, l->nrow);
    for (int i = 0; i < o->rows->ncomponent; i++) {
        const struct component *c = &o->rows->component[i];
        const int row = c->row[0], loop = l->row[row].loop;
        const struct model_measure *m = &l->model->measure[l->model->loop[loop].measure];
        o->known[o->nknown++] = (struct known){row, c->k[0], m->iq, loops_scale(l, loop)};
    }
}

void solve_build(struct solve *o, struct rows *rows, const struct split *split, struct arena *life)
{
    *o = (struct solve){.rows = rows, .split = split, .life = life};
    o->block = TAKE(life, struct block, split->npart);
    o->at = TAKE(life, double, rows->tree->model->nq);
    o->x = TAKE(life, double, rows->loops->nrow);
    o->second = TAKE(life, double, rows->loops->nrow);
    find_known(o, life);
    for (int i = 0; i < split->npart; i++) {
        const struct component *c = &rows->component[i];
        factor_build(&o->block[i].C_qd, &split->part[i], c->F, life);
        if (split->part[i].whole) store_for(&o->block[i].store, (size_t)c->nrow * (size_t)c->nk, life);
    }
}

void solve_fit(struct solve *o, int i)
{
    const struct part *p = &o->split->part[i];
    struct block *b = &o->block[i];
    factor_fit(&b->C_qd, o->life);
    b->G = store_for(&b->store, (size_t)p->nr * (size_t)p->ni, o->life);
}
