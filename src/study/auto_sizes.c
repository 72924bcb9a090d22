/* auto_sizes.c -- steps of two rates of order 4, chosen once: those that miss half the tolerance, by tests against half of them. */
#include <math.h>

#include "base/stop.h"
#include "engine/motion.h"
#include "study/auto_parts.h"
#include "system/system.h"

/* What the whole run is off by as r goes, from where half its step has come at the same time, in tolerances; INFINITY: it
 * has not come there. */
static double missed_by(struct choice *o, const struct racer *r)
{
    const double gone = r->sim.x.t - o->scene->start, span = r->sim.plan.until - o->scene->start;
    struct racer *half = auto_add_sized(o, r, .5);
    const struct ode2 *ode = r->sim.stepper.ode;
    double most = 0;
    if (!half || !(gone > 0)) return INFINITY;
    while (!half->out && half->sim.x.t < r->sim.x.t * (1 - 1e-9) && !stop) racer_go(half, half->work + 1, NULL, NULL);
    if (half->out) return INFINITY;
    half->out = true; /* it does not race */
    if (system_charts(r->sim.system) != system_charts(half->sim.system)) return INFINITY;
    double *dq = TAKE(o->own, double, ode->n);
    motion_diff(ode, dq, r->sim.x.q, half->sim.x.q);
    for (int i = 0; i < ode->n; i++) {
        const double usual = o->tolerance * ode2_usual(ode, i), v = r->sim.x.v[i];
        /* a vibration is off by no more than twice its size, however long it lasts */
        const double dv = fmin(fabs(v - half->sim.x.v[i]) * span / gone, 2 * fmax(fabs(v), o->quick.top[i]));
        most = fmax(most, fabs(dq[i]) * span / gone / usual);
        most = fmax(most, dv / (usual * fmax(1, fabs(v))));
    }
    return most;
}

/* Such steps as miss half the tolerance, going by what `missed` of it is, with four powers of the step; NULL: no others. */
static struct racer *sized(struct choice *o, const struct racer *r, double missed)
{
    static const double EXACT = .5, LEAST = .25, MOST = 2, ALIKE = 1.1;
    const double by = fmin(MOST, fmax(LEAST, pow(EXACT / missed, .25)));
    struct racer *other = by > 1 && by < ALIKE ? NULL : auto_add_sized(o, r, by);
    if (other) racer_go(other, other->work + r->work / fmin(1, by), NULL, NULL);
    return other;
}

/* Does r take so much beside the best that other steps of it are not worth a test? */
static bool is_hopeless(const struct racer *r, double best)
{
    static const double FAR = 4;             /* further than sizes are going to bring them */
    static const double TEST = 3, PART = .1; /* what a test takes, of what has been run; what it may, of the best */
    return racer_foretold(r) > FAR * best || TEST * r->work > PART * best;
}

/* Steps chosen once have to be as fine as the tolerance asks for, and need not be finer: others are tried in their place.
 * Returns the best there is then [evaluations]. */
static double size_steps(struct choice *o, struct racer *r, double best)
{
    enum { SIZES = 5 };
    struct racer *good = NULL;
    for (int i = 0; r && !r->out && !stop; i++) {
        if (is_hopeless(r, best)) break;
        const double missed = missed_by(o, r);
        r->holds = missed <= 1;
        r->out |= !r->holds;
        if (r->holds && good) (racer_foretold(r) < racer_foretold(good) ? good : r)->out = true;
        if (r->holds && !r->out) good = r;
        r = i < SIZES && !(good && !r->holds) && isfinite(missed) ? sized(o, r, missed) : NULL;
    }
    if (r && !r->holds) r->out = true;
    return good ? fmin(best, racer_foretold(good)) : best;
}

/* Do forces bend by the state, or jump at a known time on the way?  Steps chosen once, by what is tried, would go over that. */
static bool may_break(const struct sim *sim)
{
    enum { MOST = 1000 };
    const struct ode2 *ode = sim->stepper.ode;
    const struct ode2_breaks *b = ode->breaks;
    if (system_may_bend(sim->system)) return true;
    double t = sim->scene->start;
    for (int i = 0; b && b->next && b->sides && i < MOST && (t = b->next(ode, t)) < sim->plan.until; i++)
        if (b->sides(ode, t)) return true;
    return false;
}

void auto_size_fourths(struct choice *o, double best)
{
    if (may_break(&o->racer[0]->sim)) return;
    const int before = o->n;
    auto_add_fourths(o, best);
    const int n = o->n;
    for (int i = before; i < n; i++) {
        struct racer *r = o->racer[i];
        racer_go(r, r->work + AUTO_QUOTA, NULL, NULL);
        best = size_steps(o, r, best);
    }
}
