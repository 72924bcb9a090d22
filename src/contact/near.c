/* near.c -- see near.h */
#include "contact/near.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

enum { LEAST = 8 }; /* contacts that are worth a group */

struct seen {
    double x[3], R[9]; /* the first body, from the second; over a plane its height and the normal, from the first */
};

struct group {
    int a, b;             /* bodies */
    const double *normal; /* of the plane of b; NULL: it is none */
    int n, nnear;
    int *member, *near; /* [n] contacts, [nnear] those of them that were near; ascending */
    double rho;
    struct seen at; /* where they were parted: */
    double far;     /* the others are farther than that; below 0: they were not */
    double margin;  /* over the reach, of that */
    int vain;       /* gaps since then that were above the reach */
};

struct near {
    const struct contacts *contacts;
    const struct model *model;
    const struct sweep_ops *ops;
    int ngroup, nalone;
    struct group *group;
    int *alone;  /* contacts of no group */
    double *gap; /* [contacts] work */
};

static bool is_distance(const struct model_contact *c)
{
    return c->pair != PAIR_STOP && c->pair != PAIR_FRICTION;
}

static bool belongs(const struct model_contact *c, const struct model_contact *to)
{
    if (!is_distance(c) || !is_distance(to) || c->a.body != to->a.body || c->b.body != to->b.body) return false;
    const bool plane = c->pair == PAIR_PLANE;
    return plane == (to->pair == PAIR_PLANE) && (!plane || memcmp(c->normal, to->normal, sizeof c->normal) == 0);
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
    const struct model_contact *first = &m->contact[i];
    *o = (struct group){.a = first->a.body, .b = first->b.body, .far = -1};
    if (first->pair == PAIR_PLANE) o->normal = first->normal;
    o->member = TAKE(life, int, n);
    o->near = TAKE(life, int, n);
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
    o->gap = TAKE(life, double, m->ncontact);
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
    double d[3], n[3];
    near->ops->pose(s, &a, g->a);
    near->ops->pose(s, &b, g->b);
    v3_diff(d, a.r, b.r);
    if (g->normal) {
        m3_mul(n, b.R, g->normal);
        o->x[0] = v3_dot(n, d);
        m3_tmul(o->R, a.R, n);
    } else {
        m3_tmul(o->x, b.R, d);
        m3_tmulm(o->R, b.R, a.R);
    }
}

/* By how much, at the most, gaps have changed. */
static double moved(const struct group *g, const struct seen *now)
{
    const int nx = g->normal ? 1 : 3, nR = 3 * nx;
    double apart = 0, turn = 0;
    for (int i = 0; i < nx; i++) apart += (now->x[i] - g->at.x[i]) * (now->x[i] - g->at.x[i]);
    for (int i = 0; i < nR; i++) turn += (now->R[i] - g->at.R[i]) * (now->R[i] - g->at.R[i]);
    return sqrt(apart) + sqrt(turn) * g->rho;
}

/* All gaps of it are known: near are those below a distance that lasts for as long as what is asked for in vain until then
 * costs no more than to part them again. */
static void part(struct group *o, const struct seen *now, const double *gap, double reach)
{
    static const double LEAST_MARGIN = .01; /* of the size */
    o->margin = o->vain > o->n ? o->margin / 2 : fmax(2 * o->margin, LEAST_MARGIN * o->rho);
    o->vain = 0;
    o->at = *now;
    o->far = reach + o->margin;
    o->nnear = 0;
    for (int k = 0; k < o->n; k++)
        if (gap[k] <= o->far) o->near[o->nnear++] = o->member[k];
}

static void gaps_of(struct near *o, struct group *g, const struct sweep *s, struct nearby *to, double reach,
                    const double *q)
{
    struct seen now;
    see(&now, o, s, g);
    const bool all = g->vain > g->n || !(moved(g, &now) + reach < g->far);
    const int n = all ? g->n : g->nnear, *list = all ? g->member : g->near;
    for (int k = 0; k < n; k++) {
        o->gap[k] = contacts_gap(o->contacts, s, list[k], q);
        if (o->gap[k] <= reach)
            nearby_add(to, list[k], o->gap[k]);
        else
            g->vain++;
    }
    if (all && isfinite(reach)) part(g, &now, o->gap, reach);
}

void near_gaps(struct near *o, const struct sweep *s, struct nearby *g, double reach, const double *q)
{
    nearby_clear(g);
    for (int k = 0; k < o->nalone; k++) nearby_add(g, o->alone[k], contacts_gap(o->contacts, s, o->alone[k], q));
    for (int k = 0; k < o->ngroup; k++) gaps_of(o, &o->group[k], s, g, reach, q);
}
