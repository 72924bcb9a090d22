/* split_gain.c -- how fast dependent coordinates go: the largest number of G, in scales.
 *
 * Where the independents are many, G = -C_qd^-1 C_qi is not made, which would cost a solution for each of them; its
 * largest number is found from a few columns and rows: from a row to the column of its largest number, from there to
 * the row of that column's, as long as they grow, beginning with the row where a sum of all columns with scattered
 * signs is largest (Higham & Relton, SIAM J. Sci. Comput. 38 (2016) C584).  This may stop short of the largest, seldom
 * by much. */
#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "loop/condense_parts.h"

static double exact(const struct condense *o, const struct part *c, const double *G)
{
    double most = 0;
    for (int r = 0; r < c->nr; r++) c->x[r] = o->rows.per[c->of->k[c->dep[r]]];
    for (int j = 0; j < c->ni; j++, G += c->nr) {
        const double size = o->rows.size[c->of->k[c->ind[j]]];
        for (int r = 0; r < c->nr; r++) {
            const double g = fabs(G[r]) * size * c->x[r];
            if (g > most) most = g;
        }
    }
    return most;
}

void component_times_G(const struct part *c, const struct solved *at, double *y, const double *x)
{
    memset(y, 0, sizeof *y * (size_t)c->nr);
    for (int r = 0; r < c->nr; r++)
        for (int i = c->from[r]; i < c->from[r + 1]; i++) y[r] -= at->F[c->of_ind[i].e] * x[c->of_ind[i].at];
    pivot_rows_solve(at->A, at->swap, c->band, y, c->nr, c->ld);
}

/* z [ni] := row r of G; y [nr] work */
static void row_of_G(const struct part *c, const struct solved *at, double *z, double *y, int row)
{
    memset(y, 0, sizeof *y * (size_t)c->nr);
    memset(z, 0, sizeof *z * (size_t)c->ni);
    y[row] = 1;
    pivot_rows_tsolve(at->A, at->swap, c->band, y, c->nr, c->ld);
    for (int r = 0; r < c->nr; r++)
        for (int i = c->from[r]; i < c->from[r + 1]; i++) z[c->of_ind[i].at] -= at->F[c->of_ind[i].e] * y[r];
}

/* The largest of x [n], each times or by its size; k: where it is. */
static double largest(const struct condense *o, const struct part *c, const double *x, const int *of, int n, bool times,
                      int *k)
{
    double most = 0;
    for (int i = 0; i < n; i++) {
        const double size = o->rows.size[c->of->k[of[i]]], g = fabs(x[i]) * (times ? size : 1 / size);
        if (g > most) most = g, *k = i;
    }
    return most;
}

/* From row `row` on. */
static double climb(const struct condense *o, const struct part *c, const struct solved *at, double *x, int row)
{
    enum { MOST = 4 };
    double most = 0;
    for (int i = 0; i < MOST; i++) {
        int column = 0;
        row_of_G(c, at, x, c->x, row);
        const double there = largest(o, c, x, c->ind, c->ni, true, &column) / o->rows.size[c->of->k[c->dep[row]]];
        if (!(there > most)) break;
        most = there;
        memset(x, 0, sizeof *x * (size_t)c->ni);
        x[column] = o->rows.size[c->of->k[c->ind[column]]];
        component_times_G(c, at, c->x, x);
        const double down = largest(o, c, c->x, c->dep, c->nr, false, &row);
        if (!(down > most)) break;
        most = down;
    }
    return most;
}

static double estimate(const struct condense *o, const struct part *c, const struct solved *at)
{
    double *x = c->probe, most = 0;
    for (unsigned trial = 0; trial < 2; trial++) {
        int row = 0;
        for (int j = 0; j < c->ni; j++) {
            const unsigned sign = ((unsigned)j + 1000 * trial) * 2654435761u >> 16;
            x[j] = (sign & 1 ? 1 : -1) * o->rows.size[c->of->k[c->ind[j]]];
        }
        component_times_G(c, at, c->x, x);
        largest(o, c, c->x, c->dep, c->nr, false, &row);
        most = fmax(most, climb(o, c, at, x, row));
    }
    return most;
}

double component_gain(const struct condense *o, const struct part *c)
{
    if (c->wide) return estimate(o, c, &(struct solved){c->A, c->of->F, c->prow});
    component_G(c, c->G);
    return exact(o, c, c->G);
}

double component_gain_at_base(const struct condense *o, const struct part *c)
{
    return c->wide ? estimate(o, c, &c->base) : exact(o, c, c->G0);
}
