/* run.c -- fmdsub run: a deck to a stream of records */
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "cli/cli.h"
#include "out/facts.h"
#include "out/number.h"
#include "out/targets.h"
#include "sim/checkpoint.h"
#include "sim/sim.h"
#include "study/left_out.h"
#include "study/verify.h"

static bool shows_progress(const struct request *request)
{
    const char *word = request->progress ? request->progress : "auto";
    if (strcmp(word, "auto") != 0) return strcmp(word, "always") == 0;
    return isatty(STDERR_FILENO) && !request->quiet;
}

static void write_number(char *to, double x)
{
    if (isfinite(x))
        to[number_round(to, x, 12)] = 0;
    else
        strcpy(to, "-");
}

enum { MOST_FACTS = 48 };

static bool is_json(const char *path)
{
    const size_t n = path ? strlen(path) : 0;
    return n > 5 && strcmp(path + n - 5, ".json") == 0;
}

static void put_json(FILE *to, const struct pair *facts, int n, struct arena *life)
{
    cJSON *all = cJSON_CreateObject();
    char *text = facts_pairs(all, facts, n, life) ? cJSON_PrintUnformatted(all) : NULL;
    if (text) fprintf(to, "%s\n", text);
    cJSON_free(text);
    cJSON_Delete(all);
}

/* For people on stderr, in a file a name, a blank and a value to the line. */
static void put_lines(FILE *to, const struct pair *facts, int n)
{
    char number[NUMBER_MOST + 1];
    for (int i = 0; i < n; i++) {
        if (facts[i].kind == PAIR_NUMBER) write_number(number, facts[i].number);
        fprintf(to, "%-*s %s\n", to == stderr ? 22 : 0, facts[i].key,
                facts[i].kind == PAIR_NUMBER ? number
                : facts[i].kind == PAIR_TEXT ? facts[i].text
                : facts[i].truth             ? "true"
                                             : "false");
    }
}

/* For the scene and its run, before the first step, and for watches over what is left out. */
struct bytes {
    size_t taken, used, watches;
};

/* Counts, the CPU time of stepping, and memory. */
static enum status write_stats(const struct sim *sim, const struct bytes *bytes, const struct request *request,
                               struct arena *life, struct report *report)
{
    struct pair facts[MOST_FACTS];
    int n = sim_facts(sim, facts, MOST_FACTS - 4);
    FILE *to = request->stats ? file_or_end(request->stats, "w") : stderr;
    if (!to) return fail(report, E_FILE, "%s: cannot open for writing", request->stats);
    facts[n++] = pair_number("cpu_seconds", sim->cpu);
    facts[n++] = pair_number("bytes_taken", (double)bytes->taken);
    facts[n++] = pair_number("bytes_used", (double)bytes->used);
    facts[n++] = pair_number("bytes_watches", (double)bytes->watches);
    if (is_json(request->stats))
        put_json(to, facts, n, life);
    else
        put_lines(to, facts, n);
    if (to == stderr) return OK;
    const bool written = !ferror(to);
    return fclose(to) == 0 && written ? OK : fail(report, E_FILE, "%s: cannot write", request->stats);
}

static const char *form_of(const struct request *request)
{
    return request->format ? request->format : "csv";
}

static struct sink open_sink(struct stream *stream, const struct request *request, struct arena *life)
{
    const bool units = request->units && strcmp(form_of(request), "csv") == 0;
    return units ? csv_open_units(stream, life) : format_find(form_of(request))->open(stream, life);
}

/* One JSON value is whole or nothing. */
static enum status check_form(const struct request *request, const struct scene *scene, struct report *report)
{
    if (strcmp(form_of(request), "json") != 0 || !(request->resume_from || scene->checkpoint.file)) return OK;
    return fail(report, E_USAGE, "checkpoints are of records as csv or ndjson: a json that is cut is none");
}

/* The stream of a run that is new, or goes on. */
static enum status begin_stream(struct stream *stream, struct sim *sim, const struct request *request,
                                struct arena *life, struct report *report)
{
    long long bytes = 0;
    if (!request->resume_from) {
        TRY(stream_to(stream, request->output, life, report));
        return checkpoint_open(sim, stream, form_of(request), report);
    }
    TRY(checkpoint_take(sim, request->resume_from, form_of(request), &bytes, life, report));
    if (request->output)
        TRY(stream_resume(stream, request->output, bytes, life, report));
    else
        TRY(stream_to(stream, request->output, life, report));
    stream->before = request->output ? 0 : bytes;
    if (!request->quiet) fprintf(stderr, "resumed at t = %.12g s\n", sim->x.t);
    return checkpoint_open(sim, stream, form_of(request), report);
}

/* A deck that is run, for study/left_out.h. */
struct again {
    const struct request *request;
    const struct scene *scene;
};

static enum status load_again(struct scene **scene, void *self, unsigned unheard, struct arena *life)
{
    const struct again *o = self;
    struct report report = {0};
    struct diags *diags;
    return cli_load_again(scene, &diags, o->request, o->scene, unheard, life, &report);
}

/* Would somebody read what effects that are left out change? */
static bool tells(const struct sim *sim, const struct request *request)
{
    return !request->quiet || request->want_stats || sim->scene->effects.tolerance > 0 ||
           strcmp(form_of(request), "csv") != 0;
}

static enum status stream_run(struct sim *sim, const struct request *request, struct arena *life, struct report *report)
{
    struct stream stream;
    struct report closing = {0};
    TRY(begin_stream(&stream, sim, request, life, report));
    struct sink sink = open_sink(&stream, request, life);
    struct verify verify;
    verify_open(&verify, sim, &sink, diags_open(life), life);
    struct sink *to = request->verify ? &verify.sink : &sink;
    struct again again = {request, sim->scene};
    struct left_out left_out = {.load = load_again, .self = &again};
    if (tells(sim, request)) to = left_out_open(&left_out, sim, to, life);
    enum status status = sim_run(sim, to, report);
    if (request->verify && !request->quiet) verify_print(&verify, stderr);
    enum status closed = stream_close(&stream, status == OK || status == E_VERDICT, &closing);
    if (closed != OK && (status == OK || status == E_VERDICT)) {
        *report = closing;
        status = closed;
    }
    if (status == E_FILE && sim->x.t < sim->plan.until)
        fprintf(stderr, "fmdsub: stopped at t = %.12g s: nothing more can be written\n", sim->x.t);
    if (stream_kept(&stream)) {
        fputs("fmdsub: unfinished records are kept in ", stderr);
        text_put(stderr, stream_kept(&stream));
        fputc('\n', stderr);
    }
    return status;
}

/* Where the run ended, whole or not. */
static enum status write_state(struct sim *sim, const struct request *request, struct arena *life,
                               struct report *report)
{
    struct stream stream;
    TRY(stream_create(&stream, request->final_state, life, report));
    return stream_finish(&stream, sim_write_state(sim, &stream, report), report);
}

/* Records, state, counts and checkpoints go to four files, and none is the deck's. */
static enum status check_targets(const struct request *request, const struct scene *scene, struct arena *life,
                                 struct report *report)
{
    const struct target target[] = {
        {"standard output", request->output ? NULL : "/dev/stdout", false},
        {"--output", request->output, true},
        {"--final-state", request->final_state, true},
        {"--stats", request->stats, false},
        {"the checkpoint", scene->checkpoint.file, true},
    };
    return targets_check(target, sizeof target / sizeof *target, &scene->deck->read, life, report);
}

static enum status strict_verdict(const struct sim *sim, const struct diags *diags, struct report *report)
{
    if (diags_warnings(diags))
        return fail(report, E_VERDICT, "--strict: %d warning(s) about the deck", diags_warnings(diags));
    if (sim->warnings) return fail(report, E_VERDICT, "--strict: %d warning(s) about the run", sim->warnings);
    if (sim->stepper.effort.rejected && !sim->stepper.kind->adaptive) /* there it is the way of working */
        return fail(report, E_VERDICT, "--strict: %ld steps were rejected", sim->stepper.effort.rejected);
    return OK;
}

enum status verb_run(const struct request *request, struct arena *life, struct report *report)
{
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim;
    const struct sim_options options = {
        .version = FMDSUB_VERSION,
        .log = request->quiet ? NULL : stderr,
        .warnings = stderr,
        .progress = shows_progress(request) ? PROGRESS_ALWAYS : PROGRESS_NEVER,
    };
    enum status status = cli_load_run(&scene, &diags, request, life, report);
    if (status == OK) status = check_form(request, scene, report);
    if (status == OK) status = check_targets(request, scene, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    TRY(cli_told(diags, request, status));
    const struct bytes bytes = {arena_held(life), arena_used(life), sim.beside ? arena_used(sim.beside) : 0};
    status = stream_run(&sim, request, life, report);
    if (request->final_state && status != E_SIGPIPE) {
        struct report failed = {0};
        enum status written = write_state(&sim, request, life, &failed);
        if (written != OK && status == OK) status = fail(report, written, "%s", failed.text);
    }
    if (status == OK && request->strict) status = strict_verdict(&sim, diags, report);
    if ((request->want_stats || request->verbose) && status != E_SIGPIPE) {
        enum status written = write_stats(&sim, &bytes, request, life, report);
        if (status == OK) status = written;
    }
    return status;
}
