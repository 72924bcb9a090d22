/* passing.c -- see passing.h */
#include "engine/passing.h"

#include <math.h>

#include "engine/path.h"

enum { HALVINGS = 8 };

struct passing_look {
    const struct ode2 *ode;
    struct path way;
    enum edge_kind kind;                       /* of the step as a whole, */
    double at;                                 /* the part of it */
    double *q[HALVINGS + 1], *v[HALVINGS + 1]; /* of the middle of a part, by how small it is */
};

struct passing_look *passing_open(const struct ode2 *ode, struct arena *life)
{
    if (!ode->passed) return NULL;
    struct passing_look *o = TAKE(life, struct passing_look, 1);
    o->ode = ode;
    path_open(&o->way, ode, life);
    for (int k = 0; k <= HALVINGS; k++) {
        o->q[k] = TAKE(life, double, ode->nq);
        o->v[k] = TAKE(life, double, ode->n);
    }
    return o;
}

static struct instant on_the_way(struct passing_look *o, double x, int depth)
{
    const double t = path_time(&o->way, x);
    path_place(&o->way, o->q[depth], x);
    path_velocity(&o->way, o->v[depth], x);
    return (struct instant){.t = t, .q = o->q[depth], .v = o->v[depth], .ta = t, .tb = t};
}

static bool found(struct passing_look *o, const struct instant *a, double xa, const struct instant *b, double xb,
                  int depth)
{
    if (depth > HALVINGS || o->ode->passed(o->ode, a, NULL, b) == MET_NOT) return false;
    const double x = (xa + xb) / 2;
    const struct instant middle = on_the_way(o, x, depth);
    return o->ode->passed(o->ode, a, &middle, b) == MET || found(o, a, xa, &middle, x, depth + 1) ||
           found(o, &middle, x, b, xb, depth + 1);
}

bool passing_found(struct passing_look *o, const struct state *a, const struct state *b)
{
    const struct instant first = {.t = a->t, .q = a->q, .v = a->v, .ta = a->t, .tb = a->t},
                         last = {.t = b->t, .q = b->q, .v = b->v, .ta = b->t, .tb = b->t};
    const enum met met = o->ode->passed(o->ode, &first, NULL, &last);
    o->at = o->ode->edge(o->ode, &o->kind);
    if (met == MET_NOT) return false;
    path_between(&o->way, a, b);
    return found(o, &first, 0, &last, 1, 0);
}

enum edge_kind passing_edge(const struct passing_look *o, double *at)
{
    *at = o->at;
    return isfinite(o->at) ? o->kind : EDGE_NONE;
}
