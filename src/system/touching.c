/* touching.c -- rigid contacts as the engine sees them: gaps, and rows of the independent coordinates.
 *
 * A row g of the tree becomes G_i - G_d C_qd^-1 C_qi of the independent coordinates, as any generalized force does; what
 * drives bring of its rate is g times the rates of the tree where the independent ones stand still. */
#include <math.h>
#include <string.h>

#include "system/parts.h"
#include "tree/sizes.h"

static enum status gap(const struct ode2_contact *c, double *g, const double *q, double t, struct trouble *why)
{
    struct system *s = c->self;
    s->ops->place(s->view, q, ALL);
    for (int i = 0; i < c->m; i++) {
        g[i] = contacts_gap(s->contacts, s->view, i, q);
        if (!isfinite(g[i])) return trouble_set(why, TROUBLE_NOT_FINITE, -1, g[i], t);
    }
    return OK;
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

static enum status rows(const struct ode2_contact *c, double *G, double *b, const int *on, const double *q, double t,
                        struct trouble *why)
{
    struct system *s = c->self;
    const size_t n = (size_t)s->model->n, door = (size_t)system_ode2(s)->n;
    s->ops->move(s->view, q, s->still, ALL);
    TRY(driven(s, q, t, why));
    for (int i = 0; i < c->m; i++) {
        if (!on[i]) continue;
        contacts_rows(s->contacts, s->view, s->row, i);
        for (int k = 0; k <= c->of[i].across; k++, G += door, b++) {
            const double *y = s->row + (size_t)k * n;
            *b = rate_along(s, i, k, y, s->model->ndrive ? s->v : NULL);
            if (s->loops)
                condense_reduce(s->loops, G, y, q, t);
            else
                memcpy(G, y, n * sizeof *G);
        }
    }
    return OK;
}

void touching_build(struct system *s, struct arena *life)
{
    const struct model *m = s->model;
    struct ode2_touch *of = TAKE(life, struct ode2_touch, m->ncontact);
    const double length = sizes_length(m);
    s->contacts = contacts_build(m, s->ops, life);
    s->touching = (struct ode2_contact){.m = m->ncontact, .of = of, .self = s, .gap = gap, .rows = rows};
    for (int i = 0; i < m->ncontact; i++) {
        const struct model_contact *c = &m->contact[i];
        of[i] = (struct ode2_touch){.restitution = c->law.restitution,
                                    .holding = c->law.holding,
                                    .sliding = c->law.sliding,
                                    .across = c->across,
                                    .size = contact_size(c, length)};
        s->touching.nrow += contact_rows(c);
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
