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

/* Columns of a rotation, along the Cayley vector phi from the base in place of the angular velocity:
 * F := F T^-1,  T^-1 = (1 - [phi]x/2)/(1 + |phi|^2/4). */
static void along_phi(double *F, const int *at, const double *phi)
{
    const double s = 1 / (1 + v3_dot(phi, phi) / 4), f[3] = {F[at[0]], F[at[1]], F[at[2]]};
    double x[3]; /* f' [phi]x = (f x phi)' */
    v3_cross(x, f, phi);
    for (int k = 0; k < 3; k++) F[at[k]] = s * (f[k] - x[k] / 2);
}

/* C_qd of F into the band. */
static void fill(struct component *c)
{
    if (c->nr == 0) return;
    double *store = c->A_room.store;
    memset(store, 0, sizeof *store * (size_t)c->nr * (size_t)(c->ld + 1));
    for (const struct entry *x = c->of_dep; x < c->of_dep + c->nof_dep; x++) store[x->at] = c->F[x->e];
}

int component_factor(struct condense *o, struct component *c, const double *dx)
{
    for (int i = 0; dx && i < c->nspin; i++) {
        const struct spin *spin = &c->spin[i];
        const int *iv = o->moves->turn[spin->turn].iv;
        if (o->bound[spin->turn]) along_phi(c->F, spin->at, (const double[]){dx[iv[0]], dx[iv[1]], dx[iv[2]]});
    }
    fill(c);
    return pivot_rows(c->A, c->prow, c->band, c->nr, c->ld) == c->nr;
}

void component_take(const struct component *c, double *restrict x, const double *restrict xt)
{
    const double *restrict F = c->F;
    const struct entry *e = c->of_ind;
    for (int r = 0; r < c->nr; r++) {
        const struct entry *end = c->of_ind + c->from[r + 1];
        double sum = x[r];
        for (; e < end; e++) sum -= F[e->e] * xt[e->k];
        x[r] = sum;
    }
}

void component_solve(const struct component *c, double *x)
{
    pivot_rows_solve(c->A, c->prow, c->band, x, c->nr, c->ld);
}

void component_G(const struct component *c, double *G)
{
    if (c->nr == 0 || c->ni == 0) return;
    memset(G, 0, sizeof *G * (size_t)c->nr * (size_t)c->ni);
    for (int r = 0; r < c->nr; r++)
        for (const struct entry *x = c->of_ind + c->from[r]; x < c->of_ind + c->from[r + 1]; x++)
            G[r + x->at * c->nr] = -c->F[x->e];
    pivot_rows_solves(c->A, c->prow, c->band, G, c->nr, c->ld, c->ni);
}

double component_ratio(const struct condense *o, const struct component *c)
{
    double least = INFINITY, most = 0;
    for (int j = 0; j < c->nr; j++) {
        double x = fabs(c->A[(size_t)j * (size_t)(c->ld + 1)]) * o->size[c->k[c->dep[j]]];
        least = fmin(least, x);
        most = fmax(most, x);
    }
    return c->nr == 0 ? 1 : most > 0 ? least / most : 0;
}

double condense_least_ratio(const struct condense *o)
{
    double least = 1;
    for (int i = 0; i < o->ncomponent; i++) least = fmin(least, component_ratio(o, &o->component[i]));
    return least;
}

long condense_see(struct condense *o, const double *q)
{
    const long posture = open_place(o->tree, q);
    if (posture == o->seen) return posture;
    loops_look(o->loops, o->sweep, q);
    return o->seen = posture;
}

long condense_look(struct condense *o, const double *q)
{
    const long posture = condense_see(o, q);
    o->factored = 0;
    loops_jacobian(o->loops, o->sweep);
    return posture;
}

enum status condense_factor(struct condense *o, const double *q, double t, struct trouble *why)
{
    if (condense_see(o, q) == o->factored) return OK;
    const long posture = condense_look(o, q);
    for (int i = 0; i < o->ncomponent; i++)
        if (!component_factor(o, &o->component[i], NULL))
            return trouble_set(why, TROUBLE_CLOSURE, o->loops->row[o->component[i].row[0]].loop, NAN, t);
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
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        memset(c->x, 0, sizeof *c->x * (size_t)c->nr);
        for (int k = 0; k < c->nlead; k++) c->x[c->lead[k]] = o->loops->c1[c->row[c->kept[c->lead[k]]]];
        component_take(c, c->x, xt);
        component_solve(c, c->x);
        for (int r = 0; r < c->nr; r++) xt[c->k[c->dep[r]]] = c->x[r];
    }
}

/* x_d := -C_qd^-1 C'' , C'' with x_d = 0: (C_q v)_q v + C_qi a_i + C_tt. */
static void accelerate(struct condense *o, double *at)
{
    loops_second(o->C2, o->loops, o->sweep, at);
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        for (int r = 0; r < c->nr; r++) c->x[r] = -o->C2[c->row[c->kept[r]]];
        component_solve(c, c->x);
        for (int r = 0; r < c->nr; r++) at[c->k[c->dep[r]]] = c->x[r];
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

void component_multipliers(const struct component *c, const double *rt)
{
    for (int r = 0; r < c->nr; r++) c->x[r] = -rt[c->k[c->dep[r]]];
    pivot_rows_tsolve(c->A, c->prow, c->band, c->x, c->nr, c->ld);
}

void condense_lambda(struct condense *o, double *lambda, const double *rt)
{
    memset(lambda, 0, sizeof *lambda * (size_t)o->loops->nrow);
    for (int i = 0; i < o->ncomponent; i++) {
        struct component *c = &o->component[i];
        component_multipliers(c, rt);
        for (int r = 0; r < c->nr; r++) lambda[c->row[c->kept[r]]] = c->x[r];
    }
}
