/* curves.c -- see curves.h */
#include "cli/curves.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/crew.h"
#include "cli/recorded.h"
#include "multirate/schemes.h"
#include "sim/sim.h"

enum { LEAST_ROWS = 500 };

/* ---- in a process of its own: a deck ---- */

struct keeper {
    struct curves *to;
    struct arena *life;
};

static enum status keep_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    struct keeper *k = sink->self;
    (void)report;
    k->to->n = meta->n;
    return OK;
}

static enum status keep_row(struct sink *sink, const double *x, struct report *report)
{
    struct keeper *k = sink->self;
    (void)report;
    memcpy(recorded_row(k->to, k->life), x, (size_t)k->to->n * sizeof *x);
    return OK;
}

/* Did the caller say when records are due? */
static bool is_told(const struct request *request)
{
    for (int i = 0; i < request->nset; i++)
        if (strncmp(request->set[i], "output.every=", strlen("output.every=")) == 0) return true;
    return false;
}

/* A picture wants more records than the deck may have asked for: those in between are drawn, too. */
void curves_refine(struct scene *scene, const struct request *request)
{
    if (is_told(request)) return;
    const double each = (scene->integrate.until - scene->start) / LEAST_ROWS;
    const struct stepper_kind *kind = stepper_find(scene->integrate.scheme);
    const bool own = kind && (kind->adaptive || kind->tolerant) && !(scene->integrate.step > 0);
    if (own && scene->output.every > each) scene->output.every /= ceil(scene->output.every / each);
}

void curves_refine_steps(struct sim *sim, const struct request *request)
{
    if (is_told(request)) return;
    if (!sim->stepper.kind->adaptive && sim->every > sim->majors / LEAST_ROWS)
        sim->every = sim->majors > LEAST_ROWS ? sim->majors / LEAST_ROWS : 1;
}

static enum status run_deck(struct curves *o, const struct request *request, bool fine, struct arena *life,
                            struct report *report)
{
    static const struct sink_ops ops = {.meta = keep_meta, .row = keep_row};
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim = {0};
    struct keeper keeper = {o, life};
    struct sink sink = {&ops, &keeper};
    const struct sim_options options = {.version = FMDSUB_VERSION, .warnings = stderr};
    enum status status = cli_load_run(&scene, &diags, request, life, report);
    if (status == OK && fine) curves_refine(scene, request);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    TRY(cli_told(diags, request, status));
    if (fine) curves_refine_steps(&sim, request);
    o->column = sim.columns;
    return sim_run(&sim, &sink, report);
}

/* ---- a file of records ---- */

static enum status read_file(struct curves *o, const struct request *request, struct arena *life, struct report *report)
{
    cli_confine(request, life);
    return recorded_read(o, life, report);
}

/* ---- from the one process to the other ---- */

struct job {
    const struct request *request;
    struct curves *to;
    bool fine;
    enum status *ended;
    struct arena *life;
};

/* How it ended, then names and units, each with a 0 after it, then the rows. */
static enum status tell(const struct curves *o, enum status ended, int to)
{
    char *text = NULL;
    size_t n = 0;
    FILE *words = words_open(&text, &n);
    for (int i = 0; i < o->n; i++) {
        fputs(o->column[i].name, words);
        fputc(0, words);
        fputs(o->column[i].unit ? o->column[i].unit : "", words);
        fputc(0, words);
    }
    words_close(words, &text);
    enum status status = crew_tell(to, &ended, sizeof ended);
    if (status == OK) status = crew_tell(to, text, n);
    if (status == OK) status = crew_tell(to, o->x, (size_t)o->rows * (size_t)o->n * sizeof *o->x);
    free(text);
    return status;
}

static enum status work(void *self, int i, int to, struct report *report)
{
    const struct job *job = self;
    struct request one = *job->request;
    struct curves curves = {.file = one.word[i]};
    struct arena *life = arena_open();
    one.word += i;
    one.nword = 1;
    enum status status = recorded_is(curves.file) ? read_file(&curves, &one, life, report)
                                                  : run_deck(&curves, &one, job->fine, life, report);
    if (curves.rows > 0 && (status == OK || status == E_VERDICT || status == E_NUMERIC || status == E_LIMIT)) {
        if (status != OK && report->text[0]) fprintf(stderr, "fmdsub: %s: %s\n", curves.file, report->text);
        *report = (struct report){0};
        status = tell(&curves, status, to);
    }
    arena_close(life);
    return status;
}

static void hear_columns(struct curves *o, const char *text, size_t n, struct arena *life)
{
    int capacity = 0;
    text = arena_copy(life, text, n);
    for (const char *at = text; at < text + n; at += strlen(at) + 1) {
        o->column = arena_more(life, o->column, o->n, &capacity, sizeof *o->column);
        o->column[o->n] = (struct column){.name = at};
        at += strlen(at) + 1;
        if (*at) o->column[o->n].unit = at;
        o->n++;
    }
}

static enum status hear(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    struct job *job = self;
    struct curves *o = &job->to[i];
    (void)report;
    if (!o->file) {
        o->file = job->request->word[i];
        if (*job->ended == OK) memcpy(job->ended, bytes, sizeof *job->ended);
    } else if (!o->n) {
        hear_columns(o, bytes, n, job->life);
    } else {
        o->rows = (int)(n / sizeof(double)) / o->n;
        o->x = TAKE(job->life, double, n / sizeof(double));
        memcpy(o->x, bytes, n);
    }
    return OK;
}

/* What changes a deck is not there for records that are made already. */
static enum status check_settings(const struct request *request, struct report *report)
{
    for (int i = 0; i < request->nword; i++)
        if (!recorded_is(request->word[i])) return OK;
    for (int i = 0; i < request->nset; i++) {
        const char *option = request->option[i] ? request->option[i] : "--set";
        if (strcmp(option, "--columns") != 0)
            return fail(report, E_USAGE, "%s is for decks: '%.80s' holds records already", option, request->word[0]);
    }
    return OK;
}

enum status curves_make(struct curves *o, const struct request *request, bool fine, enum status *ended,
                        struct arena *life, struct report *report)
{
    struct job job = {request, o, fine, ended, life};
    const struct crew crew = {.n = request->nword, .self = &job, .work = work, .hear = hear};
    *ended = OK;
    TRY(check_settings(request, report));
    return crew_run(&crew, life, report);
}
