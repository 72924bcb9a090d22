/* passing.c -- see passing.h */
#include "engine/passing.h"

#include "engine/motion.h"

enum { HALVINGS = 8 };

struct passing_look {
    const struct ode2 *ode;
    const struct state *from, *to;
    double *dx, *rate, *u;                     /* [n] from one to the other; its rate there; on the way */
    double *q[HALVINGS + 1], *v[HALVINGS + 1]; /* of the middle of a part, by how small it is */
};

struct passing_look *passing_open(const struct ode2 *ode, struct arena *life)
{
    if (!ode->passed) return NULL;
    struct passing_look *o = TAKE(life, struct passing_look, 1);
    o->ode = ode;
    double **vector[] = {&o->dx, &o->rate, &o->u};
    for (int i = 0; i < 3; i++) *vector[i] = TAKE(life, double, ode->n);
    for (int k = 0; k <= HALVINGS; k++) {
        o->q[k] = TAKE(life, double, ode->nq);
        o->v[k] = TAKE(life, double, ode->n);
    }
    return o;
}

/* Where the cubic is at the part x of the step. */
static struct instant on_the_way(struct passing_look *o, double x, int depth)
{
    const double h = o->to->t - o->from->t, y = 1 - x, t = o->from->t + x * h;
    for (int i = 0; i < o->ode->n; i++) {
        const double v0 = o->from->v[i], v1 = o->rate[i];
        o->u[i] = x * x * (3 - 2 * x) * o->dx[i] + h * x * y * (y * v0 - x * v1);
        o->v[depth][i] = 6 * x * y * o->dx[i] / h + y * (1 - 3 * x) * v0 + x * (1 - 3 * y) * v1;
    }
    motion_point(o->ode, o->q[depth], o->from->q, o->u, 1, t);
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
    if (o->ode->passed(o->ode, &first, NULL, &last) == MET_NOT) return false;
    o->from = a;
    o->to = b;
    motion_diff(o->ode, o->dx, b->q, a->q);
    motion_rate(o->ode, o->rate, b->q, a->q, o->dx, b->v, b->t);
    return found(o, &first, 0, &last, 1, 0);
}
