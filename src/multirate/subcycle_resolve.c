/* subcycle_resolve.c -- do the minor steps resolve what vibrates in them?
 *
 * In a step the midpoint rule advances the phase of a vibration by 2 atan(z/2), z = omega h: beyond z = 2 by more
 * than a quarter of a turn, so that the velocity nearly reverses from step to step and the phase is meaningless,
 * though the energy balance holds.  d_k is then sqrt(2) to 2 times the velocity amplitude; in coordinates that
 * follow a slow motion it is small. */
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

static const double LEAST = 2; /* omega h */

void subcycle_resolve_open(struct subcycle *c, struct arena *life)
{
    c->resolve.M = TAKE_MATRIX(life, double, c->ns, c->ns);
    c->resolve.own = TAKE(life, double, c->ns);
    c->resolve.square = TAKE(life, double, c->ns);
}

/* Each fast coordinate by itself, while the others recoil. */
void subcycle_resolve_refresh(struct subcycle *c)
{
    struct resolve *o = &c->resolve;
    const int ns = c->ns;
    copy(o->M, c->dec.Mss, ns * ns);
    zero(o->square, ns);
    if (dense_cholesky(o->M, ns, ns) >= 0) return;
    for (int i = 0; i < ns; i++) {
        zero(c->s1, ns);
        c->s1[i] = 1;
        dense_cholesky_solve(o->M, c->s1, ns, ns);
        o->own[i] = 1 / c->s1[i];
        o->square[i] = dot(c->s1, c->resp.one.K + (long)i * c->n, ns);
    }
}

/* Twice the energy of the vibration of coordinate i, at least [J]. */
static double energy_of(const struct subcycle *c, int i)
{
    double sum = 0;
    for (int k = 0; k < c->ratio; k++) {
        const double d = c->d[i + (long)k * c->ns];
        sum += d * d;
    }
    return c->resolve.own[i] * sum / (4 * c->ratio);
}

void subcycle_resolve(const struct subcycle *c, struct stepper *s)
{
    struct unresolved *worst = &s->unresolved;
    if (c->alpha > 0 || s->options.tolerance > 0) return;
    worst->motion = c->newton.energy;
    for (int i = 0; i < c->ns; i++) {
        const double square = c->h * c->h * c->resolve.square[i];
        const double energy = square > LEAST * LEAST ? energy_of(c, i) : 0;
        if (energy > worst->energy) *worst = (struct unresolved){energy, worst->motion, sqrt(square), c->t0, i};
    }
}

void subcycle_resolve_recall(struct subcycle *c, struct recall *r)
{
    recall_within(r, "resolve");
    recall_list(r, "own", c->resolve.own, c->ns);
    recall_list(r, "square", c->resolve.square, c->ns);
    recall_without(r);
}
