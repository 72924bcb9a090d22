/* guard.c -- the first sign of motion that the step does not resolve: the balance of energy is lost on the way.
 *
 * The verdict on the balance is passed at the end, against all that was done; where it is lost by then, it was at some step,
 * and there, with the coordinate whose frequency the step resolves least, it is told. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/recall.h"
#include "la/dense.h"
#include "sim/parts.h"

#define GUARD_RHO .5

enum { SOON = 20 }; /* major steps in which all works are near nothing, and a quadrature is off by parts of them */

/* The coordinate of the largest local frequency times its step, that too; -1: not known. */
static int least_resolved(double *omega_h, const struct sim *sim, struct arena *scratch)
{
    const struct ode2 *o = sim->stepper.ode;
    const int n = o->n, two = sim->stepper.kind->two_rates;
    double *M = TAKE_MATRIX(scratch, double, n, n), *K = TAKE_MATRIX(scratch, double, n, n);
    const struct instant x = {.t = sim->x.t, .q = sim->x.q, .v = sim->x.v, .ta = sim->x.t, .tb = sim->x.t};
    struct trouble why;
    int worst = -1;
    *omega_h = 0;
    if (o->ops->mass(o, M, x.q, x.t, ALL, &why) != OK || o->ops->slopes(o, K, NULL, &x, ALL, &why) != OK) return -1;
    if (dense_cholesky(M, n, n) >= 0) return -1;
    for (int i = 0; i < n; i++) {
        dense_cholesky_solve(M, K + (long)n * i, n, n);
        const double h = sim->last_h * (two && i >= o->ns ? sim->plan.ratio : 1);
        const double w = sqrt(fabs(K[i + (long)n * i])) * h;
        if (w > *omega_h) *omega_h = w, worst = i;
    }
    return worst;
}

/* Behind the n characters of text: what the step does not resolve, if that is known. */
static void add_cause(char *text, size_t size, int n, const struct sim *sim)
{
    enum { MANY = 500 };
    static const double RESOLVED = .5;
    double omega_h = 0;
    struct arena *scratch = arena_open();
    const int i =
        sim->stepper.ode->n <= MANY && !sim->stepper.kind->adaptive ? least_resolved(&omega_h, sim, scratch) : -1;
    if (i >= 0 && omega_h > RESOLVED)
        snprintf(text + n, size - (size_t)n, ": the step does not resolve '%.80s' (omega h = %.3g)",
                 sim_coordinate_name(sim, i), omega_h);
    arena_close(scratch);
}

bool guard_acts(const struct sim *sim)
{
    return sim->plan.guard == GUARD_ACT && !sim->stepper.kind->adaptive;
}

void guard_open(struct sim *sim)
{
    if (guard_acts(sim)) sim->guard.may_damp = stepper_may_damp(&sim->stepper, GUARD_RHO);
}

bool guard_damp(struct sim *sim)
{
    char text[240];
    const struct ledger *l = &sim->ledger;
    if (!sim->guard.may_damp || sim->stepper.damps) return false;
    const int n =
        snprintf(text, sizeof text,
                 "the energy balance, off by %.3g of ||W||, is lost in parts of a step, too, which are damped "
                 "by rho_infinity %g from here",
                 l->norm > 0 ? fabs(l->residual) / l->norm : 0, GUARD_RHO);
    add_cause(text, sizeof text, n, sim);
    sim_warn(sim, "t = %.6g s: %s", sim->x.t, text);
    sim->guard.t_damped = sim->x.t;
    sim->guard.depth = sim->guard.calm = 0;
    stepper_damp(&sim->stepper);
    return true;
}

void guard_recall(struct sim *sim, struct recall *r)
{
    recall_within(r, "guard");
    recall_one(r, "acted", sim->guard.acted);
    recall_one(r, "depth", sim->guard.depth);
    recall_one(r, "most", sim->guard.most);
    recall_one(r, "calm", sim->guard.calm);
    recall_one(r, "parted", sim->guard.parted);
    recall_one(r, "t_damped", sim->guard.t_damped);
    recall_without(r);
}

void guard_part(struct sim *sim, int depth)
{
    char text[240];
    sim->guard.calm = 0;
    if (depth > sim->guard.most) sim->guard.most = depth;
    if (depth <= sim->guard.depth) return;
    if (sim->guard.depth == 0 && !sim->guard.acted) {
        const int n =
            snprintf(text, sizeof text, "the energy balance is lost within a step, which is taken in parts from here");
        add_cause(text, sizeof text, n, sim);
        sim_warn(sim, "t = %.6g s: %s", sim->x.t, text);
        sim->guard.acted = true;
    }
    sim->guard.depth = depth;
}

enum status guard_look(struct sim *sim, struct sink *sink, struct report *report)
{
    const struct ledger *l = &sim->ledger;
    const double share = l->norm > 0 ? fabs(l->residual) / l->norm : 0;
    char text[240];
    if (guard_acts(sim) && share > l->delta / 2) (void)guard_damp(sim);
    if (!(share > l->delta) || sim->guard.told || sim->stepper.effort.majors < SOON) return OK;
    sim->guard.told = true;
    sim->guard.t = sim->x.t;
    const int n = snprintf(text, sizeof text, "the energy balance is off by %.3g of ||W||, for the first time", share);
    add_cause(text, sizeof text, n, sim);
    sim_warn(sim, "t = %.6g s: %s", sim->x.t, text);
    return sink_event(sink, sim->x.t, "balance", text, report);
}
