/* study.c -- fmdsub study: schemes, ratios, steps and tolerances on one deck, as a table or as CSV, and what they say */
#include "study/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/choices.h"
#include "cli/cli.h"
#include "cli/gnuplot.h"
#include "cli/study_page.h"
#include "out/columns.h"
#include "out/stream.h"
#include "out/targets.h"
#include "study/picture.h"
#include "study/rows.h"

static enum status choose_budget(struct study_options *o, const struct request *request, struct report *report)
{
    char *end;
    o->budget = 60;
    if (!request->budget) return OK;
    if (strcmp(request->budget, "none") == 0) {
        o->budget = INFINITY;
        return OK;
    }
    o->budget = strtod(request->budget, &end);
    if (*end || !(o->budget > 0) || !isfinite(o->budget))
        return fail(report, E_USAGE, "--budget takes seconds, or none, not '%.40s'", request->budget);
    return OK;
}

static enum status choose_numbers(struct study_options *o, struct choices *c, const struct request *request,
                                  struct arena *life, struct report *report)
{
    double x[MOST_CHOICES];
    int one = 0;
    TRY(choices_read(c, request, life, report));
    o->nscheme = c->nscheme;
    o->nratio = c->nratio;
    o->nstep = c->nstep;
    o->ntolerance = c->ntolerance;
    o->repeats = -1;
    if (!request->repeats) return OK;
    if (strcmp(request->repeats, "0") == 0) {
        o->repeats = 0;
        return OK;
    }
    TRY(choices_numbers(x, &one, "repeats", request->repeats, true, life, report));
    if (one != 1) return fail(report, E_USAGE, "--repeats takes one number");
    o->repeats = (int)x[0];
    return OK;
}

static enum status choose_pick(double *pick, const struct request *request, struct arena *life, struct report *report)
{
    double x[MOST_CHOICES];
    int one = 0;
    TRY(choices_numbers(x, &one, "pick", request->pick, false, life, report));
    if (one != 1) return fail(report, E_USAGE, "--pick takes one error, not '%.200s'", request->pick);
    *pick = x[0];
    return OK;
}

/* What was measured in a small part of the run is no choice for all of it; in a larger one that is told, even if the rest
 * is not to be. */
static enum status print_pick(const struct study *study, double pick, struct report *report)
{
    static const double LEAST = .1;
    const struct study_row *row = study_pick(study, pick);
    const struct subject *s = &study->subject;
    const double whole = s->scene ? s->scene->integrate.until : s->until, share = study_share(study);
    const char *why = study->reference.cut ? "the budget allows no more: raise --budget" : "two references part there";
    if (share < LEAST)
        return fail(report, E_NUMERIC, "nothing is picked: errors are known up to t = %.4g s only, of %.4g s (%s)",
                    s->until, whole, why);
    if (!row) return fail(report, E_VERDICT, "no run of the study has an error below %g", pick);
    study_print_pick(study, row, stdout);
    if (share < 1)
        fprintf(stderr, "fmdsub: picked by errors up to t = %.4g s only, of %.4g s (%s)\n", s->until, whole, why);
    return OK;
}

/* A table in which every run stopped, or none began, answers nothing. */
static enum status any_whole(const struct study *study, struct report *report)
{
    for (const struct study_row *r = study->row; r < study->row + study->nrow; r++)
        if (r->status == OK || r->status == E_VERDICT) return OK;
    if (study->nrow == 0)
        return fail(report, E_LIMIT,
                    "no setting was run: each takes more work than the reference or the budget allows");
    return fail(report, E_NUMERIC, "no setting ran to its end: smaller steps, or other schemes");
}

/* The wanted setting alone, or what the rows say. */
static enum status print_study(const struct study *study, double pick, const struct request *request,
                               struct report *report)
{
    if (request->pick) return print_pick(study, pick, report);
    if (!request->quiet) study_answer(study, stderr);
    return any_whole(study, report);
}

static enum status no_row(void *self, const struct study_row *row, struct report *report)
{
    (void)self, (void)row, (void)report;
    return OK;
}

/* The picture, or with --script what would draw it. */
static enum status draw(const struct study *study, const struct scene *scene, struct gnuplot *gnuplot,
                        const struct request *request, struct arena *life, struct report *report)
{
    struct gnuplot_script script;
    gnuplot_begin(&script, request->plot, request->script, PICTURE_WIDTH, PICTURE_HEIGHT, 0);
    picture_script(study, scene_title(scene), script.to);
    return gnuplot_end(gnuplot, &script, life, report);
}

/* Rows to stdout or a file as they are done; a file that is not whole keeps its other name. */
static enum status run_rows(struct study *study, const struct scene *scene, const struct study_options *options,
                            struct diags *diags, const struct request *request, struct arena *life,
                            struct report *report)
{
    struct study_options o = *options;
    struct stream stream;
    struct rows rows = {.line = {.form = table_form_of(request->format, !request->output && isatty(STDOUT_FILENO))},
                        .absolute = request->absolute,
                        .stream = &stream};
    TRY(stream_to(&stream, request->output, life, report));
    o.done = rows_put;
    o.self = &rows;
    enum status status = study_run(study, scene, &o, diags, life, report);
    struct report late = {0};
    const enum status ended = rows_end(&rows, status, &late);
    if (status == OK && ended != OK) status = fail(report, ended, "%s", late.text);
    return stream_finish(&stream, status, report);
}

static enum status check_plot(const struct request *request, struct report *report)
{
    TRY(gnuplot_check(request->plot, request->script, report));
    if (request->script && request->pick) return fail(report, E_USAGE, "--script and --pick both print on stdout");
    return OK;
}

static enum status write_page(const struct study *study, const struct scene *scene, const struct diags *diags,
                              const struct request *request, struct arena *life, struct report *report)
{
    const struct study_page page = {.title = scene_title(scene),
                                    .name = scene->deck->name,
                                    .deck = diags_source(diags, scene->deck->root->file)->text,
                                    .command = request->command};
    struct stream stream;
    TRY(stream_create(&stream, request->page, life, report));
    return stream_finish(&stream, study_page(study, &page, &stream, life, report), report);
}

enum status verb_study(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct choices choices = {0};
    struct study study = {0};
    double pick = 0;
    struct study_options o = {.version = FMDSUB_VERSION,
                              .log = request->quiet ? NULL : stderr,
                              .progress = request->quiet || !isatty(STDERR_FILENO) ? NULL : stderr,
                              .scheme = choices.scheme,
                              .ratio = choices.ratio,
                              .step = choices.step,
                              .tolerance = choices.tolerance,
                              .done = no_row};
    struct gnuplot gnuplot = {0};
    TRY(check_plot(request, report));
    if (request->plot && !request->script) TRY(gnuplot_open(&gnuplot, report));
    enum status status = cli_load_run(&scene, &diags, request, life, report);
    const struct target files[] = {
        {"--output", request->output, true}, {"--plot", request->plot, true}, {"--report", request->page, true}};
    if (status == OK) status = targets_check(files, 3, &scene->deck->read, life, report);
    if (status == OK && request->pick) status = choose_pick(&pick, request, life, report);
    if (status == OK) status = choose_numbers(&o, &choices, request, life, report);
    if (status == OK) status = choose_budget(&o, request, report);
    if (status == OK && (request->pick || request->script) && !request->output)
        status = study_run(&study, scene, &o, diags, life, report);
    else if (status == OK)
        status = run_rows(&study, scene, &o, diags, request, life, report);
    if (status != OK && study.nrow && !request->quiet) study_answer(&study, stderr);
    status = cli_told(diags, request, status);
    if (status == OK && request->page) status = write_page(&study, scene, diags, request, life, report);
    if (status == OK && request->plot) status = draw(&study, scene, &gnuplot, request, life, report);
    gnuplot_close(&gnuplot);
    return status == OK ? print_study(&study, pick, request, report) : status;
}
