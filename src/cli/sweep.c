/* sweep.c -- fmdsub sweep: one deck at many points; the commands and scripts that spread it over machines */
#include "sweep/sweep.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"
#include "out/targets.h"
#include "sim/sim.h"

/* ---- what was asked for ---- */

static enum status read_count(long *to, const char *option, const char *text, long least, struct report *report)
{
    char *end;
    if (!text) return OK;
    errno = 0;
    *to = strtol(text, &end, 10);
    if (end == text || *end || errno || *to < least || *to > MOST_POINTS)
        return fail(report, E_USAGE, "--%s takes a whole number of %ld or more, not '%.40s'", option, least, text);
    return OK;
}

static enum status read_shard(struct sweep *o, const char *text, struct report *report)
{
    char *end;
    o->shards = 1;
    if (!text) return OK;
    const long i = strtol(text, &end, 10);
    const char *second = end + 1;
    const long n = *end == '/' ? strtol(second, &end, 10) : 0;
    if (*end || end == second || i < 1 || n < i || n > MOST_POINTS)
        return fail(report, E_USAGE, "--shard takes I/N, the I-th of N, such as 3/40, not '%.40s'", text);
    o->shard = i - 1;
    o->shards = n;
    return OK;
}

static enum status read_points(struct sweep *o, const struct request *request, struct arena *life,
                               struct report *report)
{
    long draws = 0, seed = 1;
    TRY(read_count(&draws, "sample", request->sample, 1, report));
    TRY(read_count(&seed, "seed", request->seed, 0, report));
    o->points.seed = (uint64_t)seed;
    o->points.latin = request->latin;
    if (request->latin && !draws) return fail(report, E_USAGE, "--latin is of --sample N");
    for (int i = 0; i < request->nover; i++) TRY(points_add(&o->points, request->over[i], life, report));
    return points_close(&o->points, draws, life, report);
}

/* The deck as it stands: is it right, and has it what is wanted? */
static enum status look(struct sweep *o, const struct request *request, struct arena *life, struct report *report)
{
    struct request one = *request;
    const struct sim_options options = {.version = FMDSUB_VERSION};
    struct scene *scene;
    struct diags *diags = NULL;
    struct sim sim = {0};
    if (request->of) {
        TRY(wanted_read(&o->wanted, request->of, life, report));
        if (one.nset == MOST_SETS) return fail(report, E_USAGE, "more than %d settings", MOST_SETS);
        one.option[one.nset] = "--of";
        one.set[one.nset++] = wanted_setting(&o->wanted, life);
    }
    o->options = (struct deck_options){.nset = one.nset,
                                       .set = memcpy(TAKE(life, char *, MOST_SETS), one.set, sizeof one.set),
                                       .option = memcpy(TAKE(life, char *, MOST_SETS), one.option, sizeof one.option)};
    enum status status = cli_load(&scene, &diags, &one, life, report);
    if (status == OK) {
        const struct target table = {"--output", request->output, true};
        TRY(targets_check(&table, 1, &scene->deck->read, life, report));
        TRY(sweep_resolve(o, scene->deck, life, report));
        status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    }
    if (request->of && (status == E_MODEL || status == E_NUMERIC)) *report = (struct report){0}, status = OK;
    status = cli_told(diags, request, status);
    if (status == OK && !request->of) wanted_last(&o->wanted, sim.columns, sim.chosen.n, life);
    return status;
}

/* ---- on other machines ---- */

static void put_word(const char *word)
{
    if (*word &&
        strspn(word, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=@%+,-") == strlen(word)) {
        printf(" %s", word);
        return;
    }
    fputs(" '", stdout);
    for (; *word; word++)
        if (*word == '\'')
            fputs("'\\''", stdout);
        else
            putchar(*word);
    putchar('\'');
}

static void put_option(const char *option, const char *value)
{
    if (!value) return;
    printf(" --%s", option);
    put_word(value);
}

/* The sweep again, but for where it runs and where its rows go. */
static void put_rest(const struct request *request)
{
    for (int i = 0; i < request->nover; i++) put_option("over", request->over[i]);
    put_option("sample", request->sample);
    put_option("seed", request->seed);
    if (request->latin) fputs(" --latin", stdout);
    put_option("of", request->of);
    if (request->times) fputs(" --times", stdout);
    for (int i = 0; i < request->nset; i++) put_option("set", request->set[i]);
    put_word(request->word[0]);
}

static enum status print_list(const struct sweep *o, const struct request *request)
{
    for (long i = o->shard; i < o->points.n; i += o->shards) {
        printf("%s sweep --quiet --shard %ld/%ld", program_invocation_name, i + 1, o->points.n);
        put_rest(request);
        putchar('\n');
    }
    return OK;
}

static enum status print_slurm(const struct sweep *o, const struct request *request, struct report *report)
{
    long tasks = 0;
    TRY(read_count(&tasks, "slurm", request->slurm, 1, report));
    if (tasks > o->points.n) tasks = o->points.n;
    const char *name = request->output ? request->output : "sweep.csv";
    printf("#!/bin/sh\n#SBATCH --job-name=fmdsub-sweep\n#SBATCH --array=1-%ld\n#SBATCH --cpus-per-task=1\n"
           "# %ld points in %ld tasks; one that was cut off goes on where it stopped.  When all are done:\n"
           "#     %s sweep --merge",
           tasks, o->points.n, tasks, program_invocation_name);
    put_option("output", name);
    for (int i = 0; i < request->nover; i++) put_option("over", request->over[i]);
    put_option("sample", request->sample);
    put_word(name);
    printf(".[0-9]*\n%s sweep --resume --jobs 1 --shard \"$SLURM_ARRAY_TASK_ID/%ld\" --output", program_invocation_name,
           tasks);
    put_word(name);
    fputs(".\"$SLURM_ARRAY_TASK_ID\"", stdout);
    put_rest(request);
    putchar('\n');
    return OK;
}

/* ---- tables ---- */

/* A first failure stays. */
static enum status close_stream(struct stream *stream, enum status status, struct report *report)
{
    status = stream_finish(stream, status, report);
    if (stream_kept(stream)) fprintf(stderr, "fmdsub: unfinished rows are kept in %s\n", stream_kept(stream));
    return status;
}

static enum table_form form_of(const struct request *request)
{
    return table_form_of(request->format, false);
}

/* What an earlier run has left: beside the output, or the output itself. */
static enum status read_left(struct sweep *o, const struct request *request, struct arena *life, struct report *report)
{
    if (!request->output) return fail(report, E_USAGE, "--resume goes on with the rows of --output FILE");
    if (form_of(request) != TABLE_CSV) return fail(report, E_USAGE, "--resume reads CSV only");
    const char *name = stream_part(request->output, life);
    FILE *file = name ? file_to_read(name) : NULL;
    if (!file) file = file_to_read(name = request->output);
    if (!file) return OK;
    const enum status status = sheet_read(&o->sheet, file, name, report);
    (void)fclose(file);
    TRY(status);
    TRY(sweep_check(o, name, report));
    return sweep_compare(o, name, life, report);
}

static enum status verdict(const struct sweep *o, struct report *report)
{
    const long all = (o->points.n - o->shard + o->shards - 1) / o->shards;
    if (!o->failed) return OK;
    return fail(report, E_VERDICT, "%ld of %ld points did not end well: column exit", o->failed, all);
}

/* ---- tables of parts put together ---- */

static enum status read_part(struct sheet *sheet, const char *name, struct report *report)
{
    const bool in = strcmp(name, "-") == 0;
    FILE *file = in ? stdin : file_to_read(name);
    if (!file) return fail(report, E_FILE, "cannot read '%s': %s", name, strerror(errno));
    const enum status status = sheet_read(sheet, file, in ? "standard input" : name, report);
    if (!in) (void)fclose(file);
    return status;
}

static enum status write_sheet(const struct sheet *sheet, const struct request *request, struct arena *life,
                               struct report *report)
{
    struct stream stream;
    struct table_line line = {.form = form_of(request)};
    TRY(stream_to(&stream, request->output, life, report));
    enum status status = sheet_begin(sheet, &line, &stream, report);
    for (long i = 0; i < sheet->rows && status == OK; i++)
        if (sheet->row[i]) status = sheet_put(sheet, i, &line, &stream, report);
    if (status == OK) status = sheet_end(&line, &stream, report);
    return close_stream(&stream, status, report);
}

static enum status merge(const struct request *request, struct arena *life, struct report *report)
{
    struct sweep o = {.sheet = {.life = life}};
    struct files read = {.arena = life};
    const struct target table = {"--output", request->output, true};
    long missing = 0, first = 0;
    if (!request->nword)
        return fail(report, E_USAGE, "--merge takes the tables to be put together; '-' is standard input");
    if (request->nover) TRY(read_points(&o, request, life, report));
    for (int i = 0; i < request->nword; i++) files_add_path(&read, request->word[i]);
    TRY(targets_check(&table, 1, &read, life, report));
    for (int i = 0; i < request->nword; i++) TRY(read_part(&o.sheet, request->word[i], report));
    if (!o.sheet.n) return fail(report, E_FILE, "--merge: the files are empty");
    TRY(write_sheet(&o.sheet, request, life, report));
    const long all = o.points.n > o.sheet.rows ? o.points.n : o.sheet.rows;
    for (long i = all; i-- > 0;)
        if (i >= o.sheet.rows || !o.sheet.row[i]) missing++, first = i + 1;
    if (!missing) return OK;
    return fail(report, E_VERDICT, "%ld of %ld points are missing, the first is point %ld", missing, all, first);
}

enum status verb_sweep(const struct request *request, struct arena *life, struct report *report)
{
    const char *word = request->progress ? request->progress : "auto";
    const bool shows =
        strcmp(word, "auto") != 0 ? strcmp(word, "always") == 0 : isatty(STDERR_FILENO) && !request->quiet;
    struct sweep o = {.version = FMDSUB_VERSION,
                      .times = request->times,
                      .log = request->quiet ? NULL : stderr,
                      .progress = shows ? stderr : NULL};
    struct stream stream;
    long jobs = 0;
    if (request->merge) return merge(request, life, report);
    TRY(read_count(&jobs, "jobs", request->jobs, 1, report));
    o.jobs = (int)jobs;
    TRY(read_shard(&o, request->shard, report));
    TRY(read_points(&o, request, life, report));
    if (request->nword == 1 && strcmp(request->word[0], "-") == 0)
        return fail(report, E_USAGE, "a sweep reads its deck anew at each point: a file, not standard input");
    TRY(look(&o, request, life, report));
    if (request->list) return print_list(&o, request);
    if (request->slurm) return print_slurm(&o, request, report);
    o.deck = request->word[0];
    sweep_head(&o, life);
    if (request->resume) TRY(read_left(&o, request, life, report));
    TRY(stream_to(&stream, request->output, life, report));
    TRY(close_stream(&stream, sweep_run(&o, form_of(request), &stream, life, report), report));
    return verdict(&o, report);
}
