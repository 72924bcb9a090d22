/* hold.c -- see hold.h */
#include "reduce/hold.h"

#include <math.h>
#include <string.h>

#include "la/dense.h"
#include "la/vec3.h"
#include "reduce/rigid.h"

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static void axpy(double *y, double s, const double *x, int n)
{
    for (int i = 0; i < n; i++) y[i] += s * x[i];
}

static int largest(const double *d)
{
    int k = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(d[i]) > fabs(d[k])) k = i;
    return k;
}

static int farthest(const struct fe *fe, const double *from, const double *along)
{
    int best = 0;
    double most = -1;
    for (int i = 0; i < fe->n; i++) {
        double d[3], off[3];
        v3_diff(d, fe->x + 3 * i, from);
        v3_cross(off, d, along);
        double far = along[0] == 0 && along[1] == 0 && along[2] == 0 ? v3_norm(d) : v3_norm(off);
        if (far > most) {
            most = far;
            best = i;
        }
    }
    return best;
}

/* Six freedoms of three nodes stop all rigid motion and nothing else. */
static void support(bool *held, const struct fe *fe)
{
    const double none[3] = {0};
    double ab[3], ac[3], normal[3];
    int a = farthest(fe, fe->centre, none), b = farthest(fe, fe->x + 3 * a, none);
    v3_diff(ab, fe->x + 3 * b, fe->x + 3 * a);
    int c = farthest(fe, fe->x + 3 * a, ab);
    v3_diff(ac, fe->x + 3 * c, fe->x + 3 * a);
    v3_cross(normal, ab, ac);
    for (int k = 0; k < 3; k++) {
        held[3 * a + k] = true;
        if (k != largest(ab)) held[3 * b + k] = true;
        if (k == largest(normal)) held[3 * c + k] = true;
    }
}

/* Without the further constraints. */
static void solve(double *u, const struct hold *o, const double *f)
{
    if (u != f) memcpy(u, f, (size_t)o->size * sizeof *u);
    if (!o->floating) {
        factor_solve(u, &o->K, u, o->size);
        return;
    }
    double push[6], moved[6];
    for (int k = 0; k < 6; k++) push[k] = dot(o->R + (size_t)k * o->size, u, o->size);
    for (int k = 0; k < 6; k++) axpy(u, -push[k], o->C0 + (size_t)k * o->size, o->size);
    factor_solve(u, &o->K, u, o->size);
    for (int k = 0; k < 6; k++) moved[k] = dot(o->C0 + (size_t)k * o->size, u, o->size);
    for (int k = 0; k < 6; k++) axpy(u, -moved[k], o->R + (size_t)k * o->size, o->size);
}

/* u += Y (C Y)^-1 mu; mu is lost. */
static void constrain(double *u, const struct hold *o, double *mu)
{
    if (!o->nc) return;
    dense_cholesky_solve(o->G, mu, o->nc, o->nc);
    for (int c = 0; c < o->nc; c++) axpy(u, mu[c], o->Y + (size_t)c * o->size, o->size);
}

void hold_solve(double *u, const struct hold *o, const double *f)
{
    solve(u, o, f);
    for (int c = 0; c < o->nc; c++) o->mu[c] = -dot(o->C + (size_t)c * o->size, u, o->size);
    constrain(u, o, o->mu);
}

void hold_static(double *u, const struct hold *o, const struct tie *tie, int k)
{
    memset(u, 0, (size_t)o->size * sizeof *u);
    if (!tie->rigid) {
        int first = 0;
        while (o->owner[first] != tie) first++;
        for (int c = 0; c < o->nc; c++) o->mu[c] = c == first + k;
        constrain(u, o, o->mu);
        return;
    }
    for (int i = 0; i < tie->n; i++) rigid_at(u + 3 * tie->node[i], o->fe->x + 3 * tie->node[i], tie->x, k);
    sparse_mul(o->f, &o->fe->K, u);
    for (int i = 0; i < o->size; i++) o->f[i] = -o->f[i];
    hold_solve(o->f, o, o->f);
    axpy(u, 1, o->f, o->size);
}

/* Row k of a tie's A as a vector over all freedoms. */
static void row_of(double *c, const struct tie *tie, int k)
{
    for (int i = 0; i < tie->ngauge; i++)
        for (int a = 0; a < 3; a++) c[3 * tie->gauge[i] + a] = tie->A[6 * (3 * i + a) + k];
}

static void take_reference(struct hold *o, const struct tie *reference, struct arena *life)
{
    o->C0 = TAKE(life, double, 6 * (size_t)o->size);
    o->R = TAKE(life, double, 6 * (size_t)o->size);
    for (int k = 0; k < 6; k++) {
        row_of(o->C0 + (size_t)k * o->size, reference, k);
        rigid_motion(o->R + (size_t)k * o->size, o->fe, reference->x, k);
    }
}

static enum status take_constraints(struct hold *o, const struct tie *const *tie, int ntie, struct arena *life,
                                    struct report *report)
{
    o->C = TAKE(life, double, 6 * (size_t)ntie * (size_t)o->size);
    o->Y = TAKE(life, double, 6 * (size_t)ntie * (size_t)o->size);
    o->owner = TAKE(life, const struct tie *, 6 * ntie);
    for (int t = o->floating; t < ntie; t++)
        for (int k = 0; !tie[t]->rigid && k < tie[t]->motions; k++) {
            o->owner[o->nc] = tie[t];
            row_of(o->C + (size_t)o->nc * o->size, tie[t], k);
            solve(o->Y + (size_t)o->nc * o->size, o, o->C + (size_t)o->nc * o->size);
            o->nc++;
        }
    o->G = TAKE(life, double, (size_t)o->nc *(size_t)o->nc);
    o->mu = TAKE(life, double, o->nc);
    for (int j = 0; j < o->nc; j++)
        for (int i = 0; i < o->nc; i++)
            o->G[i + j * o->nc] = dot(o->C + (size_t)i * o->size, o->Y + (size_t)j * o->size, o->size);
    int bad = dense_cholesky(o->G, o->nc, o->nc);
    if (bad < 0) return OK;
    return fail(report, E_MODEL, "interface '%s': its motion is not free where the others are held",
                o->owner[bad]->name);
}

enum status hold_make(struct hold *o, const struct fe *fe, const struct tie *const *tie, int ntie, struct arena *life,
                      struct report *report)
{
    int bad;
    *o = (struct hold){.fe = fe, .size = 3 * fe->n, .floating = true, .held = TAKE(life, bool, 3 * (size_t)fe->n)};
    o->f = TAKE(life, double, o->size);
    for (int t = 0; t < ntie; t++) {
        if (!tie[t]->rigid) continue;
        o->floating = false;
        for (int i = 0; i < 3 * tie[t]->n; i++) o->held[3 * tie[t]->node[i / 3] + i % 3] = true;
    }
    if (tie[0]->motions < 6)
        return fail(report, E_MODEL,
                    "interface '%s': a single node does not stop the body's rotation; name a set of nodes",
                    tie[0]->name);
    if (o->floating) {
        support(o->held, fe);
        take_reference(o, tie[0], life);
    }
    TRY(factor_make(&o->K, &bad, &fe->K, o->held, 0, life, report));
    if (bad >= 0)
        return fail(report, E_MODEL,
                    "the stiffness is not positive with the interfaces held, at %s: is a part not joined to the rest, "
                    "or are elements of reduced integration alone in a row?",
                    fe_freedom(fe, bad, life));
    TRY(take_constraints(o, tie, ntie, life, report));
    o->freedom = o->K.n - o->nc;
    return OK;
}
