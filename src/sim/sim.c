/* sim.c -- opens a run and takes it to its end; see sim.h */
#include "sim/sim.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/stop.h"
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
    if (stop && stop_limit())
        return fail(report, status, "no start: the limit of %s is reached on the way to rest", stop_limit());
    if (stop) return status;
    if (why.code == TROUBLE_DEFLECTION)
        return fail(
            report, E_MODEL,
            "no start: no static equilibrium was found: on the way '%s' bends by %g times its length; look at its "
            "loads, or at how fast it is turned [no-equilibrium]",
            sim->model->body[why.index].name, why.value);
    if (why.code == TROUBLE_DIVERGED && why.kind == REST_FALLS)
        return fail(report, E_MODEL,
                    "no start: the static equilibrium near the initial position is unstable: '%s' falls away; start "
                    "beside it, on the side to which it is to fall [no-equilibrium]",
                    sim_coordinate_name(sim, why.index));
    if (why.code == TROUBLE_DIVERGED && why.kind == REST_GOES_ON && why.value != 0)
        return fail(
            report, E_MODEL,
            "no start: no stable static equilibrium was found near the initial position; the search has moved '%s' by "
            "%.3g m or rad: look for what should hold it, or for a load that is more than that bears [no-equilibrium]",
            sim_coordinate_name(sim, why.index), why.value);
    return fail(
        report, E_MODEL,
        "no start: no stable static equilibrium was found near the initial position; look for a part that nothing "
        "holds [no-equilibrium]");
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
    const double *rest = sim->options.rest;
    if (!sim->whole) memcpy(sim->x.q, rest, sizeof *sim->x.q * (size_t)sim->stepper.ode->nq);
    for (int i = 0; sim->whole && i < sim->whole->n; i++)
        if (sim->from_whole[i] >= 0) sim->x.q[sim->from_whole[i]] = rest[i];
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
    if (sim->stepper.touch) TRY(contacts_begin(sim, report));
    ledger_open(&sim->ledger, sim->scene->delta, least, e.kinetic, e.elastic, e.gravity);
    if (sim->stepper.kind->adaptive) ledger_tolerate(&sim->ledger, sim->stepper.options.tolerance);
    sim->last_h = sim->plan.step;
    sim->min_h = sim->plan.step;
    return OK;
}

enum status sim_open(struct sim *sim, const struct scene *scene, const struct integrate *plan,
                     const struct sim_options *options, struct diags *diags, struct arena *life, struct report *report)
{
    struct model *m;
    *sim = (struct sim){.scene = scene, .plan = *plan, .options = *options};
    TRY(model_build(&m, scene, NULL, diags, life));
    TRY(leave_still(&m, sim, life));
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
    corners_open(sim, life);
    pulses_stop_at(sim, m, life);
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
    guard_open(sim);
    advance_open(sim, life);
    trust_follow(sim, life);
    if (sim->stepper.touch) sim->press = TAKE(life, double, sim->stepper.ode->contact->nrow);
    TRY(start(sim, diags, report));
    trust_open(sim, life);
    if (sim->whole || m->off) sim->beside = arena_within(life);
    neglects_open(sim, sim->beside);
    lateral_open(sim, sim->beside);
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
    return o->kind->use == USE_POSITION && o->index >= 0 ? sim->model->coordinate[o->index].fast : -1;
}

double sim_column_usual(const struct sim *sim, int i)
{
    const char *unit = sim->columns[i].unit;
    if (sim_column_rate(sim, i) < 0 || !unit) return 0;
    return strcmp(unit, "m") == 0 ? system_length(sim->system) : strcmp(unit, "rad") == 0 ? 1 : 0;
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

static enum status write_end(struct sim *sim, struct sink *sink, struct report *report)
{
    struct pair facts[MOST_SIM_FACTS];
    struct run_summary summary = {.facts = facts};
    if (!sink) return OK;
    summary.n = sim_facts(sim, facts, MOST_SIM_FACTS);
    return sink_end(sink, &summary, report);
}

static enum status verdict(const struct sim *sim, struct report *report)
{
    const struct ledger *l = &sim->ledger;
    if (spins_passed(sim))
        return fail(report, E_VERDICT,
                    "a body without geometric stiffening turned faster than it can: what it did beyond is wrong "
                    "[W-stiffening]");
    if (!ledger_broken(l) && sim->guard.broken)
        return fail(
            report, E_VERDICT,
            "motion that the step does not resolve was excited from t = %.6g s on, and the energy balance did not "
            "hold there: try a smaller step, or rho_infinity below 1 [balance]",
            sim->guard.t);
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
    sim_print_neutral(sim, sim->options.log);
    TRY(write_head(sim, sink, report));
    enum status status = steps_take(sim, sink, &progress, report);
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
