/* condense_split.c -- which coordinates are dependent.
 *
 * LU of a component's C_q with full pivoting picks as many rows as the rank and the columns of the dependent
 * coordinates (Wehage & Haug 1982); columns have weights, and a column is taken late if the deck would rather have it
 * independent.  Chosen anew between major steps when |G| has grown: dependents run away from the independents. */
#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "system/condense_parts.h"

static const double NOTHING = 1e-10; /* a pivot of round-off: C_q is scaled to numbers of order 1 */
static const double LARGE = 3;       /* rate of a dependent coordinate per unit: time to look for a better split */

/* Columns of displacements times the length: all numbers of C_q are then of like size. */
static void whole_matrix(struct condense *o, struct component *c)
{
    memset(c->whole, 0, sizeof *c->whole * (size_t)c->nrow * (size_t)c->nk);
    for (int r = 0; r < c->nrow; r++) component_row(o, c, r, c->whole + r, c->nrow);
    for (int k = 0; k < c->nk; k++)
        for (int r = 0; r < c->nrow; r++) c->whole[r + (size_t)k * (size_t)c->nrow] *= o->size[c->k[k]];
}

int component_rank(struct condense *o, struct component *c, double least)
{
    whole_matrix(o, c);
    int rank = pivot_lu(c->whole, c->prow, c->pcol, c->nrow, c->nk, c->nrow, NULL, c->nrow, least);
    while (rank > 0 && fabs(c->whole[(size_t)(rank - 1) * (size_t)(c->nrow + 1)]) < NOTHING) rank--;
    return rank;
}

/* x [n] sorted by key[x], the smallest first. */
static void sort_by(int *x, int n, const int *key)
{
    for (int i = 1; i < n; i++) {
        int here = x[i], k = i;
        for (; k > 0 && (key ? key[x[k - 1]] > key[here] : x[k - 1] > here); k--) x[k] = x[k - 1];
        x[k] = here;
    }
}

/* Where C_qd can have numbers; the rest of F and A is zero from now on. */
static void find_band(const struct condense *o, struct component *c)
{
    int below = 0, above = 0;
    memset(c->F, 0, sizeof *c->F * (size_t)c->nr * (size_t)c->nk);
    for (int r = 0; r < c->nr; r++) {
        int loop = o->loops->row[c->row[c->kept[r]]].loop;
        for (int j = 0; j < c->nr; j++)
            for (int k = 0; k < o->loops->nk[loop]; k++) {
                if (o->column[o->loops->k[loop][k]] != c->dep[j]) continue;
                if (r - j > below) below = r - j;
                if (j - r > above) above = j - r;
            }
    }
    c->band[0] = below;
    c->band[1] = above + below;
}

static void find_leads(const struct condense *o, struct component *c)
{
    c->nlead = 0;
    for (int r = 0; r < c->nr; r++)
        if (o->model->loop[o->loops->row[c->row[c->kept[r]]].loop].drive) c->lead[c->nlead++] = r;
}

/* Splits the coordinates after pivot_lu has sorted them; fast ones first among the independent.  Rows and dependent
 * columns go from loop to loop, so that C_qd has its numbers near the diagonal. */
static void take_split(const struct condense *o, struct component *c)
{
    memcpy(c->kept, c->prow, sizeof *c->kept * (size_t)c->nrow);
    for (int k = 0; k < c->nk; k++) c->dependent[k] = false;
    for (int r = 0; r < c->nr; r++) {
        c->dep[r] = c->pcol[r];
        c->dependent[c->pcol[r]] = true;
    }
    sort_by(c->kept, c->nr, NULL);
    sort_by(c->dep, c->nr, c->loop_of);
    int n = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < c->nk; k++)
            if (!c->dependent[k] && o->model->urgent[c->k[k]] == (pass == 0)) c->ind[n++] = k;
    find_band(o, c);
    find_leads(o, c);
}

static double quality(struct condense *o, struct component *c)
{
    return component_factor(o, c, NULL) ? component_ratio(o, c) : 0;
}

double component_choose(struct condense *o, struct component *c)
{
    whole_matrix(o, c);
    pivot_lu(c->whole, c->prow, c->pcol, c->nrow, c->nk, c->nrow, c->weight, c->nr, 0);
    take_split(o, c);
    return quality(o, c);
}

/* Fast ones first, then slow; coordinates in no loop are all independent.  A component
 * keeps its number of fast ones, whoever they are. */
void condense_number(struct condense *o)
{
    int n = 0;
    for (int i = 0; i < o->nt; i++) o->slot[i] = -1;
    for (int pass = 0; pass < 2; pass++) {
        for (int i = 0; i < o->nt; i++)
            if (o->owner[i] < 0 && o->model->urgent[i] == (pass == 0)) o->ind[n++] = i;
        for (int i = 0; i < o->ncomponent; i++) {
            const struct component *c = &o->component[i];
            for (int j = pass == 0 ? 0 : c->nfast; j < (pass == 0 ? c->nfast : c->ni); j++)
                o->ind[n++] = c->k[c->ind[j]];
        }
        if (pass == 0) o->ode.ns = n;
    }
    o->ode.n = n;
    for (int i = 0; i < n; i++) o->slot[o->ind[i]] = i;
    for (int i = 0; i < o->moves->nturn; i++) {
        o->bound[i] = false;
        for (int k = 0; k < 3; k++) o->bound[i] |= o->slot[o->moves->turn[i].iv[k]] < 0;
    }
    o->G0_at[0] = NAN;
}

double component_gain(const struct condense *o, struct component *c)
{
    double most = 0;
    component_G(c, c->G);
    for (int j = 0; j < c->ni; j++)
        for (int r = 0; r < c->nr; r++) {
            double g = c->G[r + (size_t)j * (size_t)c->nr] * o->size[c->k[c->ind[j]]] / o->size[c->k[c->dep[r]]];
            most = fmax(most, fabs(g));
        }
    return most;
}

static void keep_split(int *to, const struct component *c)
{
    memcpy(to, c->kept, sizeof *to * (size_t)c->nrow);
    memcpy(to + c->nrow, c->dep, sizeof *to * (size_t)c->nr);
    memcpy(to + c->nrow + c->nr, c->ind, sizeof *to * (size_t)c->ni);
}

static void put_back(const struct condense *o, struct component *c, const int *from)
{
    memcpy(c->kept, from, sizeof *from * (size_t)c->nrow);
    memcpy(c->dep, from + c->nrow, sizeof *from * (size_t)c->nr);
    memcpy(c->ind, from + c->nrow + c->nr, sizeof *from * (size_t)c->ni);
    find_band(o, c);
    find_leads(o, c);
}

/* A new split, if dependent coordinates have come to run away from the independent ones and there is a better one.
 * Where all splits are singular alike, as in a flat posture, the rates stay moderate and nothing changes. */
static int improve(struct condense *o, struct component *c)
{
    double now = component_gain(o, c);
    c->gain = fmin(c->gain, now);
    if (now <= fmax(LARGE, 2 * c->gain)) return 0;
    keep_split(o->split, c);
    c->gain = component_choose(o, c) > 0 ? component_gain(o, c) : INFINITY;
    if (c->gain < now / 2) return 1;
    put_back(o, c, o->split);
    c->gain = now;
    return 0;
}

/* Whole velocities first, then the splits, then the velocities of the new independent ones. */
int condense_rechart(struct ode2 *ode, double *q, double *v, double t)
{
    struct condense *o = ode->self;
    struct trouble why;
    int changed = 0;
    if (condense_rates(o, o->vt, NULL, q, v, NULL, t, &why) != OK) return 0;
    for (int i = 0; i < o->ncomponent; i++)
        if (o->component[i].nr) changed |= improve(o, &o->component[i]);
    if (!changed) return 0;
    condense_number(o);
    o->charts++;
    for (int i = 0; i < o->ode.n; i++) v[i] = o->vt[o->ind[i]];
    return 1;
}
