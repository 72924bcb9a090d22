/* condense_reduce.c -- mass and slopes of the independent coordinates from those of the tree.
 *
 *     M^ = T' M T,   K^ = T' K T,   C^ = T' C T,   T = [1; G]             (2-4)
 *
 * from the tree's own matrices; where the independents are few, M^ column by column as the momentum T' (M T e_i) of a
 * unit velocity, by inverse dynamics, and the slopes as sums of reduced rows: K^ = sum (T' g)(T' g)' k.  Then nothing
 * is as large as the square of the tree. */
#include <math.h>
#include <string.h>

#include "loop/condense_parts.h"

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
static void times_T(const struct part *p, const double *G, double *X, size_t nt)
{
    for (int r = 0; r < p->nr; r++) {
        const double *from = X + nt * (size_t)p->dep[r];
        if (all_zero(from, nt)) continue;
        for (int j = 0; j < p->ni; j++) {
            const double g = G[r + (size_t)j * (size_t)p->nr];
            if (g != 0) add_times(X + nt * (size_t)p->ind[j], g, from, nt);
        }
    }
}

/* z [nt] := T' z, its independent numbers; x [nr] work. */
static void through_T(const struct part *p, const double *G, double *z, double *x)
{
    const int nr = p->nr;
    for (int r = 0; r < nr; r++) x[r] = z[p->dep[r]];
    if (all_zero(x, (size_t)nr)) return;
    for (int j = 0; j < p->ni; j++) {
        const double *g = G + (size_t)j * (size_t)nr;
        double sum = z[p->ind[j]];
        for (int r = 0; r < nr; r++) sum += g[r] * x[r];
        z[p->ind[j]] = sum;
    }
}

/* Y [n x n] := T' X T, which takes X [nt x nt] to pieces. */
static void congruence(struct condense *o, double *Y, double *X)
{
    const size_t nt = (size_t)o->rows.n, n = (size_t)o->ode.n;
    const int *ind = o->split.ind, npart = o->split.npart;
    const struct part *part = o->split.part;
    if (all_zero(X, nt * nt)) { /* there is no damper */
        memset(Y, 0, sizeof *Y * n * n);
        return;
    }
    for (int i = 0; i < npart; i++) times_T(&part[i], solve_G_of(&o->solve, i), X, nt);
    for (size_t j = 0; j < n; j++) {
        double *z = X + nt * (size_t)ind[j];
        for (int i = 0; i < npart; i++) through_T(&part[i], solve_G_of(&o->solve, i), z, o->solve.x);
        for (size_t i = 0; i < n; i++) Y[i + n * j] = z[ind[i]];
    }
}

static void symmetric(double *M, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) M[i + j * n] = M[j + i * n] = (M[i + j * n] + M[j + i * n]) / 2;
}

/* w [n] := x_i + G' x_d / 2, x [nt]. */
static void half_through_T(const struct condense *o, double *restrict w, const double *restrict x)
{
    for (int i = 0; i < o->ode.n; i++) w[i] = x[o->split.ind[i]];
    for (int k = 0; k < o->split.npart; k++) {
        const struct part *p = &o->split.part[k];
        const double *g = solve_G_of(&o->solve, k);
        for (int j = 0; j < p->ni; j++, g += p->nr) {
            double sum = 0;
            for (int r = 0; r < p->nr; r++) sum += g[r] * x[p->dep[r]];
            w[o->split.slot[p->ind[j]]] += sum / 2;
        }
    }
}

/* Y [n x n] := T' X T of a symmetric X [nt x nt]: a half and its transpose,
 *
 *     X_ii/2 + (X_id + G' X_dd/2) G */
static void symmetric_congruence(struct condense *o, double *Y, const double *X)
{
    const size_t nt = (size_t)o->rows.n, n = (size_t)o->ode.n;
    const int *ind = o->split.ind, *slot = o->split.slot;
    for (size_t j = 0; j < n; j++) {
        const double *x = X + nt * (size_t)ind[j];
        for (size_t i = 0; i < n; i++) Y[i + n * j] = x[ind[i]] / 2;
    }
    for (int k = 0; k < o->split.npart; k++) {
        const struct part *p = &o->split.part[k];
        for (int r = 0; r < p->nr; r++) {
            const double *g = solve_G_of(&o->solve, k) + r;
            half_through_T(o, o->Ty, X + nt * (size_t)p->dep[r]);
            for (int j = 0; j < p->ni; j++, g += p->nr)
                if (*g != 0) add_times(Y + n * (size_t)slot[p->ind[j]], *g, o->Ty, n);
        }
    }
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i <= j; i++) Y[i + n * j] = Y[j + n * i] = Y[i + n * j] + Y[j + n * i];
}

/* --- few independents: column by column ------------------------------------------------------------- */

void condense_still(struct condense *o, double *still, const double *q, unsigned cls)
{
    const struct open_tree *tree = o->tree;
    memset(still, 0, sizeof *still * (size_t)o->rows.n);
    open_move(o->tree, q, o->zero);
    tree->ops->forward(tree->sweep, NULL, o->zero, NULL, cls);
    tree->ops->backward(tree->sweep, still, cls);
}

void condense_momentum(struct condense *o, double *y, const double *x, const double *still, unsigned cls)
{
    const struct open_tree *tree = o->tree;
    memset(y, 0, sizeof *y * (size_t)o->rows.n);
    tree->ops->forward(tree->sweep, NULL, o->zero, x, cls);
    tree->ops->backward(tree->sweep, y, cls);
    for (int i = 0; i < o->rows.n; i++) y[i] -= still[i];
}

/* x [nt] := column i of T */
static void column_of_T(const struct condense *o, double *x, int i)
{
    const int place = o->split.ind[i], owner = o->rows.owner[place];
    memset(x, 0, sizeof *x * (size_t)o->rows.n);
    x[place] = 1;
    if (owner < 0) return;
    const struct part *p = &o->split.part[owner];
    const double *g = solve_G_of(&o->solve, owner) + (size_t)(-1 - p->place[o->rows.column[place]]) * (size_t)p->nr;
    for (int r = 0; r < p->nr; r++) x[p->dep[r]] = g[r];
}

/* M^ e_i = T' (M T e_i): the forces that set the tree, at rest, going with T e_i, and reduced like any. */
static enum status mass_by_momentum(struct condense *o, double *M, const double *q, double t, unsigned cls,
                                    struct trouble *why)
{
    const size_t n = (size_t)o->ode.n;
    condense_still(o, o->still, q, cls);
    for (int i = 0; i < o->ode.n; i++) {
        column_of_T(o, o->Tx, i);
        condense_momentum(o, o->rt, o->Tx, o->still, cls);
        solve_reduce(&o->solve, M + n * (size_t)i, o->lambda, o->rt);
        if (!isfinite(M[(n + 1) * (size_t)i])) return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, t);
    }
    symmetric(M, o->ode.n);
    return OK;
}

/* y [n] := T' row */
static void reduce_row(void *self, double *y, const struct row *row)
{
    const struct condense *o = self;
    const int *slots = o->split.slot;
    for (int i = 0; i < o->ode.n; i++) y[i] = 0;
    for (int e = 0; e < row->n; e++) {
        const int k = row->k[e], slot = slots[k], owner = o->rows.owner[k];
        if (slot >= 0) {
            y[slot] += row->x[k];
            continue;
        }
        const struct part *p = &o->split.part[owner];
        const double *g = solve_G_of(&o->solve, owner) + p->place[o->rows.column[k]];
        for (int j = 0; j < p->ni; j++) y[slots[p->ind[j]]] += row->x[k] * g[(size_t)j * (size_t)p->nr];
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
    elements_slopes_reduced(o->tree->elements, o->tree->sweep, K, C, x, (enum rate)cls, &to);
    for (size_t i = 0; i < nn; i++)
        if ((K && !isfinite(K[i])) || (C && !isfinite(C[i])))
            return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, x->t);
    return OK;
}

/* Where nothing but flexible bodies has slopes, and their coordinates are independent: these have no part in G. */
static void slopes_of_bodies(const struct condense *o, double *K, double *C, enum rate cls)
{
    const size_t nn = (size_t)o->ode.n * (size_t)o->ode.n;
    if (K) memset(K, 0, sizeof *K * nn);
    if (C) memset(C, 0, sizeof *C * nn);
    elastic_slopes(&o->tree->elastic, K, C, o->ode.n, o->split.slot, cls);
}

/* --- either way --------------------------------------------------------------------------------- */

static enum status mass_there(struct condense *o, double *M, const double *q, double t, unsigned cls,
                              struct trouble *why)
{
    const struct ode2 *tree = &o->tree->ode;
    TRY(solve_G(&o->solve, q, t, why));
    if (o->few) return mass_by_momentum(o, M, q, t, cls, why);
    if (cls == FAST && tree->near < tree->n) memset(o->M, 0, sizeof *M * (size_t)tree->n * (size_t)tree->n);
    TRY(condense_own_rows(o, tree->ops->mass(tree, o->M, q, t, cls, why), why));
    symmetric_congruence(o, M, o->M);
    return OK;
}

enum status condense_mass(const struct ode2 *ode, double *M, const double *q, double t, unsigned cls,
                          struct trouble *why)
{
    struct condense *o = ode->self;
    const int nn = ode->n * ode->n;
    if (isnan(q[0])) return condense_lost(o, t, why);
    TRY(mass_there(o, M, q, t, cls, why));
    o->sided = condense_sides(o, o->side, q, t);
    if (!o->sided) return OK;
    memset(M, 0, sizeof *M * (size_t)nn);
    for (int k = 0; k < SIDES; k++) {
        TRY(mass_there(o, o->M_side, o->side[k], t, cls, why));
        for (int i = 0; i < nn; i++) M[i] += condense_share[k] * o->M_side[i];
    }
    return OK;
}

/* The change of G with q, which counts with the forces, is left out: modified Newton. */
enum status condense_slopes(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                            struct trouble *why)
{
    struct condense *o = ode->self;
    const struct ode2 *tree = &o->tree->ode;
    if (isnan(x->q[0])) return condense_lost(o, x->t, why);
    if (elements_are_none(o->tree->elements) && elastic_has_slots(&o->tree->elastic, o->split.slot)) {
        slopes_of_bodies(o, K, C, (enum rate)cls);
        return OK;
    }
    condense_time(o, x->t, x->ta, x->tb);
    TRY(solve_G(&o->solve, x->q, x->t, why));
    split_spread(&o->split, o->vt, x->v);
    solve_follow(&o->solve, o->vt, o->rows.loops->c1);
    struct instant whole = *x;
    whole.v = o->vt;
    whole.a = NULL;
    if (o->few) return slopes_by_rows(o, K, C, &whole, cls, why);
    if (K) {
        TRY(condense_own_rows(o, tree->ops->slopes(tree, o->M, NULL, &whole, cls, why), why));
        congruence(o, K, o->M);
    }
    if (C) {
        TRY(condense_own_rows(o, tree->ops->slopes(tree, NULL, o->M, &whole, cls, why), why));
        congruence(o, C, o->M);
    }
    return OK;
}

/* Does the frame of a body move as drives say, whatever the independents do, and not its coordinates?  By G. */
static bool is_driven(const struct condense *o, const struct elastic_body *b)
{
    const int *path, n = o->tree->ops->path(o->tree->sweep, &path, b->number);
    for (int k = 0; k < b->model->nmode; k++)
        if (o->split.slot[b->model->mode_v[k]] < 0) return false;
    for (int k = 0; k < n; k++) {
        if (o->split.slot[path[k]] >= 0) return false;
        const int owner = o->rows.owner[path[k]];
        const struct part *p = &o->split.part[owner];
        const double *g = solve_G_of(&o->solve, owner) + p->place[o->rows.column[path[k]]];
        for (int j = 0; j < p->ni; j++)
            if (g[(size_t)j * (size_t)p->nr] != 0) return false;
    }
    return true;
}

/* Counted in instructions. */
double condense_price(struct condense *o)
{
    const struct elastic *elastic = &o->tree->elastic;
    double price = 1;
    if (elastic->n == 0 || solve_G(&o->solve, o->q, 0, NULL) != OK) return price;
    for (int i = 0; i < elastic->n; i++)
        if (is_driven(o, &elastic->body[i])) price = 3;
    return price;
}

/* Bodies whose frames the independents move, too, are left out: where a frame can give way to its coordinates, what
 * holds for a frame that moves as given is far from true. */
enum status condense_turning(const struct ode2 *ode, double *K, double *C, const struct instant *x, unsigned cls,
                             struct trouble *why)
{
    struct condense *o = ode->self;
    const struct open_tree *tree = o->tree;
    const struct instant whole = {.q = x->q, .v = o->vt, .a = o->at};
    bool moving = false;
    if (tree->elastic.n == 0) return OK;
    TRY(solve_G(&o->solve, x->q, x->t, why));
    for (int i = 0; i < tree->elastic.n; i++) {
        struct elastic_body *b = &tree->elastic.body[i];
        if (!elastic_in_class(b, (enum rate)cls) || !is_driven(o, b)) continue;
        if (!moving) {
            condense_time(o, x->t, x->ta, x->tb);
            TRY(solve_motion(&o->solve, o->vt, o->at, x->q, x->v, x->a, x->t, why));
            tree->ops->accelerate(tree->sweep, o->vt, o->at, ALL);
            moving = true;
        }
        elastic_turning(b, K, C, ode->n, o->split.slot, tree->ops, tree->sweep, o->model->gravity, &whole);
    }
    return OK;
}
