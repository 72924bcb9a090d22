/* edge.c -- see edge.h */
#include "engine/edge.h"

#include <math.h>

#include "base/scalar.h"

/* Of a step with y of it beyond an edge, accelerations `ahead` at its end; in scales of the tolerance. */
static double edge_error(const struct stepper *s, const struct adaptive *m, const double *ahead, double y)
{
    const double h = fabs(m->came);
    const int n = s->ode->n;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        const double ev = h * y * (ahead[i] - m->a[i]) / 2;
        const double in_v = ev / adaptive_scale_v(s, i), in_q = h * ev / adaptive_scale_q(s, i);
        sum += in_v * in_v + in_q * in_q;
    }
    return sqrt(sum / (2 * n));
}

double edge_cut(const struct stepper *s, const struct adaptive *m, double t, double err, double share)
{
    static const double BEHIND = .1; /* of what the error may be: how far to go beyond */
    const struct ode2 *o = s->ode;
    const struct instant a = {.t = t, .q = m->q, .v = m->v}, b = {.t = t + m->came, .q = m->q1, .v = m->v1};
    if (!o->passed || err > 1) return 1;
    if (o->passed(o, &a, NULL, &b) != MET_NOT) return .5;
    if (!m->ahead) return 1;
    const double x = o->edge(o), y = smaller(x, 1 - x);
    const double own = isfinite(x) ? edge_error(s, m, m->ahead, y) / share : 0;
    return own > 1 ? x + BEHIND * y / own : 1;
}
