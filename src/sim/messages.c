/* messages.c -- a run in words: the plan, the end; and the same as facts for the stream */
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "base/stop.h"
#include "base/text.h"
#include "engine/relay.h"
#include "engine/touch.h"
#include "sim/parts.h"

int sim_settings(const struct sim *sim, struct pair *facts, int most)
{
    const struct integrate *p = &sim->plan;
    const struct model *m = sim->model;
    const struct stepper_kind *kind = sim->stepper.kind;
    int n = 0;
    if (most < 18) return 0;
    facts[n++] = pair_text("scheme", kind->name);
    if (p->because) facts[n++] = pair_text("auto", p->because);
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
    if (most < MOST_SIM_FACTS) return 0;
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
        n += nearest_facts(sim, facts + n);
    }
    facts[n++] = pair_bool("balanced", !ledger_broken(l));
    if (guard_acts(sim)) {
        facts[n++] = pair_number("guard_steps", (double)sim->guard.parted);
        facts[n++] = pair_number("guard_parts", ldexp(1, sim->guard.most));
        facts[n++] = pair_bool("guard_damps", sim->stepper.damps);
    }
    n += trust_facts(sim, facts + n);
    n += neglects_facts(sim, facts + n);
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
    fprintf(to, ": %s, %d bod%s, %d freedom%s (%d fast), %s, ", sim_space(sim), sim->scene->nbody - 1,
            sim->scene->nbody == 2 ? "y" : "ies", sim->stepper.ode->n, sim->stepper.ode->n == 1 ? "" : "s",
            sim->stepper.ode->ns, g[0] == 0 && g[1] == 0 && g[2] == 0 ? "no gravity" : "gravity");
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
    if (p->because) fprintf(to, "auto: %s\n", p->because);
    if (sim->forgets)
        fprintf(to, "from the state coordinates and rates alone (%s): not to the last bit one run\n", sim->forgets);
}

/* Whose steps they were. */
static void print_auto(const struct sim *sim, FILE *to)
{
    const bool relay = sim->stepper.kind == &step_relay;
    const char *before = "auto: ";
    if (!relay) fprintf(to, "%s%s", before, sim->stepper.kind->name);
    for (int i = 0; relay && i < RUNNERS; i++) {
        const char *name = relay_name(&sim->stepper.options, i);
        const long steps = relay_steps(&sim->stepper, i);
        if (!name) continue;
        fprintf(to, "%s%ld step%s by %s", before, steps, steps == 1 ? "" : "s", name);
        before = ", ";
    }
    fprintf(to, ", foretold %.2g evaluations\n", sim->plan.foretold);
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
    warn_of_misfits(sim);
    warn_of_deflections(sim);
    warn_of_unresolved(sim);
    warn_of_trust(sim);
    warn_of_neglects(sim);
    warn_of_lateral(sim);
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
    const struct ledger_verdict v = ledger_judge(l);
    fprintf(to, "energy balance %s: %s ", ledger_broken(l) ? "broken" : "kept",
            v.gained ? "the scheme put in" : "off by");
    put_energy(to, v.wrong, 2);
    fputs(" of ", to);
    put_energy(to, v.of, 3);
    fprintf(to, " (%.2g; limit %g)\n", ledger_share(l), l->delta);
}

/* What the guard has done. */
static void print_guard(const struct sim *sim, FILE *to)
{
    if (!sim->guard.acted && !sim->stepper.damps) return;
    fprintf(to, "guard: %ld major steps in parts, at most %.0f", sim->guard.parted, ldexp(1, sim->guard.most));
    if (sim->stepper.damps)
        fprintf(to, "; rho_infinity %g from t = %.6g s", sim->stepper.damped->options.rho_infinity,
                sim->guard.t_damped);
    fputc('\n', to);
}

/* What sub-cycling has not saved. */
static void print_plain(const struct sim *sim, FILE *to)
{
    const struct effort *e = &sim->stepper.effort;
    if (sim->stepper.plainly == 0 || e->minors == e->majors) return;
    fprintf(to, "near contacts all coordinates took the minor step: in %ld of the %ld major steps\n",
            sim->stepper.plainly, e->majors);
}

static void print_lowered(const struct sim *sim, FILE *to)
{
    const struct touch *touch = sim->stepper.touch;
    if (!touch || touch_lowered(touch) == 0) return;
    fprintf(to, "restitution lowered in %ld of the %ld impacts: with friction the whole would have gained energy\n",
            touch_lowered(touch), touch_impacts(touch));
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
    if (isfinite(sim->plan.foretold)) print_auto(sim, to);
    print_plain(sim, to);
    print_lowered(sim, to);
    print_nearest(sim, to);
    print_guard(sim, to);
    print_balance(l, to);
    print_trust(sim, to);
    print_neglects(sim, to);
}

const char *place_of(char *text, size_t size, const struct sim *sim, const struct node *node)
{
    const struct source *s = diags_source(sim->scene->deck->diags, node->file);
    snprintf(text, size, "%.200s:%d:%d", s ? s->path : "", node->mark.line, node->mark.col);
    return text;
}
