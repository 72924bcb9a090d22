/* works.c -- see works.h */
#include "engine/works.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"

void works_open(struct works *o, int n, struct arena *life)
{
    o->u = TAKE(life, double, n);
}

void works_taken(struct works *o, const double *before, const double *after)
{
    for (int c = 0; c < POWER_CHANNELS; c++) o->turned += fabs(after[c] - before[c]);
    o->tried = 0;
    o->slow = 0;
}

/* With velocities that are each faster by what all but stands; not those of a trial, which may be anything. */
static double energy_at(const struct stepper *s, double t)
{
    const struct adaptive *m = adaptive_of(s);
    if (!s->ode->kinetic) return 0;
    for (int i = 0; i < s->ode->n; i++) m->works.u[i] = m->v[i] + copysign(adaptive_standing(s, i), m->v[i]);
    return s->ode->kinetic(s->ode, m->q, m->works.u, t);
}

double works_scale(struct stepper *s, double t)
{
    struct works *o = &adaptive_of(s)->works;
    o->energy = larger(o->energy, energy_at(s, t));
    return o->energy + o->turned;
}

static double share(const struct adaptive *m, double most, double by)
{
    const double scale = m->tolerance * (m->works.energy + m->works.turned + by);
    return most == 0 ? 0 : most / scale;
}

/* Trials from one place: have errors stopped falling as they should? */
static bool is_rough(struct works *o, double err, double h)
{
    enum { MOST_SLOW = 3 };
    if (o->tried > 0 && h < o->tried && err > o->error * h * h / (o->tried * o->tried)) o->slow++;
    o->tried = h;
    o->error = err;
    return o->slow > MOST_SLOW;
}

double adaptive_works(struct stepper *s, const double *e, const double *work, double t, double h)
{
    struct adaptive *m = adaptive_of(s);
    struct works *o = &m->works;
    double most = 0, by = 0;
    for (int c = 0; c < POWER_CHANNELS; c++) {
        most = larger(most, fabs(e[c]));
        by += fabs(work[c]);
    }
    if (!isfinite(most)) return most;
    if (share(m, most, by) > .1 && !o->asked) {
        o->asked = true;
        o->energy = larger(o->energy, energy_at(s, t));
    }
    static const double ROUND_OFF = 1e-12; /* of energies and works */
    const double err = share(m, most, by);
    if (!(err > 1) || !is_rough(o, err, fabs(h)) || most > ROUND_OFF * (o->energy + o->turned + by)) return err;
    o->energy = larger(o->energy, 10 * most / m->tolerance);
    return share(m, most, by);
}
