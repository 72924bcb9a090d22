/* adaptive_scales.c -- what errors are held against; see adaptive.h */
#include <math.h>

#include "base/scalar.h"
#include "engine/adaptive.h"

double adaptive_size(const struct stepper *s, const double *q, int i)
{
    const struct adaptive *m = s->self;
    return s->ode->move ? fmin(ode2_usual(s->ode, i), fabs(m->span[i])) : fabs(q[i]);
}

double adaptive_scale_q(const struct stepper *s, int i)
{
    const struct adaptive *m = s->self;
    return m->tolerance * ode2_usual(s->ode, i) +
           m->tolerance * fmax(adaptive_size(s, m->q, i), adaptive_size(s, m->q1, i));
}

static double standing(const struct stepper *s, int i, bool plain)
{
    static const double SLOWEST = 1e-3; /* [1/s] */
    const struct adaptive *m = s->self;
    return ode2_usual(s->ode, i) * fmax((plain ? .1 : .01) * m->pace, SLOWEST);
}

double adaptive_standing(const struct stepper *s, int i)
{
    const struct adaptive *m = s->self;
    return standing(s, i, m->scheme->plain);
}

double adaptive_scale_plain(const struct stepper *s, int i, double top)
{
    const struct adaptive *m = s->self;
    return m->tolerance * standing(s, i, true) + m->tolerance * top;
}

/* What all but stands is not judged by its round-off. */
double adaptive_scale_v(const struct stepper *s, int i)
{
    const struct adaptive *m = s->self;
    const double own = m->scheme->plain ? m->top[i] : fmax(fabs(m->v[i]), fabs(m->v1[i]));
    return m->tolerance * adaptive_standing(s, i) + m->tolerance * own;
}

double adaptive_share(const struct adaptive *m, double h)
{
    static const double ROUND_OFF = 1e-13; /* times the tolerance: what it leaves of an error */
    static const double LEAST = 1e-2;      /* of the root: ten thousand steps */
    const double x = h / (m->elapsed + 10 * h), part = m->scheme->plain ? x : larger(LEAST, sqrt(x));
    return smaller(1, larger(part, ROUND_OFF / m->tolerance));
}
