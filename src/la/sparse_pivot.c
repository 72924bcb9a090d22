/* sparse_pivot.c -- see sparse_pivot.h
 *
 * Every row knows its best number; a tournament of the rows finds the best of all.  A pivot changes the rows that have
 * a number in its column, which are listed by column, and only these play again. */
#include "la/sparse_pivot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Numbers of a row by column, or the rows of a column. */
struct list {
    int n, room, *at;
    double *x; /* of rows */
};

struct elimination {
    struct arena *scratch;
    const double *weight;
    struct list *row, *column;
    int *row_here, *row_place; /* which row stands at a place, and where a row stands */
    int *column_here, *column_place;
    double *best;        /* [m] largest |x| weight of the row; 0: none left */
    int *best_at;        /* [m] its column */
    int leaves, *winner; /* [2 leaves] of the tournament; leaves: the rows, -1: none */
    int *entry;          /* [n] place in the row at work, less 1; 0: not there */
};

static void append(struct list *o, struct arena *scratch, int at, double x, bool numbers)
{
    if (o->n == o->room) {
        struct list old = *o;
        o->room = 2 * old.room + 4;
        o->at = TAKE(scratch, int, o->room);
        if (old.n) memcpy(o->at, old.at, sizeof *o->at * (size_t)old.n);
        if (numbers) o->x = TAKE(scratch, double, o->room);
        if (numbers && old.n) memcpy(o->x, old.x, sizeof *o->x * (size_t)old.n);
    }
    if (numbers) o->x[o->n] = x;
    o->at[o->n++] = at;
}

/* --- the search --------------------------------------------------------------------------------- */

static void find_best(struct elimination *o, int i)
{
    const struct list *r = &o->row[i];
    double best = 0;
    int at = -1;
    for (int e = 0; e < r->n; e++) {
        const int j = r->at[e];
        const double x = fabs(r->x[e]) * (o->weight ? o->weight[j] : 1);
        if (x > best || (x > 0 && x == best && o->column_place[j] < o->column_place[at])) best = x, at = j;
    }
    o->best[i] = best;
    o->best_at[i] = at;
}

/* The better of two rows, -1: none. */
static int better(const struct elimination *o, int a, int b)
{
    if (a < 0 || o->best[a] == 0) return b;
    if (b < 0 || o->best[b] < o->best[a]) return a;
    if (o->best[a] < o->best[b]) return b;
    const int pa = o->column_place[o->best_at[a]], pb = o->column_place[o->best_at[b]];
    if (pa != pb) return pa < pb ? a : b;
    return o->row_place[a] < o->row_place[b] ? a : b;
}

static void play(struct elimination *o, int i)
{
    find_best(o, i);
    for (int k = (o->leaves + i) / 2; k > 0; k /= 2) o->winner[k] = better(o, o->winner[2 * k], o->winner[2 * k + 1]);
}

/* --- a pivot ------------------------------------------------------------------------------------ */

static void stand(int *here, int *place, int at, int what)
{
    here[at] = what;
    place[what] = at;
}

/* Brings the pivot to place k; what stood there takes its place and plays with it. */
static void bring(struct elimination *o, int k, int pi, int pj)
{
    const int i = o->row_here[k], j = o->column_here[k], to_row = o->row_place[pi], to_column = o->column_place[pj];
    stand(o->row_here, o->row_place, to_row, i);
    stand(o->row_here, o->row_place, k, pi);
    stand(o->column_here, o->column_place, to_column, j);
    stand(o->column_here, o->column_place, k, pj);
    if (i != pi) play(o, i);
    for (int e = 0; j != pj && e < o->column[j].n; e++) {
        const int r = o->column[j].at[e];
        if (o->row_place[r] > k) play(o, r);
    }
}

/* The number in column j out of row r; 0: there was none. */
static double take_out(struct list *r, int j)
{
    for (int e = 0; e < r->n; e++) {
        if (r->at[e] != j) continue;
        const double x = r->x[e];
        r->at[e] = r->at[--r->n];
        r->x[e] = r->x[r->n];
        return x;
    }
    return 0;
}

/* Row i -= f row p */
static void subtract(struct elimination *o, int i, int p, double f)
{
    struct list *r = &o->row[i];
    const struct list *u = &o->row[p];
    for (int e = 0; e < r->n; e++) o->entry[r->at[e]] = e + 1;
    const int old = r->n;
    for (int e = 0; e < u->n; e++) {
        const int j = u->at[e], place = o->entry[j];
        if (place) {
            r->x[place - 1] -= f * u->x[e];
            continue;
        }
        append(r, o->scratch, j, 0 - f * u->x[e], true);
        append(&o->column[j], o->scratch, i, 0, false);
    }
    for (int e = 0; e < old; e++) o->entry[r->at[e]] = 0;
}

/* Row pi leaves the tournament; the other rows lose column pj. */
static double eliminate(struct elimination *o, int pi, int pj)
{
    const int k = o->row_place[pi];
    const double pivot = take_out(&o->row[pi], pj);
    for (int e = 0; e < o->column[pj].n; e++) {
        const int i = o->column[pj].at[e];
        if (o->row_place[i] <= k) continue;
        const double f = take_out(&o->row[i], pj) / pivot;
        if (f != 0) subtract(o, i, pi, f);
        play(o, i);
    }
    o->row[pi].n = 0;
    play(o, pi);
    return pivot;
}

/* --- all of it ---------------------------------------------------------------------------------- */

static void read(struct elimination *o, const int *start, const int *column, const double *value, int m, int n)
{
    o->row = TAKE(o->scratch, struct list, m);
    o->column = TAKE(o->scratch, struct list, n);
    for (int i = 0; i < m; i++)
        for (int e = start[i]; e < start[i + 1]; e++) {
            append(&o->row[i], o->scratch, column[e], value[e], true);
            append(&o->column[column[e]], o->scratch, i, 0, false);
        }
}

static void prepare(struct elimination *o, int m, int n)
{
    o->row_place = TAKE(o->scratch, int, m);
    o->column_place = TAKE(o->scratch, int, n);
    o->best = TAKE(o->scratch, double, m);
    o->best_at = TAKE(o->scratch, int, m);
    o->entry = TAKE(o->scratch, int, n);
    for (int i = 0; i < m; i++) stand(o->row_here, o->row_place, i, i);
    for (int j = 0; j < n; j++) stand(o->column_here, o->column_place, j, j);
    for (o->leaves = 1; o->leaves < m;) o->leaves *= 2;
    o->winner = TAKE(o->scratch, int, 2 * o->leaves);
    for (int i = 0; i < o->leaves; i++) o->winner[o->leaves + i] = i < m ? i : -1;
    for (int i = 0; i < m; i++) find_best(o, i);
    for (int k = o->leaves - 1; k > 0; k--) o->winner[k] = better(o, o->winner[2 * k], o->winner[2 * k + 1]);
}

int sparse_pivot(int *row, int *col, double *pivot, const int *start, const int *column, const double *value, int m,
                 int n, const double *weight, int most, double least, struct arena *scratch)
{
    const struct arena_mark mark = arena_mark(scratch);
    struct elimination o = {.scratch = scratch, .weight = weight, .row_here = row, .column_here = col};
    double first = 0;
    int k = 0;
    read(&o, start, column, value, m, n);
    prepare(&o, m, n);
    for (; k < most && k < m && k < n; k++) {
        const int pi = o.winner[1];
        if (pi < 0 || o.best[pi] == 0) break;
        if (k == 0) first = o.best[pi];
        if (!(o.best[pi] > least * first)) break;
        const int pj = o.best_at[pi];
        bring(&o, k, pi, pj);
        pivot[k] = eliminate(&o, pi, pj);
    }
    arena_rewind(scratch, mark);
    return k;
}
