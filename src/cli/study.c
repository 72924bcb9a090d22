/* study.c -- fmdsub study: schemes x ratios x steps on one deck, as a table or as CSV */
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
    double step[MOST_CHOICES];
};

static enum status choose_schemes(struct study_options *o, struct choices *c, const struct scene *scene,
                                  const struct request *request, struct arena *life, struct report *report)
{
    static const char *const usual[] = {"midpoint", "subcycle", "miao", "newmark"};
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
    (void)scene;
    o->nscheme = 4;
    memcpy(c->scheme, usual, sizeof usual);
    return OK;
}

static enum status choose_numbers(struct study_options *o, struct choices *c, const struct scene *scene,
                                  const struct request *request, struct arena *life, struct report *report)
{
    double x[MOST_CHOICES];
    double h = scene->integrate.step;
    int n = scene->integrate.ratio;
    o->nratio = n > 1 ? 2 : 1;
    c->ratio[0] = 1;
    c->ratio[1] = n;
    if (request->ratios) {
        TRY(read_number_list(x, &o->nratio, "ratios", request->ratios, true, life, report));
        for (int i = 0; i < o->nratio; i++) c->ratio[i] = (int)x[i];
    }
    o->nstep = 3;
    for (int i = 0; i < 3; i++) c->step[i] = h / (1 << i);
    if (request->steps) TRY(read_number_list(c->step, &o->nstep, "steps", request->steps, false, life, report));
    if (!(h > 0) && !request->steps) return fail(report, E_USAGE, "the deck has no 'step': name some with --steps");
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

enum status verb_study(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct choices choices;
    struct table *table = NULL;
    struct study_options o = {.version = FMDSUB_VERSION,
                              .log = request->quiet ? NULL : stderr,
                              .scheme = choices.scheme,
                              .ratio = choices.ratio,
                              .step = choices.step};
    enum status status = cli_load(&scene, &diags, request, life, report);
    const struct target table_file = {"--output", request->output, true};
    if (status == OK) status = targets_check(&table_file, 1, &scene->deck->read, life, report);
    if (status == OK) status = choose_schemes(&o, &choices, scene, request, life, report);
    if (status == OK) status = choose_numbers(&o, &choices, scene, request, life, report);
    if (status == OK) status = study_run(&table, scene, &o, diags, life, report);
    TRY(cli_told(diags, request, status));
    if (request->output) return write_file(table, request->output, life, report);
    return table_print(table, !isatty(STDOUT_FILENO), stdout, report);
}
