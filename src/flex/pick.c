/* pick.c -- see pick.h */
#include "flex/pick.h"

#include <string.h>

#include "flex/statics.h"

struct picking {
    int n, all;
    int *at; /* [n] */
    struct arena *life;
};

/* Blocks of `size` by coordinate. */
static double *singles(const struct picking *p, const double *old, int size)
{
    if (!old) return NULL;
    double *o = TAKE(p->life, double, size * p->n);
    for (int k = 0; k < p->n; k++) memcpy(o + size * k, old + (long)size * p->at[k], (size_t)size * sizeof *o);
    return o;
}

/* And by pairs. */
static double *pairs(const struct picking *p, const double *old, int size)
{
    if (!old) return NULL;
    double *o = TAKE(p->life, double, size * p->n * p->n);
    for (int j = 0; j < p->n; j++)
        for (int i = 0; i < p->n; i++)
            memcpy(o + (long)size * (i + p->n * j), old + (long)size * (p->at[i] + (long)p->all * p->at[j]),
                   (size_t)size * sizeof *o);
    return o;
}

static struct flex_statics *statics(const struct picking *p, const struct flex_statics *old)
{
    if (!old) return NULL;
    struct flex_statics *o = TAKE(p->life, struct flex_statics, 1);
    *o = *old;
    o->node = NULL; /* its parts are those of all */
    o->kind = TAKE(p->life, enum flex_kind, p->n);
    for (int k = 0; k < p->n; k++) o->kind[k] = old->kind[p->at[k]];
    return o;
}

static void nodes(struct flex_body *o, const struct picking *p, const struct flex_body *old)
{
    o->node = TAKE(p->life, struct flex_node, o->nnode);
    for (int k = 0; k < o->nnode; k++) {
        struct flex_node *to = &o->node[k];
        const struct flex_node *from = &old->node[k];
        *to = *from;
        to->phi = singles(p, from->phi, 3);
        to->psi = singles(p, from->psi, 3);
        to->S = pairs(p, from->S, 3);
        to->T = pairs(p, from->T, 3);
    }
}

static void stresses(struct flex_body *o, const struct picking *p, const struct flex_body *old)
{
    o->stress = TAKE(p->life, struct flex_stress, o->nstress);
    for (int k = 0; k < o->nstress; k++) {
        o->stress[k] = old->stress[k];
        o->stress[k].tensor = singles(p, old->stress[k].tensor, 6);
        o->stress[k].axial = singles(p, old->stress[k].axial, 1);
        o->stress[k].bending = singles(p, old->stress[k].bending, 1);
    }
}

struct flex_body *flex_pick(const struct flex_body *old, const bool *keep, struct arena *life)
{
    struct picking p = {.all = old->n, .at = TAKE(life, int, old->n), .life = life};
    struct flex_body *o = TAKE(life, struct flex_body, 1);
    for (int k = 0; k < old->n; k++)
        if (keep[k]) p.at[p.n++] = k;
    *o = *old;
    o->n = p.n;
    nodes(o, &p, old);
    stresses(o, &p, old);
    o->f = singles(&p, old->f, 3);
    o->xf = singles(&p, old->xf, 9);
    o->ff = pairs(&p, old->ff, 9);
    o->rpsi = singles(&p, old->rpsi, 3);
    o->ppsi = pairs(&p, old->ppsi, 1);
    o->s = pairs(&p, old->s, 3);
    o->xs = pairs(&p, old->xs, 9);
    o->K = pairs(&p, old->K, 1);
    o->D = pairs(&p, old->D, 1);
    o->far = singles(&p, old->far, 2);
    o->hertz = singles(&p, old->hertz, 1);
    o->statics = statics(&p, old->statics);
    return o;
}
