/* sparse_pivot.c -- see sparse_pivot.h
 *
 * Every row knows its best number; a tournament of the rows finds the best of all.  A pivot changes the rows that have
 * a number in its column, which are listed by column, and only these play again.  Best is what is of the largest
 * class, sizes [2^k, 2^(k+1)), and in it what promises the least fill. */
#include "la/sparse_pivot.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Numbers of a row by column, or the rows that have had one in a column. */
struct list {
    int n, capacity, *at;
    double *x; /* of rows */
};

/* A row's best number. */
struct best {
    int column; /* -1: none */
    int class;
    double size, fill; /* fill: new numbers at most, when it played */
};

struct elimination {
    struct arena *scratch;
    const double *weight;
    struct list *row, *column;
    int *count; /* [n] rows left that have a number in the column */
    bool *row_done, *column_done;
    struct best *best;
    int leaves, *winner; /* [2 leaves] of the tournament; leaves: the rows, -1: none */
    int *entry;          /* [n] place in the row at work, less 1; 0: not there */
};

static void append(struct list *o, struct arena *scratch, int at, double x, bool numbers)
{
    if (o->n == o->capacity) {
        struct list old = *o;
        o->capacity = 2 * old.capacity + 4;
        o->at = TAKE(scratch, int, o->capacity);
        if (old.n) memcpy(o->at, old.at, sizeof *o->at * (size_t)old.n);
        if (numbers) o->x = TAKE(scratch, double, o->capacity);
        if (numbers && old.n) memcpy(o->x, old.x, sizeof *o->x * (size_t)old.n);
    }
    if (numbers) o->x[o->n] = x;
    o->at[o->n++] = at;
}

static void put(struct elimination *o, int i, int j, double x)
{
    append(&o->row[i], o->scratch, j, x, true);
    append(&o->column[j], o->scratch, i, 0, false);
    o->count[j]++;
}

/* --- the search --------------------------------------------------------------------------------- */

/* Classes begin away from 1, -1 and their halves, which geometry makes often and round-off would scatter. */
static int class_of(double size)
{
    static const double BETWEEN = 1.37;
    return ilogb(BETWEEN * size);
}

static void find_best(struct elimination *o, int i)
{
    const struct list *r = &o->row[i];
    struct best *b = &o->best[i];
    b->column = -1;
    for (int e = 0; e < r->n; e++) {
        const int j = r->at[e];
        const double size = fabs(r->x[e]) * (o->weight ? o->weight[j] : 1);
        if (!(size > 0 && isfinite(size))) continue;
        const int class = class_of(size);
        if (b->column >= 0 && (class < b->class || (class == b->class && o->count[j] >= o->count[b->column]))) continue;
        *b = (struct best){j, class, size, (double)(r->n - 1) * (o->count[j] - 1)};
    }
}

/* The better of two rows, -1: none. */
static int better(const struct elimination *o, int a, int b)
{
    if (a < 0 || o->best[a].column < 0) return b;
    if (b < 0 || o->best[b].column < 0) return a;
    if (o->best[a].class != o->best[b].class) return o->best[a].class > o->best[b].class ? a : b;
    if (o->best[a].fill != o->best[b].fill) return o->best[a].fill < o->best[b].fill ? a : b;
    return a < b ? a : b;
}

static void play(struct elimination *o, int i)
{
    find_best(o, i);
    for (int k = (o->leaves + i) / 2; k > 0; k /= 2) o->winner[k] = better(o, o->winner[2 * k], o->winner[2 * k + 1]);
}

/* --- a pivot ------------------------------------------------------------------------------------ */

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
    const int old = r->n;
    for (int e = 0; e < old; e++) o->entry[r->at[e]] = e + 1;
    for (int e = 0; e < u->n; e++) {
        const int place = o->entry[u->at[e]];
        if (place)
            r->x[place - 1] -= f * u->x[e];
        else
            put(o, i, u->at[e], -f * u->x[e]);
    }
    for (int e = 0; e < old; e++) o->entry[r->at[e]] = 0;
}

/* Row p leaves with its best number; the other rows lose that column. */
static double eliminate(struct elimination *o, int p)
{
    const int j = o->best[p].column;
    const double pivot = take_out(&o->row[p], j);
    o->row_done[p] = o->column_done[j] = true;
    for (int e = 0; e < o->row[p].n; e++) o->count[o->row[p].at[e]]--;
    for (int e = 0; e < o->column[j].n; e++) {
        const int i = o->column[j].at[e];
        if (o->row_done[i]) continue;
        const double f = take_out(&o->row[i], j) / pivot;
        if (f != 0) subtract(o, i, p, f);
        play(o, i);
    }
    o->row[p].n = 0;
    play(o, p);
    return pivot;
}

/* --- all of it ---------------------------------------------------------------------------------- */

static void prepare(struct elimination *o, const int *start, const int *column, const double *value, int m, int n)
{
    o->row = TAKE(o->scratch, struct list, m);
    o->column = TAKE(o->scratch, struct list, n);
    o->count = TAKE(o->scratch, int, n);
    o->row_done = TAKE(o->scratch, bool, m);
    o->column_done = TAKE(o->scratch, bool, n);
    o->best = TAKE(o->scratch, struct best, m);
    o->entry = TAKE(o->scratch, int, n);
    for (int i = 0; i < m; i++)
        for (int e = start[i]; e < start[i + 1]; e++)
            if (value[e] != 0) put(o, i, column[e], value[e]);
    for (o->leaves = 1; o->leaves < m;) o->leaves *= 2;
    o->winner = TAKE(o->scratch, int, 2 * o->leaves);
    for (int i = 0; i < o->leaves; i++) o->winner[o->leaves + i] = i < m ? i : -1;
    for (int i = 0; i < m; i++) find_best(o, i);
    for (int k = o->leaves - 1; k > 0; k--) o->winner[k] = better(o, o->winner[2 * k], o->winner[2 * k + 1]);
}

static void list_others(int *list, const bool *done, int n, int from)
{
    for (int i = 0; i < n; i++)
        if (!done[i]) list[from++] = i;
}

int sparse_pivot(int *row, int *col, double *pivot, const int *start, const int *column, const double *value, int m,
                 int n, const double *weight, int most, double least, struct arena *scratch)
{
    const struct arena_mark mark = arena_mark(scratch);
    struct elimination o = {.scratch = scratch, .weight = weight};
    double first = 0;
    int k = 0;
    prepare(&o, start, column, value, m, n);
    for (; k < most && k < m && k < n; k++) {
        const int p = o.winner[1];
        if (p < 0 || o.best[p].column < 0) break;
        if (k == 0) first = o.best[p].size;
        if (!(o.best[p].size > least * first)) break;
        row[k] = p;
        col[k] = o.best[p].column;
        pivot[k] = eliminate(&o, p);
    }
    list_others(row, o.row_done, m, k);
    list_others(col, o.column_done, n, k);
    arena_rewind(scratch, mark);
    return k;
}
