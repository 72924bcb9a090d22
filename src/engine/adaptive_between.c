/* adaptive_between.c -- states inside the last step of a scheme that chooses its steps; see adaptive.h */
#include <math.h>

#include "engine/adaptive.h"
#include "engine/motion.h"

bool adaptive_interpolates(const struct stepper *s)
{
    if (!s->kind->adaptive || s->touch) return false;
    const struct adaptive_scheme *o = adaptive_of(s)->scheme;
    return o->between && s->options.tolerance >= o->between_from;
}

double adaptive_records(struct stepper *s, double t, double h, double end)
{
    struct adaptive *m = s->self;
    struct trouble why = {0};
    double err = 0;
    m->ready = false;
    if (!m->scheme->ready || !(s->due > t && s->due < end)) return 0;
    m->ready = m->scheme->ready(s, m, &err, t, h, &why) == OK && err <= 1;
    return m->ready || err > 1 ? err : INFINITY;
}

bool adaptive_between(const struct stepper *s, double *q, double *v, double t)
{
    const struct adaptive *m = s->self;
    const bool ends = t >= m->t1;
    if (ends || t <= motion_behind(m->t0, m->t1)) {
        copy(q, ends ? m->q : m->q0, s->ode->nq);
        copy(v, ends ? m->v : m->v0, s->ode->n);
        return true;
    }
    if (m->scheme->ready && !m->ready) return false;
    m->scheme->between(s, m, m->u, v, (t - m->t0) / (m->t1 - m->t0));
    motion_point(s->ode, q, m->q0, m->u, 1, t);
    return true;
}

/* Velocities by Hermite's cubic, too. */
static void velocities_between(const struct stepper *s, const struct adaptive *m, double *v, double x)
{
    const double h = m->t1 - m->t0, y = 1 - x, part = x * x * (3 - 2 * x);
    for (int i = 0; i < s->ode->n; i++)
        v[i] = m->v0[i] + part * (m->v[i] - m->v0[i]) + h * x * y * (y * m->a0[i] - x * m->a[i]);
}

void adaptive_look(const struct stepper *s, double *q, double *v, double t)
{
    const struct adaptive *m = s->self;
    const double x = (t - m->t0) / (m->t1 - m->t0);
    if (m->scheme->between && adaptive_between(s, q, v, t)) return;
    adaptive_cubic(s, m, m->u, m->dx, v, x);
    velocities_between(s, m, v, x);
    motion_point(s->ode, q, m->q0, m->u, 1, t);
}

void adaptive_cubic(const struct stepper *s, const struct adaptive *m, double *u, double *dx, double *rate, double x)
{
    motion_diff(s->ode, dx, m->q, m->q0);
    motion_rate(s->ode, rate, m->q, m->q0, dx, m->v, m->t1);
    motion_cubic(u, dx, m->v0, rate, s->ode->n, m->t1 - m->t0, x);
}

void adaptive_travel(const struct stepper *s, struct adaptive *m, double *dx)
{
    if (!s->ode->move) return;
    motion_diff(s->ode, dx, m->q1, m->q);
    for (int i = 0; i < s->ode->n; i++) m->span[i] += dx[i];
}
