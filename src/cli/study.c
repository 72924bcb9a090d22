/* study.c -- fmdsub study: schemes, ratios, steps and tolerances on one deck, as a table or as CSV, and what they say */
#include "study/study.h"
#include "multirate/schemes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"
#include "out/columns.h"
#include "out/stream.h"
#include "out/targets.h"

enum { MOST_CHOICES = 64 };

static enum status read_number_list(double *x, int *n, const char *option, const char *list, bool whole,
                                    struct arena *life, struct report *report)
{
    const char **words = columns_split(n, list, life);
    if (*n == 0) return fail(report, E_USAGE, "--%s names no number", option);
    if (*n > MOST_CHOICES) return fail(report, E_USAGE, "--%s: more than %d", option, MOST_CHOICES);
    for (int i = 0; i < *n; i++) {
        char *end;
        x[i] = strtod(words[i], &end);
        if (*end || !(x[i] > 0) || !isfinite(x[i]) || (whole && x[i] != floor(x[i])) || (whole && x[i] > 1e6))
            return fail(report, E_USAGE, "--%s: expected %s, found '%.40s'", option,
                        whole ? "whole numbers from 1" : "positive numbers", words[i]);
    }
    return OK;
}

struct choices {
    const char *scheme[MOST_CHOICES];
    int ratio[MOST_CHOICES];
    double step[MOST_CHOICES], tolerance[MOST_CHOICES];
};

static enum status choose_schemes(struct study_options *o, struct choices *c, const struct scene *scene,
                                  const struct request *request, struct arena *life, struct report *report)
{
    if (request->schemes) {
        const char **words = columns_split(&o->nscheme, request->schemes, life);
        if (o->nscheme == 0) return fail(report, E_USAGE, "--schemes names no scheme");
        if (o->nscheme > MOST_CHOICES) return fail(report, E_USAGE, "--schemes: more than %d", MOST_CHOICES);
        for (int i = 0; i < o->nscheme; i++) {
            c->scheme[i] = words[i];
            if (!stepper_find(words[i])) return fail(report, E_USAGE, "--schemes: no scheme '%.40s'", words[i]);
        }
        return OK;
    }
    o->usual = true;
    const bool steps = scene->integrate.step > 0 || request->steps;
    const bool rates = steps && (scene->integrate.ratio > 1 || request->ratios);
    const struct {
        const char *scheme;
        bool fits;
    } usual[] = {{"midpoint", steps}, {"newmark", steps}, {"subcycle", rates}, {"miao", rates},
                 {"dopri5", true},    {"dop853", true},   {"radau9", true}};
    for (size_t i = 0; i < sizeof usual / sizeof *usual; i++)
        if (usual[i].fits) c->scheme[o->nscheme++] = usual[i].scheme;
    return OK;
}

static enum status choose_numbers(struct study_options *o, struct choices *c, const struct scene *scene,
                                  const struct request *request, struct arena *life, struct report *report)
{
    double x[MOST_CHOICES];
    double h = scene->integrate.step;
    int n = scene->integrate.ratio;
    o->nratio = 1; /* at ratio 1 a scheme of two rates is one of the others */
    c->ratio[0] = n;
    if (request->ratios) {
        TRY(read_number_list(x, &o->nratio, "ratios", request->ratios, true, life, report));
        for (int i = 0; i < o->nratio; i++) c->ratio[i] = (int)x[i];
    }
    o->nstep = 3;
    for (int i = 0; i < 3; i++) c->step[i] = h / (1 << i);
    if (request->steps) TRY(read_number_list(c->step, &o->nstep, "steps", request->steps, false, life, report));
    bool fixed = false;
    for (int i = 0; i < o->nscheme; i++) fixed |= !stepper_find(c->scheme[i])->adaptive;
    if (fixed && !(h > 0) && !request->steps)
        return fail(report, E_USAGE, "the deck has no 'step': name some with --steps");
    static const double usual[] = {1e-3, 1e-5, 1e-7, 1e-9};
    o->ntolerance = 4;
    memcpy(c->tolerance, usual, sizeof usual);
    if (request->tolerances)
        TRY(read_number_list(c->tolerance, &o->ntolerance, "tolerances", request->tolerances, false, life, report));
    for (int i = 0; i < o->ntolerance; i++)
        if (c->tolerance[i] > .1) return fail(report, E_USAGE, "--tolerances: at most 0.1");
    o->repeats = 3;
    if (request->repeats) {
        int one;
        TRY(read_number_list(x, &one, "repeats", request->repeats, true, life, report));
        if (one == 1) o->repeats = (int)x[0];
    }
    return OK;
}

/* CSV into a file, renamed when whole. */
static enum status write_file(const struct table *table, const char *path, struct arena *life, struct report *report)
{
    struct stream stream;
    const char *csv = table_csv(table, life);
    TRY(stream_create(&stream, path, life, report));
    enum status status = stream_put(&stream, csv, strlen(csv), report);
    enum status closed = stream_close(&stream, status == OK, report);
    return status == OK ? closed : status;
}

/* The wanted setting alone, or all rows and what they say. */
static enum status print_study(const struct study *study, double pick, const struct request *request,
                               struct arena *life, struct report *report)
{
    const struct table *table = study_table(study, life);
    if (request->output) TRY(write_file(table, request->output, life, report));
    if (request->pick) {
        const struct study_row *row = study_pick(study, pick);
        if (!row) return fail(report, E_VERDICT, "no run of the study has an error below %g", pick);
        study_print_pick(row, stdout);
        return OK;
    }
    if (!request->output) TRY(table_print(table, !isatty(STDOUT_FILENO), stdout, report));
    if (!request->quiet) study_answer(study, stderr);
    return OK;
}

enum status verb_study(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct choices choices = {0};
    struct study study;
    double pick = 0;
    int one = 0;
    struct study_options o = {.version = FMDSUB_VERSION,
                              .log = request->quiet ? NULL : stderr,
                              .scheme = choices.scheme,
                              .ratio = choices.ratio,
                              .step = choices.step,
                              .tolerance = choices.tolerance};
    enum status status = cli_load(&scene, &diags, request, life, report);
    const struct target table_file = {"--output", request->output, true};
    if (status == OK) status = targets_check(&table_file, 1, &scene->deck->read, life, report);
    if (status == OK && request->pick)
        status = read_number_list(&pick, &one, "pick", request->pick, false, life, report);
    if (status == OK) status = choose_schemes(&o, &choices, scene, request, life, report);
    if (status == OK) status = choose_numbers(&o, &choices, scene, request, life, report);
    if (status == OK) status = study_run(&study, scene, &o, diags, life, report);
    TRY(cli_told(diags, request, status));
    return print_study(&study, pick, request, life, report);
}
