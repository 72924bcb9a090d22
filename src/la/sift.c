/* sift.c -- see sift.h */
#include "la/sift.h"

#include "la/wide.h"

enum { MOST = 16, SPREAD = 3 }; /* groups; what a block takes besides its product, in columns */

/* --- building ----------------------------------------------------------------------------------- */

/* While groups are being made; each has all places of the row that it began with (-1: every place). */
struct sorting {
    const double *A;
    int rows, cols, ngroup, first[MOST], wide[MOST], many[MOST];
    int *of;   /* [rows] group; -1: a row of zeros */
    int *full; /* [rows] entries that are not zero */
};

static int fits(const struct sorting *s, int row, int into)
{
    for (int j = 0; j < s->cols; j++) {
        const double *c = s->A + (long)j * s->rows;
        if (c[row] != 0 && c[into] == 0) return 0;
    }
    return 1;
}

/* The group of fewest columns that has all of the row and not much else; a new one; -1: there are too many. */
static int group_of(struct sorting *s, int row)
{
    const int n = s->full[row];
    int best = -1;
    for (int g = 0; g < s->ngroup; g++) {
        if (s->wide[g] - n > 1 + n / 2 || (best >= 0 && s->wide[g] >= s->wide[best])) continue;
        if (fits(s, row, s->first[g])) best = g;
    }
    if (best >= 0 || s->ngroup == MOST) return best;
    s->first[s->ngroup] = row;
    s->wide[s->ngroup] = n;
    return s->ngroup++;
}

/* What a group costs, in columns of a block. */
static long cost(int rows, int cols)
{
    return (long)((rows + SIFT_BLOCK - 1) / SIFT_BLOCK) * (SPREAD + cols);
}

/* Rows of many entries first.  Returns what all groups cost; -1: there would be too many. */
static long sort_rows(struct sorting *s)
{
    long sum = 0;
    for (int i = 0; i < s->rows; i++) {
        s->of[i] = -1;
        for (int j = 0; j < s->cols; j++) s->full[i] += s->A[i + (long)j * s->rows] != 0;
    }
    for (int n = s->cols; n > 0; n--)
        for (int i = 0; i < s->rows; i++) {
            if (s->full[i] != n) continue;
            s->of[i] = group_of(s, i);
            if (s->of[i] < 0) return -1;
            s->many[s->of[i]]++;
        }
    for (int g = 0; g < s->ngroup; g++) sum += cost(s->many[g], s->wide[g]);
    return sum;
}

/* All rows with all columns. */
static void all_in_one(struct sorting *s)
{
    s->ngroup = 1;
    s->first[0] = -1;
    s->wide[0] = s->cols;
    s->many[0] = s->rows;
    for (int i = 0; i < s->rows; i++) s->of[i] = 0;
}

static void take_group(struct sift_group *o, const struct sorting *s, const double *base, int g, struct arena *life)
{
    int n = 0, k = 0, last = 0;
    o->blocks = (s->many[g] + SIFT_BLOCK - 1) / SIFT_BLOCK;
    o->ncol = s->wide[g];
    o->row = TAKE(life, int, o->blocks *SIFT_BLOCK);
    o->col = TAKE(life, int, o->ncol);
    o->A = TAKE(life, double, (long)o->blocks * o->ncol * SIFT_BLOCK);
    for (int i = 0; i < s->rows; i++)
        if (s->of[i] == g) o->row[k++] = last = i;
    while (k < o->blocks * SIFT_BLOCK) o->row[k++] = last;
    n = 0;
    for (int j = 0; j < s->cols; j++)
        if (s->first[g] < 0 || s->A[s->first[g] + (long)j * s->rows] != 0) o->col[n++] = j;
    o->base = base ? TAKE(life, double, o->blocks *SIFT_BLOCK) : NULL;
    for (int i = 0; base && i < o->blocks * SIFT_BLOCK; i++) o->base[i] = base[o->row[i]];
    double *A = o->A;
    for (int b = 0; b < o->blocks; b++)
        for (int c = 0; c < o->ncol; c++)
            for (k = 0; k < SIFT_BLOCK; k++) *A++ = s->A[o->row[b * SIFT_BLOCK + k] + (long)o->col[c] * s->rows];
}

void sift_build(struct sift *o, const double *A, const double *base, int rows, int cols, struct arena *life)
{
    struct sorting s = {A, rows, cols, .of = TAKE(life, int, rows), .full = TAKE(life, int, rows)};
    const long sorted = sort_rows(&s);
    if (sorted < 0 || sorted > cost(rows, cols)) all_in_one(&s);
    o->ngroup = s.ngroup;
    o->group = TAKE(life, struct sift_group, s.ngroup);
    for (int g = 0; g < s.ngroup; g++) take_group(&o->group[g], &s, base, g, life);
}

/* --- product ------------------------------------------------------------------------------------ */

/* Half a block in a register; the same bits, however many numbers that takes. */
typedef double half __attribute__((vector_size(SIFT_BLOCK / 2 * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Written out: as a loop it takes as long as the product. */
INTO static inline void spread(double *restrict y, const half *s, const int *restrict row)
{
    y[row[0]] = (*s)[0];
    y[row[1]] = (*s)[1];
    y[row[2]] = (*s)[2];
    y[row[3]] = (*s)[3];
}

INTO static inline void block(double *restrict y, const double *restrict A, const double *restrict base,
                              const int *restrict row, const int *restrict col, int ncol, const double *restrict x)
{
    half s = *(const half *)base, t = *(const half *)(base + SIFT_BLOCK / 2);
    for (int c = 0; c < ncol; c++, A += SIFT_BLOCK) {
        const double f = x[col[c]];
        s += *(const half *)A * f;
        t += *(const half *)(A + SIFT_BLOCK / 2) * f;
    }
    spread(y, &s, row);
    spread(y, &t, row + SIFT_BLOCK / 2);
}

/* A base of zeros has no stride. */
WIDE static void groups(double *restrict y, const struct sift *o, const double *restrict x, int based)
{
    static const double none[SIFT_BLOCK];
    const int stride = based ? SIFT_BLOCK : 0;
    for (int g = 0; g < o->ngroup; g++) {
        const struct sift_group *at = &o->group[g];
        const double *base = based ? at->base : none;
        const long size = (long)at->ncol * SIFT_BLOCK;
        for (int b = 0; b < at->blocks; b++)
            block(y, at->A + size * b, base + stride * b, at->row + SIFT_BLOCK * b, at->col, at->ncol, x);
    }
}

void sift_at(double *restrict y, const struct sift *o, const double *restrict x)
{
    groups(y, o, x, 1);
}

void sift_times(double *restrict y, const struct sift *o, const double *restrict x)
{
    groups(y, o, x, 0);
}
