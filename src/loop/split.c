/* split.c -- which coordinates are dependent.
 *
 * LU of a component's C_q with full pivoting picks as many rows as the rank and the columns of the dependent
 * coordinates (Wehage & Haug 1982); columns have weights, and a column is taken late if the deck would rather have it
 * independent.  Chosen anew between major steps when |G| has grown: dependents run away from the independents. */
#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "la/sparse_pivot.h"
#include "loop/condense_parts.h"

static const double NOTHING = 1e-10; /* a pivot of round-off: C_q is scaled to numbers of order 1 */
static const double LARGE = 3;       /* rate of a dependent coordinate per unit: time to look for a better split */

/* Columns of displacements times the length: all numbers of C_q are then of like size. */
static void whole_matrix(struct condense *o, struct part *c)
{
    memset(c->whole, 0, sizeof *c->whole * (size_t)c->of->nrow * (size_t)c->of->nk);
    for (int r = 0; r < c->of->nrow; r++)
        for (int e = c->of->start[r]; e < c->of->start[r + 1]; e++)
            c->whole[r + (size_t)c->of->at[e] * (size_t)c->of->nrow] =
                c->of->F[e] * o->rows.size[c->of->k[c->of->at[e]]];
}

/* Pivots of the component's C_q at the present posture; returns how many. */
static int find_pivots(struct condense *o, struct part *c, const double *weight, int most, double least)
{
    int n;
    if (c->whole) {
        whole_matrix(o, c);
        n = pivot_lu(c->whole, c->prow, c->pcol, c->of->nrow, c->of->nk, c->of->nrow, weight, most, least);
        for (int k = 0; k < n; k++) c->pivot[k] = c->whole[(size_t)k * (size_t)(c->of->nrow + 1)];
        return n;
    }
    const struct arena_mark mark = arena_mark(o->scratch);
    double *value = TAKE(o->scratch, double, c->of->start[c->of->nrow]);
    for (int e = 0; e < c->of->start[c->of->nrow]; e++) value[e] = c->of->F[e] * o->rows.size[c->of->k[c->of->at[e]]];
    n = sparse_pivot(c->prow, c->pcol, c->pivot, c->of->start, c->of->at, value, c->of->nrow, c->of->nk, weight, most,
                     least, o->scratch);
    arena_rewind(o->scratch, mark);
    return n;
}

int component_rank(struct condense *o, struct part *c, double least)
{
    int rank = find_pivots(o, c, NULL, c->of->nrow, least);
    while (rank > 0 && fabs(c->pivot[rank - 1]) < NOTHING) rank--;
    return rank;
}

/* x [n] sorted by key[x], the smallest first, equals as they come; work [n]. */
static void sort_by(int *x, int n, const int *key, int *work)
{
    for (int size = 1; size < n; size *= 2) {
        for (int from = 0; from < n; from += 2 * size) {
            const int middle = from + size < n ? from + size : n, to = middle + size < n ? middle + size : n;
            for (int i = from, a = from, b = middle; i < to; i++) {
                const bool second = a == middle || (b < to && key[x[b]] < key[x[a]]);
                work[i] = second ? x[b++] : x[a++];
            }
        }
        memcpy(x, work, sizeof *x * (size_t)n);
    }
}

static double *room_for(struct condense *o, struct room *room, size_t size)
{
    if (size <= room->size) return room->store;
    room->size = room->size ? size + size / 2 : size;
    return room->store = TAKE(o->life, double, room->size);
}

/* Where C_qd can have numbers, and room for it and for G. */
static void find_band(struct condense *o, struct part *c)
{
    enum { WIDE = 16, FEW = 3 }; /* of a few rows all, for which pivot_rows() is quickest */
    int below = c->nr <= FEW ? c->nr - 1 : 0, above = below;
    if (c->nr == 0) return;
    for (int r = 0; r < c->nr; r++)
        for (int e = c->of->start[c->kept[r]]; e < c->of->start[c->kept[r] + 1]; e++) {
            const int j = c->place[c->of->at[e]];
            if (j < 0) continue;
            if (r - j > below) below = r - j;
            if (j - r > above) above = j - r;
        }
    c->band[0] = below;
    c->band[1] = above + below < c->nr ? above + below : c->nr - 1;
    c->ld = below + c->band[1];
    c->A = room_for(o, &c->A_room, (size_t)c->nr * (size_t)(c->ld + 1)) + c->band[1];
    c->G = room_for(o, &c->G_room, (size_t)c->nr * (size_t)c->ni);
    c->wide = !c->whole && c->ni > WIDE;
    if (c->wide)
        c->base.A = room_for(o, &c->base_room, (size_t)c->nr * (size_t)(c->ld + 1)) + c->band[1];
    else
        c->G0 = room_for(o, &c->G0_room, (size_t)c->nr * (size_t)c->ni);
}

/* Which numbers of C_q go where. */
static void list_entries(struct part *c)
{
    const int offset = (int)(c->A - c->A_room.store);
    int n = 0;
    c->nof_dep = 0;
    for (int r = 0; r < c->nr; r++) {
        c->from[r] = n;
        for (int e = c->of->start[c->kept[r]]; e < c->of->start[c->kept[r] + 1]; e++) {
            const int j = c->place[c->of->at[e]];
            if (j >= 0)
                c->of_dep[c->nof_dep++] = (struct entry){e, c->of->k[c->of->at[e]], offset + r + j * c->ld, -1};
            else
                c->of_ind[n++] = (struct entry){e, c->of->k[c->of->at[e]], -1 - j, -1};
        }
    }
    c->from[c->nr] = n;
}

static void find_places(struct part *c)
{
    for (int j = 0; j < c->nr; j++) c->place[c->dep[j]] = j;
    for (int j = 0; j < c->ni; j++) c->place[c->ind[j]] = -1 - j;
}

static void find_leads(const struct condense *o, struct part *c)
{
    c->nlead = 0;
    for (int r = 0; r < c->nr; r++)
        if (o->model->loop[o->loops->row[c->of->row[c->kept[r]]].loop].drive) c->lead[c->nlead++] = r;
}

/* Splits the coordinates after pivot_lu has sorted them; fast ones first among the independent.  Rows and dependent
 * columns go from loop to loop, so that C_qd has its numbers near the diagonal. */
static void take_split(struct condense *o, struct part *c)
{
    memcpy(c->kept, c->prow, sizeof *c->kept * (size_t)c->of->nrow);
    for (int k = 0; k < c->of->nk; k++) c->place[k] = -1;
    for (int r = 0; r < c->nr; r++) c->place[c->dep[r] = c->pcol[r]] = r;
    sort_by(c->kept, c->nr, c->row_order, o->work);
    sort_by(c->dep, c->nr, c->loop_of, o->work);
    int n = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < c->of->nk; k++)
            if (c->place[k] < 0 && o->model->urgent[c->of->k[k]] == (pass == 0)) c->ind[n++] = k;
    find_places(c);
    find_band(o, c);
    list_entries(c);
    find_leads(o, c);
}

static double quality(struct condense *o, struct part *c)
{
    return component_factor(c) ? component_ratio(o, c) : 0;
}

double component_choose(struct condense *o, struct part *c)
{
    o->factored = 0;
    find_pivots(o, c, c->weight, c->nr, 0);
    take_split(o, c);
    return quality(o, c);
}

static void number_entries(const struct condense *o, struct part *c)
{
    for (int i = 0; i < c->from[c->nr]; i++) c->of_ind[i].slot = o->slot[c->of_ind[i].k];
}

/* Fast ones first, then slow; coordinates in no loop are all independent.  A component
 * keeps its number of fast ones, whoever they are. */
void condense_number(struct condense *o)
{
    int n = 0;
    for (int i = 0; i < o->nt; i++) o->slot[i] = -1;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < o->nt; i++)
            if (o->rows.owner[i] < 0 && o->model->urgent[i] == (pass == 0)) o->ind[n++] = i;
        for (int i = 0; i < o->npart; i++) {
            const struct part *c = &o->part[i];
            for (int j = pass == 0 ? 0 : c->nfast; j < (pass == 0 ? c->nfast : c->ni); j++)
                o->ind[n++] = c->of->k[c->ind[j]];
        }
        if (pass == 0) o->ode.ns = n;
    }
    o->ode.n = n;
    for (int i = 0; i < n; i++) o->slot[o->ind[i]] = i;
    for (int i = 0; i < o->npart; i++) number_entries(o, &o->part[i]);
    for (int i = 0; i < o->moves->nturn; i++) {
        o->bound[i] = false;
        for (int k = 0; k < 3; k++) o->bound[i] |= o->slot[o->moves->turn[i].iv[k]] < 0;
    }
    o->tangent = 0;
}

static void keep_split(int *to, const struct part *c)
{
    memcpy(to, c->kept, sizeof *to * (size_t)c->of->nrow);
    memcpy(to + c->of->nrow, c->dep, sizeof *to * (size_t)c->nr);
    memcpy(to + c->of->nrow + c->nr, c->ind, sizeof *to * (size_t)c->ni);
}

static void put_back(struct condense *o, struct part *c, const int *from)
{
    o->factored = 0;
    memcpy(c->kept, from, sizeof *from * (size_t)c->of->nrow);
    memcpy(c->dep, from + c->of->nrow, sizeof *from * (size_t)c->nr);
    memcpy(c->ind, from + c->of->nrow + c->nr, sizeof *from * (size_t)c->ni);
    find_places(c);
    find_band(o, c);
    list_entries(c);
    find_leads(o, c);
}

/* Have dependent coordinates come to run away from the independent ones?  Where all splits are singular alike, as in a
 * flat posture, the rates stay moderate. */
static bool runs_away(const struct condense *o, struct part *c)
{
    const double now = component_gain_at_base(o, c);
    c->gain = fmin(c->gain, now);
    return now > fmax(LARGE, 2 * c->gain);
}

/* A new split, if there is a better one.  The base is lost, and found again by the next tangent. */
static int improve(struct condense *o, struct part *c)
{
    const double now = component_gain_at_base(o, c);
    keep_split(o->split, c);
    c->gain = component_choose(o, c) > 0 ? component_gain(o, c) : INFINITY;
    if (c->gain < now / 2) return 1;
    put_back(o, c, o->split);
    c->gain = now;
    return 0;
}

/* Whole velocities first, then the splits, then the velocities of the new independent ones.  The tangent is the one on
 * which the next step begins. */
int condense_rechart(struct ode2 *ode, double *q, double *v, double t)
{
    struct condense *o = ode->self;
    struct trouble why;
    int changed = 0, wanted = 0;
    struct ode2 *tree = &o->tree->ode;
    if (tree->chart && condense_rates(o, o->vt, NULL, q, v, NULL, t, &why) == OK)
        tree->chart->rechart(tree, q, o->vt, t); /* its coordinates stay */
    if (!condense_tangent(o, q)) return 0;
    for (int i = 0; i < o->npart; i++) wanted += o->part[i].away = runs_away(o, &o->part[i]);
    if (!wanted) return 0;
    o->tangent = 0;
    if (condense_rates(o, o->vt, NULL, q, v, NULL, t, &why) != OK) return 0;
    for (int i = 0; i < o->npart; i++)
        if (o->part[i].away) changed |= improve(o, &o->part[i]);
    if (!changed) return 0;
    condense_number(o);
    o->charts++;
    for (int i = 0; i < o->ode.n; i++) v[i] = o->vt[o->ind[i]];
    return 1;
}
