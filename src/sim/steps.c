/* steps.c -- all steps of a run, with its records, watches and checkpoints: major steps as the plan has them, or those that
 * a scheme chooses */
#include <math.h>

#include "base/clock.h"
#include "base/stop.h"
#include "engine/adaptive.h"
#include "engine/motion.h"
#include "engine/single.h"
#include "sim/parts.h"

enum { CHECK_EVERY = 64 };

/* The record that stands in sim->row. */
static enum status put_row(struct sim *sim, struct sink *sink, struct report *report)
{
    sim->rows++;
    sim->recorded = sim->x.t;
    trust_note(sim);
    neglects_note(sim);
    if (sim->lateral.n) lateral_note(sim);
    return sink->ops->row(sink, sim->row, report);
}

static enum status write_row(struct sim *sim, struct sink *sink, struct report *report)
{
    if (!sink) return OK;
    enum status status = record_fill(sim);
    if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
    return put_row(sim, sink, report);
}

/* When major step k (from 1) ends: the double nearest to i h, i the whole number of minor steps since t = 0, or since the
 * start where that is no end of a step. */
static double whole_step(const struct sim *sim, long k)
{
    const double i = (double)((sim->before + k) * sim->plan.ratio);
    return sim->origin.x == 0 ? meant_times(i, &sim->step) : meant_sum(&sim->origin, i, &sim->step);
}

/* The last one ends at `until`. */
static double end_of(const struct sim *sim, long k)
{
    return k == sim->majors ? sim->plan.until : whole_step(sim, k);
}

/* Major step k to its end at `to`; the last may be cut: same ratio, a smaller minor step. */
static enum status major(struct sim *sim, long k, double to)
{
    const struct integrate *p = &sim->plan;
    const double over = k == sim->majors ? to - whole_step(sim, k) : 0;
    double h = p->step;
    if (fabs(over) > 1e-9 * h * p->ratio) h = (to - sim->x.t) / p->ratio;
    const double from = sim->x.t;
    const enum status status = advance(sim, h, p->ratio, to);
    if (sim->x.t != from || status != OK) sim->cut = over != 0 || sim->x.t != to;
    return status;
}

static enum status check_events(struct sim *sim, struct sink *sink, struct report *report)
{
    enum status status = events_check(sim, sink, report);
    return status == E_NUMERIC ? describe_trouble(sim, &sim->trouble, status, report) : status;
}

/* The loops, too, where records do not look at them. */
static enum status check_energies(struct sim *sim, struct report *report)
{
    enum status status = look_at_energies(sim);
    if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
    system_note_closure(sim->system, sim->x.q, sim->x.t);
    return OK;
}

/* The same by the evaluation for a record, which is due there. */
static enum status check_energies_by_record(struct sim *sim, struct report *report)
{
    struct energies e;
    enum status status = record_evaluate(sim, sim->needs | EVALUATE_ENERGY);
    if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
    system_energies(sim->system, &e);
    ledger_look(&sim->ledger, sim->x.t, e.kinetic, e.elastic, e.gravity);
    return OK;
}

/* What is due at the end of major step k: a look at the energies, a record. */
static enum status look_and_write(struct sim *sim, long k, bool due, struct sink *sink, struct report *report)
{
    const bool looks = look_is_due(sim, k, due), shared = looks && due && sink && record_looks(sim);
    if (looks) TRY((shared ? check_energies_by_record : check_energies)(sim, report));
    if (looks || sim->looks_at_once) TRY(guard_look(sim, sink, report));
    if (!due) return OK;
    if (!shared) return write_row(sim, sink, report);
    record_read(sim);
    return put_row(sim, sink, report);
}

/* Who sends a signal knows of it; a limit has to be reported. */
static enum status stopped(const struct sim *sim, struct report *report)
{
    const char *limit = stop_limit();
    if (!limit) return stop_status();
    return fail(report, stop_status(), "stopped at t = %.12g s: the limit of %s is reached", sim->x.t, limit);
}

/* Was the step given up because the run is asked to end?  A major step of very many minor ones is. */
static bool is_given_up(enum status status)
{
    return stop && status == stop_status();
}

/* Then the run ends where it stands, with a record, if it has none there. */
static enum status end_here(struct sim *sim, struct sink *sink, struct report *report)
{
    if (!sim->looks_at_once) TRY(check_energies(sim, report));
    if (sim->recorded != sim->x.t) TRY(write_row(sim, sink, report));
    return stopped(sim, report);
}

/* A checkpoint, where one is due. */
static enum status save(struct sim *sim, long step, long due, double seen, struct report *report)
{
    sim->place = (struct run_place){sim->place.resumed, step, due, seen};
    return checkpoint_due(sim) ? checkpoint_write(sim, report) : OK;
}

/* The clock is read at records and every so many steps, not at each; at few of the records that follow each other at once.
 * Who counts looks at every step and reads no clock. */
static enum status tick(const struct sim *sim, struct sink *sink, struct progress *progress, struct report *report)
{
    enum { FEW = 16 };
    static const double AT_ONCE = 1e-3; /* [s] */
    TRY(sink_passed(sink, report));
    if (sim->options.counting) return OK;
    if (progress->skipped++ < progress->due) return OK;
    const double now = clock_wall();
    progress->due = now - progress->read < AT_ONCE ? FEW : 0;
    progress->skipped = 0;
    progress->read = now;
    progress_show(progress, now, sim->x.t, sim->plan.until);
    return sink_tick(sink, now, report);
}

/* From record to record. */
static enum status step_on(struct sim *sim, struct sink *sink, struct progress *progress, struct report *report)
{
    for (long k = sim->place.step + 1; k <= sim->majors; k++) {
        const bool loops = sim->model->nloop > 0;
        const long charts = loops ? system_charts(sim->system) : 0;
        const double t0 = sim->x.t, to = end_of(sim, k);
        if (sim->njump) TRY(jumps_check(sim, to, sink, report));
        enum status status = major(sim, k, to);
        if (is_given_up(status)) return end_here(sim, sink, report);
        if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
        trust_step(sim);
        corners_note(sim, t0);
        if (sim->stepper.touch) TRY(contacts_events(sim, sink, report));
        if (loops && system_charts(sim->system) != charts) TRY(write_partition(sim, sink, report));
        if (sim->npass) TRY(passes_check(sim, sink, report));
        if (events_watched(sim)) TRY(check_events(sim, sink, report));
        bool due = (sim->before + k) % sim->every == 0 || k == sim->majors || sim->watch.met;
        TRY(look_and_write(sim, k, due, sink, report));
        if (due || k % CHECK_EVERY == 0 || sim->options.counting) TRY(tick(sim, sink, progress, report));
        if (sim->saves.stream) TRY(save(sim, k, 0, 0, report));
        if (sim->watch.met) return OK;
        if (stop && (k < sim->majors || sim->x.t != to)) return end_here(sim, sink, report);
    }
    return OK;
}

/* The record number k, from 1, that is due behind record number `from`. */
static long next_due(const struct sim *sim, long from)
{
    long k = from + 1;
    while (k < sim->majors && (sim->before + k) % sim->every != 0) k++;
    return k;
}

/* A record at t inside the last step: the state by the scheme's interpolation, the balance as it would be if it
 * went on evenly; works are not asked for (NEED_WORKS). */
static enum status write_between(struct sim *sim, double t, double t0, const struct ledger *before, struct sink *sink,
                                 struct report *report)
{
    const struct state end = sim->x;
    const struct ledger after = sim->ledger;
    struct energies e;
    if (!adaptive_between(&sim->stepper, sim->look->q, sim->look->v, t))
        return fail(report, E_BUG, "the record at t = %.12g s cannot be had inside a step from %.12g s", t, t0);
    sim->x = (struct state){t, sim->look->q, sim->look->v, sim->look->a};
    enum status status = system_energy_at(sim->system, &e, sim->x.q, sim->x.v, t, &sim->trouble);
    if (status == OK) {
        ledger_between(&sim->ledger, before, (t - t0) / (end.t - t0), e.kinetic, e.elastic, e.gravity);
        status = write_row(sim, sink, report);
    } else {
        status = describe_trouble(sim, &sim->trouble, status, report);
    }
    sim->x = end;
    sim->ledger = after;
    return status;
}

/* When the next record is due, number k or one behind it: a step that begins on a record, but for round-off, may begin behind it,
 * and is asked for those that are inside it. */
static double due_inside(const struct sim *sim, long k)
{
    const double behind = motion_behind(sim->x.t, sim->plan.until);
    while (k < sim->majors && end_of(sim, k) <= behind) k = next_due(sim, k);
    return end_of(sim, k);
}

/* The records that are due in the step from t0, or at its end; *k is the next one. */
static enum status write_due(struct sim *sim, long *k, double t0, const struct ledger *before, struct sink *sink,
                             struct report *report)
{
    for (; *k <= sim->majors && end_of(sim, *k) <= sim->x.t; *k = next_due(sim, *k)) {
        const double t = end_of(sim, *k);
        if (t < sim->x.t)
            TRY(write_between(sim, t, t0, before, sink, report));
        else
            TRY(write_row(sim, sink, report));
    }
    return OK;
}

/* The record, number k or one behind it, before which no drive jumps but for what is looked for up to number k. */
static double seen_to(const struct sim *sim, long k)
{
    const double clear = jumps_clear(sim);
    for (long next = k; next < sim->majors; k = next) {
        next = next_due(sim, k);
        if (!(end_of(sim, next) < clear)) break;
    }
    return end_of(sim, k);
}

/* By the steps of a scheme that chooses them, across records or, where it cannot look back, from record to record; also where
 * a drive may jump at times that are not known. */
static enum status step_naturally(struct sim *sim, struct sink *sink, struct progress *progress, struct report *report)
{
    const double until = sim->plan.until;
    const bool on = sim->place.resumed;
    double seen = on ? sim->place.seen : sim->x.t, onto = INFINITY;
    sim->cut = true;
    for (long k = on ? sim->place.due : next_due(sim, 0), i = sim->place.step + 1; sim->x.t < until; i++) {
        const long charts = system_charts(sim->system), due = k;
        const double t0 = sim->x.t;
        const struct ledger before = sim->ledger;
        if (sim->njump && seen <= t0) TRY(jumps_check(sim, seen = seen_to(sim, k), sink, report));
        const double to = sim->onto_records ? end_of(sim, k) : sim->njump ? seen : until;
        sim->stepper.due = due_inside(sim, k);
        const enum status status = advance_naturally(sim, fmin(to, onto));
        if (is_given_up(status)) return end_here(sim, sink, report);
        if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
        if (sim->x.t >= onto) onto = INFINITY;
        if (events_watched(sim) && system_charts(sim->system) == charts) {
            const double event = onto_event(sim);
            if (event < onto) {
                onto = event;
                TRY(advance_back(sim));
                continue;
            }
        }
        trust_step(sim);
        corners_note(sim, t0);
        if (sim->stepper.touch) TRY(contacts_events(sim, sink, report));
        if (system_charts(sim->system) != charts) TRY(write_partition(sim, sink, report));
        if (sim->npass) TRY(passes_check(sim, sink, report));
        if (events_watched(sim)) TRY(check_events(sim, sink, report));
        TRY(write_due(sim, &k, t0, &before, sink, report));
        TRY(guard_look(sim, sink, report));
        const bool last = sim->watch.met || (stop && sim->x.t < until);
        if (last && sim->recorded != sim->x.t) TRY(write_row(sim, sink, report));
        if (k != due) sim->rejected = sim->stepper.effort.rejected;
        if (k != due || i % CHECK_EVERY == 0 || sim->options.counting) TRY(tick(sim, sink, progress, report));
        if (sim->saves.stream && onto == INFINITY) TRY(save(sim, i, k, seen, report)); /* else the next one */
        if (sim->watch.met) return OK;
        if (last) return stopped(sim, report);
    }
    return OK;
}

enum status steps_take(struct sim *sim, struct sink *sink, struct progress *progress, struct report *report)
{
    if (!sim->place.resumed) {
        TRY(write_row(sim, sink, report));
        if (events_watched(sim)) TRY(check_events(sim, sink, report));
    }
    corners_begin(sim);
    return (sim->stepper.natural ? step_naturally : step_on)(sim, sink, progress, report);
}
