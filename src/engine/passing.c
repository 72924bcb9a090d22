/* passing.c -- see passing.h */
#include "engine/passing.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/path.h"

enum { HALVINGS = 8 };

struct passing_look {
    const struct ode2 *ode;
    struct path way;
    enum edge_kind kind;                       /* of the step as a whole, */
    double at;                                 /* the part of it */
    bool doubts;                               /* may one lie in a part that is halved no more? */
    double *q[HALVINGS + 3], *v[HALVINGS + 3]; /* of the middle of a part, by how small it is; of the ends of one */
};

struct passing_look *passing_open(const struct ode2 *ode, struct arena *life)
{
    if (!ode->passed) return NULL;
    struct passing_look *o = TAKE(life, struct passing_look, 1);
    o->ode = ode;
    path_open(&o->way, ode, life);
    for (int k = 0; k < HALVINGS + 3; k++) {
        o->q[k] = TAKE(life, double, ode->nq);
        o->v[k] = TAKE(life, double, ode->n);
    }
    return o;
}

int passing_parts(const struct ode2 *o, const struct state *a, const struct state *b)
{
    static const double PART = .5; /* of a usual change */
    double pace = o->driven ? larger(o->driven(o, a->t), o->driven(o, b->t)) : 0;
    for (int i = 0; i < o->n; i++) pace = larger(pace, larger(fabs(a->v[i]), fabs(b->v[i])) / ode2_usual(o, i));
    const double parts = ceil(pace * fabs(b->t - a->t) / PART);
    return parts < 1 ? 1 : parts <= PASSING_PARTS ? (int)parts : PASSING_PARTS + 1;
}

static struct instant at_end(const struct state *x)
{
    return (struct instant){.t = x->t, .q = x->q, .v = x->v, .ta = x->t, .tb = x->t};
}

static struct instant on_the_way(struct passing_look *o, double x, int place)
{
    const double t = path_time(&o->way, x);
    path_place(&o->way, o->q[place], x);
    path_velocity(&o->way, o->v[place], x);
    return (struct instant){.t = t, .q = o->q[place], .v = o->v[place], .ta = t, .tb = t};
}

static bool found(struct passing_look *o, const struct instant *a, double xa, const struct instant *b, double xb,
                  int depth)
{
    if (o->ode->passed(o->ode, a, NULL, b) == MET_NOT) return false;
    if (depth > HALVINGS) return o->doubts;
    const double x = (xa + xb) / 2;
    const struct instant middle = on_the_way(o, x, depth);
    return o->ode->passed(o->ode, a, &middle, b) == MET || found(o, a, xa, &middle, x, depth + 1) ||
           found(o, &middle, x, b, xb, depth + 1);
}

/* In any of so many parts, or where two meet. */
static bool in_parts(struct passing_look *o, const struct state *a, const struct state *b, int parts)
{
    const struct instant first = at_end(a), last = at_end(b);
    struct instant from = first;
    path_between(&o->way, a, b);
    for (int k = 0; k < parts; k++) {
        const double x = (double)k / parts, y = (double)(k + 1) / parts;
        const bool inside = k + 1 < parts;
        const struct instant to = inside ? on_the_way(o, y, HALVINGS + 1 + k % 2) : last;
        if (inside && o->ode->passed(o->ode, &first, &to, &last) == MET) return true;
        if (found(o, &from, x, &to, y, 0)) return true;
        from = to;
    }
    return false;
}

bool passing_may(struct passing_look *o, const struct state *a, const struct state *b)
{
    o->doubts = true;
    return in_parts(o, a, b, passing_parts(o->ode, a, b));
}

bool passing_found(struct passing_look *o, const struct state *a, const struct state *b)
{
    const int parts = passing_parts(o->ode, a, b);
    const struct instant first = at_end(a), last = at_end(b);
    const enum met met = o->ode->passed(o->ode, &first, NULL, &last);
    o->at = o->ode->edge(o->ode, &o->kind);
    o->doubts = false;
    return (met != MET_NOT || parts > 1) && in_parts(o, a, b, parts);
}

enum edge_kind passing_edge(const struct passing_look *o, double *at)
{
    *at = o->at;
    return isfinite(o->at) ? o->kind : EDGE_NONE;
}
