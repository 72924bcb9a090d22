/* factor.c -- see factor.h */
#include "reduce/factor.h"

#include <stdlib.h>
#include <string.h>

#include "reduce/lapack.h"

enum { MOST_BAND = 1 << 30 }; /* numbers */

/* Nodes joined by the matrix. */
struct graph {
    int n;
    size_t *start; /* [n + 1] */
    int *to;
};

/* to [return] (NULL: only counted): the nodes in the rows of `node`; mark [nodes]: who was met by whom. */
static int neighbours(const struct sparse *A, int node, int *to, int *mark)
{
    int n = 0;
    for (size_t k = A->row[3 * node]; k < A->row[3 * node + 3]; k++) {
        int other = A->col[k] / 3;
        if (other == node || mark[other] == node + 1) continue;
        mark[other] = node + 1;
        if (to) to[n] = other;
        n++;
    }
    return n;
}

static void graph_of(struct graph *o, const struct sparse *A, int nodes, struct arena *scratch)
{
    int *mark = TAKE(scratch, int, nodes);
    o->n = nodes;
    o->start = TAKE(scratch, size_t, nodes + 1);
    for (int i = 0; i < nodes; i++) o->start[i + 1] = o->start[i] + (size_t)neighbours(A, i, NULL, mark);
    o->to = TAKE(scratch, int, o->start[nodes]);
    memset(mark, 0, (size_t)nodes * sizeof *mark);
    for (int i = 0; i < nodes; i++) neighbours(A, i, o->to + o->start[i], mark);
}

static int degree(const struct graph *g, int i)
{
    return (int)(g->start[i + 1] - g->start[i]);
}

/* Breadth first from `root` over nodes without a level; list [return] in order, level set; children by degree. */
static int spread(int *list, int *level, const struct graph *g, int root)
{
    int n = 0;
    list[n++] = root;
    level[root] = 1;
    for (int i = 0; i < n; i++) {
        int first = n;
        for (size_t k = g->start[list[i]]; k < g->start[list[i] + 1]; k++) {
            int other = g->to[k];
            if (level[other]) continue;
            level[other] = level[list[i]] + 1;
            int at = n++;
            for (; at > first && degree(g, list[at - 1]) > degree(g, other); at--) list[at] = list[at - 1];
            list[at] = other;
        }
    }
    return n;
}

/* An end of the component of `root`: the last level's node of least degree, as long as there are more levels. */
static int far_end(int *list, int *level, const struct graph *g, int root)
{
    for (int depth = 0;;) {
        int n = spread(list, level, g, root), deepest = level[list[n - 1]], best = list[n - 1];
        for (int i = n - 1; i >= 0 && level[list[i]] == deepest; i--)
            if (degree(g, list[i]) <= degree(g, best)) best = list[i];
        for (int i = 0; i < n; i++) level[list[i]] = 0;
        if (deepest <= depth) return root;
        depth = deepest;
        root = best;
    }
}

/* node [nodes]: new order of the nodes of A (three rows each) that leads to a small band. */
static void order(int *node, const struct sparse *A, int nodes)
{
    struct arena *scratch = arena_open();
    struct graph g;
    int *level = TAKE(scratch, int, nodes), *list = TAKE(scratch, int, nodes), n = 0;
    graph_of(&g, A, nodes, scratch);
    for (int i = 0; i < nodes; i++)
        if (!level[i]) n += spread(node + n, level, &g, far_end(list, level, &g, i));
    for (int i = 0; i < nodes / 2; i++) {
        int swap = node[i];
        node[i] = node[nodes - 1 - i];
        node[nodes - 1 - i] = swap;
    }
    arena_close(scratch);
}

/* of [return], place [3 nodes]: the freedoms that are not held, in the order of the band. */
static int number(int *of, int *place, const struct sparse *A, const bool *held, struct arena *life)
{
    int nodes = A->n / 3, n = 0;
    int *node = TAKE(life, int, nodes);
    order(node, A, nodes);
    for (int i = 0; i < A->n; i++) place[i] = -1;
    for (int i = 0; i < nodes; i++)
        for (int k = 3 * node[i]; k < 3 * node[i] + 3; k++)
            if (!held[k]) {
                place[k] = n;
                of[n++] = k;
            }
    return n;
}

static int width_of(const struct sparse *A, const int *place)
{
    int width = 0;
    for (int i = 0; i < A->n; i++)
        for (size_t k = A->row[i]; place[i] >= 0 && k < A->row[i + 1]; k++) {
            int j = place[A->col[k]];
            if (j >= 0 && place[i] - j > width) width = place[i] - j;
        }
    return width;
}

/* AB(i - j, j) = A(i,j); diagonal [n] for the test of pivots. */
static void fill(struct factor *o, double *diagonal, const struct sparse *A, const int *place, double shift)
{
    size_t ld = (size_t)o->width + 1;
    for (int i = 0; i < A->n; i++)
        for (size_t k = A->row[i]; place[i] >= 0 && k < A->row[i + 1]; k++) {
            int j = place[A->col[k]];
            if (j >= 0 && place[i] >= j) o->L[(size_t)(place[i] - j) + ld * (size_t)j] = A->v[k];
        }
    for (int j = 0; j < o->n; j++) {
        o->L[ld * (size_t)j] += shift;
        diagonal[j] = o->L[ld * (size_t)j];
    }
}

enum status factor_make(struct factor *o, int *bad, const struct sparse *A, const bool *held, double shift,
                        struct arena *life, struct report *report)
{
    int *of = TAKE(life, int, A->n), *place = TAKE(life, int, A->n), info;
    *o = (struct factor){.n = number(of, place, A, held, life), .of = of};
    o->width = width_of(A, place);
    if (((double)o->width + 1) * o->n > MOST_BAND)
        return fail(report, E_LIMIT, "the band matrix would have %d x %d numbers: the mesh is too large", o->width + 1,
                    o->n);
    int ld = o->width + 1;
    o->L = TAKE(life, double, (size_t)ld *(size_t)o->n);
    o->x = TAKE(life, double, o->n);
    double *diagonal = TAKE(life, double, o->n);
    fill(o, diagonal, A, place, shift);
    dpbtrf_("L", &o->n, &o->width, o->L, &ld, &info, 1);
    *bad = info > 0 ? of[info - 1] : -1;
    for (int j = 0; info == 0 && *bad < 0 && j < o->n; j++) {
        double l = o->L[(size_t)ld * (size_t)j];
        if (!(l * l > 1e-13 * diagonal[j])) *bad = of[j];
    }
    return OK;
}

void factor_solve(double *u, const struct factor *o, const double *f, int size)
{
    int one = 1, ld = o->width + 1, info;
    for (int i = 0; i < o->n; i++) o->x[i] = f[o->of[i]];
    dpbtrs_("L", &o->n, &o->width, &one, o->L, &ld, o->x, &o->n, &info, 1);
    memset(u, 0, (size_t)size * sizeof *u);
    for (int i = 0; i < o->n; i++) u[o->of[i]] = o->x[i];
}
