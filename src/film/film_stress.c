/* film_stress.c -- the equivalent stress along a beam, by the places that its deck asks for */
#include <math.h>

#include "film/film.h"

void film_stress_open(struct film *o, struct actor *a, const struct flex_body *f, const struct node *body)
{
    const struct node *list = body && body->type == NODE_MAP ? node_find(body, "stress") : NULL;
    int *place = TAKE(o->life, int, f->nstress);
    double *station = TAKE(o->life, double, f->nstress);
    if (!node_find(body, "beam")) return;
    for (int i = 0; list && i < f->nstress; i++) {
        const struct node *n = f->stress[i].name ? node_find(list, f->stress[i].name) : NULL;
        const struct node *s = n && n->type == NODE_MAP ? node_find(n, "station") : NULL;
        int k = a->nstress;
        if (!s || !s->has_value) continue;
        for (; k > 0 && station[k - 1] > s->value; k--) station[k] = station[k - 1], place[k] = place[k - 1];
        station[k] = s->value;
        place[k] = i;
        a->nstress++;
    }
    a->place = place;
    a->station = station;
}

void film_stress_add(struct film *o, const struct sim *sim, struct actor *a)
{
    if (!a->nstress) return;
    a->stress = arena_more(o->life, a->stress, o->frames, &a->stresses, (size_t)a->nstress * sizeof *a->stress);
    double *to = a->stress + (size_t)o->frames * (size_t)a->nstress;
    for (int i = 0; i < a->nstress; i++) to[i] = system_stress(sim->system, a->body, a->place[i], STRESS_VON_MISES);
}

double film_along(const struct actor *a, const double *x, int i)
{
    const double *s = a->station;
    double low = INFINITY, high = -INFINITY;
    int k = 0;
    if (!a->nstress) return 0;
    for (int j = 0; j < a->nv; j++) low = fmin(low, a->base[3 * j]), high = fmax(high, a->base[3 * j]);
    const double at = (a->base[3 * i] - low) / (high - low);
    while (k < a->nstress && s[k] < at) k++;
    if (k == 0 || k == a->nstress) return x[k ? k - 1 : 0];
    return x[k - 1] + (x[k] - x[k - 1]) * (at - s[k - 1]) / (s[k] - s[k - 1]);
}

const double *film_stress(const struct actor *a, int frame)
{
    return a->nstress ? a->stress + (size_t)frame * (size_t)a->nstress : NULL;
}
