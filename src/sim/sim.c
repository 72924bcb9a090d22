/* sim.c -- opens a run and takes it to its end; see sim.h */
#include "sim/sim.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/stop.h"
#include "engine/adaptive.h"
#include "engine/single.h"
#include "la/vec3.h"
#include "model/build.h"
#include "sim/parts.h"

static struct state new_state(const struct model *m, struct arena *life)
{
    return (struct state){m->t0, TAKE(life, double, m->nq), TAKE(life, double, m->n), TAKE(life, double, m->n)};
}

/* From the deck's start to the equilibrium near it; the deck's rates stay. */
static enum status start_at_rest(struct sim *sim, struct report *report)
{
    struct trouble why = {0};
    TRY(sim_without_contacts(sim, "no start: initial: static", report));
    struct arena *scratch = arena_open();
    const size_t bytes = (size_t)system_ode2(sim->system)->n * sizeof(double);
    memcpy(sim->x.a, sim->x.v, bytes); /* a place to keep them */
    enum status status = rest_find(sim, scratch, &why);
    arena_close(scratch);
    memcpy(sim->x.v, sim->x.a, bytes);
    if (status == OK) return OK;
    if (why.code == TROUBLE_DEFLECTION)
        return fail(
            report, E_MODEL,
            "no start: no static equilibrium was found: on the way '%s' bends by %g times its length; look at its "
            "loads, or at how fast it is turned [no-equilibrium]",
            sim->model->body[why.index].name, why.value);
    return fail(report, E_MODEL,
                "no start: no stable static equilibrium was found near the initial position (last move %.3g m or rad); "
                "look for a part that nothing holds [no-equilibrium]",
                why.value);
}

static enum status place(struct sim *sim, struct report *report)
{
    struct report why = {0};
    enum status status = system_start(sim->system, sim->x.q, sim->x.v, &why);
    const bool shifted = sim->scene->from && sim->model->ndrive && sim->scene->start == 0;
    if (status == OK) return OK;
    if (shifted)
        snprintf(why.text + strlen(why.text), sizeof why.text - strlen(why.text),
                 "; 'time: keep' beside 'from' goes on at the state's own time");
    return sim_no_start(sim, status, why.text, report);
}

/* Work of the forces at the last evaluation along the mechanism's length, of torques along 1 rad [J]. */
static double strained(const struct sim *sim)
{
    const struct model *m = sim->model;
    double sum = 0;
    for (int i = 0; i < m->nforce; i++) {
        const struct model_force *f = &m->force[i];
        double force, elongation, power;
        system_force(sim->system, &force, &elongation, &power, i);
        const bool turns = f->torque || (f->measure >= 0 && m->measure[f->measure].angular);
        sum += fabs(force) * (turns ? 1 : system_length(sim->system)) + fabs(system_force_torque(sim->system, i));
    }
    return sum;
}

/* Work of the weight of what contacts carry along the mechanism's length [J]. */
static double carried(const struct sim *sim, double mass)
{
    return sim->stepper.touch ? mass * v3_norm(sim->model->gravity) * system_length(sim->system) : 0;
}

/* Energy of all bodies moved by what round-off makes of the mechanism's length in the time of the run [J]: where nothing
 * moves, springs and markers still do by so much; and what forces do by round-off of places. */
static enum status least_energy(double *least, struct sim *sim, struct trouble *why)
{
    static const double round_off = 1e-11, of_places = 1e5 * DBL_EPSILON;
    const struct model *m = sim->model;
    const struct state *x = &sim->x;
    const double v = round_off * system_length(sim->system) / (sim->plan.until - m->t0);
    double mass = 0;
    for (int i = 1; i < m->nbody; i++) mass += m->body[i].mass;
    TRY(system_evaluate(sim->system, x->q, x->v, x->t, EVALUATE_FORCE, why));
    *least = mass * v * v + of_places * (strained(sim) + carried(sim, mass));
    return OK;
}

/* What start_at_rest() finds, found before. */
static void take_rest(struct sim *sim)
{
    memcpy(sim->x.q, sim->options.rest, sizeof *sim->x.q * (size_t)sim->stepper.ode->nq);
}

/* Consistent accelerations at the start; a massless freedom shows here. */
static enum status start(struct sim *sim, struct diags *diags, struct report *report)
{
    struct energies e;
    struct trouble why = {0};
    TRY(place(sim, report));
    TRY(idle_begin(sim, diags, report));
    if (sim->scene->at_rest && !sim->options.rest) TRY(start_at_rest(sim, report));
    if (sim->scene->at_rest && sim->options.rest) take_rest(sim);
    if (inertias_note(sim) != OK) return describe_trouble(sim, &sim->trouble, E_MODEL, report);
    double least;
    if (stepper_start(&sim->stepper, &sim->x, &why) != OK || least_energy(&least, sim, &why) != OK ||
        system_energy_at(sim->system, &e, sim->x.q, sim->x.v, sim->x.t, &why) != OK)
        return describe_trouble(sim, &why, E_MODEL, report);
    TRY(passes_begin(sim, diags));
    if (sim->stepper.touch) TRY(contacts_begin(sim, diags, report));
    ledger_open(&sim->ledger, sim->scene->delta, least, e.kinetic, e.elastic, e.gravity);
    sim->last_h = sim->plan.step;
    sim->min_h = sim->plan.step;
    return OK;
}

enum status sim_open(struct sim *sim, const struct scene *scene, const struct integrate *plan,
                     const struct sim_options *options, struct diags *diags, struct arena *life, struct report *report)
{
    struct model *m;
    *sim = (struct sim){.scene = scene, .plan = *plan, .options = *options};
    TRY(model_build(&m, scene, diags, life));
    sim->model = m;
    enum status steps = plan_steps(sim, diags, life, report);
    TRY(choose_columns(sim, diags, life, report));
    if (!(sim->needs & NEED_MOMENTUM) && effect_wish(&scene->effects, EFFECT_MOMENTUM) == WISH_AUTO)
        m->drift = DRIFT_ALONE;
    TRY(steps);
    TRY(state_take(sim, m, diags, life));
    events_open(sim, life);
    rotations_open(sim, life);
    deflections_open(sim, life);
    spins_open(sim, life);
    tilts_open(sim, life);
    passes_open(sim, life);
    inertias_open(sim, life);
    jumps_open(sim, life);
    sim->system = system_build(m, life);
    idle_open(sim, life);
    TRY(flatten_open(sim, diags, life));
    if (follows_turns(sim)) system_follow_turns(sim->system, life);
    TRY(state_turns(sim, diags));
    sim->x = new_state(m, life);
    warn_of_unread(sim, diags);
    warn_of_pulses(sim, diags);
    warn_of_loops(sim, diags);
    stepper_open(&sim->stepper, sim->stepper.kind, system_ode2(sim->system), sim->plan.options, life);
    advance_open(sim, life);
    if (sim->stepper.touch) sim->press = TAKE(life, double, sim->stepper.ode->contact->nrow);
    TRY(start(sim, diags, report));
    trust_open(sim, life);
    return memory_take(sim, life, report);
}

const char *sim_coordinate_name(const struct sim *sim, int i)
{
    return sim_place_name(sim, system_place(sim->system, i));
}

const char *sim_place_name(const struct sim *sim, int iv)
{
    const struct model *m = sim->model;
    for (int i = 0; i < m->ncoordinate; i++)
        if (m->coordinate[i].iv == iv) return m->coordinate[i].name;
    for (int i = 0; i < m->njoint; i++) /* a rate that pairs with no position: of a quaternion */
        for (int k = 0; k < m->joint[i].nv; k++)
            if (m->joint[i].iv[k] == iv) return m->joint[i].name;
    return "?";
}

bool sim_column_compared(const struct sim *sim, int i)
{
    return i >= sim->ncounted && sim->chosen.index[i] != 0 && !sim->catalogue.origin[sim->chosen.index[i]].kind->own;
}

int sim_column_rate(const struct sim *sim, int i)
{
    const struct origin *o = &sim->catalogue.origin[sim->chosen.index[i]];
    return o->kind->use == USE_POSITION ? sim->model->coordinate[o->index].fast : -1;
}

static enum status write_meta(const struct sim *sim, struct sink *sink, struct report *report)
{
    struct pair settings[24];
    char hash[20];
    struct run_meta meta = {
        .version = sim->options.version,
        .title = sim->scene->title,
        .deck = sim->scene->deck->name,
        .hash = hash,
        .settings = settings,
        .n = sim->chosen.n,
        .columns = sim->columns,
    };
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)sim->scene->deck->hash);
    meta.nsettings = sim_settings(sim, settings, 24);
    return sink_meta(sink, &meta, report);
}

/* Of a run that goes on it has been written: the sink hears of it all the same. */
static enum status write_head(const struct sim *sim, struct sink *sink, struct report *report)
{
    if (!sim->place.resumed) return write_meta(sim, sink, report);
    stream_mute(sim->saves.stream, true);
    const enum status status = write_meta(sim, sink, report);
    stream_mute(sim->saves.stream, false);
    return status;
}

static enum status write_row(struct sim *sim, struct sink *sink, struct report *report)
{
    if (!sink) return OK;
    enum status status = record_fill(sim);
    if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
    sim->rows++;
    trust_note(sim);
    return sink->ops->row(sink, sim->row, report);
}

static enum status write_end(struct sim *sim, struct sink *sink, struct report *report)
{
    struct pair facts[32];
    struct run_summary summary = {.facts = facts};
    if (!sink) return OK;
    summary.n = sim_facts(sim, facts, 32);
    return sink_end(sink, &summary, report);
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
    if (sim->x.t != from) sim->cut = over != 0 || sim->x.t != to;
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

/* Who sends a signal knows of it; a limit has to be reported. */
static enum status stopped(const struct sim *sim, struct report *report)
{
    const char *limit = stop_limit();
    if (!limit) return stop_status();
    return fail(report, stop_status(), "stopped at t = %.12g s: the limit of %s is reached", sim->x.t, limit);
}

/* A checkpoint, where one is due. */
static enum status save(struct sim *sim, long step, long due, double seen, struct report *report)
{
    sim->place = (struct run_place){sim->place.resumed, step, due, seen};
    return checkpoint_due(sim) ? checkpoint_write(sim, report) : OK;
}

/* Steps from record to record: the clock is read there and every so many steps, not at each. */
static enum status step_on(struct sim *sim, struct sink *sink, struct progress *progress, struct report *report)
{
    enum { CHECK_EVERY = 64 };
    for (long k = sim->place.step + 1; k <= sim->majors; k++) {
        const bool loops = sim->model->nloop > 0;
        const long charts = loops ? system_charts(sim->system) : 0;
        const double to = end_of(sim, k);
        if (sim->njump) TRY(jumps_check(sim, to, sink, report));
        enum status status = major(sim, k, to);
        if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
        if (sim->stepper.touch) TRY(contacts_events(sim, sink, report));
        if (loops && system_charts(sim->system) != charts) TRY(write_partition(sim, sink, report));
        if (sim->npass) TRY(passes_check(sim, sink, report));
        if (events_watched(sim)) TRY(check_events(sim, sink, report));
        bool due = (sim->before + k) % sim->every == 0 || k == sim->majors || sim->watch.met;
        if (look_is_due(sim, k, due)) TRY(check_energies(sim, report));
        if (sim->looks_always || due) TRY(guard_look(sim, sink, report));
        if (due) TRY(write_row(sim, sink, report));
        if (due || k % CHECK_EVERY == 0) {
            double now = clock_wall();
            progress_show(progress, now, sim->x.t, sim->plan.until);
            TRY(sink_tick(sink, now, report));
        }
        if (sim->saves.stream) TRY(save(sim, k, 0, 0, report));
        if (sim->watch.met) return OK;
        if (stop && (k < sim->majors || sim->x.t != to)) {
            if (!sim->looks_always) TRY(check_energies(sim, report));
            if (!due) TRY(write_row(sim, sink, report));
            return stopped(sim, report);
        }
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

/* A record at t inside the last step: the state by the scheme's interpolation, works and the balance as they would be
 * if they went on evenly. */
static enum status write_between(struct sim *sim, double t, double t0, const struct ledger *before, struct sink *sink,
                                 struct report *report)
{
    const struct state end = sim->x;
    const struct ledger after = sim->ledger;
    struct energies e;
    adaptive_between(&sim->stepper, sim->look->q, sim->look->v, t);
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

/* By the steps of a scheme that chooses them, across records or, where it cannot look back, from record to record; a drive
 * that may jump is looked at from record to record, too. */
static enum status step_naturally(struct sim *sim, struct sink *sink, struct progress *progress, struct report *report)
{
    enum { CHECK_EVERY = 64 };
    const double until = sim->plan.until;
    const bool on = sim->place.resumed;
    double seen = on ? sim->place.seen : sim->x.t;
    sim->cut = true;
    for (long k = on ? sim->place.due : next_due(sim, 0), i = sim->place.step + 1; sim->x.t < until; i++) {
        const long charts = system_charts(sim->system), due = k;
        const double t0 = sim->x.t;
        const struct ledger before = sim->ledger;
        if (sim->njump && seen <= t0) TRY(jumps_check(sim, seen = end_of(sim, k), sink, report));
        const enum status status = advance_naturally(sim, sim->njump          ? seen
                                                          : sim->onto_records ? end_of(sim, k)
                                                                              : until);
        if (status != OK) return describe_trouble(sim, &sim->trouble, status, report);
        if (system_charts(sim->system) != charts) TRY(write_partition(sim, sink, report));
        if (sim->npass) TRY(passes_check(sim, sink, report));
        if (events_watched(sim)) TRY(check_events(sim, sink, report));
        TRY(write_due(sim, &k, t0, &before, sink, report));
        TRY(guard_look(sim, sink, report));
        const bool last = sim->watch.met || (stop && sim->x.t < until);
        if (last && end_of(sim, k - 1) != sim->x.t) TRY(write_row(sim, sink, report));
        if (k != due) sim->rejected = sim->stepper.effort.rejected;
        if (k != due || i % CHECK_EVERY == 0) {
            const double now = clock_wall();
            progress_show(progress, now, sim->x.t, until);
            TRY(sink_tick(sink, now, report));
        }
        if (sim->saves.stream) TRY(save(sim, i, k, seen, report));
        if (sim->watch.met) return OK;
        if (last) return stopped(sim, report);
    }
    return OK;
}

static enum status verdict(const struct sim *sim, struct report *report)
{
    const struct ledger *l = &sim->ledger;
    if (spins_passed(sim))
        return fail(report, E_VERDICT,
                    "a body without geometric stiffening turned faster than it can: what it did beyond is wrong "
                    "[W-stiffening]");
    if (!ledger_broken(l)) return OK;
    if (ledger_judge(l).gained)
        return fail(
            report, E_VERDICT,
            "the scheme's own damping, which is to take energy, has put in %.3g J, %.3g of what there is, more "
            "than delta = %g: 'step' does not resolve a damper or a spring at the start, and %s swings over; try "
            "a smaller step, or midpoint [balance]",
            l->gained, ledger_share(l), l->delta, sim->stepper.kind->name);
    return fail(report, E_VERDICT,
                "the energy balance (2-26) is broken: |residual| %.3g J at t = %.6g s is %.3g of ||W|| = %.3g J, "
                "more than delta = %g; try %s [balance]",
                l->worst, l->t_worst, ledger_share(l), l->norm, l->delta,
                sim->stepper.kind->adaptive ? "a smaller tolerance" : "a smaller step, or ratio 1");
}

enum status sim_run(struct sim *sim, struct sink *sink, struct report *report)
{
    struct progress progress;
    double wall = clock_wall(), cpu = clock_cpu();
    progress_open(&progress, sim->options.progress == PROGRESS_ALWAYS ? sim->options.log : NULL, wall, sim->x.t);
    print_plan(sim);
    sim_print_assembly(sim, sim->options.log);
    TRY(write_head(sim, sink, report));
    enum status status = sim->place.resumed ? OK : write_row(sim, sink, report);
    if (status == OK && events_watched(sim) && !sim->place.resumed) status = check_events(sim, sink, report);
    if (status == OK) status = (sim->stepper.natural ? step_naturally : step_on)(sim, sink, &progress, report);
    if (status == OK) status = verdict(sim, report);
    sim->cpu = clock_cpu() - cpu;
    sim->trust.column = -1;
    if (sink && (status == OK || status == E_VERDICT) && !sim->options.counting) trust_find(sim);
    sim->status = status;
    progress_close(&progress);
    if (status != E_FILE && status != E_SIGPIPE) {
        enum status ended = write_end(sim, sink, report);
        if (ended != OK) status = sim->status = ended;
    }
    if (status != E_SIGPIPE) warn_at_end(sim);
    if (status != E_SIGPIPE) print_end(sim, clock_wall() - wall);
    return status;
}
