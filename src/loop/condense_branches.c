/* condense_branches.c -- a start where the rank of C_q drops at this very posture: branches meet, or nothing moves. */
#include <math.h>
#include <string.h>

#include "loop/condense_parts.h"

/* A number in [-1, 1] from another, always the same. */
static double scatter(unsigned i)
{
    unsigned x = (i + 1) * 2654435761u;
    x ^= x >> 15;
    x *= 2246822519u;
    x ^= x >> 13;
    return (double)(x >> 8) / 8388608 - 1;
}

static int redundant_missing(const struct split *split, const double *C, double more)
{
    int n = 0;
    for (const struct part *p = split->part; p < split->part + split->npart; p++)
        for (int r = p->nr; r < p->of->nrow; r++) n += fabs(C[p->row[r]]) > more;
    return n;
}

/* A small way off o->q, which is the base then; 0: it cannot be closed. */
static int go_off(struct condense *o, double *q1, unsigned trial)
{
    static const double WAY = 1e-2;
    const int *ind = o->split.ind;
    memset(o->dx, 0, sizeof *o->dx * (size_t)o->rows.n);
    for (int i = 0; i < o->ode.n; i++)
        o->dx[ind[i]] = WAY * o->rows.size[ind[i]] * scatter(trial * 1000u + (unsigned)i);
    closing_predict(&o->closing, o->dx);
    return closing_close(&o->closing, q1, &o->lost, &(struct way){.base = o->q, .s = 1, .dx = o->dx}, 0);
}

/* Do redundant rows still hold a small way off?  Where C_q has lost rank at this very posture only, the way along a
 * direction that is too many leaves them at second order. */
enum status condense_search_branches(struct condense *o)
{
    static const double MISS = 1e-7;
    int row, worst = 0, lost = 0;
    double miss = 0;
    if (o->start.redundant == 0) return OK;
    for (unsigned trial = 0; trial < 3; trial++) {
        if (!closing_tangent(&o->closing, o->q)) return OK;
        if (!go_off(o, o->qtry, trial)) continue;
        rows_misfit(o->C, &row, &o->rows, o->qtry);
        const int missing = redundant_missing(&o->split, o->C, MISS + 10 * o->start.misfit);
        if (missing > lost) {
            lost = missing;
            miss = condense_redundant_miss(&worst, &o->split, o->C);
        }
    }
    if (lost == 0) return OK;
    o->start.branches = true;
    o->start.blamed = o->rows.loops->row[worst].loop;
    return fail(
        &o->start.report, E_MODEL,
        "the mechanism stands at a dead point, or is locked: constraint '%s' cannot close after a small motion (it "
        "misses by %.3g of the mechanism's size); draw it in another posture, or name one by 'initial:', by "
        "rates or by more coordinates than it has freedoms, which have to fit [dead-point]",
        condense_row_name(o, worst), miss);
}
