/* condense_reduce.c -- residual, mass and slopes of the independent coordinates from those of the tree.
 *
 *     r = r_i + G' r_d,   M^ = T' M T,   K^ = T' K T,   C^ = T' C T,   T = [1; G]             (2-4)
 *
 * from the tree's own matrices; where the independents are few, M^ column by column as the momentum T' (M T e_i) of a
 * unit velocity, by inverse dynamics, and the slopes as sums of reduced rows: K^ = sum (T' g)(T' g)' k.  Then nothing
 * is as large as the square of the tree.
 *
 * Where C_qd is nearly singular, r and M^ are means over two postures on either side. */
#include <math.h>
#include <string.h>

#include "loop/condense_parts.h"

void condense_gather(struct condense *o, double *r, double *w, const double *rt)
{
    for (int i = 0; i < o->ode.n; i++) r[i] = 0;
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        component_multipliers(c, rt);
        if (w) component_power(o, c, w);
        for (int k = 0; k < c->nr; k++) {
            const double lambda = c->x[k];
            for (const struct entry *x = c->of_ind + c->from[k]; x < c->of_ind + c->from[k + 1]; x++)
                r[x->slot] += c->of->F[x->e] * lambda;
        }
    }
    for (int i = 0; i < o->ode.n; i++) r[i] += rt[o->ind[i]];
}

/* The tree names a row by its place in the whole v; but first it may be a drive that is to blame. */
static enum status in_own_rows(const struct condense *o, enum status status, struct trouble *why)
{
    if (status != OK && why && why->code == TROUBLE_NOT_FINITE) TRY(condense_driven(o, true, why->t, why));
    if (status != OK && why && why->code != TROUBLE_LAW && why->index >= 0) why->index = o->slot[why->index];
    return status;
}

/* The velocities of the whole tree at the ends of the interval, if they are asked for. */
static enum status look_at_ends(struct condense *o, struct instant *whole, const struct instant *x, struct trouble *why)
{
    if (!x->va || !o->tree->ode.settle) return OK;
    TRY(condense_rates(o, o->va, NULL, x->qa, x->va, NULL, x->ta, why));
    TRY(condense_rates(o, o->vb, NULL, x->qb, x->vb, NULL, x->tb, why));
    whole->va = o->va;
    whole->vb = o->vb;
    return OK;
}

void condense_settle(const struct ode2 *ode, double *q1, double *v1, const struct instant *x)
{
    struct condense *o = ode->self;
    struct instant whole = *x;
    struct trouble why;
    if (look_at_ends(o, &whole, x, &why) != OK) return;
    o->tree->ode.settle(&o->tree->ode, q1, o->vb, &whole);
    for (int i = 0; i < ode->n; i++) v1[i] = o->vb[o->ind[i]];
}

static enum status resid_there(struct condense *o, double *r, double *w, double *dk, const struct instant *x,
                               unsigned cls, struct trouble *why)
{
    struct instant whole = *x;
    TRY(look_at_ends(o, &whole, x, why));
    condense_time(o, x->t, x->ta, x->tb);
    whole.jump = condense_jumps(o);
    TRY(condense_driven(o, false, x->t, why));
    TRY(condense_motion(o, o->vt, o->at, x->q, x->v, x->a, x->t, why));
    TRY(condense_contest(o, x->t, why));
    whole.v = o->vt;
    whole.a = o->at;
    TRY(in_own_rows(o, open_resid(o->tree, o->rt, w, dk, &whole, (enum rate)cls, why), why));
    condense_gather(o, r, w, o->rt);
    for (int i = 0; i < o->ode.n; i++)
        if (!isfinite(r[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i, r[i], x->t);
    return OK;
}

static const double ASIDE = 2e-3; /* rad, or of the mechanism's length */

/* Drives, too, have their mechanism beside where it is; not where they must agree with each other. */
static void drives_aside(struct condense *o, double way)
{
    o->loops->aside = o->holds == 0 ? way : 0;
}

/* Postures on both sides of q, where C_qd is nearly singular: round-off eps of the closure would come into r as
 * eps/ratio^3.  r and M^ pass smoothly through such a posture, and their mean over the two sides differs from them by
 * ASIDE^2 only.  0: not nearly singular, or the sides are no better. */
static int look_aside(struct condense *o, const double *q, double t)
{
    static const double NEARLY = 3e-4;
    const double here = condense_least_ratio(o);
    struct trouble why;
    if (here >= NEARLY) return 0;
    for (int side = 0; side < 2; side++) {
        for (int i = 0; i < o->ode.n; i++) o->aside[i] = (side ? ASIDE : -ASIDE) * o->rows.size[o->ind[i]];
        drives_aside(o, side ? ASIDE : -ASIDE);
        condense_point(&o->ode, o->side[side], q, o->aside, 1, t);
        drives_aside(o, 0);
        if (condense_factor(o, o->side[side], t, &why) != OK || condense_least_ratio(o) < 2 * here) return 0;
    }
    return 1;
}

static enum status resid(const struct ode2 *ode, double *r, double *w, double *dk, const struct instant *x,
                         unsigned cls, struct trouble *why)
{
    struct condense *o = ode->self;
    if (isnan(x->q[0])) return condense_lost(o, x->t, why);
    TRY(resid_there(o, r, w, dk, x, cls, why));
    if (!look_aside(o, x->q, x->t)) return OK;
    double w_side[2][POWER_CHANNELS] = {{0}};
    for (int side = 0; side < 2; side++) {
        struct instant there = *x;
        there.q = o->side[side];
        TRY(resid_there(o, side ? o->mean : r, w ? w_side[side] : NULL, dk, &there, cls, why));
    }
    for (int i = 0; i < ode->n; i++) r[i] = (r[i] + o->mean[i]) / 2;
    for (int i = 0; w && i < POWER_CHANNELS; i++) w[i] = (w_side[0][i] + w_side[1][i]) / 2;
    return OK;
}

/* --- with the tree's own matrices ------------------------------------------------------------------ */

static inline void add_times(double *restrict y, double g, const double *restrict x, size_t n)
{
    for (size_t i = 0; i < n; i++) y[i] += g * x[i];
}

static bool all_zero(const double *x, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (x[i] != 0) return false;
    return true;
}

/* X := X T, its independent columns.  Stiffness and damping have dependent columns that are zero. */
static void times_T(const struct part *c, double *X, size_t nt)
{
    for (int r = 0; r < c->nr; r++) {
        const double *from = X + nt * (size_t)c->of->k[c->dep[r]];
        if (all_zero(from, nt)) continue;
        for (int j = 0; j < c->ni; j++) {
            const double g = c->G[r + (size_t)j * (size_t)c->nr];
            if (g != 0) add_times(X + nt * (size_t)c->of->k[c->ind[j]], g, from, nt);
        }
    }
}

/* z [nt] := T' z, its independent numbers. */
static void through_T(struct part *c, double *z)
{
    const int nr = c->nr;
    for (int r = 0; r < nr; r++) c->x[r] = z[c->of->k[c->dep[r]]];
    if (all_zero(c->x, (size_t)nr)) return;
    for (int j = 0; j < c->ni; j++) {
        const double *g = c->G + (size_t)j * (size_t)nr;
        double sum = z[c->of->k[c->ind[j]]];
        for (int r = 0; r < nr; r++) sum += g[r] * c->x[r];
        z[c->of->k[c->ind[j]]] = sum;
    }
}

/* Y [n x n] := T' X T, which takes X [nt x nt] to pieces. */
static void congruence(struct condense *o, double *Y, double *X)
{
    const size_t nt = (size_t)o->nt, n = (size_t)o->ode.n;
    if (all_zero(X, nt * nt)) { /* there is no damper */
        memset(Y, 0, sizeof *Y * n * n);
        return;
    }
    for (int i = 0; i < o->npart; i++) times_T(&o->part[i], X, nt);
    for (size_t j = 0; j < n; j++) {
        double *z = X + nt * (size_t)o->ind[j];
        for (int i = 0; i < o->npart; i++) through_T(&o->part[i], z);
        for (size_t i = 0; i < n; i++) Y[i + n * j] = z[o->ind[i]];
    }
}

static enum status prepare_T(struct condense *o, const double *q, double t, struct trouble *why)
{
    TRY(condense_factor(o, q, t, why));
    for (int i = 0; i < o->npart; i++) component_G(&o->part[i], o->part[i].G);
    return OK;
}

static void symmetric(double *M, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) M[i + j * n] = M[j + i * n] = (M[i + j * n] + M[j + i * n]) / 2;
}

/* --- few independents: column by column ------------------------------------------------------------- */

/* What holds the tree at rest. */
void condense_still(struct condense *o, const double *q, unsigned cls)
{
    memset(o->still, 0, sizeof *o->still * (size_t)o->nt);
    open_move(o->tree, q, o->zero);
    o->ops->forward(o->sweep, NULL, o->zero, NULL, cls);
    o->ops->backward(o->sweep, o->still, cls);
}

void condense_momentum(struct condense *o, double *y, const double *x, unsigned cls)
{
    memset(y, 0, sizeof *y * (size_t)o->nt);
    o->ops->forward(o->sweep, NULL, o->zero, x, cls);
    o->ops->backward(o->sweep, y, cls);
    for (int i = 0; i < o->nt; i++) y[i] -= o->still[i];
}

/* x [nt] := column i of T */
static void column_of_T(const struct condense *o, double *x, int i)
{
    const int place = o->ind[i], owner = o->rows.owner[place];
    memset(x, 0, sizeof *x * (size_t)o->nt);
    x[place] = 1;
    if (owner < 0) return;
    const struct part *c = &o->part[owner];
    const double *g = c->G + (size_t)(-1 - c->place[o->rows.column[place]]) * (size_t)c->nr;
    for (int r = 0; r < c->nr; r++) x[c->of->k[c->dep[r]]] = g[r];
}

/* M^ e_i = T' (M T e_i): the forces that set the tree, at rest, going with T e_i, and gathered like any. */
static enum status mass_by_momentum(struct condense *o, double *M, const double *q, double t, unsigned cls,
                                    struct trouble *why)
{
    const size_t n = (size_t)o->ode.n;
    condense_still(o, q, cls);
    for (int i = 0; i < o->ode.n; i++) {
        column_of_T(o, o->Tx, i);
        condense_momentum(o, o->rt, o->Tx, cls);
        condense_gather(o, M + n * (size_t)i, NULL, o->rt);
        if (!isfinite(M[(n + 1) * (size_t)i])) return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, t);
    }
    symmetric(M, o->ode.n);
    return OK;
}

/* y [n] := T' row */
static void reduce_row(void *self, double *y, const struct row *row)
{
    const struct condense *o = self;
    for (int i = 0; i < o->ode.n; i++) y[i] = 0;
    for (int e = 0; e < row->n; e++) {
        const int k = row->k[e], slot = o->slot[k];
        if (slot >= 0) {
            y[slot] += row->x[k];
            continue;
        }
        const struct part *c = &o->part[o->rows.owner[k]];
        const double *g = c->G + c->place[o->rows.column[k]];
        for (int j = 0; j < c->ni; j++) y[o->slot[c->of->k[c->ind[j]]]] += row->x[k] * g[(size_t)j * (size_t)c->nr];
    }
}

static enum status slopes_by_rows(struct condense *o, double *K, double *C, const struct instant *x, unsigned cls,
                                  struct trouble *why)
{
    const size_t nn = (size_t)o->ode.n * (size_t)o->ode.n;
    const struct reduction to = {o->ode.n, o, reduce_row, o->Ty, o->Ty + o->ode.n};
    if (K) memset(K, 0, sizeof *K * nn);
    if (C) memset(C, 0, sizeof *C * nn);
    open_move(o->tree, x->q, x->v);
    elements_slopes_reduced(o->elements, o->sweep, K, C, x, (enum rate)cls, &to);
    for (size_t i = 0; i < nn; i++)
        if ((K && !isfinite(K[i])) || (C && !isfinite(C[i])))
            return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, x->t);
    return OK;
}

/* --- either way --------------------------------------------------------------------------------- */

static enum status mass_there(struct condense *o, double *M, const double *q, double t, unsigned cls,
                              struct trouble *why)
{
    TRY(prepare_T(o, q, t, why));
    if (o->few) return mass_by_momentum(o, M, q, t, cls, why);
    TRY(in_own_rows(o, o->tree->ode.ops->mass(&o->tree->ode, o->M, q, t, cls, why), why));
    congruence(o, M, o->M);
    symmetric(M, o->ode.n);
    return OK;
}

static enum status mass(const struct ode2 *ode, double *M, const double *q, double t, unsigned cls, struct trouble *why)
{
    struct condense *o = ode->self;
    const int nn = ode->n * ode->n;
    if (isnan(q[0])) return condense_lost(o, t, why);
    TRY(mass_there(o, M, q, t, cls, why));
    if (!look_aside(o, q, t)) return OK;
    TRY(mass_there(o, M, o->side[0], t, cls, why));
    TRY(mass_there(o, o->M_side, o->side[1], t, cls, why));
    for (int i = 0; i < nn; i++) M[i] = (M[i] + o->M_side[i]) / 2;
    return OK;
}

/* The change of G with q, which counts with the forces, is left out: modified Newton. */
static enum status slopes(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                          struct trouble *why)
{
    struct condense *o = ode->self;
    if (isnan(x->q[0])) return condense_lost(o, x->t, why);
    condense_time(o, x->t, x->ta, x->tb);
    TRY(prepare_T(o, x->q, x->t, why));
    condense_spread(o, o->vt, x->v);
    condense_follow(o, o->vt);
    struct instant whole = *x;
    whole.v = o->vt;
    whole.a = NULL;
    if (o->few) return slopes_by_rows(o, K, C, &whole, cls, why);
    if (K) {
        TRY(in_own_rows(o, o->tree->ode.ops->slopes(&o->tree->ode, o->M, NULL, &whole, cls, why), why));
        congruence(o, K, o->M);
    }
    if (C) {
        TRY(in_own_rows(o, o->tree->ode.ops->slopes(&o->tree->ode, NULL, o->M, &whole, cls, why), why));
        congruence(o, C, o->M);
    }
    return OK;
}

/* Does the frame of a body move as drives say, whatever the independents do, and not its coordinates? */
static bool is_driven(const struct condense *o, const struct elastic_body *b)
{
    const int *path, n = o->ops->path(o->sweep, &path, b->number);
    for (int k = 0; k < b->model->nmode; k++)
        if (o->slot[b->model->mode_v[k]] < 0) return false;
    for (int k = 0; k < n; k++) {
        if (o->slot[path[k]] >= 0) return false;
        const struct part *c = &o->part[o->rows.owner[path[k]]];
        const double *g = c->G + c->place[o->rows.column[path[k]]];
        for (int j = 0; j < c->ni; j++)
            if (g[(size_t)j * (size_t)c->nr] != 0) return false;
    }
    return true;
}

/* Counted in instructions. */
double condense_price(struct condense *o)
{
    struct trouble why;
    double price = 1;
    if (o->elastic->n == 0 || prepare_T(o, o->q, 0, &why) != OK) return price;
    for (int i = 0; i < o->elastic->n; i++)
        if (is_driven(o, &o->elastic->body[i])) price = 3;
    return price;
}

/* Bodies whose frames the independents move, too, are left out: where a frame can give way to its coordinates, what
 * holds for a frame that moves as given is far from true.  G is that of slopes(). */
static enum status turning(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                           struct trouble *why)
{
    struct condense *o = ode->self;
    const struct instant whole = {.q = x->q, .v = o->vt, .a = o->at};
    bool moving = false;
    for (int i = 0; i < o->elastic->n; i++) {
        struct elastic_body *b = &o->elastic->body[i];
        struct pose frame;
        if (!elastic_in_class(b, (enum rate)cls) || !is_driven(o, b)) continue;
        if (!moving) {
            TRY(condense_motion(o, o->vt, o->at, x->q, x->v, x->a, x->t, why));
            o->ops->speed_up(o->sweep, o->vt, o->at, ALL);
            moving = true;
        }
        o->ops->pose(o->sweep, &frame, b->number);
        elastic_turning(b, K, C, ode->n, o->slot, &frame, o->model->gravity, &whole);
    }
    return OK;
}

const struct ode2_ops condense_ops = {.resid = resid, .mass = mass, .slopes = slopes, .turning = turning};
