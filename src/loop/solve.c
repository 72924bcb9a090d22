/* solve.c -- the equations of the loops at a posture, solved for the dependents.
 *
 * With C_q = [C_qd C_qi] of each component, its rows cut down to the rank, and C_qd = P L U,
 *
 *     v_d = -C_qd^-1 (C_qi v_i + C_t)                      velocities
 *     a_d = -C_qd^-1 (C_qi a_i + (C_q v)_q v + C_tt)       accelerations
 *     lambda = -C_qd^-T r_d                                multipliers          (2-4)
 *
 * A is banded: rows and dependent columns go from loop to loop. */
#include <math.h>
#include <string.h>

#include "la/pivot.h"
#include "la/vec3.h"
#include "loop/condense_parts.h"

/* C_qd of F into the band. */
static void fill(struct part *c)
{
    if (c->nr == 0) return;
    double *store = c->A_room.store;
    memset(store, 0, sizeof *store * (size_t)c->nr * (size_t)(c->ld + 1));
    for (const struct entry *x = c->of_dep; x < c->of_dep + c->nof_dep; x++) store[x->at] = c->of->F[x->e];
}

int component_factor(struct part *c)
{
    fill(c);
    return pivot_rows(c->A, c->prow, c->band, c->nr, c->ld) == c->nr;
}

void component_take(const struct part *c, double *restrict x, const double *restrict xt)
{
    const double *restrict F = c->of->F;
    const struct entry *e = c->of_ind;
    for (int r = 0; r < c->nr; r++) {
        const struct entry *end = c->of_ind + c->from[r + 1];
        double sum = x[r];
        for (; e < end; e++) sum -= F[e->e] * xt[e->k];
        x[r] = sum;
    }
}

void component_solve(const struct part *c, double *x)
{
    pivot_rows_solve(c->A, c->prow, c->band, x, c->nr, c->ld);
}

void component_G(const struct part *c, double *G)
{
    if (c->nr == 0 || c->ni == 0) return;
    memset(G, 0, sizeof *G * (size_t)c->nr * (size_t)c->ni);
    for (int r = 0; r < c->nr; r++)
        for (const struct entry *x = c->of_ind + c->from[r]; x < c->of_ind + c->from[r + 1]; x++)
            G[r + x->at * c->nr] = -c->of->F[x->e];
    pivot_rows_solves(c->A, c->prow, c->band, G, c->nr, c->ld, c->ni);
}

double component_ratio(const struct condense *o, const struct part *c)
{
    double least = INFINITY, most = 0;
    for (int j = 0; j < c->nr; j++) {
        double x = fabs(c->A[(size_t)j * (size_t)(c->ld + 1)]) * o->rows.size[c->of->k[c->dep[j]]];
        least = fmin(least, x);
        most = fmax(most, x);
    }
    return c->nr == 0 ? 1 : most > 0 ? least / most : 0;
}

double condense_least_ratio(const struct condense *o)
{
    double least = 1;
    for (int i = 0; i < o->npart; i++) least = fmin(least, component_ratio(o, &o->part[i]));
    return least;
}

enum status condense_factor(struct condense *o, const double *q, double t, struct trouble *why)
{
    const long posture = rows_linearize(&o->rows, q);
    if (posture == o->factored) return OK;
    o->factored = 0;
    for (int i = 0; i < o->npart; i++)
        if (!component_factor(&o->part[i]))
            return trouble_set(why, TROUBLE_CLOSURE, o->loops->row[o->part[i].of->row[0]].loop, NAN, t);
    o->factored = posture;
    return OK;
}

void condense_spread(const struct condense *o, double *xt, const double *x)
{
    memset(xt, 0, sizeof *xt * (size_t)o->nt);
    for (int i = 0; i < o->ode.n; i++) xt[o->ind[i]] = x[i];
}

void condense_follow(struct condense *o, double *xt)
{
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        memset(c->x, 0, sizeof *c->x * (size_t)c->nr);
        for (int k = 0; k < c->nlead; k++) c->x[c->lead[k]] = o->loops->c1[c->of->row[c->kept[c->lead[k]]]];
        component_take(c, c->x, xt);
        component_solve(c, c->x);
        for (int r = 0; r < c->nr; r++) xt[c->of->k[c->dep[r]]] = c->x[r];
    }
}

/* x_d := -C_qd^-1 C'' , C'' with x_d = 0: (C_q v)_q v + C_qi a_i + C_tt. */
static void accelerate(struct condense *o, double *at)
{
    loops_second(o->C2, o->loops, o->sweep, at);
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        for (int r = 0; r < c->nr; r++) c->x[r] = -o->C2[c->of->row[c->kept[r]]];
        component_solve(c, c->x);
        for (int r = 0; r < c->nr; r++) at[c->of->k[c->dep[r]]] = c->x[r];
    }
}

enum status condense_motion(struct condense *o, double *vt, double *at, const double *q, const double *v,
                            const double *a, double t, struct trouble *why)
{
    TRY(condense_factor(o, q, t, why));
    condense_spread(o, vt, v);
    condense_follow(o, vt);
    if (!at) return OK;
    if (a)
        condense_spread(o, at, a);
    else
        memset(at, 0, sizeof *at * (size_t)o->nt);
    open_move(o->tree, q, vt);
    o->ops->speed_up(o->sweep, vt, at, ALL);
    accelerate(o, at);
    return OK;
}

enum status condense_rates(struct condense *o, double *vt, double *at, const double *q, const double *v,
                           const double *a, double t, struct trouble *why)
{
    condense_time(o, t, t, t);
    return condense_motion(o, vt, at, q, v, a, t, why);
}

void component_multipliers(const struct part *c, const double *rt)
{
    for (int r = 0; r < c->nr; r++) c->x[r] = -rt[c->of->k[c->dep[r]]];
    pivot_rows_tsolve(c->A, c->prow, c->band, c->x, c->nr, c->ld);
}

void condense_lambda(struct condense *o, double *lambda, const double *rt)
{
    memset(lambda, 0, sizeof *lambda * (size_t)o->loops->nrow);
    for (int i = 0; i < o->npart; i++) {
        struct part *c = &o->part[i];
        component_multipliers(c, rt);
        for (int r = 0; r < c->nr; r++) lambda[c->of->row[c->kept[r]]] = c->x[r];
    }
}
