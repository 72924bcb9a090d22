/* messages.c -- a run in words: the plan, the end, why it stopped; and the same as facts for the stream */
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/stop.h"
#include "base/text.h"
#include "sim/parts.h"

int sim_settings(const struct sim *sim, struct pair *facts, int most)
{
    const struct integrate *p = &sim->plan;
    const struct model *m = sim->model;
    const struct stepper_kind *kind = sim->stepper.kind;
    int n = 0;
    if (most < 17) return 0;
    facts[n++] = pair_text("scheme", kind->name);
    facts[n++] = pair_number("step", p->step);
    if (!kind->adaptive) facts[n++] = pair_number("ratio", p->ratio);
    if (sim->scene->start != 0) facts[n++] = pair_number("start", sim->scene->start);
    facts[n++] = pair_number("until", p->until);
    for (const struct key *k = kind->keys; k && k->name; k++)
        if (k->flags & KEY_META) facts[n++] = pair_number(k->name, key_value(k, p->options));
    facts[n++] = pair_number("space", m->space);
    facts[n++] = pair_number("bodies", sim->scene->nbody - 1);
    facts[n++] = pair_number("freedoms", sim->stepper.ode->n);
    facts[n++] = pair_number("fast", sim->stepper.ode->ns);
    facts[n++] = pair_number("delta", sim->scene->delta);
    return n;
}

static const char *status_word(const struct sim *sim)
{
    switch (sim->status) {
    case OK:
        return "done";
    case E_VERDICT:
        return ledger_broken(&sim->ledger) ? "energy balance broken" : "done, but wrong";
    case E_NUMERIC:
        return "stopped";
    case E_SIGHUP:
        return "hung up";
    case E_SIGINT:
        return "interrupted";
    case E_SIGTERM:
        return "terminated";
    case E_LIMIT:
        return stop == SIGXCPU                       ? "CPU time limit reached"
               : stop == SIGALRM                     ? "time limit reached"
               : sim->trouble.code == TROUBLE_MEMORY ? "memory limit reached"
                                                     : "limit reached";
    case E_USAGE:
    case E_DECK:
    case E_MODEL:
    case E_FILE:
    case E_SIGPIPE:
    case E_BUG:
        break;
    }
    return "failed";
}

int sim_facts(const struct sim *sim, struct pair *facts, int most)
{
    const struct effort *e = &sim->stepper.effort;
    const struct ledger *l = &sim->ledger;
    int n = 0;
    if (most < 20) return 0;
    facts[n++] = pair_text("status", status_word(sim));
    facts[n++] = pair_number("exit", sim->status);
    facts[n++] = pair_number("t_end", sim->x.t);
    if (sim->watch.slot) facts[n++] = pair_bool("condition_met", sim->watch.met);
    facts[n++] = pair_number("rows", (double)sim->rows);
    facts[n++] = pair_number("major_steps", (double)e->majors);
    facts[n++] = pair_number("minor_steps", (double)e->minors);
    facts[n++] = pair_number("slow_evaluations", (double)e->slow);
    facts[n++] = pair_number("fast_evaluations", (double)e->fast);
    facts[n++] = pair_number("factorizations", (double)e->factors);
    facts[n++] = pair_number("sweeps", (double)e->sweeps);
    facts[n++] = pair_number("rejected", (double)e->rejected);
    if (!sim->stepper.kind->adaptive) facts[n++] = pair_number("smallest_step", sim->min_h);
    facts[n++] = pair_number("energy_residual_worst", l->worst);
    facts[n++] = pair_number("energy_norm", l->norm);
    facts[n++] = pair_number("energy_share", ledger_share(l));
    facts[n++] = pair_number("energy_numerical", l->lost);
    facts[n++] = pair_number("newton_left", l->left);
    if (sim->model->nloop) {
        facts[n++] = pair_number("constraint_worst", system_constraint_worst(sim->system));
        facts[n++] = pair_number("partitions", (double)system_charts(sim->system));
    }
    facts[n++] = pair_bool("balanced", !ledger_broken(l));
    if (sim->nspin) facts[n++] = pair_bool("buckling_speed_passed", spins_passed(sim));
    return n;
}

/* One at the start, those that are due, one at the end. */
static long records(const struct sim *sim)
{
    const long end = sim->before + sim->majors;
    return 1 + end / sim->every - sim->before / sim->every + (end % sim->every != 0);
}

void print_plan(const struct sim *sim)
{
    FILE *to = sim->options.log;
    const struct integrate *p = &sim->plan;
    const struct step_options *o = p->options;
    const struct model *m = sim->model;
    const struct stepper_kind *kind = sim->stepper.kind;
    const double *g = m->gravity;
    if (!to) return;
    text_put(to, sim->scene->deck->name);
    fprintf(to, ": %s, %d bod%s, %d freedom%s (%d fast), %s, ", m->space == 2 ? "planar" : "spatial",
            sim->scene->nbody - 1, sim->scene->nbody == 2 ? "y" : "ies", sim->stepper.ode->n,
            sim->stepper.ode->n == 1 ? "" : "s", sim->stepper.ode->ns,
            g[0] == 0 && g[1] == 0 && g[2] == 0 ? "no gravity" : "gravity");
    if (kind->adaptive)
        fprintf(to, "%s to tolerance %g%s", kind->name, o->tolerance,
                sim->filled_in ? " (the deck has no 'step' and no 'tolerance')" : "");
    else if (p->ratio > 1 && kind->two_rates)
        fprintf(to, "%s h = %g s, H = %d h", kind->name, p->step, p->ratio);
    else
        fprintf(to, "%s h = %g s", kind->name, p->step);
    if (sim->scene->start != 0) fprintf(to, ", from t = %g s", sim->scene->start);
    fprintf(to, "%s to t = %g s%s, %ld records of %d columns\n", sim->scene->start != 0 ? "" : ",", p->until,
            sim->watch.slot ? " at the latest" : "", records(sim), sim->chosen.n);
    if (sim->forgets)
        fprintf(to, "from the state coordinates and rates alone (%s): not to the last bit one run\n", sim->forgets);
}

void print_condition(const struct sim *sim, FILE *to)
{
    char text[81];
    snprintf(text, sizeof text, "%s", sim->scene->when.node->text);
    fputc('\'', to);
    text_put(to, text);
    fputs("' ", to);
}

void sim_warn(struct sim *sim, const char *format, ...)
{
    FILE *to = sim->options.warnings ? sim->options.warnings : sim->options.log;
    char text[600];
    va_list args;
    sim->warnings++;
    if (!to) return;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    fputs("warning: ", to);
    text_put(to, text);
    fputc('\n', to);
}

void warn_at_end(struct sim *sim)
{
    warn_of_rotations(sim);
    warn_of_spins(sim);
    warn_of_tilts(sim);
    warn_of_deflections(sim);
}

/* "61.9 kJ" */
static void put_energy(FILE *to, double joule, int digits)
{
    static const char *const prefix[] = {"p", "n", "u", "m", "", "k", "M", "G", "T"};
    enum { PLAIN = 4, LAST = 8 };
    int i = PLAIN;
    for (; fabs(joule) >= 1000 && i < LAST; i++) joule /= 1000;
    for (; fabs(joule) < 1 && joule != 0 && i > 0; i--) joule *= 1000;
    fprintf(to, "%.*g %sJ", digits, joule, prefix[i]);
}

/* A balance that is kept tells of no instability; errors of any size may stand beside it. */
static void print_balance(const struct ledger *l, FILE *to)
{
    fprintf(to, "energy balance %s: off by ", ledger_broken(l) ? "broken" : "kept");
    put_energy(to, l->worst, 2);
    fputs(" of ", to);
    put_energy(to, l->norm, 3);
    fprintf(to, " (%.2g; limit %g); how far off the motion is, `fmdsub study` tells\n",
            l->norm > 0 ? ledger_share(l) : 0, l->delta);
}

void print_end(const struct sim *sim, double wall)
{
    FILE *to = sim->options.log;
    const struct effort *e = &sim->stepper.effort;
    const struct ledger *l = &sim->ledger;
    if (!to) return;
    if (sim->watch.slot && (sim->watch.met || sim->status == OK)) {
        print_condition(sim, to);
        fputs(sim->watch.met ? "turned true\n" : "has not turned true until the latest end\n", to);
    }
    fprintf(to, "%s at t = %.12g s: %ld major, %ld minor steps", status_word(sim), sim->x.t, e->majors, e->minors);
    if (e->rejected) fprintf(to, " (%ld rejected", e->rejected);
    if (e->rejected && !sim->stepper.kind->adaptive) fprintf(to, ", smallest h %.3g s", sim->min_h);
    if (e->rejected) fputc(')', to);
    fprintf(to, ", %ld slow and %ld fast evaluations, %ld factorizations; %.3g s\n", e->slow, e->fast, e->factors,
            wall);
    print_balance(l, to);
}

static const char *force_name(const struct sim *sim, int i)
{
    return i >= 0 && i < sim->model->nforce ? sim->model->force[i].name : "?";
}

static bool is_flexible(const struct sim *sim)
{
    for (int i = 1; i < sim->scene->nbody; i++)
        if (sim->scene->body[i].flex) return true;
    return false;
}

/* A flexible body whose own mass is round-off beside what it carries; NULL: none. */
static const struct model_body *lightest(const struct sim *sim)
{
    static const double lost = 1e-10; /* of the mass of all */
    const struct model *m = sim->model;
    const struct model_body *light = NULL;
    double all = 0;
    for (int i = 1; i < m->nbody; i++) {
        all += m->body[i].mass;
        if (m->body[i].flex && (!light || m->body[i].mass < light->mass)) light = &m->body[i];
    }
    return light && light->mass < lost * all ? light : NULL;
}

/* What to try, by the code and by what is already in use. */
static const char *advice(const struct sim *sim, const struct trouble *why)
{
    const struct step_options *o = sim->plan.options;
    switch (why->code) {
    case TROUBLE_LAW:
        if (why->kind == FORCE_BETWEEN)
            return "let it stand, unloaded, nearer to where it works, or turn about the axis of its own stiffness";
        if (isinf(why->value)) return "keep away from 0 what its expression divides by, as by max(gap, 1e-6)";
        return "look at the expressions and tables of its forces";
    case TROUBLE_DRIVE:
        return "look at its expression";
    case TROUBLE_NOT_FINITE:
        return sim->stepper.effort.majors || sim->stepper.effort.rejected
                   ? "try a smaller step, or look at the forces"
                   : "look for numbers of the deck that are too large, and at its forces";
    case TROUBLE_MASS:
        if (is_flexible(sim))
            return "give the bodies it moves mass and inertia; or a flexible body bends too far for its frame: cut it "
                   "into 'segments', take fewer modes, or 'stiffening: false'";
        return "give the bodies it moves mass and inertia";
    case TROUBLE_DEFLECTION:
        return bending_advice(sim->model->body[why->index].flex);
    case TROUBLE_CLOSURE:
        if (why->kind == CLOSURE_REDUNDANT)
            return "others hold the same freedom, and sizes that differ from theirs by e miss by the root of e near a "
                   "dead point: make the sizes agree exactly, or weaken or leave out one of these constraints";
        return "the mechanism comes to a dead point or locks here, see its posture in the last record; or the step is "
               "too large";
    case TROUBLE_SINGULAR:
        return "look for a body without mass or inertia";
    case TROUBLE_MEMORY:
        return "raise '--max-memory'; forces across joints and freedoms without mass are what asks for it";
    case TROUBLE_IDLE:
        return "give it inertia there if a force acts along that turn, else try a smaller step";
    case TROUBLE_REJECTED:
        return "look for a force that jumps";
    case TROUBLE_INERTIA:
        return "mend its inertia: 'inertia_check: false' takes it as it is";
    case TROUBLE_NONE:
    case TROUBLE_DIVERGED:
    case TROUBLE_TOO_SMALL:
        break;
    }
    if (o->iteration == ITERATION_FIXED_POINT) return "try 'iteration: newton'";
    return sim->plan.ratio > 1 ? "try a smaller ratio or step" : "try a smaller step";
}

/* For `fmdsub explain`. */
static const char *stop_code(enum trouble_code code)
{
    switch (code) {
    case TROUBLE_MEMORY:
        return " [memory]";
    case TROUBLE_LAW:
    case TROUBLE_DRIVE:
    case TROUBLE_NOT_FINITE:
        return " [not-finite]";
    case TROUBLE_MASS:
        return " [no-mass]";
    case TROUBLE_INERTIA:
        return " [W-inertia]";
    case TROUBLE_SINGULAR:
        return " [singular]";
    case TROUBLE_CLOSURE:
        return " [dead-point]";
    case TROUBLE_DEFLECTION:
        return " [bending]";
    case TROUBLE_IDLE:
        return " [W-idle]";
    case TROUBLE_NONE:
    case TROUBLE_DIVERGED:
    case TROUBLE_TOO_SMALL:
    case TROUBLE_REJECTED:
        break;
    }
    return " [no-convergence]";
}

/* What iterations and steps come to grief at: a force of the deck that jumps near here; false: there is none. */
static bool jumps_here(char *text, size_t size, const struct sim *sim, const struct trouble *why)
{
    double before, behind;
    const double H = sim->plan.step * sim->plan.ratio;
    if (why->code != TROUBLE_NONE && why->code != TROUBLE_DIVERGED && why->code != TROUBLE_TOO_SMALL &&
        why->code != TROUBLE_REJECTED)
        return false;
    const int force = system_leap(sim->system, &before, &behind, sim->x.q, sim->x.v, sim->x.t, H);
    if (force < 0) return false;
    snprintf(
        text, size,
        "force '%.60s' jumps near here, between %.4g and %.4g: let it go from one to the other, as tanh(x/0.01) in "
        "place of sign(x)",
        sim->model->force[force].name, before, behind);
    return true;
}

enum status describe_trouble(const struct sim *sim, const struct trouble *why, enum status status,
                             struct report *report)
{
    char what[200], jump[240];
    const struct model_body *light = lightest(sim);
    if (why->code == TROUBLE_MEMORY) status = E_LIMIT;
    if (status != E_NUMERIC && status != E_MODEL && why->code != TROUBLE_MEMORY && why->code != TROUBLE_REJECTED)
        return status;
    const char *coordinate =
        why->index >= 0 && why->index < sim->stepper.ode->n ? sim_coordinate_name(sim, why->index) : "?";
    switch (why->code) {
    case TROUBLE_MEMORY:
        snprintf(what, sizeof what, "a matrix of all freedoms would take %.3g MB, more than is left", why->value / 1e6);
        break;
    case TROUBLE_NOT_FINITE:
        if (*coordinate == '?')
            snprintf(what, sizeof what, "the state has a part that is not a number");
        else
            snprintf(what, sizeof what, "the residual of '%s' is not a number", coordinate);
        break;
    case TROUBLE_LAW:
        if (why->kind == FORCE_BETWEEN)
            snprintf(what, sizeof what, "bushing '%s' has tilted by half a turn, where its law ends",
                     force_name(sim, why->index));
        else
            snprintf(what, sizeof what,
                     isinf(why->value) ? "force '%s' grows without bound" : "force '%s' is not a number",
                     force_name(sim, why->index));
        break;
    case TROUBLE_MASS:
        snprintf(what, sizeof what, "coordinate '%s' moves no mass: the mass matrix is singular", coordinate);
        if (light)
            return fail(
                report, status,
                "%s at t = %.12g s: %s; beside the masses that it carries the %.3g kg of flexible body '%s' "
                "are lost in round-off: take fewer modes than its %d, or a density nearer to a real one [no-mass]",
                status == E_MODEL ? "no start" : "stopped", sim->x.t, what, light->mass, light->name, light->nmode);
        break;
    case TROUBLE_SINGULAR:
        snprintf(what, sizeof what, "the iteration matrix is singular at '%s' (pivot ratio %.2g)", coordinate,
                 why->value);
        break;
    case TROUBLE_DRIVE:
        snprintf(what, sizeof what, "drive '%s' or a rate of it is not a number", sim->model->loop[why->index].name);
        break;
    case TROUBLE_CLOSURE:
        snprintf(what, sizeof what, "%s '%s' cannot be kept", sim_loop_kind(sim, why->index),
                 sim->model->loop[why->index].name);
        if (isfinite(why->value))
            snprintf(what + strlen(what), sizeof what - strlen(what), ": it misses by %.3g of the mechanism's size",
                     why->value);
        break;
    case TROUBLE_DEFLECTION:
        snprintf(what, sizeof what, "the end of '%s' is displaced by more than its length",
                 sim->model->body[why->index].name);
        break;
    case TROUBLE_INERTIA:
        snprintf(what, sizeof what,
                 "the mass matrix is not positive: the inertia of body '%.60s' is negative about an axis",
                 sim->model->body[why->index].name);
        break;
    case TROUBLE_IDLE:
        idle_describe(what, sizeof what, sim, why->index);
        break;
    case TROUBLE_TOO_SMALL:
        snprintf(what, sizeof what, "the step fell to %.3g s", why->value);
        break;
    case TROUBLE_REJECTED:
        snprintf(what, sizeof what, "%.0f steps were rejected, which is the limit", why->value);
        break;
    case TROUBLE_NONE:
    case TROUBLE_DIVERGED:
        snprintf(what, sizeof what,
                 "no convergence, worst at '%s' (%.3g of the tolerance), with steps from %.3g s down "
                 "to a 1024th",
                 coordinate, why->value, sim->plan.step);
    }
    return fail(report, status, "%s at t = %.12g s: %s; %s%s", status == E_MODEL ? "no start" : "stopped", sim->x.t,
                what, jumps_here(jump, sizeof jump, sim, why) ? jump : advice(sim, why), stop_code(why->code));
}
