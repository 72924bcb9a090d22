/* stiff.c -- see stiff.h */
#include "study/stiff.h"

#include <math.h>

#include "engine/accel.h"
#include "engine/motion.h"

enum { ROUNDS = (STIFF_EVALUATIONS - 1) / 2 };
static const double SMALL = 1e-6; /* of the usual sizes */

struct about {
    const struct sim *sim;
    struct accel accel;
    struct effort none;
    int n;
    double *q, *v, *a0, *a; /* [nq], [n] */
    double *u, *w;          /* [n] displacement, its rate */
};

static double size_of(const struct about *o, const double *x)
{
    double most = 0;
    for (int i = 0; i < o->n; i++) most = fmax(most, fabs(x[i]) / ode2_usual(o->sim->stepper.ode, i));
    return most;
}

/* (u, w) := (w, da of (u, w)); what is done with a small part of them. */
static bool once(struct about *o)
{
    const struct state *x = &o->sim->x;
    const struct ode2 *ode = o->sim->stepper.ode;
    struct trouble why;
    motion_point(ode, o->q, x->q, o->u, 1, x->t);
    for (int i = 0; i < o->n; i++) o->v[i] = x->v[i] + o->w[i];
    if (accel_solve(&o->accel, o->a, NULL, o->q, o->v, x->t, &why) != OK) return false;
    for (int i = 0; i < o->n; i++) {
        o->u[i] = o->w[i];
        o->w[i] = o->a[i] - o->a0[i];
    }
    return true;
}

static void scale(struct about *o, double by)
{
    for (int i = 0; i < o->n; i++) {
        o->u[i] *= by;
        o->w[i] *= by;
    }
}

/* Two evaluations: the square of the rate. */
static double squared(struct about *o)
{
    const double before = size_of(o, o->u);
    if (!once(o)) return NAN;
    const double rates = size_of(o, o->u), by = rates > 0 ? SMALL / rates : 1;
    scale(o, by); /* rates are large beside displacements: all of it to small ones */
    if (!once(o)) return NAN;
    const double after = size_of(o, o->u) / by;
    const double most = fmax(size_of(o, o->u), 1e-300);
    scale(o, SMALL / most);
    return before > 0 ? after / before : NAN;
}

double stiff_rate(const struct sim *sim)
{
    struct arena *scratch = arena_open();
    const int n = sim->stepper.ode->n, nq = sim->stepper.ode->nq;
    struct about o = {.sim = sim, .n = n};
    struct trouble why;
    double square = NAN;
    o.q = TAKE(scratch, double, nq);
    o.v = TAKE(scratch, double, n);
    o.a0 = TAKE(scratch, double, n);
    o.a = TAKE(scratch, double, n);
    o.u = TAKE(scratch, double, n);
    o.w = TAKE(scratch, double, n);
    accel_open(&o.accel, sim->stepper.ode, &o.none, scratch);
    bool fine = accel_solve(&o.accel, o.a0, NULL, sim->x.q, sim->x.v, sim->x.t, &why) == OK;
    for (int i = 0; i < n; i++)
        o.u[i] = SMALL * ode2_usual(sim->stepper.ode, i) * (.3 + fmod(.618 * (i + 1), 1) - 2 * (i % 2));
    for (int i = 0; i < ROUNDS && fine; i++) {
        const double next = squared(&o);
        fine = isfinite(next);
        if (fine) square = next;
    }
    arena_close(scratch);
    return square > 0 ? sqrt(square) : 0;
}
