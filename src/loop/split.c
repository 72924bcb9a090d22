/* split.c -- see split.h */
#include "loop/split.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "la/pivot.h"
#include "la/sparse_pivot.h"

/* --- pivots ------------------------------------------------------------------------------------- */

/* Columns of displacements times the length: all numbers of C_q are then of like size. */
static void whole_matrix(struct part *p, const double *unit)
{
    const struct component *c = p->of;
    memset(p->whole, 0, sizeof *p->whole * (size_t)c->nrow * (size_t)c->nk);
    for (int r = 0; r < c->nrow; r++)
        for (int e = c->start[r]; e < c->start[r + 1]; e++)
            p->whole[r + (size_t)c->at[e] * (size_t)c->nrow] = c->F[e] * unit[c->k[c->at[e]]];
}

/* Pivots of the component's C_q; returns how many. */
static int find_pivots(struct split *o, struct part *p, const double *unit, const double *weight, int most,
                       double least)
{
    const struct component *c = p->of;
    int n;
    if (p->whole) {
        whole_matrix(p, unit);
        n = pivot_lu(p->whole, p->prow, p->pcol, c->nrow, c->nk, c->nrow, weight, most, least);
        for (int k = 0; k < n; k++) p->pivot[k] = p->whole[(size_t)k * (size_t)(c->nrow + 1)];
        return n;
    }
    const struct arena_mark mark = arena_mark(o->scratch);
    double *value = TAKE(o->scratch, double, c->start[c->nrow]);
    for (int e = 0; e < c->start[c->nrow]; e++) value[e] = c->F[e] * unit[c->k[c->at[e]]];
    n = sparse_pivot(p->prow, p->pcol, p->pivot, c->start, c->at, value, c->nrow, c->nk, weight, most, least,
                     o->scratch);
    arena_rewind(o->scratch, mark);
    return n;
}

int split_rank(struct split *o, struct part *p, double least)
{
    static const double NOTHING = 1e-10; /* a pivot of round-off: C_q is scaled to numbers of order 1 */
    int rank = find_pivots(o, p, o->rows->size, NULL, p->of->nrow, least);
    while (rank > 0 && fabs(p->pivot[rank - 1]) < NOTHING) rank--;
    return rank;
}

/* --- the order of rows and coordinates ---------------------------------------------------------- */

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

/* Where C_qd can have numbers. */
static void find_band(struct part *p)
{
    enum { WIDE = 16, FEW = 3 }; /* of a few rows all, for which pivot_rows() is quickest */
    const struct component *c = p->of;
    int below = p->nr <= FEW ? p->nr - 1 : 0, above = below;
    if (p->nr == 0) return;
    for (int r = 0; r < p->nr; r++)
        for (int e = c->start[p->kept[r]]; e < c->start[p->kept[r] + 1]; e++) {
            const int j = p->place[c->at[e]];
            if (j < 0) continue;
            if (r - j > below) below = r - j;
            if (j - r > above) above = j - r;
        }
    p->band[0] = below;
    p->band[1] = above + below < p->nr ? above + below : p->nr - 1;
    p->ld = below + p->band[1];
    p->wide = !p->whole && p->ni > WIDE;
}

enum { RUN = 4 }; /* numbers that follow one another; of fewer it is not worth knowing */

/* Which numbers of C_q go where. */
static void list_entries(struct part *p)
{
    const struct component *c = p->of;
    int n = 0;
    p->nof_dep = 0;
    for (int r = 0; r < p->nr; r++) {
        p->from[r] = n;
        for (int e = c->start[p->kept[r]]; e < c->start[p->kept[r] + 1]; e++) {
            const int j = p->place[c->at[e]];
            if (j >= 0)
                p->of_dep[p->nof_dep++] = (struct entry){e, c->k[c->at[e]], p->band[1] + r + j * p->ld, -1};
            else
                p->of_ind[n++] = (struct entry){e, c->k[c->at[e]], -1 - j, -1};
        }
    }
    p->from[p->nr] = n;
    p->runs = n >= RUN * p->nr;
    for (int r = 0; r < p->nr; r++)
        for (const struct entry *x = p->of_ind + p->from[r] + 1; x < p->of_ind + p->from[r + 1]; x++)
            p->runs &= x->e == x[-1].e + 1 && x->k == x[-1].k + 1;
}

static void list_rows(const struct split *o, struct part *p)
{
    const struct loops *l = o->rows->loops;
    p->nlead = 0;
    for (int r = 0; r < p->of->nrow; r++) {
        p->row[r] = p->of->row[p->kept[r]];
        if (r < p->nr && l->model->loop[l->row[p->row[r]].loop].drive) p->lead[p->nlead++] = r;
    }
}

void split_arrange(struct split *o, struct part *p)
{
    for (int j = 0; j < p->nr; j++) p->place[o->rows->column[p->dep[j]]] = j;
    for (int j = 0; j < p->ni; j++) p->place[o->rows->column[p->ind[j]]] = -1 - j;
    find_band(p);
    list_entries(p);
    list_rows(o, p);
    o->number++;
}

/* Splits the coordinates after the pivots have sorted them; fast ones first among the independent.  Rows and dependent
 * columns go from loop to loop, so that C_qd has its numbers near the diagonal. */
static void take_split(struct split *o, struct part *p)
{
    const struct component *c = p->of;
    const bool *urgent = o->rows->tree->model->urgent;
    memcpy(p->kept, p->prow, sizeof *p->kept * (size_t)c->nrow);
    for (int k = 0; k < c->nk; k++) p->place[k] = -1;
    for (int r = 0; r < p->nr; r++) p->place[p->dep[r] = p->pcol[r]] = r;
    sort_by(p->kept, p->nr, p->row_order, o->work);
    sort_by(p->dep, p->nr, p->loop_of, o->work);
    for (int r = 0; r < p->nr; r++) p->dep[r] = c->k[p->dep[r]];
    int n = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < c->nk; k++)
            if (p->place[k] < 0 && urgent[c->k[k]] == (pass == 0)) p->ind[n++] = c->k[k];
    split_arrange(o, p);
}

void split_choose(struct split *o, struct part *p, const double *unit, double fast)
{
    const bool *urgent = o->rows->tree->model->urgent;
    for (int k = 0; k < p->of->nk; k++) o->claim[k] = p->weight[k] * (urgent[p->of->k[k]] ? fast : 1);
    find_pivots(o, p, unit, o->claim, p->nr, 0);
    take_split(o, p);
}

void split_keep(struct split *o, const struct part *p)
{
    int *to = o->kept;
    memcpy(to, p->kept, sizeof *to * (size_t)p->of->nrow);
    memcpy(to + p->of->nrow, p->dep, sizeof *to * (size_t)p->nr);
    memcpy(to + p->of->nrow + p->nr, p->ind, sizeof *to * (size_t)p->ni);
}

void split_return(struct split *o, struct part *p)
{
    const int *from = o->kept;
    memcpy(p->kept, from, sizeof *from * (size_t)p->of->nrow);
    memcpy(p->dep, from + p->of->nrow, sizeof *from * (size_t)p->nr);
    memcpy(p->ind, from + p->of->nrow + p->nr, sizeof *from * (size_t)p->ni);
    split_arrange(o, p);
}

static void part_recall(struct split *o, struct part *p, struct recall *r)
{
    const struct component *c = p->of;
    recall_one(r, "nr", p->nr);
    recall_one(r, "nfast", p->nfast);
    recall_one(r, "chosen", p->chosen);
    recall_one(r, "gain", p->gain);
    recall_one(r, "least_gain", p->least_gain);
    recall_one(r, "best_gain", p->best_gain);
    recall_list(r, "weight", p->weight, c->nk);
    recall_list(r, "kept", p->kept, c->nrow);
    recall_list(r, "dep", p->dep, c->nrow);
    recall_list(r, "ind", p->ind, c->nk);
    p->ni = c->nk - p->nr;
    if (r->back && !*r->wrong) split_arrange(o, p);
}

void split_recall(struct split *o, struct recall *r)
{
    recall_within(r, "split");
    for (int i = 0; i < o->npart; i++) {
        char name[16];
        snprintf(name, sizeof name, "part%d", i);
        recall_within(r, name);
        part_recall(o, &o->part[i], r);
        recall_without(r);
    }
    recall_without(r);
}

/* --- all components ----------------------------------------------------------------------------- */

/* Fast ones first, then slow; coordinates in no loop are all independent.  A component keeps its number of fast ones,
 * whoever they are. */
static void list_independents(struct split *o)
{
    const struct rows *rows = o->rows;
    const bool *urgent = rows->tree->model->urgent;
    o->n = 0;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < rows->n; i++)
            if (rows->owner[i] < 0 && urgent[i] == (pass == 0)) o->ind[o->n++] = i;
        for (const struct part *p = o->part; p < o->part + o->npart; p++)
            for (int j = pass == 0 ? 0 : p->nfast; j < (pass == 0 ? p->nfast : p->ni); j++) o->ind[o->n++] = p->ind[j];
        if (pass == 0) o->ns = o->n;
    }
}

static void number_entries(const struct split *o, struct part *p)
{
    p->runs_on = p->runs;
    for (int r = 0; r < p->nr; r++)
        for (struct entry *x = p->of_ind + p->from[r]; x < p->of_ind + p->from[r + 1]; x++) {
            x->slot = o->slot[x->k];
            p->runs_on &= x == p->of_ind + p->from[r] || x->slot == x[-1].slot + 1;
        }
}

void split_number(struct split *o)
{
    const struct moves *moves = &o->rows->tree->moves;
    list_independents(o);
    for (int i = 0; i < o->rows->n; i++) o->slot[i] = -1;
    for (int i = 0; i < o->n; i++) o->slot[o->ind[i]] = i;
    for (o->run = 0; o->run < o->n && o->ind[o->run] == o->ind[0] + o->run;) o->run++;
    if (o->run < RUN) o->run = 0;
    for (struct part *p = o->part; p < o->part + o->npart; p++) number_entries(o, p);
    for (int i = 0; i < moves->nturn; i++) {
        o->follows[i] = false;
        for (int k = 0; k < 3; k++) o->follows[i] |= o->slot[moves->turn[i].iv[k]] < 0;
    }
}

bool split_drops(const struct split *o, int row)
{
    for (const struct part *p = o->part; p < o->part + o->npart; p++)
        for (int r = p->nr; r < p->of->nrow; r++)
            if (p->row[r] == row) return true;
    return false;
}

void split_spread(const struct split *o, double *restrict xt, const double *restrict x)
{
    const int run = o->run;
    memset(xt, 0, sizeof *xt * (size_t)o->rows->n);
    for (int i = 0; i < run; i++) xt[o->ind[0] + i] = x[i];
    for (int i = run; i < o->n; i++) xt[o->ind[i]] = x[i];
}

/* --- building ----------------------------------------------------------------------------------- */

static void build_part(struct split *o, struct part *p, struct arena *life)
{
    enum { SMALL = 4096 }; /* numbers of C_q: below, dense is no slower */
    const struct component *c = p->of;
    const int fewest = c->nrow < c->nk ? c->nrow : c->nk, entries = c->start[c->nrow];
    const size_t size = (size_t)c->nrow * (size_t)c->nk;
    p->kept = TAKE(life, int, c->nrow);
    p->row = TAKE(life, int, c->nrow);
    p->dep = TAKE(life, int, c->nrow);
    p->ind = TAKE(life, int, c->nk);
    p->place = TAKE(life, int, c->nk);
    p->lead = TAKE(life, int, c->nrow);
    p->of_dep = TAKE(life, struct entry, entries);
    p->of_ind = TAKE(life, struct entry, entries);
    p->from = TAKE(life, int, c->nrow + 1);
    p->weight = TAKE(life, double, c->nk);
    p->loop_of = TAKE(life, int, c->nk);
    p->row_order = TAKE(life, int, c->nrow);
    p->prow = TAKE(life, int, c->nrow);
    p->pcol = TAKE(life, int, c->nk);
    p->pivot = TAKE(life, double, fewest);
    if (size <= SMALL) p->whole = TAKE(life, double, size);
    split_order(o, p);
}

static void close_scratch(void *scratch)
{
    arena_close(scratch);
}

void split_build(struct split *o, const struct rows *rows, struct arena *life)
{
    const int most = rows->n > rows->loops->nrow ? rows->n : rows->loops->nrow;
    *o = (struct split){.rows = rows, .npart = rows->ncomponent, .scratch = arena_open()};
    arena_defer(life, close_scratch, o->scratch);
    o->part = TAKE(life, struct part, o->npart);
    o->ind = TAKE(life, int, rows->n);
    o->slot = TAKE(life, int, rows->n);
    o->reach = TAKE(life, double, rows->n);
    o->follows = TAKE(life, bool, rows->tree->moves.nturn);
    o->kept = TAKE(life, int, 2 * rows->n + rows->loops->nrow);
    o->work = TAKE(life, int, most);
    o->claim = TAKE(life, double, rows->n);
    o->x = TAKE(life, double, most);
    o->y = TAKE(life, double, most);
    split_reach(o);
    for (int i = 0; i < o->npart; i++) {
        o->part[i].of = &rows->component[i];
        build_part(o, &o->part[i], life);
    }
}
