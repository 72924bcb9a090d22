/* check.c -- fmdsub check: what a deck makes, without running it */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "cli/chosen.h"
#include "cli/cli.h"
#include "probe/modes.h"
#include "sim/sim.h"
#include "study/advice.h"
#include "study/auto.h"

static const double two_pi = 6.28318530717958647693;

const char *check_parent(const struct model *m, int body)
{
    const struct model_body *parent = &m->body[m->body[body].parent];
    return parent->at_node ? m->body[parent->parent].name : parent->name;
}

/* A flexible body's modes, and the places in use. */
static void print_elastic(FILE *to, const struct model *m, int body)
{
    const struct model_body *b = &m->body[body];
    int nodes = 1; /* the frame's */
    for (int i = body + 1; i < m->nbody; i++) nodes += m->body[i].at_node && m->body[i].parent == body;
    fprintf(to, "  %-16s flexible: %d elastic coordinates, %d node%s in use", "", b->nmode, nodes,
            nodes == 1 ? "" : "s");
    for (int k = 0; b->flex->hertz && k < b->nmode; k++)
        fprintf(to, "%s%.4g", k ? ", " : "; clamped at its inboard joint ", b->flex->hertz[k]);
    fprintf(to, "%s\n", b->flex->hertz ? " Hz" : "");
}

/* Of a beam: what its modes are, by runs, and how much they have of its bending by what the deck does. */
static void print_kept(FILE *to, const struct model *m, int body)
{
    const struct flex_body *f = m->body[body].flex;
    if (f->chosen) chosen_print(to, f->chosen);
    if (!f->statics || f->n == 0) return;
    fprintf(to, "  %-16s modes:", "");
    for (int a = 0, b; a < f->n; a = b) {
        for (b = a + 1; b < f->n && f->statics->kind[b] == f->statics->kind[a];) b++;
        fprintf(to, "%s %d", a ? "," : "", a + 1);
        if (b > a + 1) fprintf(to, "-%d", b);
        fprintf(to, " %s", flex_kind_name(f->statics->kind[a]));
    }
    fputc('\n', to);
    for (int i = 0; i < m->nkept; i++) {
        const struct model_kept *k = &m->kept[i];
        if (k->body != body) continue;
        fprintf(to, "  %-16s kept by %s: %.3g %% of the compliance", "", k->name, 100 * k->kept.share);
        if (k->kept.mass >= 0) fprintf(to, ", %.3g %% of the mass", 100 * k->kept.mass);
        fputc('\n', to);
    }
}

static void print_title(FILE *to, const struct sim *sim)
{
    const struct scene *scene = sim->scene;
    text_put(to, scene->deck->name);
    fputs(": ", to);
    text_put(to, scene->title);
    fprintf(to, "%s%s\n", *scene->title ? ", " : "", sim_space(sim));
}

static void print_bodies(FILE *to, const struct model *m, int count)
{
    fprintf(to, "bodies: %d\n", count);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_body *b = &m->body[i];
        const struct model_joint *j = &m->joint[b->joint];
        if (b->at_node) continue;
        fprintf(to, "  %-16s %8.4g kg, %s, on %s by %s (%s, %d freedom%s)\n", b->name, b->mass,
                b->fast ? "fast" : "slow", check_parent(m, i), j->name, model_kind(m, j->type)->name, j->nv,
                j->nv == 1 ? "" : "s");
        if (b->flex) print_elastic(to, m, i);
        if (b->flex) print_kept(to, m, i);
    }
}

static void print_coordinates(FILE *to, const struct sim *sim)
{
    const struct model *m = sim->model;
    fprintf(to, "freedoms: %d, of these fast: %d\n", sim->stepper.ode->n, sim->stepper.ode->ns);
    for (int i = 0; i < m->ncoordinate; i++)
        fprintf(to, "  %-24s %s  start %.6g\n", m->coordinate[i].name, m->coordinate[i].fast ? "fast" : "slow",
                sim->x.q[m->coordinate[i].iq]);
}

static enum status print_mass(FILE *to, struct sim *sim, struct report *report)
{
    double centre[3], mass;
    TRY(sim_mass(&mass, centre, sim, report));
    fprintf(to, "mass: %.6g kg, centre at (%.6g, %.6g", mass, centre[0], centre[1]);
    fprintf(to, sim->model->space == 3 ? ", %.6g) m\n" : ") m\n", centre[2]);
    return OK;
}

/* In lines of a terminal's width. */
static void print_independent(FILE *to, const struct sim *sim)
{
    enum { WIDTH = 96 };
    size_t used = (size_t)fprintf(to, "  independent:");
    for (int i = 0; i < sim->stepper.ode->n; i++) {
        const char *name = sim_coordinate_name(sim, i);
        if (used + strlen(name) + 1 > WIDTH) used = (size_t)fprintf(to, "\n              ") - 1;
        used += (size_t)fprintf(to, " %s", name);
    }
    fputc('\n', to);
}

static void print_closures(FILE *to, const struct sim *sim, struct arena *life)
{
    struct closures o;
    sim_closures(&o, sim, life);
    if (o.n == 0) return;
    fprintf(to, "loops: %d, in %d component(s); %d equations, rank %d\n", o.n, o.components, o.equations, o.rank);
    for (int i = 0; i < o.n; i++) {
        const struct closure *c = &o.closure[i];
        fprintf(to, "  %-16s %s, %s to %s, %d equation%s", c->name, c->kind, c->first, c->second, c->equations,
                c->equations == 1 ? "" : "s");
        if (c->redundant) fprintf(to, ", %d of them redundant", c->redundant);
        fprintf(to, "%s\n", c->unique ? "" : "; reactions not unique");
    }
    for (int i = 0; i < o.nloose; i++) fprintf(to, "  %-16s of the tree; reactions not unique\n", o.loose[i]);
    print_independent(to, sim);
    fprintf(to, "  largest gap in the loops: %.2g m as drawn, %.2g m closed\n", o.length * o.drawn,
            o.length * o.closed);
    sim_print_assembly(sim, to);
}

static void print_forces(FILE *to, const struct model *m)
{
    if (m->nforce) fprintf(to, "forces: %d\n", m->nforce);
    for (int i = 0; i < m->nforce; i++)
        fprintf(to, "  %-16s %s\n", m->force[i].name, m->force[i].cls == FAST ? "fast" : "slow");
}

double check_omega(const struct sim *sim, double omega)
{
    static const double MOVES = 1e-3; /* [rad] */
    return fabs(omega) * (sim->plan.until - sim->scene->start) < MOVES ? 0 : omega;
}

/* What oscillates, and what grows instead. */
static void print_range(FILE *to, const struct sim *sim, const struct modes *modes)
{
    static const double LITTLE = 1e-6; /* of the highest */
    const double top = check_omega(sim, modes->mode[modes->n - 1].omega);
    int growing = 0;
    while (growing < modes->n && check_omega(sim, modes->mode[growing].omega) < -LITTLE * fabs(top)) growing++;
    if (growing < modes->n && top > 0)
        fprintf(to, "natural frequencies at the start: %.4g to %.4g Hz",
                fmax(0, check_omega(sim, modes->mode[growing].omega)) / two_pi, top / two_pi);
    else
        fputs("no natural frequencies at the start", to);
    if (growing)
        fprintf(to, "; %d motion%s (%.3g 1/s)", growing, growing == 1 ? " grows" : "s grow", -modes->mode[0].omega);
    fputs(" (`fmdsub modes` shows all)\n", to);
}

static void print_quickest(FILE *to, const struct sim *sim, const char *what, int i, double omega)
{
    if (i >= 0 && check_omega(sim, omega) > 0)
        fprintf(to, "  quickest %s coordinate: %s, %.4g Hz\n", what, sim_coordinate_name(sim, i), omega / two_pi);
}

/* Steps by the linearisation at the start. */
static void print_suggestion(FILE *to, const struct sim *sim, const struct modes *modes)
{
    static const double slow = 1e-3; /* [rad] in a hundredth of the run */
    double h;
    int ratio;
    if (!(modes->fast_top > 0) && !(modes->slow_top > 0)) return;
    if (sim->stepper.kind->adaptive) {
        fprintf(to, "  scheme %s chooses its own steps\n", sim->stepper.kind->name);
        return;
    }
    if (fmax(modes->fast_top, modes->slow_top) * modes_longest_step(sim) < slow) {
        fputs("  too slow to choose a step by: `fmdsub study` tells what steps are worth in the motion itself\n", to);
        return;
    }
    modes_suggest(&h, &ratio, modes, sim);
    fprintf(to, "  to resolve them (omega h = 0.1): step %.3g, ratio %d; the deck has %.3g, %d\n", h, ratio,
            sim->plan.step, sim->plan.ratio);
}

/* Small motions about the start. */
static void print_frequencies(FILE *to, const struct sim *sim, bool suggest, struct arena *life)
{
    struct modes modes;
    struct report quiet = {0};
    if (modes_find(&modes, sim, life, &quiet) != OK || modes.n == 0) return;
    print_range(to, sim, &modes);
    print_quickest(to, sim, "fast", modes.fast_worst, modes.fast_top);
    print_quickest(to, sim, "slow", modes.slow_worst, modes.slow_top);
    if (suggest) print_suggestion(to, sim, &modes);
}

static void print_advised(FILE *to, const struct advised *a)
{
    fprintf(to, "%s at ", a->scheme);
    if (isfinite(a->step)) fprintf(to, "step %.12g", a->step);
    if (isfinite(a->tolerance)) fprintf(to, "tolerance %.0e", a->tolerance);
    if (a->ratio > 1) fprintf(to, ", ratio %d", a->ratio);
    fprintf(to, " (%.2g evaluations)", a->work);
}

/* All for the error of entry i, from there on; what is too dear last.  The entry behind them. */
static int print_for_error(FILE *to, const struct advice *o, int i)
{
    const double error = o->entry[i].error;
    int end = i;
    const char *before = "";
    fprintf(to, "  %.0e: ", error);
    for (; end < o->n && o->entry[end].error == error; end++) {
        if (o->entry[end].dear) continue;
        fputs(before, to), print_advised(to, &o->entry[end]);
        before = ", or ";
    }
    if (before[0]) before = "; ";
    for (int k = i; k < end; k++) {
        const struct advised *a = &o->entry[k];
        if (a->dear)
            fprintf(to, "%snone by %s, which would take %.2g evaluations", before, a->scheme, a->work), before = ", ";
    }
    fputc('\n', to);
    return end;
}

/* Why no step is among it. */
static void print_no_steps(FILE *to, const struct advice *o)
{
    fprintf(to, "  no fixed step: %s", o->no_steps);
    if (isfinite(o->corner)) fprintf(to, ", such as t = %.9g s; schemes with a tolerance step onto them", o->corner);
    fputc('\n', to);
}

/* What trial runs have told of steps and tolerances. */
static void print_advice(FILE *to, const struct sim *sim, const struct advice *o)
{
    if (o->why) {
        const bool study = !o->stop.text[0];
        fprintf(to, "steps: no advice, for %s%s", o->why, study ? "; `fmdsub study` looks longer" : "");
        if (o->stop.text[0]) fputs(":\n  ", to), text_put(to, o->stop.text);
        fputc('\n', to);
        return;
    }
    fprintf(to, "steps: by trial runs of %.2g evaluations", o->work);
    if (o->until < sim->plan.until) fprintf(to, " up to t = %.4g s%s", o->until, o->parted ? ", where they part" : "");
    fputs(", for an error in the columns, over their ranges, of\n", to);
    for (int i = 0; i < o->n;) i = print_for_error(to, o, i);
    if (o->n == 0) fputs("  none that a scheme here can promise\n", to);
    if (o->without) {
        fputs("  promised without ", to), text_put(to, o->without);
        if (o->nwithout > 1) fprintf(to, " and %d more", o->nwithout - 1);
        fputs(", in which trial runs differ by a third of the range and more\n", to);
    }
    if (o->only) fprintf(to, "  promised up to t = %.4g s only: %s\n", o->until, o->only);
    if (o->steps_until < o->until) fprintf(to, "  fixed steps were tried up to t = %.4g s\n", o->steps_until);
    if (o->no_steps) print_no_steps(to, o);
}

static void print_records(FILE *to, const struct sim *sim)
{
    fprintf(to, "records: %d columns of %d", sim->chosen.n, sim->catalogue.n);
    if (sim->stepper.kind->adaptive)
        fprintf(to, ", every %g s\n", sim->plan.step * (double)sim->every);
    else
        fprintf(to, ", every %ld major steps, %ld major steps in all\n", sim->every, sim->majors);
}

enum status verb_check(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim;
    const struct sim_options options = {.version = FMDSUB_VERSION, .drawn = true};
    if (request->format && (strcmp(request->format, "ndjson") == 0 || request->expanded))
        return fail(report, E_USAGE,
                    "'fmdsub check' prints words, or one object by --format json, or rows by --format csv, or a deck "
                    "by --expanded");
    enum status status = cli_load(&scene, &diags, request, life, report);
    if (status == OK && !request->expanded && !request->no_trial) status = auto_choose(scene, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    TRY(cli_told(diags, request, status));
    struct advice advice;
    const bool trial = !request->expanded && !request->no_trial;
    if (trial) TRY(advice_find(&advice, &sim, diags_open(life), report));
    if (request->expanded) {
        deck_print(stdout, scene->deck);
    } else if (request->format) {
        TRY(check_json(&sim, trial ? &advice : NULL, strcmp(request->format, "csv") == 0, life, report));
    } else {
        print_title(stdout, &sim);
        print_bodies(stdout, sim.model, scene->nbody - 1);
        TRY(print_mass(stdout, &sim, report));
        print_coordinates(stdout, &sim);
        print_closures(stdout, &sim, life);
        print_forces(stdout, sim.model);
        print_frequencies(stdout, &sim, !trial || !(advice.no_steps || advice_step(&advice, 1e-2)), life);
        if (trial) print_advice(stdout, &sim, &advice);
        if (sim.plan.because) printf("auto: %s\n", sim.plan.because);
        print_records(stdout, &sim);
    }
    if (request->strict && diags_warnings(diags))
        return fail(report, E_VERDICT, "--strict: %d warning(s) about the deck", diags_warnings(diags));
    return OK;
}
