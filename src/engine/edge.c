/* edge.c -- see edge.h */
#include "engine/edge.h"

#include <math.h>

#include "base/scalar.h"

/* What a step with y of it beyond an edge is off by in velocity i. */
static double edge_off(const struct adaptive *m, double y, int i)
{
    return m->came * y * (m->ahead[i] - m->a[i]) / 2;
}

/* The same of all, in scales of the tolerance. */
static double edge_error(const struct stepper *s, const struct adaptive *m, double y)
{
    const double h = fabs(m->came);
    const int n = s->ode->n;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        const double ev = edge_off(m, y, i);
        const double in_v = ev / adaptive_scale_v(s, i), in_q = h * ev / adaptive_scale_q(s, i);
        sum += in_v * in_v + in_q * in_q;
    }
    return sqrt(sum / (2 * n));
}

/* Of a way to x: close before it. */
static double close_before(double x)
{
    static const double NEARER = 1e-3, LEAST = 1e-9;
    return x * (1 - larger(NEARER * (1 - x), LEAST));
}

/* A jump at x: over it, where that may be, or close before it. */
static double leap(const struct stepper *s, struct adaptive *m, double x)
{
    static const double PART = .01 /* of the tolerance, for each */, SURE = .9, ROOM = 2;
    const double own = edge_error(s, m, 1) / PART;
    if (m->held == 0) m->held = m->h;
    m->leaps = own <= 1;
    m->beyond = m->leaps;
    if (m->leaps) return 1;
    return SURE / own > ROOM * x ? SURE / own : close_before(x);
}

double edge_cut(const struct stepper *s, struct adaptive *m, double t, double err, double share)
{
    static const double BEHIND = .1; /* of what the error may be: how far to go beyond */
    const struct ode2 *o = s->ode;
    const struct instant a = {.t = t, .q = m->q, .v = m->v}, b = {.t = t + m->came, .q = m->q1, .v = m->v1};
    enum edge_kind kind;
    if (!o->passed) return 1;
    const enum met met = o->passed(o, &a, NULL, &b);
    const double x = m->ahead ? o->edge(o, &kind) : NAN;
    if (isfinite(x) && kind == EDGE_JUMP) return leap(s, m, x);
    if (isfinite(x) && kind == EDGE_PULSE && x > 0) return smaller(.5, close_before(x));
    if (err > 1) return 1;
    if (met != MET_NOT || (isfinite(x) && kind == EDGE_PULSE)) return .5;
    if (!isfinite(x)) return 1;
    const double y = smaller(x, 1 - x), own = edge_error(s, m, y) / share;
    m->beyond = y;
    return own > 1 ? x + BEHIND * y / own : 1;
}

void edge_add(const struct adaptive *m, double *position, double *velocity, int n)
{
    if (!(m->beyond > 0)) return;
    for (int i = 0; i < n; i++) {
        const double ev = fabs(edge_off(m, m->beyond, i));
        velocity[i] = fabs(velocity[i]) + ev;
        position[i] = fabs(position[i]) + fabs(m->came) * ev;
    }
}
