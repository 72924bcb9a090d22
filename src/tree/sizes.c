/* sizes.c -- see sizes.h */
#include "tree/sizes.h"

#include <math.h>

#include "la/vec3.h"

static double longest_arm(const struct model *m)
{
    double most = 0;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        if (j->parent) most = fmax(most, v3_norm(j->a));
        most = fmax(most, v3_norm(j->b));
    }
    for (int i = 0; i < m->nloop; i++) {
        const struct model_loop *l = &m->loop[i];
        if (l->first) most = fmax(most, v3_norm(l->a));
        if (l->second) most = fmax(most, v3_norm(l->b));
        if (model_kind(m, l->type)->tie == TIE_POINTS) most = fmax(most, l->number);
    }
    return most;
}

bool sizes_is_length(const struct model *m, const struct model_joint *j, int k)
{
    return !model_kind(m, j->type)->freedom[k].turns;
}

/* Bodies from the first one, nodes of flexible ones from their reference. */
static double drawn_apart(const struct model *m)
{
    double most = 0, d[3];
    for (int i = 1; i < m->nbody; i++) {
        const struct flex_body *f = m->body[i].flex;
        v3_diff(d, m->body[i].at, m->body[1].at);
        most = fmax(most, v3_norm(d));
        for (int k = 0; f && k < f->nnode; k++) {
            v3_diff(d, f->node[k].x, f->node[f->reference].x);
            most = fmax(most, v3_norm(d));
        }
    }
    return most;
}

static double by_bodies(const struct model *m)
{
    const double length = longest_arm(m);
    return length > 0 ? length : drawn_apart(m);
}

/* Where a push along a length begins, or a spring in it rests [m]; 0: it does not tell. */
static double place_of_force(const struct model *m, const struct model_force *f)
{
    struct affine spring;
    if (f->type != FORCE_LAW || m->measure[f->measure].angular) return 0;
    if (f->kind->clear) return fabs(f->kind->clear(f->par, 0));
    if (!f->kind->affine || !f->kind->affine(&spring, f->par) || !(spring.k > 0)) return 0;
    return fabs(spring.rest + spring.preload / spring.k);
}

static double place_of_contact(const struct model_contact *c)
{
    const double round = fmax(c->radius, c->other);
    if (c->pair == PAIR_FRICTION) return 0;
    return c->pair != PAIR_STOP ? round : c->angular ? 0 : fabs(c->limit);
}

/* The farthest place that stops, springs and contacts name. */
static double by_places(const struct model *m)
{
    double most = 0;
    for (int i = 0; i < m->nforce; i++) most = fmax(most, place_of_force(m, &m->force[i]));
    for (int i = 0; i < m->ncontact; i++) most = fmax(most, place_of_contact(&m->contact[i]));
    return most;
}

double sizes_of_start(const struct model *m)
{
    double most = 0;
    if (by_bodies(m) > 0) return 0;
    if (m->length > 0) return m->length;
    for (int i = 0; i < m->njoint && m->q0; i++) {
        const struct model_joint *j = &m->joint[i];
        for (int k = 0; k < j->nv; k++)
            if (sizes_is_length(m, j, k)) most = fmax(most, fabs(m->q0[j->iq[k]]));
    }
    if (!(most > 0)) most = by_places(m);
    return most > 0 ? most : 1;
}

double sizes_length(const struct model *m)
{
    const double length = by_bodies(m);
    return length > 0 ? length : sizes_of_start(m);
}

/* The farthest that elastic coordinate k moves a place of its body, per unit, in lengths; where it only turns them, as
 * torsion does, in rad. */
static double reach(const struct flex_body *f, int k, double length)
{
    static const double little = 1e-6; /* round-off of a turn */
    double most = f->far ? f->far[2 * k] : 0, turn = f->far ? f->far[2 * k + 1] : 0;
    for (int i = 0; i < f->nnode; i++) {
        most = fmax(most, v3_norm(f->node[i].phi + 3 * k));
        turn = fmax(turn, v3_norm(f->node[i].psi + 3 * k));
    }
    return most > little * length * turn ? most / length : turn;
}

void sizes_fill(double *size, const struct model *m)
{
    const double length = sizes_length(m);
    for (int i = 0; i < m->n; i++) size[i] = 1;
    for (int i = 0; i < m->njoint; i++) {
        const struct model_joint *j = &m->joint[i];
        for (int k = 0; k < j->nv; k++)
            if (sizes_is_length(m, j, k)) size[j->iv[k]] = length;
    }
    for (int i = 1; i < m->nbody; i++)
        for (int k = 0; k < m->body[i].nmode; k++) {
            double per_unit = reach(m->body[i].flex, k, length);
            if (per_unit > 0) size[m->body[i].mode_v[k]] = 1 / per_unit;
        }
}
