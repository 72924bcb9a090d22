/* split_gain.c -- how fast dependent coordinates go: the largest number of G, in reaches.
 *
 * Where the independents are many, G = -C_qd^-1 C_qi is not made, which would cost a solution for each of them; its
 * largest number is found from a few columns and rows: from a row to the column of its largest number, from there to
 * the row of that column's, as long as they grow, beginning with the row where a sum of all columns with scattered
 * signs is largest (Higham & Relton, SIAM J. Sci. Comput. 38 (2016) C584).  This may stop short of the largest, seldom
 * by much. */
#include <math.h>
#include <string.h>

#include "loop/factor.h"

double split_gain(const struct split *o, const struct part *p, const double *G)
{
    const double *scale = o->reach;
    double most = 0;
    for (int r = 0; r < p->nr; r++) o->x[r] = 1 / scale[p->dep[r]];
    for (int j = 0; j < p->ni; j++, G += p->nr) {
        const double size = scale[p->ind[j]];
        for (int r = 0; r < p->nr; r++) {
            const double g = fabs(G[r]) * size * o->x[r];
            if (g > most) most = g;
        }
    }
    return most;
}

/* The largest of x [n], each times or by its size; k: where it is. */
static double largest(const double *scale, const double *x, const int *of, int n, bool times, int *k)
{
    double most = 0;
    for (int i = 0; i < n; i++) {
        const double size = scale[of[i]], g = fabs(x[i]) * (times ? size : 1 / size);
        if (g > most) most = g, *k = i;
    }
    return most;
}

/* From row `row` on. */
static double climb(const struct split *o, const struct part *p, const struct factor *at, int row)
{
    enum { MOST = 4 };
    const double *scale = o->reach;
    double most = 0;
    for (int i = 0; i < MOST; i++) {
        int column = 0;
        factor_row_of_G(at, o->y, o->x, row);
        const double there = largest(scale, o->y, p->ind, p->ni, true, &column) / scale[p->dep[row]];
        if (!(there > most)) break;
        most = there;
        memset(o->y, 0, sizeof *o->y * (size_t)p->ni);
        o->y[column] = scale[p->ind[column]];
        factor_times_G(at, o->x, o->y);
        const double down = largest(scale, o->x, p->dep, p->nr, false, &row);
        if (!(down > most)) break;
        most = down;
    }
    return most;
}

double split_gain_estimate(const struct split *o, const struct part *p, const struct factor *at)
{
    double most = 0;
    for (unsigned trial = 0; trial < 2; trial++) {
        int row = 0;
        for (int j = 0; j < p->ni; j++) {
            const unsigned sign = ((unsigned)j + 1000 * trial) * 2654435761u >> 16;
            o->y[j] = (sign & 1 ? 1 : -1) * o->reach[p->ind[j]];
        }
        factor_times_G(at, o->x, o->y);
        largest(o->reach, o->x, p->dep, p->nr, false, &row);
        most = fmax(most, climb(o, p, at, row));
    }
    return most;
}
