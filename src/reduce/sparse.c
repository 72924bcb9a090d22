/* sparse.c -- entries sorted by two passes of counting, columns then rows; see sparse.h */
#include "reduce/sparse.h"

#include <assert.h>
#include <math.h>

/* order [count]: entries `from` (NULL: as they come) sorted by key, equal ones as they came; start [n + 1]: where
 * each key's run starts. */
static void sort_by(int *order, size_t *start, const int *key, const int *from, int count, int n, struct arena *scratch)
{
    size_t *at = TAKE(scratch, size_t, n + 1);
    for (int k = 0; k < count; k++) start[key[k] + 1]++;
    for (int i = 0; i < n; i++) start[i + 1] += start[i];
    for (int i = 0; i <= n; i++) at[i] = start[i];
    for (int k = 0; k < count; k++) {
        int e = from ? from[k] : k;
        order[at[key[e]]++] = e;
    }
}

/* Entries with their mirror images. */
static void mirror(struct triplets *o, const struct triplets *from, struct arena *scratch)
{
    int capacity = from->half ? 2 * from->count : from->count;
    *o = (struct triplets){.n = from->n,
                           .i = TAKE(scratch, int, capacity),
                           .j = TAKE(scratch, int, capacity),
                           .v = TAKE(scratch, double, capacity),
                           .line = TAKE(scratch, int, capacity)};
    for (int k = 0; k < from->count; k++)
        for (int turn = 0; turn < (from->half && from->i[k] != from->j[k] ? 2 : 1); turn++) {
            o->i[o->count] = turn ? from->j[k] : from->i[k];
            o->j[o->count] = turn ? from->i[k] : from->j[k];
            o->v[o->count] = from->v[k];
            o->line[o->count++] = from->line[k];
        }
}

static enum status check_twice(const struct triplets *t, const int *order, struct text *text)
{
    for (int k = 1; k < t->count; k++) {
        int a = order[k - 1], b = order[k];
        if (t->i[a] != t->i[b] || t->j[a] != t->j[b]) continue;
        text->line = t->line[b] > t->line[a] ? t->line[b] : t->line[a];
        return text_bad(text, "this entry was given before, on line %d",
                        t->line[b] > t->line[a] ? t->line[a] : t->line[b]);
    }
    return OK;
}

/* |A(i,j) - A(j,i)| within 1e-8 of the geometric mean of the diagonal. */
static enum status check_symmetry(const struct sparse *A, const struct triplets *t, const int *order, struct text *text)
{
    assert(A->v);
    for (int i = 0; i < A->n; i++)
        for (size_t k = A->row[i]; k < A->row[i + 1]; k++) {
            const double *back = sparse_at(A, A->col[k], i), *a = sparse_at(A, i, i);
            const double *b = sparse_at(A, A->col[k], A->col[k]);
            double scale = sqrt(fabs(a ? *a : 0) * fabs(b ? *b : 0)), other = back ? *back : 0;
            if (fabs(A->v[k] - other) <= 1e-8 * scale) continue;
            text->line = t->line[order[k]];
            return text_bad(text, "the matrix is not symmetric: %.9g here, %.9g across the diagonal", A->v[k], other);
        }
    return OK;
}

enum status sparse_build(struct sparse *o, const struct triplets *from, struct text *text, struct arena *life)
{
    struct arena *scratch = arena_open();
    struct triplets t;
    mirror(&t, from, scratch);
    int *by_col = TAKE(scratch, int, t.count), *order = TAKE(scratch, int, t.count);
    *o = (struct sparse){.n = t.n,
                         .row = TAKE(life, size_t, t.n + 1),
                         .col = TAKE(life, int, t.count),
                         .v = TAKE(life, double, t.count)};
    sort_by(by_col, TAKE(scratch, size_t, t.n + 1), t.j, NULL, t.count, t.n, scratch);
    sort_by(order, o->row, t.i, by_col, t.count, t.n, scratch);
    for (int k = 0; k < t.count; k++) {
        o->col[k] = t.j[order[k]];
        o->v[k] = t.v[order[k]];
    }
    enum status status = check_twice(&t, order, text);
    if (status == OK && !from->half) status = check_symmetry(o, &t, order, text);
    arena_close(scratch);
    return status;
}

void sparse_mul(double *y, const struct sparse *A, const double *x)
{
    for (int i = 0; i < A->n; i++) {
        double sum = 0;
        for (size_t k = A->row[i]; k < A->row[i + 1]; k++) sum += A->v[k] * x[A->col[k]];
        y[i] = sum;
    }
}

double *sparse_at(const struct sparse *A, int i, int j)
{
    size_t low = A->row[i], high = A->row[i + 1];
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (A->col[middle] == j) return A->v + middle;
        if (A->col[middle] < j)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}
