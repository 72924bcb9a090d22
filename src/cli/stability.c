/* stability.c -- fmdsub stability: what grows from step to step, by scheme, ratio and step */
#include "study/stability.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "cli/choices.h"
#include "cli/cli.h"
#include "cli/gnuplot.h"
#include "cli/stability_json.h"
#include "out/table.h"
#include "out/targets.h"

static enum status refuse(const struct stability_options *o, struct report *report)
{
    for (int i = 0; i < o->nscheme; i++)
        if (o->scheme[i]->adaptive)
            return fail(report, E_USAGE, "--schemes: %s chooses its own steps: it has no map of a major step",
                        o->scheme[i]->name);
    return OK;
}

static enum status choose(struct stability_options *o, struct choices *c, const struct request *request,
                          struct arena *life, struct report *report)
{
    TRY(choices_read(c, request, life, report));
    *o = (struct stability_options){.scheme = c->scheme,
                                    .nscheme = c->nscheme < 32 ? c->nscheme : 32,
                                    .ratio = c->ratio,
                                    .nratio = c->nratio,
                                    .step = c->step,
                                    .nstep = c->nstep};
    return refuse(o, report);
}

static enum status print_csv(const struct stability *o, struct arena *life, struct report *report)
{
    static const struct table_column columns[] = {
        {"scheme", NULL, 0}, {"ratio", NULL, 6}, {"step", NULL, 17},      {"radius", NULL, 17}, {"own", NULL, 17},
        {"fast", NULL, 17},  {"slow", NULL, 17}, {"frequency", NULL, 17}, {"most", NULL, 0},    {"verdict", NULL, 0},
    };
    struct table *table = table_open(columns, sizeof columns / sizeof *columns, life);
    for (const struct stability_row *r = o->row; r < o->row + o->nrow; r++) {
        table_text(table, r->kind->name);
        table_number(table, r->ratio);
        table_number(table, r->step);
        table_number(table, r->known ? r->radius : NAN);
        table_number(table, r->own);
        table_number(table, stability_fast(o, r));
        table_number(table, stability_slow(o, r));
        table_number(table, r->known ? r->frequency : NAN);
        table_text(table, r->most);
        table_text(table, stability_verdict(r));
    }
    return table_print(table, TABLE_CSV, stdout, report);
}

static enum status print_rows(const struct stability *o, struct sim *sim, const struct request *request,
                              struct arena *life, struct report *report)
{
    const enum table_form form = table_form_of(request->format, isatty(STDOUT_FILENO));
    if (request->script) return OK;
    if (form == TABLE_JSON) return stability_json(o, sim, life, report);
    return form == TABLE_CSV ? print_csv(o, life, report) : stability_print(o, stdout, life, report);
}

/* The picture, or with --script what would draw it. */
static enum status draw(const struct stability *o, struct gnuplot *gnuplot, const struct request *request,
                        struct arena *life, struct report *report)
{
    struct gnuplot_script script;
    gnuplot_begin(&script, request->plot, request->script, STABILITY_WIDTH, STABILITY_HEIGHT, 0);
    stability_script(o, scene_title(o->sim->scene), script.to);
    return gnuplot_end(gnuplot, &script, life, report);
}

static enum status work(const struct request *request, struct gnuplot *gnuplot, struct arena *life,
                        struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim;
    struct choices choices = {0};
    struct stability_options options;
    struct stability o;
    const struct sim_options run = {.drawn = true, .version = FMDSUB_VERSION, .counting = true};
    enum status status = cli_load(&scene, &diags, request, life, report);
    const struct target file = {"--plot", request->plot, true};
    if (status == OK) status = targets_check(&file, 1, &scene->deck->read, life, report);
    if (status == OK) status = choose(&options, &choices, request, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &run, diags, life, report);
    if (status == OK) status = sim_without_contacts(&sim, "stability", report);
    TRY(cli_told(diags, request, status));
    TRY(cli_go_to(&sim, request, report));
    TRY(stability_find(&o, &sim, &options, life, report));
    TRY(print_rows(&o, &sim, request, life, report));
    if (request->plot) TRY(draw(&o, gnuplot, request, life, report));
    if (!request->quiet) stability_answer(&o, stderr);
    return OK;
}

enum status verb_stability(const struct request *request, struct arena *life, struct report *report)
{
    struct gnuplot gnuplot = {0};
    if (request->format && strcmp(request->format, "ndjson") == 0)
        return fail(report, E_USAGE, "'fmdsub stability' prints csv or json");
    TRY(gnuplot_check(request->plot, request->script, report));
    if (request->plot && !request->script) TRY(gnuplot_open(&gnuplot, report));
    const enum status status = work(request, &gnuplot, life, report);
    gnuplot_close(&gnuplot);
    return status;
}
