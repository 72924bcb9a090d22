/* advance.c -- a major step, and what is done when it will not converge.
 *
 * First the major step is halved with the minor step kept (ratio n into n/2 and the rest), then, at
 * ratio 1, the minor step itself.  Nothing unconverged is accepted; at 2^-10 of the deck's step the run stops, and so it
 * does where halving has become the rule.
 *
 * A scheme that looks at points of time gains or loses energy where a law has a corner within a step: as much as a
 * stop's stiffness brings in a part of the step.  Such a step is halved, too, while it spoils the balance; where the guard
 * acts every step is, and those behind it begin in as many parts, which may be halved as often again.  And no scheme steps over a pole of a force. */
#include <math.h>
#include <string.h>

#include "engine/adaptive.h"
#include "engine/crossed.h"
#include "engine/passing.h"
#include "engine/single.h"
#include "engine/touch.h"
#include "sim/parts.h"

enum { MOST_HALVINGS = 10 };
enum { REJECTED_PER_MAJOR = 10, REJECTED_BESIDES = 10000, REJECTED_PER_RECORD = 100000 };
static const double SPOILT = 1e-3; /* of what the balance may be off by, in one step */
enum { CALM = 64 };                /* major steps behind which the guard tries larger parts */

/* Is there a watch that reads what the look at the energies leaves: bodies where the step has ended? */
static bool looks_at_once(const struct sim *sim)
{
    const bool watched = sim->watched || sim->nspin || sim->ntilt || sim->npass || sim->idle.n || sim->negative;
    return watched || (sim->nrotation && sim->model->nloop) || sim->stepper.kind->adaptive ||
           effect_wish(&sim->scene->effects, EFFECT_LEDGER) == WISH_ON;
}

/* Until it converges: as often again where the guard may have used them up. */
static int halvings(const struct sim *sim)
{
    return guard_acts(sim) ? 2 * MOST_HALVINGS : MOST_HALVINGS;
}

void advance_open(struct sim *sim, struct arena *life)
{
    sim->keep = TAKE(life, struct single, 1);
    single_open(sim->keep, sim->stepper.ode, life);
    sim->look = TAKE(life, struct single, 1);
    single_open(sim->look, sim->stepper.ode, life);
    sim->stepper.guess = sim->guess;
    sim->onto_records = !adaptive_interpolates(&sim->stepper) || sim->needs & NEED_WORKS;
    sim->stepper.natural = sim->stepper.ode->n > 0 && sim->stepper.kind->adaptive &&
                           (!sim->onto_records || events_watched(sim) || sim->stepper.touch);
    sim->watched = (sim->stepper.kind->points && system_may_bend(sim->system)) || system_may_have_poles(sim->system) ||
                   guard_acts(sim);
    if (!sim->stepper.kind->adaptive) sim->passing = passing_open(sim->stepper.ode, life);
    sim->crossed = crossed_open(&sim->stepper, life);
    sim->undone = sim->watched || sim->passing || sim->crossed;
    sim->looks_at_once = looks_at_once(sim);
    sim->looks_always = sim->looks_at_once || (sim->needs & NEED_ENERGY && sim->every == 1);
    sim->noting = sim->nrotation || sim->nspin || sim->ntilt || sim->idle.n || sim->negative || sim->ndeflection;
}

enum status look_at_energies(struct sim *sim)
{
    struct energies e;
    TRY(system_energy_at(sim->system, &e, sim->x.q, sim->x.v, sim->x.t, &sim->trouble));
    ledger_look(&sim->ledger, sim->x.t, e.kinetic, e.elastic, e.gravity);
    return OK;
}

/* Books the step that was just accepted.  A state whose energy is unknown ends the run: it is no step to halve. */
static enum status book(struct sim *sim)
{
    const struct stepper *s = &sim->stepper;
    ledger_swing(&sim->ledger, s->swing);
    ledger_add(&sim->ledger, s->work, s->lost, s->left);
    if (s->touch) ledger_strike(&sim->ledger, s->struck);
    return sim->looks_at_once ? look_at_energies(sim) : OK;
}

static enum status note(struct sim *sim, double h, int ratio)
{
    sim->last_h = h;
    if (h < sim->min_h) sim->min_h = h;
    if (!sim->noting) return OK;
    if (sim->nrotation) rotations_note(sim, h, ratio);
    if (sim->nspin) spins_note(sim);
    if (sim->ntilt) tilts_note(sim);
    if (sim->idle.n) TRY(idle_note(sim));
    if (sim->negative) TRY(inertias_note(sim));
    return sim->ndeflection ? deflections_note(sim) : OK;
}

static enum status halve(struct sim *sim, double h, int ratio, double to, int depth);

/* What a watched step may have to go back to. */
static void keep(struct sim *sim)
{
    single_save(sim->keep, sim->stepper.ode, &sim->x);
    sim->kept = sim->ledger;
    sim->kept_t = sim->x.t;
}

/* To the state that was kept, at t. */
static enum status undo(struct sim *sim, double t)
{
    if (sim->stepper.touch) touch_back(sim->stepper.touch, &sim->x);
    single_restore(sim->keep, sim->stepper.ode, &sim->x, t);
    sim->ledger = sim->kept;
    sim->stepper.effort.rejected++;
    TRY(system_back(sim->system, sim->x.q, sim->x.v, t, &sim->trouble));
    return stepper_start(&sim->stepper, &sim->x, &sim->trouble);
}

/* Has the step that was booked last gone over a corner that it had better met?  Or, where the guard acts, lost the balance
 * at all? */
static bool spoilt(const struct sim *sim)
{
    const struct ledger *l = &sim->ledger;
    const bool acts = guard_acts(sim);
    if (!acts && (!sim->stepper.kind->points || !system_may_bend(sim->system))) return false;
    return fabs(l->residual - sim->kept.residual) > SPOILT * l->delta * l->norm && (acts || system_bent(sim->system));
}

/* Has a step that ends clear of all gone over a touch?  What minor steps in between have seen is not known: they are taken
 * in shorter major ones. */
static bool passed_over(const struct sim *sim)
{
    const struct state before = {sim->kept_t, sim->keep->q, sim->keep->v, sim->keep->a};
    if (!sim->passing) return false;
    return passing_found(sim->passing, &before, &sim->x) || passes_through(sim);
}

/* The force that has grown without bound in the step; -1: none.  A scheme with steps of its own tells the system of the last one of
 * them when it begins with the next. */
static int pole_in(const struct sim *sim)
{
    const int force = sim->watched ? system_pole(sim->system) : -1;
    const bool told = force >= 0 || !sim->watched || !sim->stepper.kind->adaptive;
    return told ? force : system_pole_to(sim->system, sim->x.q, sim->x.v, sim->x.t);
}

static enum status stop_before(struct sim *sim, int pole, double t)
{
    TRY(undo(sim, t));
    return trouble_set(&sim->trouble, TROUBLE_LAW, pole, INFINITY, t);
}

/* Watched: is the step to be undone that was taken in the chart of number `chart`? */
static bool wrong(const struct sim *sim, long chart)
{
    if (chart != system_charts(sim->system)) return false;
    return (sim->watched && (pole_in(sim) >= 0 || spoilt(sim))) || passed_over(sim);
}

/* What a step that has been taken from the chart of number `chart` leaves where it goes over edges of forces; looked: it has been
 * asked what it passes over. */
static void cross(struct sim *sim, double h, long chart, bool looked)
{
    const struct state before = {sim->kept_t, sim->keep->q, sim->keep->v, sim->keep->a};
    if (chart == system_charts(sim->system))
        crossed_step(sim->crossed, &sim->stepper, &before, &sim->x, h, looked ? sim->passing : NULL);
    else
        crossed_break(sim->crossed);
}

static enum status step(struct sim *sim, double h, int ratio, double to, int depth)
{
    const bool divisible = depth < MOST_HALVINGS, undone = sim->undone;
    const double t = sim->x.t;
    const long chart = undone ? system_charts(sim->system) : 0;
    if (depth < sim->guard.depth) return halve(sim, h, ratio, to, depth);
    if (undone) keep(sim);
    enum status status = stepper_step(&sim->stepper, &sim->x, h, ratio, to, &sim->trouble);
    if (status == E_NUMERIC && depth < halvings(sim)) return halve(sim, h, ratio, to, depth);
    TRY(status);
    TRY(book(sim));
    if (!undone) return note(sim, h, ratio);
    if (divisible && wrong(sim, chart)) {
        TRY(undo(sim, t));
        if (guard_acts(sim)) guard_part(sim, depth + 1);
        return halve(sim, h, ratio, to, depth);
    }
    if (sim->watched && !divisible && spoilt(sim) && guard_acts(sim) && guard_damp(sim)) {
        TRY(undo(sim, t));
        return step(sim, h, ratio, to, depth);
    }
    if (sim->crossed) cross(sim, h, chart, divisible);
    const int pole = pole_in(sim);
    return pole >= 0 ? stop_before(sim, pole, t) : note(sim, h, ratio);
}

/* More steps given up than a run can mean to.  Of a scheme with its own that is as many from record to record, where they are
 * more than it has taken or a force jumps: against dry friction written as sign(rate) there is no way on. */
static enum status within_limit(struct sim *sim)
{
    const struct effort *e = &sim->stepper.effort;
    const bool own = sim->stepper.kind->adaptive;
    const long rejected = e->rejected - sim->rejected;
    double before, behind;
    if (rejected <= (own ? REJECTED_PER_RECORD : REJECTED_BESIDES + REJECTED_PER_MAJOR * sim->majors)) return OK;
    if (own && !sim->stepper.natural) return OK;
    if (own && e->rejected < e->majors && find_leap(sim, &before, &behind) < 0) {
        sim->rejected = e->rejected;
        return OK;
    }
    (void)trouble_set(&sim->trouble, TROUBLE_REJECTED, -1, (double)rejected, sim->x.t);
    return E_LIMIT;
}

static enum status halve(struct sim *sim, double h, int ratio, double to, int depth)
{
    double from = sim->x.t;
    TRY(within_limit(sim));
    if (ratio > 1) {
        int first = ratio / 2;
        TRY(step(sim, h, first, from + first * h, depth + 1));
        return step(sim, h, ratio - first, to, depth + 1);
    }
    double middle = from + (to - from) / 2;
    if (!(middle > from && middle < to)) return E_NUMERIC;
    TRY(step(sim, h / 2, 1, middle, depth + 1));
    return step(sim, h / 2, 1, to, depth + 1);
}

enum status advance(struct sim *sim, double h, int ratio, double to)
{
    if (sim->guard.depth > 0 && sim->guard.calm++ == CALM) {
        sim->guard.calm = 0;
        sim->guard.depth--;
    }
    const int most = sim->guard.most;
    const enum status status = step(sim, h, ratio, to, 0);
    if (sim->guard.depth > 0 || sim->guard.most > most) sim->guard.parted++;
    return status;
}

static enum status natural_step(struct sim *sim, double to, int depth)
{
    const double t = sim->x.t;
    const long chart = system_charts(sim->system);
    TRY(within_limit(sim));
    if (sim->watched || events_watched(sim)) keep(sim);
    TRY(stepper_step(&sim->stepper, &sim->x, 0, 1, to, &sim->trouble));
    const double end = sim->x.t;
    TRY(book(sim));
    if (sim->watched && depth < MOST_HALVINGS && wrong(sim, chart)) {
        TRY(undo(sim, t));
        return natural_step(sim, t + (end - t) / 2, depth + 1);
    }
    const int pole = pole_in(sim);
    return pole >= 0 ? stop_before(sim, pole, t) : note(sim, end - t, 1);
}

enum status advance_naturally(struct sim *sim, double to)
{
    return natural_step(sim, to, 0);
}

enum status advance_back(struct sim *sim)
{
    if (sim->crossed) crossed_break(sim->crossed);
    return undo(sim, sim->kept_t);
}
