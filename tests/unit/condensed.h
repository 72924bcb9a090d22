/* condensed.h -- random linkages with drives, and the objects of their condensation each by itself: rows, split, solve,
 * closing, without condense.h on top. */
#ifndef FMDSUB_TESTS_CONDENSED_H
#define FMDSUB_TESTS_CONDENSED_H

#include "loop/closing.h"
#include "unit/absolute.h"

struct bench {
    struct arena *arena;
    struct mechanism mechanism;
    struct open_tree tree;
    struct rows rows;
    struct split split;
    struct solve solve;
    struct closing closing;
    int n, nrow;
    double *q, *q1;        /* [nq] */
    double *v, *a, *x, *y; /* [n] */
    double *C, *C1;        /* [nrow] */
};

/* --- a linkage, and its objects ------------------------------------------------------------------------- */

static inline void open_bench(struct bench *o, int space, unsigned seed)
{
    struct place drawn[MOST_BODIES] = {{.r = {0}}};
    memset(o, 0, sizeof *o);
    o->arena = arena_open();
    make(&o->mechanism, drawn, space, seed, false, o->arena);
    const struct model *m = &o->mechanism.model;
    open_build(&o->tree, m, o->arena);
    rows_build(&o->rows, &o->tree, o->arena);
    split_build(&o->split, &o->rows, o->arena);
    solve_build(&o->solve, &o->rows, &o->split, o->arena);
    closing_build(&o->closing, &o->solve, o->arena);
    o->n = m->n;
    o->nrow = o->rows.loops->nrow;
    double **of_places[] = {&o->q, &o->q1}, **of_tree[] = {&o->v, &o->a, &o->x, &o->y}, **of_rows[] = {&o->C, &o->C1};
    for (int i = 0; i < 2; i++) *of_places[i] = TAKE(o->arena, double, m->nq);
    for (int i = 0; i < 4; i++) *of_tree[i] = TAKE(o->arena, double, o->n);
    for (int i = 0; i < 2; i++) *of_rows[i] = TAKE(o->arena, double, o->nrow);
    loops_when(o->rows.loops, 0, 0);
    memcpy(o->q, m->q0, sizeof *o->q * (size_t)m->nq);
}

static inline void roll(double *x, int n, double size, struct tree_dice *d)
{
    for (int i = 0; i < n; i++) x[i] = tree_roll(d, -size, size);
}

/* A split for q, after the coordinates' weights; its pivot ratio. */
static inline double choose(struct bench *o, const double *q)
{
    struct part *p = &o->split.part[0];
    rows_linearize(&o->rows, q);
    p->nr = split_rank(&o->split, p, 1e-8);
    p->ni = p->of->nk - p->nr;
    split_choose(&o->split, p, o->rows.size, 1);
    solve_fit(&o->solve, 0);
    closing_fit(&o->closing, 0);
    split_number(&o->split);
    return solve_try(&o->solve, 0);
}

static inline void weigh(struct bench *o, struct tree_dice *d)
{
    for (int k = 0; k < o->rows.component[0].nk; k++) o->split.part[0].weight[k] = d ? pow(10, tree_roll(d, -1, 0)) : 1;
}

/* Any posture, closed or not, and a good split there. */
static inline bool open_anywhere(struct bench *o, int space, unsigned seed, struct tree_dice *d)
{
    open_bench(o, space, seed);
    roll(o->x, o->n, .5, d);
    moves_point(&o->tree.moves, o->q, o->mechanism.model.q0, o->x, 1);
    weigh(o, NULL);
    roll(o->v, o->n, 1, d);
    roll(o->a, o->n, 1, d);
    return choose(o, o->q) > 1e-2;
}

static inline double number(const struct component *c, int r, int k)
{
    for (int e = c->start[r]; e < c->start[r + 1]; e++)
        if (c->at[e] == k) return c->F[e];
    return 0;
}

#endif
