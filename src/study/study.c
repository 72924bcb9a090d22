/* study.c -- see study.h */
#include "study/study.h"

#include <math.h>
#include <string.h>

#include "multirate/schemes.h"

static const char *status_word(enum status status)
{
    return status == OK ? "ok" : status == E_VERDICT ? "unbalanced" : "stopped";
}

static enum status study_one(struct study *o, const struct integrate *plan, const struct scene *scene,
                             const struct study_options *options, struct diags *diags, struct report *report)
{
    const bool adaptive = stepper_find(plan->scheme)->adaptive;
    struct outcome run = {0};
    struct arena *life = arena_open();
    enum status status = OK;
    double cpu = INFINITY;
    for (int i = 0; status == OK && i < options->repeats; i++) {
        status = outcome_run(&run, scene, plan, options->version, diags, life, report);
        cpu = fmin(cpu, run.cpu);
    }
    if (status == OK) {
        struct study_row row = {.scheme = plan->scheme,
                                .tolerance = adaptive ? ((const struct step_options *)plan->options)->tolerance : NAN,
                                .step = adaptive ? NAN : plan->step,
                                .ratio = plan->ratio,
                                .work = run.work,
                                .cpu = cpu,
                                .effort = run.effort,
                                .energy = run.energy_share,
                                .status = run.status};
        reference_compare(&row.errors, &o->reference, &run);
        if (run.status == E_LIMIT)
            status = fail(report, run.status, "%s: %.900s", plan->scheme, run.report.text);
        else if (row.errors.instants < 1 && run.status != E_NUMERIC)
            status = fail(report, E_USAGE, "step %g s: its records and the reference's have no instant in common",
                          plan->step);
        const int c = row.errors.column;
        row.worst = c < 0 ? "" : o->reference.run.column[c].name;
        row.uncertain = c < 0 ? 0 : o->reference.uncertain[c];
        o->row = arena_more(o->life, o->row, o->nrow, &o->capacity, sizeof *o->row);
        o->row[o->nrow++] = row;
    }
    arena_close(life);
    return status;
}

/* A scheme with steps of its own writes its records as often as the reference does. */
static enum status study_tolerances(struct study *o, const char *scheme, double every, const struct scene *scene,
                                    const struct study_options *options, struct diags *diags, struct report *report)
{
    for (int i = 0; i < options->ntolerance; i++) {
        struct step_options how;
        const struct integrate plan = outcome_plan(&how, scheme, options->tolerance[i], scene, every);
        TRY(study_one(o, &plan, scene, options, diags, report));
    }
    return OK;
}

static enum status study_scheme(struct study *o, const char *scheme, double every, const struct scene *scene,
                                const struct study_options *options, struct diags *diags, struct report *report)
{
    const struct stepper_kind *kind = stepper_find(scheme);
    const int ratios = kind->two_rates ? options->nratio : 1;
    struct integrate plan = scene->integrate;
    if (options->usual && kind->full && !o->reference.small) return OK;
    plan.scheme = kind->name;
    if (kind->adaptive) return study_tolerances(o, kind->name, every, scene, options, diags, report);
    for (int r = 0; r < ratios; r++)
        for (int s = 0; s < options->nstep; s++) {
            plan.ratio = kind->two_rates ? options->ratio[r] : 1;
            plan.step = options->step[s];
            TRY(study_one(o, &plan, scene, options, diags, report));
        }
    return OK;
}

static void print_reference(const struct reference *o, FILE *to)
{
    fprintf(to, "reference: %s to 1e-11; %s to 1e-11 differs from it by %.2g (relative, worst coordinate)\n", o->scheme,
            o->second, o->apart);
    if (!o->whole) fprintf(to, "they part after t = %.6g s: errors are compared up to there\n", o->horizon);
    if (o->left_out)
        fprintf(to, "%d column%s of the deck %s known to neither within 1 %% of %s range, and %s not compared: %s%s\n",
                o->left_out, o->left_out > 1 ? "s" : "", o->left_out > 1 ? "are" : "is",
                o->left_out > 1 ? "their" : "its", o->left_out > 1 ? "are" : "is", o->left_out_name,
                o->left_out > 1 ? ", ..." : "");
}

enum status study_run(struct study *o, const struct scene *scene, const struct study_options *options,
                      struct diags *diags, struct arena *life, struct report *report)
{
    const struct integrate *plan = &scene->integrate;
    const double H = plan->step * plan->ratio * (scene->output.every_steps ? (double)scene->output.every_steps : 1);
    const double every = scene->output.every > 0 ? scene->output.every : H > 0 ? H : (plan->until - scene->start) / 100;
    *o = (struct study){.life = life};
    TRY(reference_make(&o->reference, scene, every, options->version, diags, life, report));
    if (options->log) print_reference(&o->reference, options->log);
    for (int i = 0; i < options->nscheme; i++)
        TRY(study_scheme(o, options->scheme[i], every, scene, options, diags, report));
    return OK;
}

struct table *study_table(const struct study *o, struct arena *life)
{
    static const struct table_column columns[] = {
        {"scheme", NULL, 0},
        {"tolerance", NULL, 2},
        {"step", "h [s]", 4},
        {"ratio", NULL, 4},
        {"error", NULL, 3},
        {"worst", "worst column", 0},
        {"error_fast", "fast error", 3},
        {"error_slow", "slow error", 3},
        {"work", NULL, 4},
        {"cpu", "CPU [s]", 3},
        {"cpu_ratio", "to first", 3},
        {"slow", "slow evals", 9},
        {"fast", "fast evals", 9},
        {"factors", "factors", 7},
        {"energy", "energy", 2},
        {"status", NULL, 0},
    };
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++) {
        const double before[] = {r->tolerance, r->step, r->ratio, r->errors.worst};
        const double after[] = {r->errors.fast,
                                r->errors.slow,
                                r->work,
                                r->cpu,
                                r->cpu / o->row[0].cpu,
                                (double)r->effort.slow,
                                (double)r->effort.fast,
                                (double)r->effort.factors,
                                r->energy};
        table_text(table, r->scheme);
        for (int i = 0; i < 4; i++) table_number(table, before[i]);
        table_text(table, r->worst);
        for (int i = 0; i < 9; i++) table_number(table, after[i]);
        table_text(table,
                   r->errors.worst > 0 && r->errors.worst < 10 * r->uncertain ? "reference" : status_word(r->status));
    }
    return table;
}

const struct study_row *study_pick(const struct study *o, double error)
{
    const struct study_row *best = NULL;
    for (const struct study_row *r = o->row; r < o->row + o->nrow; r++)
        if (r->status == OK && r->errors.worst <= error && (!best || r->work < best->work)) best = r;
    return best;
}
