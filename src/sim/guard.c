/* guard.c -- watches the energy balance for the first sign of motion that the fixed step does not resolve.
 *
 * The verdict on the balance is passed at the end of the run, against ||W|| of all that was done.  Here it is told
 * at which step the balance was lost, with the coordinate whose local frequency omega is highest for the step
 * (largest omega h). Where there is unresolved motion, the balance is also held against the energy that is in the
 * system, and against the energy of that motion itself. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/recall.h"
#include "base/scalar.h"
#include "engine/motion.h"
#include "la/dense.h"
#include "sim/parts.h"

#define GUARD_RHO .5

enum {
    SOON = 20
}; /* major steps behind the start, or a standstill, in which works are little and a quadrature is off by parts of them */

/* M [n x n] := the Cholesky factor of the mass matrix at the present state, K [n x n] := M^-1 K; false: they cannot
 * be had. */
static bool look_at_masses(double *M, double *K, const struct sim *sim)
{
    const struct ode2 *o = sim->stepper.ode;
    const struct instant x = {
        .t = sim->x.t, .q = sim->x.q, .v = sim->x.v, .ta = sim->x.t, .tb = sim->x.t, .looks = true};
    struct trouble why;
    if (o->ops->mass(o, M, x.q, x.t, ALL, &why) != OK || o->ops->slopes(o, K, NULL, &x, ALL, &why) != OK) return false;
    if (dense_cholesky(M, o->n, o->n) >= 0) return false;
    dense_cholesky_solves(M, K, o->n, o->n, o->n, o->n);
    return true;
}

/* The step of coordinate i: the major one if it is slow [s]. */
static double step_of(const struct sim *sim, int i)
{
    const bool slow = sim->stepper.kind->two_rates && i >= sim->stepper.ode->ns;
    return sim->last_h * (slow ? sim->plan.ratio : 1);
}

/* omega h of coordinate i: its local frequency sqrt((M^-1 K)_ii), where the others recoil freely, times its step. */
static double turn_in_step(const struct sim *sim, const double *K, int i)
{
    return sqrt(fabs(K[i + (long)sim->stepper.ode->n * i])) * step_of(sim, i);
}

/* The velocity amplitude of the vibration in coordinate i, w = omega h: from the acceleration, since a coordinate
 * that moves on evenly does not vibrate.  Schemes that collocate at points of time have the acceleration of an
 * instant, a = omega v; the others its mean over the major step, in which the velocity of an unresolved vibration is
 * reversed. */
static double vibrates(const struct sim *sim, double w, int i)
{
    static const double EVENLY = .05;
    const struct stepper_kind *kind = sim->stepper.kind;
    const double whole = sim->last_h * (kind->two_rates ? sim->plan.ratio : 1), v = fabs(sim->x.v[i]);
    const double change = fabs(sim->x.a[i]) * (kind->points ? step_of(sim, i) / w : whole / 2);
    return change > EVENLY * v ? larger(change, v) : change;
}

/* The coordinate with the largest omega h, and *omega_h; -1: not known. */
static int least_resolved(double *omega_h, const struct sim *sim, struct arena *scratch)
{
    const int n = sim->stepper.ode->n;
    double *M = TAKE_MATRIX(scratch, double, n, n), *K = TAKE_MATRIX(scratch, double, n, n);
    int worst = -1;
    *omega_h = 0;
    if (!look_at_masses(M, K, sim)) return -1;
    for (int i = 0; i < n; i++) {
        const double w = turn_in_step(sim, K, i);
        if (w > *omega_h) *omega_h = w, worst = i;
    }
    return worst;
}

/* The largest kinetic energy of vibration [J] of a coordinate with omega h above 1, which one that is and its omega
 * h; 0: no such coordinate vibrates.  1/(M^-1)_ii is the inertia of coordinate i while the others recoil. */
static double moves_unresolved(int *at, double *omega_h, const struct sim *sim, struct arena *scratch)
{
    static const double RESOLVED = 1;
    const int n = sim->stepper.ode->n;
    double *M = TAKE_MATRIX(scratch, double, n, n), *K = TAKE_MATRIX(scratch, double, n, n), most = 0;
    double *y = TAKE(scratch, double, n);
    if (!look_at_masses(M, K, sim)) return 0;
    for (int i = 0; i < n; i++) {
        const double w = turn_in_step(sim, K, i);
        if (!(w > RESOLVED)) continue;
        zero(y, n);
        y[i] = 1;
        dense_cholesky_solve(M, y, n, n);
        const double v = vibrates(sim, w, i), own = v * v / (2 * y[i]);
        if (own > most) most = own, *at = i, *omega_h = w;
    }
    return most;
}

/* Appends to the n characters of text which coordinate the step does not resolve, if that is known. */
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

/* The largest energy that has been in the system so far [J]. */
static double energy_there(struct sim *sim)
{
    const struct ledger *l = &sim->ledger;
    const double energy = l->kinetic + fabs(l->elastic) + fabs(l->gravity - l->gravity0);
    sim->guard.there = larger(sim->guard.there, larger(energy, larger(l->least, l->kinetic0 + fabs(l->elastic0))));
    return sim->guard.there;
}

/* Is the energy so far a fair measure?  A motion from rest has next to none at first: then it is waited for twice
 * the time at which the loss was seen. */
static bool lasts(const struct sim *sim)
{
    const struct ledger *l = &sim->ledger;
    const double from = sim->scene->start, t = sim->x.t;
    return 2 * (l->kinetic0 + fabs(l->elastic0)) > sim->guard.there || t - from >= 2 * (sim->guard.t_taken - from) ||
           t >= sim->plan.until;
}

/* Numerical damping removes unresolved motion within a few steps, and the balance, which counts what damping takes,
 * holds: but the effect of that motion on the rest is missing.  Has it taken more than delta of the energy in such
 * bursts?  *share: how much of it; the coordinate least resolved and its omega h. */
static bool taken_away(double *share, int *at, double *omega_h, struct sim *sim)
{
    enum { MANY = 500 };
    static const double RESOLVED = .5;
    const struct ledger *l = &sim->ledger;
    if (sim->guard.taken || sim->stepper.kind->adaptive || sim->stepper.ode->n > MANY) return false;
    const bool much = l->burst > l->delta * energy_there(sim);
    if (much && !sim->guard.taking) sim->guard.t_taken = sim->x.t;
    sim->guard.taking = much;
    if (!much || !lasts(sim)) return false;
    struct arena *scratch = arena_open();
    *at = least_resolved(omega_h, sim, scratch);
    arena_close(scratch);
    *share = l->burst / sim->guard.there;
    return *at >= 0 && *omega_h > RESOLVED;
}

static enum status tell_taken(struct sim *sim, double share, int at, double omega_h, struct sink *sink,
                              struct report *report)
{
    char text[300];
    snprintf(
        text, sizeof text,
        "the scheme's own damping has taken %.3g of the energy that is there, for the first time: the step does not "
        "resolve '%.80s' (omega h = %.3g), and what it would do is missing [W-damped]",
        share, sim_coordinate_name(sim, at), omega_h);
    sim_warn(sim, "t = %.6g s: %s", sim->guard.t_taken, text);
    sim->guard.taken = true;
    return sink_event(sink, sim->x.t, "balance", text, report);
}

/* ||W|| grows with all energy that passes through: once a motor and a brake have converted megajoules, an unresolved
 * vibration of a stiff part is invisible beside it.  Is the balance off by more than delta of the energy that has
 * been in the system, while something vibrates unresolved; or by a tenth of the energy of a strong such vibration?
 * *share: of the energy in the system; the coordinate and its omega h.  Looked at less and less often, for it costs
 * a factorization. */
static bool hidden(double *share, int *at, double *omega_h, struct sim *sim)
{
    enum { MANY = 500, OFTEN = 32 };
    static const double EXCITED = 1e-4, STRONGLY = 1e-2, TENTH = .1;
    const struct ledger *l = &sim->ledger;
    const double there = energy_there(sim), off = fabs(l->residual);
    if (!(off > TENTH * STRONGLY * there) || sim->stepper.kind->adaptive || sim->stepper.ode->n > MANY) return false;
    if (sim->guard.looks++ < sim->guard.next) return false;
    sim->guard.next = sim->guard.looks < OFTEN ? 0 : 2 * sim->guard.looks;
    struct arena *scratch = arena_open();
    const double moves = moves_unresolved(at, omega_h, sim, scratch);
    arena_close(scratch);
    if (!(moves > EXCITED * there && off > l->delta * there) && !(moves > STRONGLY * there && off > TENTH * moves))
        return false;
    *share = off / there;
    return true;
}

static enum status tell_hidden(struct sim *sim, double share, int at, double omega_h, struct sink *sink,
                               struct report *report)
{
    char text[300];
    snprintf(text, sizeof text,
             "the energy balance is off by %.3g of the energy that is there, for the first time: the step does not "
             "resolve '%.80s' (omega h = %.3g), which moves",
             share, sim_coordinate_name(sim, at), omega_h);
    sim_warn(sim, "t = %.6g s: %s", sim->x.t, text);
    sim->guard.told = sim->guard.broken = true;
    sim->guard.t = sim->x.t;
    if (guard_acts(sim)) (void)guard_damp(sim);
    return sink_event(sink, sim->x.t, "balance", text, report);
}

enum status guard_look(struct sim *sim, struct sink *sink, struct report *report)
{
    const struct ledger *l = &sim->ledger;
    const double share = l->norm > 0 ? fabs(l->residual) / l->norm : 0;
    char text[240];
    if (guard_acts(sim) && share > l->delta / 2) (void)guard_damp(sim);
    double part = 0, omega_h = 0;
    int at = -1;
    if (ledger_stands(l)) sim->guard.stood = sim->stepper.effort.majors;
    if (sim->stepper.effort.majors < SOON) return OK;
    if (l->burst > 0 && taken_away(&part, &at, &omega_h, sim)) TRY(tell_taken(sim, part, at, omega_h, sink, report));
    if (sim->guard.told) return OK;
    if (!(share > l->delta))
        return hidden(&part, &at, &omega_h, sim) ? tell_hidden(sim, part, at, omega_h, sink, report) : OK;
    if (sim->stepper.effort.majors < sim->guard.stood + SOON) return OK;
    sim->guard.told = true;
    sim->guard.t = sim->x.t;
    const int n = snprintf(text, sizeof text, "the energy balance is off by %.3g of ||W||, for the first time", share);
    add_cause(text, sizeof text, n, sim);
    sim_warn(sim, "t = %.6g s: %s", sim->x.t, text);
    return sink_event(sink, sim->x.t, "balance", text, report);
}

void warn_of_unresolved(struct sim *sim)
{
    static const double EXCITED = 1e-6, FINE = .3; /* omega h */
    const struct unresolved *o = &sim->stepper.unresolved;
    if (!(o->energy > EXCITED * o->motion)) return;
    sim_warn(
        sim,
        "the minor steps do not resolve '%.60s', which vibrates at t = %.6g s with %.2g of the energy of motion (omega "
        "h = %.3g): that is kept, but nothing of its phase is right; take a step of %.2g s [W-resolve]",
        sim_coordinate_name(sim, o->coordinate), o->t, smaller(1, o->energy / o->motion), o->omega_h,
        sim->plan.step * FINE / o->omega_h);
}
