/* path.c -- see path.h */
#include "engine/path.h"

#include "engine/motion.h"

void path_open(struct path *o, const struct ode2 *ode, struct arena *life)
{
    double **vector[] = {&o->dx, &o->rate, &o->u};
    *o = (struct path){.ode = ode};
    for (int i = 0; i < 3; i++) *vector[i] = TAKE(life, double, ode->n);
}

void path_between(struct path *o, const struct state *from, const struct state *to)
{
    o->from = from;
    o->to = to;
    motion_diff(o->ode, o->dx, to->q, from->q);
    motion_rate(o->ode, o->rate, to->q, from->q, o->dx, to->v, to->t);
}

double path_time(const struct path *o, double x)
{
    return o->from->t + x * (o->to->t - o->from->t);
}

void path_place(struct path *o, double *q, double x)
{
    motion_cubic(o->u, o->dx, o->from->v, o->rate, o->ode->n, o->to->t - o->from->t, x);
    motion_point(o->ode, q, o->from->q, o->u, 1, path_time(o, x));
}

void path_velocity(const struct path *o, double *v, double x)
{
    const double h = o->to->t - o->from->t, y = 1 - x;
    for (int i = 0; i < o->ode->n; i++)
        v[i] = 6 * x * y * o->dx[i] / h + y * (1 - 3 * x) * o->from->v[i] + x * (1 - 3 * y) * o->rate[i];
}
