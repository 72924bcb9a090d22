/* split_fast.c -- which independent coordinates are fast after a choice.
 *
 * Fast is what moves fast, whichever coordinate tells of it.  Where one that the deck calls fast has become dependent,
 * another is fast in its place: the one that was so before, or else of those that are newly independent the one that it
 * follows most, by its row of G.  A component keeps its number of fast ones; where it has come back itself, it is
 * fast. */
#include <math.h>
#include <string.h>

#include "loop/factor.h"

/* How much each independent coordinate moves the fast ones that are dependent: add [ni]. */
static void couple(struct split *o, const struct part *p, const struct factor *at, double *add)
{
    const bool *urgent = o->rows->tree->model->urgent;
    for (int j = 0; j < p->ni; j++) add[j] = 0;
    for (int r = 0; r < p->nr; r++) {
        if (!urgent[p->dep[r]]) continue;
        factor_row_of_G(at, o->y, o->x, r);
        const double per = 1 / o->reach[p->dep[r]];
        for (int j = 0; j < p->ni; j++) add[j] = fmax(add[j], fabs(o->y[j]) * o->reach[p->ind[j]] * per);
    }
}

static bool among(const int *x, int n, int k)
{
    for (int i = 0; i < n; i++)
        if (x[i] == k) return true;
    return false;
}

/* The best claim moves to place `at`, those between one on. */
static void bring_forward(int *ind, double *claim, int at, int n)
{
    int best = at;
    for (int j = at + 1; j < n; j++)
        if (claim[j] > claim[best]) best = j;
    const int k = ind[best];
    const double x = claim[best];
    memmove(ind + at + 1, ind + at, sizeof *ind * (size_t)(best - at));
    memmove(claim + at + 1, claim + at, sizeof *claim * (size_t)(best - at));
    ind[at] = k;
    claim[at] = x;
}

void split_succeed(struct split *o, struct part *p, const struct factor *at)
{
    const bool *urgent = o->rows->tree->model->urgent;
    const int *before = o->kept + p->of->nrow + p->nr;
    if (p->nfast == 0 || urgent[p->ind[p->nfast - 1]]) return;
    couple(o, p, at, o->claim);
    for (int j = 0; j < p->ni; j++) {
        const int k = p->ind[j];
        const double pull = o->claim[j] / (1 + o->claim[j]); /* below 1 */
        o->claim[j] = pull;
        if (urgent[k])
            o->claim[j] = 3;
        else if (among(before, p->nfast, k))
            o->claim[j] += 2;
        else if (!among(before, p->ni, k))
            o->claim[j] += 1;
    }
    for (int j = 0; j < p->nfast; j++) bring_forward(p->ind, o->claim, j, p->ni);
    split_arrange(o, p);
}
