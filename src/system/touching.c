/* touching.c -- rigid contacts as the engine sees them: gaps, and rows of the independent coordinates.
 *
 * A row g of the tree becomes G_i - G_d C_qd^-1 C_qi of the independent coordinates, as any generalized force does; what
 * drives bring of its rate is g times the rates of the tree where the independent ones stand still.
 *
 * Friction in a joint is pressed by the joint's own force: in a pin by what is across its axis; in a slide likewise, and
 * where its guide has a length l, at its two ends by |F/2 + M x e/l| + |F/2 - M x e/l|. */
#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "system/parts.h"
#include "tree/sizes.h"

static enum status gap(const struct ode2_contact *c, struct nearby *g, double reach, const double *q, double t,
                       struct trouble *why)
{
    struct system *s = c->self;
    s->ops->place(s->view, q, ALL);
    near_gaps(s->near, s->view, g, reach, q);
    double sum = 0;
    for (int k = 0; k < g->n; k++) sum += g->gap[g->which[k]];
    return sum > -INFINITY ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, sum, t);
}

/* Do drives move the tree by themselves?  Then s->v is how. */
static enum status driven(struct system *s, const double *q, double t, struct trouble *why)
{
    if (s->model->ndrive == 0) return OK;
    return condense_rates(s->loops, s->v, NULL, q, s->still, NULL, t, why);
}

/* The rate along the k-th row y of a contact where the tree moves with v; NULL: it stands still. */
static double rate_along(const struct system *s, int contact, int k, const double *y, const double *v)
{
    double rate = k == 1 ? -s->model->contact[contact].law.speed : 0;
    for (int j = 0; v && j < s->model->n; j++) rate += y[j] * v[j];
    return rate;
}

/* What drives alone move, but for round-off: no force of friction moves the rest. */
static void clear_driven(double *G, int n, const double *y, int nt)
{
    static const double ROUND_OFF = 1e-12;
    double most = 0, all = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(G[i]));
    for (int i = 0; i < nt; i++) all = fmax(all, fabs(y[i]));
    if (most <= ROUND_OFF * all) memset(G, 0, (size_t)n * sizeof *G);
}

static enum status rows(const struct ode2_contact *c, double *G, double *b, const int *which, int nwhich,
                        const double *q, double t, struct trouble *why)
{
    struct system *s = c->self;
    const size_t n = (size_t)s->model->n, door = (size_t)system_ode2(s)->n;
    s->ops->move(s->view, q, s->still, ALL);
    TRY(driven(s, q, t, why));
    for (int l = 0; l < nwhich; l++) {
        const int i = which[l];
        contacts_rows(s->contacts, s->view, s->row, i);
        for (int k = 0; k <= c->of[i].across; k++, G += door, b++) {
            const double *y = s->row + (size_t)k * n;
            *b = rate_along(s, i, k, y, s->model->ndrive ? s->v : NULL);
            if (s->loops)
                condense_reduce(s->loops, G, y, q, t);
            else
                memcpy(G, y, n * sizeof *G);
            if (k > 0 && c->of[i].joint) clear_driven(G, (int)door, y, (int)n);
        }
    }
    return OK;
}

/* The joint's axis in the world. */
static void axis_of(const struct system *s, double *e, const struct model_contact *c)
{
    const struct model *m = s->model;
    struct pose first;
    s->ops->pose(s->view, &first, c->joint >= 0 ? m->joint[c->joint].parent : m->loop[c->loop].first);
    m3_mul(e, first.R, (c->joint >= 0 ? m->joint[c->joint].Ea : m->loop[c->loop].Ea) + 6);
}

static double pressed(const struct system *s, const struct model_contact *c)
{
    double f[3], n[3], e[3], turn[3], one[3], two[3];
    if (c->joint >= 0)
        system_reaction(s, f, n, c->joint);
    else
        system_loop_reaction(s, f, n, c->loop);
    axis_of(s, e, c);
    v3_axpy(f, -v3_dot(f, e), e);
    if (!(c->other > 0)) return c->radius * v3_norm(f);
    v3_cross(turn, n, e);
    v3_scale(one, .5, f);
    v3_copy(two, one);
    v3_axpy(one, 1 / c->other, turn);
    v3_axpy(two, -1 / c->other, turn);
    return v3_norm(one) + v3_norm(two);
}

static enum status bound(const struct ode2_contact *c, double *N, const int *which, int nwhich, const struct instant *x,
                         const double *f, struct trouble *why)
{
    struct system *s = c->self;
    TRY(system_joint_forces(s, x, f, why));
    for (int k = 0; k < nwhich; k++)
        if (c->of[which[k]].joint) N[which[k]] = pressed(s, &s->model->contact[which[k]]);
    return OK;
}

void touching_build(struct system *s, struct arena *life)
{
    const struct model *m = s->model;
    struct ode2_touch *of = TAKE(life, struct ode2_touch, m->ncontact);
    const double length = sizes_length(m);
    s->contacts = contacts_build(m, s->ops, life);
    s->near = near_build(s->contacts, m, s->ops, life);
    s->touching = (struct ode2_contact){.m = m->ncontact, .of = of, .self = s, .gap = gap, .rows = rows};
    for (int i = 0; i < m->ncontact; i++) {
        const struct model_contact *c = &m->contact[i];
        of[i] = (struct ode2_touch){.restitution = c->law.restitution,
                                    .holding = c->law.holding,
                                    .sliding = c->law.sliding,
                                    .across = c->across,
                                    .preload = c->law.preload,
                                    .joint = c->pair == PAIR_FRICTION,
                                    .size = contact_size(c, length)};
        s->touching.nrow += contact_rows(c);
        if (of[i].joint && fmax(of[i].holding, of[i].sliding) > 0) s->touching.bound = bound;
    }
    s->row = TAKE(life, double, 3 * m->n);
    s->still = TAKE(life, double, m->n);
    s->press = TAKE(life, double, s->touching.nrow);
    system_ode2(s)->contact = &s->touching;
}

void system_push_contacts(struct system *s, const double *f)
{
    memcpy(s->press, f, (size_t)s->touching.nrow * sizeof *f);
}

double system_gap(const struct system *s, int contact)
{
    return contacts_gap(s->contacts, s->view, contact, s->q);
}

void system_slip(const struct system *s, double *rate, int contact)
{
    const struct model_contact *c = &s->model->contact[contact];
    const size_t n = (size_t)s->model->n;
    contacts_rows(s->contacts, s->view, s->row, contact);
    for (int k = 0; k < contact_rows(c); k++) rate[k] = rate_along(s, contact, k, s->row + (size_t)k * n, s->v);
}
