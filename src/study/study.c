/* study.c -- see study.h */
#include "study/study.h"
#include "multirate/schemes.h"

#include <math.h>
#include <string.h>

#include "base/stop.h"

/* ---- records kept in memory ---- */

struct memory {
    int n, rows, capacity;
    double *x; /* [rows x n] by row */
    struct arena *life;
};

static enum status keep_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct memory *m = sink->self;
    (void)report;
    m->n = meta->n;
    m->rows = 0;
    return OK;
}

static enum status keep_row(struct sink *sink, const double *x, struct report *report)
{
    struct memory *m = sink->self;
    (void)report;
    m->x = arena_more(m->life, m->x, m->rows, &m->capacity, (size_t)m->n * sizeof *m->x);
    memcpy(m->x + (size_t)m->rows++ * (size_t)m->n, x, (size_t)m->n * sizeof *x);
    return OK;
}

static enum status keep_event(struct sink *sink, double t, const char *kind, const char *text, struct report *report)
{
    (void)sink, (void)t, (void)kind, (void)text, (void)report;
    return OK;
}

static enum status keep_end(struct sink *sink, const struct run_summary *summary, struct report *report)
{
    (void)sink, (void)summary, (void)report;
    return OK;
}

static enum status keep_tick(struct sink *sink, double now, struct report *report)
{
    (void)sink, (void)now, (void)report;
    return OK;
}

static const struct sink_ops memory_ops = {keep_meta, keep_row, keep_event, keep_end, keep_tick};

/* ---- one run ---- */

struct outcome {
    struct memory memory;
    struct effort effort;
    double cpu, energy_share;
    int n;           /* columns */
    const int *rate; /* [n] of the columns: see sim_column_rate() */
    enum status status;
    struct report report;
};

static void note_outcome(struct outcome *o, const struct sim *sim, struct arena *life)
{
    int *rate = TAKE(life, int, sim->chosen.n);
    for (int i = 0; i < sim->chosen.n; i++) rate[i] = sim_column_rate(sim, i);
    o->rate = rate;
    o->n = sim->chosen.n;
    o->effort = sim->stepper.effort;
    o->energy_share = ledger_share(&sim->ledger);
    o->cpu = sim->cpu;
}

/* A deck error (a scheme that does not exist, a step that does not fit the records) is passed on; a run that stops is
 * an outcome. */
static enum status try_run(struct outcome *o, const struct scene *scene, const struct integrate *plan,
                           const struct study_options *options, struct diags *diags, struct arena *life,
                           struct report *report)
{
    const struct sim_options quiet = {.version = options->version, .counting = true};
    struct sim sim;
    *o = (struct outcome){.memory = {.life = life}};
    TRY(sim_open(&sim, scene, plan, &quiet, diags, life, report));
    struct sink sink = {&memory_ops, &o->memory};
    o->status = sim_run(&sim, &sink, &o->report);
    note_outcome(o, &sim, life);
    return stop_limit() ? fail(report, stop_status(), "the limit of %s is reached", stop_limit()) : stop_status();
}

/* ---- errors ---- */

struct errors {
    double fast, slow;
};

static double largest(const struct memory *m, int column)
{
    double most = 0;
    for (int r = 0; r < m->rows; r++) most = fmax(most, fabs(m->x[(size_t)r * (size_t)m->n + (size_t)column]));
    return most;
}

static double worst(const struct memory *a, const struct memory *b, int column)
{
    double most = 0;
    for (int r = 0; r < b->rows; r++) {
        size_t at = (size_t)r * (size_t)b->n + (size_t)column;
        double d = r < a->rows ? fabs(a->x[at] - b->x[at]) : INFINITY;
        if (!(d <= most)) most = d; /* NaN too */
    }
    return most;
}

static struct errors compare(const struct outcome *run, const struct outcome *reference)
{
    struct errors e = {NAN, NAN};
    for (int c = 0; c < reference->n; c++) {
        if (reference->rate[c] < 0) continue;
        double size = largest(&reference->memory, c);
        double error = size > 0 ? worst(&run->memory, &reference->memory, c) / size : 0;
        double *to = reference->rate[c] ? &e.fast : &e.slow;
        *to = isnan(*to) ? error : fmax(*to, error);
    }
    return e;
}

/* ---- the study ---- */

static enum status make_reference(struct outcome *o, double *apart, const struct scene *scene,
                                  const struct study_options *options, struct diags *diags, struct arena *life,
                                  struct report *report)
{
    struct integrate plan = scene->integrate;
    struct step_options how = *(const struct step_options *)plan.options;
    struct outcome second;
    double least = plan.step > 0 ? plan.step : plan.until;
    for (int i = 0; i < options->nstep; i++) least = fmin(least, options->step[i]);
    double H = scene->output.every > 0 ? scene->output.every : plan.step * plan.ratio;
    plan.scheme = "dopri5";
    plan.options = &how;
    how.tolerance = 1e-12;
    plan.ratio = 1;
    plan.step = H;
    TRY(try_run(o, scene, &plan, options, diags, life, report));
    if (o->status != OK && o->status != E_VERDICT)
        return fail(report, o->status, "no reference: %.900s", o->report.text);
    plan.scheme = "rk4";
    plan.step = H / ceil(8 * H / least - 1e-9);
    TRY(try_run(&second, scene, &plan, options, diags, life, report));
    struct errors e = compare(&second, o);
    *apart = fmax(isnan(e.fast) ? 0 : e.fast, isnan(e.slow) ? 0 : e.slow);
    return OK;
}

static const char *status_word(enum status status)
{
    return status == OK ? "ok" : status == E_VERDICT ? "unbalanced" : "stopped";
}

static enum status study_one(struct table *table, const struct integrate *plan, const struct scene *scene,
                             const struct outcome *reference, double *first_cpu, const struct study_options *options,
                             struct diags *diags, struct report *report)
{
    struct outcome o = {0};
    double cpu = INFINITY;
    struct arena *life = arena_open();
    enum status status = OK;
    for (int i = 0; status == OK && i < options->repeats; i++) {
        status = try_run(&o, scene, plan, options, diags, life, report);
        cpu = fmin(cpu, o.cpu);
    }
    if (status == OK) {
        struct errors e = compare(&o, reference);
        if (isnan(*first_cpu)) *first_cpu = cpu;
        table_text(table, plan->scheme);
        table_number(table, plan->ratio);
        table_number(table, plan->step);
        table_number(table, e.fast);
        table_number(table, e.slow);
        table_number(table, cpu);
        table_number(table, cpu / *first_cpu);
        table_number(table, (double)o.effort.slow);
        table_number(table, (double)o.effort.fast);
        table_number(table, (double)o.effort.factors);
        table_number(table, o.energy_share);
        table_text(table, status_word(o.status));
    }
    arena_close(life);
    return status;
}

static enum status study_scheme(struct table *table, const char *scheme, const struct scene *scene,
                                const struct outcome *reference, double *first_cpu, const struct study_options *options,
                                struct diags *diags, struct report *report)
{
    const struct stepper_kind *kind = stepper_find(scheme);
    int ratios = kind && kind->two_rates ? options->nratio : 1;
    for (int r = 0; r < ratios; r++) {
        for (int s = 0; s < options->nstep; s++) {
            struct integrate plan = scene->integrate;
            struct step_options how = *(const struct step_options *)plan.options;
            plan.scheme = scheme;
            plan.options = &how;
            plan.ratio = kind && kind->two_rates ? options->ratio[r] : 1;
            plan.step = options->step[s];
            if (!(how.tolerance > 0)) how.tolerance = 1e-6;
            TRY(study_one(table, &plan, scene, reference, first_cpu, options, diags, report));
            if (kind && kind->adaptive) break; /* its steps are its own */
        }
    }
    return OK;
}

enum status study_run(struct table **out, const struct scene *scene, const struct study_options *options,
                      struct diags *diags, struct arena *life, struct report *report)
{
    static const struct table_column columns[] = {
        {"scheme", NULL, 0},
        {"ratio", NULL, 4},
        {"step", "h [s]", 4},
        {"error_fast", "fast error", 3},
        {"error_slow", "slow error", 3},
        {"cpu", "CPU [s]", 3},
        {"cpu_ratio", "to first", 3},
        {"slow", "slow evals", 9},
        {"fast", "fast evals", 9},
        {"factors", "factors", 7},
        {"energy", "energy", 2},
        {"status", NULL, 0},
    };
    struct outcome reference;
    double apart = NAN, first_cpu = NAN;
    TRY(make_reference(&reference, &apart, scene, options, diags, life, report));
    if (options->log)
        fprintf(options->log, "reference: dopri5 to 1e-12; rk4 differs from it by %.2g (relative, worst coordinate)\n",
                apart);
    *out = table_open(columns, sizeof columns / sizeof *columns, life);
    for (int i = 0; i < options->nscheme; i++)
        TRY(study_scheme(*out, options->scheme[i], scene, &reference, &first_cpu, options, diags, report));
    return OK;
}
