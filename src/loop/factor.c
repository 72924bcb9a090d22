/* factor.c -- see factor.h */
#include "loop/factor.h"

#include <assert.h>
#include <math.h>
#include <string.h>

#include "base/scalar.h"

double *store_for(struct store *o, size_t size, struct arena *life)
{
    if (size <= o->size) return o->x;
    o->size = o->size ? size + size / 2 : size;
    return o->x = TAKE(life, double, o->size);
}

void factor_build(struct factor *o, const struct part *p, double *F, struct arena *life)
{
    const size_t rows = (size_t)p->of->nrow;
    *o = (struct factor){.part = p, .F = F, .swap = TAKE(life, int, rows)};
    if (p->whole) store_for(&o->store, 2 * rows * rows, life); /* for any split */
}

void factor_fit(struct factor *o, struct arena *life)
{
    const struct part *p = o->part;
    if (p->nr == 0) return;
    o->A = store_for(&o->store, (size_t)p->nr * (size_t)(p->ld + 1), life) + p->band[1];
}

int factor_make(struct factor *o)
{
    const struct part *p = o->part;
    double *store = o->store.x;
    if (p->nr == 0) return 1;
    assert(o->A == store + p->band[1]);
    memset(store, 0, sizeof *store * (size_t)p->nr * (size_t)(p->ld + 1));
    for (const struct entry *x = p->of_dep; x < p->of_dep + p->nof_dep; x++) store[x->at] = o->F[x->e];
    return pivot_rows(o->A, o->swap, p->band, p->nr, p->ld) == p->nr;
}

void factor_copy(struct factor *to, const struct factor *from)
{
    const struct part *p = from->part;
    memcpy(to->store.x, from->store.x, sizeof *to->A * (size_t)p->nr * (size_t)(p->ld + 1));
    memcpy(to->F, from->F, sizeof *to->F * (size_t)p->of->start[p->of->nrow]);
    memcpy(to->swap, from->swap, sizeof *to->swap * (size_t)p->nr);
}

static double pivot_of(const struct factor *o, const double *size, int j)
{
    return fabs(o->A[(size_t)j * (size_t)(o->part->ld + 1)]) * size[o->part->dep[j]];
}

double factor_ratio(const struct factor *o, const double *size)
{
    const struct part *p = o->part;
    double least = INFINITY, most = 0;
    for (int j = 0; j < p->nr; j++) {
        const double x = pivot_of(o, size, j);
        least = smaller(least, x);
        most = larger(most, x);
    }
    return p->nr == 0 ? 1 : most > 0 ? least / most : 0;
}

int factor_weakest(const struct factor *o, const double *size)
{
    int at = 0;
    for (int j = 1; j < o->part->nr; j++)
        if (pivot_of(o, size, j) < pivot_of(o, size, at)) at = j;
    return o->part->dep[at];
}

/* Where the numbers of each row follow one another. */
static void take_runs(const struct factor *o, double *restrict x, const double *restrict xt)
{
    const struct part *p = o->part;
    for (int r = 0; r < p->nr; r++) {
        const int n = p->from[r + 1] - p->from[r];
        const struct entry *e = p->of_ind + p->from[r];
        if (n == 0) continue;
        const double *restrict F = o->F + e->e, *restrict y = xt + e->k;
        double sum = x[r];
        for (int i = 0; i < n; i++) sum -= F[i] * y[i];
        x[r] = sum;
    }
}

void factor_take(const struct factor *o, double *restrict x, const double *restrict xt)
{
    const struct part *p = o->part;
    const double *restrict F = o->F;
    const struct entry *e = p->of_ind;
    if (p->runs) {
        take_runs(o, x, xt);
        return;
    }
    for (int r = 0; r < p->nr; r++) {
        const struct entry *end = p->of_ind + p->from[r + 1];
        double sum = x[r];
        for (; e < end; e++) sum -= F[e->e] * xt[e->k];
        x[r] = sum;
    }
}

static void give_runs(const struct factor *o, double *restrict r, const double *restrict x)
{
    const struct part *p = o->part;
    for (int k = 0; k < p->nr; k++) {
        const int n = p->from[k + 1] - p->from[k];
        const struct entry *e = p->of_ind + p->from[k];
        if (n == 0) continue;
        const double *restrict F = o->F + e->e;
        double *restrict to = r + e->slot;
        for (int i = 0; i < n; i++) to[i] += F[i] * x[k];
    }
}

void factor_give(const struct factor *o, double *restrict r, const double *restrict x)
{
    const struct part *p = o->part;
    const double *restrict F = o->F;
    const struct entry *e = p->of_ind;
    if (p->runs_on) {
        give_runs(o, r, x);
        return;
    }
    for (int k = 0; k < p->nr; k++) {
        const struct entry *end = p->of_ind + p->from[k + 1];
        const double y = x[k];
        for (; e < end; e++) r[e->slot] += F[e->e] * y;
    }
}

void factor_G(const struct factor *o, double *G)
{
    const struct part *p = o->part;
    if (p->nr == 0 || p->ni == 0) return;
    memset(G, 0, sizeof *G * (size_t)p->nr * (size_t)p->ni);
    for (int r = 0; r < p->nr; r++)
        for (const struct entry *x = p->of_ind + p->from[r]; x < p->of_ind + p->from[r + 1]; x++)
            G[r + x->at * p->nr] = -o->F[x->e];
    pivot_rows_solves(o->A, o->swap, p->band, G, p->nr, p->ld, p->ni);
}

void factor_times_G(const struct factor *o, double *y, const double *x)
{
    const struct part *p = o->part;
    memset(y, 0, sizeof *y * (size_t)p->nr);
    for (int r = 0; r < p->nr; r++)
        for (int i = p->from[r]; i < p->from[r + 1]; i++) y[r] -= o->F[p->of_ind[i].e] * x[p->of_ind[i].at];
    factor_solve(o, y);
}

void factor_row_of_G(const struct factor *o, double *z, double *y, int row)
{
    const struct part *p = o->part;
    memset(y, 0, sizeof *y * (size_t)p->nr);
    memset(z, 0, sizeof *z * (size_t)p->ni);
    y[row] = 1;
    factor_tsolve(o, y);
    for (int r = 0; r < p->nr; r++)
        for (int i = p->from[r]; i < p->from[r + 1]; i++) z[p->of_ind[i].at] -= o->F[p->of_ind[i].e] * y[r];
}
