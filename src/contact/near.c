/* near.c -- see near.h */
#include "contact/near.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

enum { LEAST = 8 }; /* contacts that are worth a group */

struct seen {
    double x[3], R[9]; /* the first body, from the second */
};

struct group {
    int a, b; /* bodies */
    int n, nnear;
    int *member; /* [n] the near ones first */
    double rho;
    struct seen at; /* where they were parted: */
    double far;     /* the others are farther than that; below 0: they were not */
};

struct near {
    const struct contacts *contacts;
    const struct model *model;
    const struct sweep_ops *ops;
    int ngroup, nalone;
    struct group *group;
    int *alone; /* contacts of no group */
};

static bool is_distance(const struct model_contact *c)
{
    return c->pair != PAIR_STOP && c->pair != PAIR_FRICTION;
}

static bool belongs(const struct model_contact *c, const struct model_contact *to)
{
    return is_distance(c) && is_distance(to) && c->a.body == to->a.body && c->b.body == to->b.body;
}

/* How many there are of i's kind; is it the first? */
static int alike(bool *first, const struct model *m, int i)
{
    int n = 0;
    *first = true;
    for (int k = 0; k < m->ncontact; k++) {
        if (!belongs(&m->contact[k], &m->contact[i])) continue;
        if (k < i) *first = false;
        n++;
    }
    return n;
}

static void open_group(struct group *o, const struct model *m, int i, int n, struct arena *life)
{
    *o = (struct group){.a = m->contact[i].a.body, .b = m->contact[i].b.body, .far = -1};
    o->member = TAKE(life, int, n);
    for (int k = i; k < m->ncontact; k++) {
        const struct model_contact *c = &m->contact[k];
        if (!belongs(c, &m->contact[i])) continue;
        o->member[o->n++] = k;
        o->rho = fmax(o->rho, v3_norm(c->a.p));
    }
}

struct near *near_build(const struct contacts *c, const struct model *m, const struct sweep_ops *ops,
                        struct arena *life)
{
    struct near *o = TAKE(life, struct near, 1);
    *o = (struct near){.contacts = c, .model = m, .ops = ops};
    o->group = TAKE(life, struct group, m->ncontact / LEAST + 1);
    o->alone = TAKE(life, int, m->ncontact);
    for (int i = 0; i < m->ncontact; i++) {
        bool first;
        const int n = alike(&first, m, i);
        if (n < LEAST)
            o->alone[o->nalone++] = i;
        else if (first)
            open_group(&o->group[o->ngroup++], m, i, n, life);
    }
    return o;
}

static void see(struct seen *o, const struct near *near, const struct sweep *s, const struct group *g)
{
    struct pose a, b;
    double d[3];
    near->ops->pose(s, &a, g->a);
    near->ops->pose(s, &b, g->b);
    v3_diff(d, a.r, b.r);
    m3_tmul(o->x, b.R, d);
    m3_tmulm(o->R, b.R, a.R);
}

static double moved(const struct group *g, const struct seen *now)
{
    double d[3], turn = 0;
    v3_diff(d, now->x, g->at.x);
    for (int i = 0; i < 9; i++) turn += (now->R[i] - g->at.R[i]) * (now->R[i] - g->at.R[i]);
    return v3_norm(d) + sqrt(turn) * g->rho;
}

/* All gaps g of it are known: those to the front that are below a distance that lasts for some steps. */
static void part(struct group *o, const struct seen *now, const double *g, double reach)
{
    static const double LASTS = 8, SLACK = .01; /* times the reach, and of the size */
    o->at = *now;
    o->far = LASTS * reach + SLACK * o->rho;
    o->nnear = 0;
    for (int k = 0; k < o->n; k++) {
        const int i = o->member[k];
        if (g[i] > o->far) continue;
        o->member[k] = o->member[o->nnear];
        o->member[o->nnear++] = i;
    }
}

static void gaps_of(const struct near *o, struct group *g, const struct sweep *s, double *gap, double reach,
                    const double *q)
{
    struct seen now;
    see(&now, o, s, g);
    const bool all = !(moved(g, &now) + reach < g->far);
    const int n = all ? g->n : g->nnear;
    for (int k = 0; k < n; k++) gap[g->member[k]] = contacts_gap(o->contacts, s, g->member[k], q);
    if (all && isfinite(reach)) part(g, &now, gap, reach);
    for (int k = 0; k < n; k++)
        if (gap[g->member[k]] > reach) gap[g->member[k]] = INFINITY;
}

void near_gaps(struct near *o, const struct sweep *s, double *g, double reach, const double *q)
{
    for (int i = 0; o->ngroup > 0 && i < o->model->ncontact; i++) g[i] = INFINITY;
    for (int k = 0; k < o->nalone; k++) g[o->alone[k]] = contacts_gap(o->contacts, s, o->alone[k], q);
    for (int k = 0; k < o->ngroup; k++) gaps_of(o, &o->group[k], s, g, reach, q);
}
