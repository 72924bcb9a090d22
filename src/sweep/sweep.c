/* sweep.c -- see sweep.h */
#include "sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/crew.h"
#include "base/text.h"
#include "out/number.h"
#include "sim/load.h"
#include "sim/sim.h"
#include "study/auto.h"

enum { SHOWN = 5 };
static const double FIRST_AFTER = 1, OFTEN = .25; /* [s] */

/* ---- in a process of its own ---- */

/* What a point tells: this, then values [n of the wanted]. */
struct result {
    enum status status;
    double cpu;
    char words[sizeof(((struct report *)0)->text)];
};

struct runner {
    const struct wanted *wanted;
    struct tally *tally; /* [n of the wanted] */
};

static enum status add_row(struct sink *sink, const double *x, struct report *report)
{
    struct runner *o = sink->self;
    (void)report;
    wanted_add(o->tally, o->wanted, x);
    return OK;
}

static enum status run_point(struct sweep *o, long point, struct tally *tally, struct arena *life,
                             struct report *report)
{
    static const struct sink_ops ops = {.row = add_row};
    const struct sim_options options = {.version = o->version};
    const int n = o->options.nset + o->points.nfactor;
    const char **set = TAKE(life, const char *, n), **option = TAKE(life, const char *, n);
    struct deck_options deck = {.nset = n, .set = set, .option = option};
    struct diags *diags = diags_open(life);
    struct scene *scene;
    struct sim sim = {0};
    struct runner runner = {&o->wanted, tally};
    struct sink sink = {&ops, &runner};
    char buffer[POINT_TEXT];
    for (int i = 0; i < o->options.nset; i++) {
        set[i] = o->options.set[i];
        option[i] = o->options.option[i];
    }
    for (int f = 0; f < o->points.nfactor; f++)
        set[o->options.nset + f] =
            arena_print(life, "%s=%s", o->points.factor[f].path, points_value(&o->points, point, f, buffer));
    enum status status = sim_load(&scene, o->deck, &deck, diags, life, report);
    if (status == OK) status = auto_choose(scene, life, report);
    if (status == OK) status = sim_open(&sim, scene, &scene->integrate, &options, diags, life, report);
    if (status != OK && diags_first(diags)) return fail(report, status, "%s", diags_first(diags));
    TRY(status);
    TRY(wanted_find(&o->wanted, sim.columns, sim.chosen.n, report));
    return sim_run(&sim, &sink, report);
}

/* ---- in the caller ---- */

struct work {
    struct sweep *sweep;
    const long *todo; /* [of the crew] points */
    enum table_form form;
    struct table_line line;
    struct stream *stream;
    long next;             /* point whose row is to be written */
    long done, all, shown; /* shown: words of points that failed */
    double begun, told;    /* [s] of the clock */
    bool wrote;
};

static enum status work(void *self, int i, int to, struct report *report)
{
    struct work *o = self;
    const int n = o->sweep->wanted.n;
    struct arena *life = arena_open();
    struct tally *tally = TAKE(life, struct tally, n);
    const size_t bytes = sizeof(struct result) + (size_t)n * sizeof(double);
    struct result *result = arena_take(life, 1, bytes);
    double *value = (double *)(result + 1);
    result->status = run_point(o->sweep, o->todo[i], tally, life, report);
    const bool whole = result->status == OK || result->status == E_VERDICT;
    for (int k = 0; k < n; k++) value[k] = whole ? wanted_value(&tally[k], &o->sweep->wanted.want[k]) : NAN;
    result->cpu = clock_cpu();
    memcpy(result->words, report->text, sizeof result->words);
    enum status status = result->status;
    *report = (struct report){0};
    if (status < E_SIGHUP) status = crew_tell(to, result, bytes);
    arena_close(life);
    return status == OK || status >= E_SIGHUP ? status : OK;
}

static void clear_line(struct work *o)
{
    if (o->wrote) fprintf(o->sweep->progress, "\r%70s\r", "");
    o->wrote = false;
}

static void tell_failure(struct work *o, long point, enum status status, const char *words)
{
    const struct sweep *s = o->sweep;
    char buffer[POINT_TEXT];
    if (!s->log || o->shown++ >= SHOWN) return;
    clear_line(o);
    fprintf(s->log, "fmdsub: point %ld (", point + 1);
    for (int f = 0; f < s->points.nfactor; f++) {
        fprintf(s->log, "%s%s=", f ? ", " : "", s->points.factor[f].name);
        text_put(s->log, points_value(&s->points, point, f, buffer));
    }
    fprintf(s->log, "): exit %d: ", (int)status);
    text_put(s->log, words);
    putc('\n', s->log);
}

/* Rows that follow on what has been written. */
static enum status write_on(struct work *o, bool gaps, struct report *report)
{
    const struct sheet *sheet = &o->sweep->sheet;
    for (; o->next < o->sweep->points.n; o->next += o->sweep->shards) {
        const bool there = o->next < sheet->rows && sheet->row[o->next];
        if (!there && !gaps) return OK;
        if (there) TRY(sheet_put(sheet, o->next, &o->line, o->stream, report));
    }
    return OK;
}

static const char *text_of(double x, int digits, struct arena *life)
{
    char number[NUMBER_MOST + 1];
    if (!isfinite(x)) return "";
    return arena_copy(life, number, (size_t)(digits ? number_round(number, x, digits) : number_write(number, x)));
}

/* value NULL: there are none. */
static enum status keep(struct work *o, long point, enum status status, double cpu, const double *value,
                        struct report *report)
{
    struct sweep *s = o->sweep;
    struct arena *life = s->sheet.life;
    const char **text = TAKE(life, const char *, s->sheet.n), **to = text;
    char buffer[POINT_TEXT];
    *to++ = arena_print(life, "%ld", point + 1);
    for (int f = 0; f < s->points.nfactor; f++) {
        const char *word = points_value(&s->points, point, f, buffer);
        *to++ = arena_copy(life, word, strlen(word));
    }
    for (int k = 0; k < s->wanted.n; k++) *to++ = value ? text_of(value[k], 0, life) : "";
    if (s->times) *to++ = text_of(cpu, 3, life);
    *to = arena_print(life, "%d", (int)status);
    sheet_keep(&s->sheet, point, text);
    s->failed += status != OK;
    o->done++;
    return write_on(o, false, report);
}

static enum status hear(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    struct work *o = self;
    const struct result *result = bytes;
    (void)n;
    if (result->status != OK) tell_failure(o, o->todo[i], result->status, result->words);
    return keep(o, o->todo[i], result->status, result->cpu, (const double *)(result + 1), report);
}

/* Out of memory, or ended from outside. */
static enum status lost(void *self, int i, const struct report *end, struct report *report)
{
    struct work *o = self;
    tell_failure(o, o->todo[i], end->status, end->text);
    return keep(o, o->todo[i], end->status, NAN, NULL, report);
}

static void show(void *self)
{
    struct work *o = self;
    const double now = clock_wall(), spent = now - o->begun;
    if (!o->sweep->progress || spent < FIRST_AFTER || now - o->told < OFTEN) return;
    o->told = now;
    o->wrote = true;
    fprintf(o->sweep->progress, "\r%ld of %ld points, %ld failed", o->done, o->all, o->sweep->failed);
    if (o->done) fprintf(o->sweep->progress, ", %.0f s to go   ", spent * (double)(o->all - o->done) / (double)o->done);
    fflush(o->sweep->progress);
}

/* ---- the whole ---- */

/* Two names may be those of one thing: k and parameters.k. */
static enum status told_apart(const struct pointset *o, struct report *report)
{
    for (int i = 0; i < o->nfactor; i++)
        for (int k = 0; k < i; k++)
            if (strcmp(o->factor[i].path, o->factor[k].path) == 0)
                return fail(report, E_USAGE, "--over: '%.40s' and '%.40s' are the same", o->factor[k].name,
                            o->factor[i].name);
    return OK;
}

enum status sweep_resolve(struct sweep *o, const struct deck *deck, struct arena *life, struct report *report)
{
    for (int i = 0; i < o->points.nfactor; i++) {
        struct factor *f = &o->points.factor[i];
        double x;
        f->path = f->name;
        if (deck_parameter(&x, f->name, deck) == 0) {
            f->path = arena_print(life, "parameters.%s", f->name);
            continue;
        }
        if (strchr(f->name, '.') || node_find(deck->root, f->name)) continue;
        const char *nearest = text_nearest(f->name, deck->parameter_name, deck->nparameter);
        return fail(report, E_USAGE, "--over: the deck has no parameter '%.40s'%s%s%s", f->name,
                    nearest ? ": did you mean '" : "; a path is such as bodies.NAME.mass", nearest ? nearest : "",
                    nearest ? "'?" : "");
    }
    return told_apart(&o->points, report);
}

void sweep_head(struct sweep *o, struct arena *life)
{
    const int n = 1 + o->points.nfactor + o->wanted.n + o->times + 1;
    struct table_column *column = TAKE(life, struct table_column, n), *to = column;
    (to++)->name = "point";
    for (int f = 0; f < o->points.nfactor; f++) (to++)->name = o->points.factor[f].name;
    for (int k = 0; k < o->wanted.n; k++) (to++)->name = o->wanted.want[k].text;
    if (o->times) (to++)->name = "cpu";
    to->name = "exit";
    o->sheet = (struct sheet){.n = n, .column = column, .life = life};
}

/* What might be otherwise another time is run again: files, limits, signals. */
static bool is_final(const char *text)
{
    const int status = atoi(text);
    return status < E_FILE;
}

enum status sweep_check(struct sweep *o, const char *name, struct report *report)
{
    char buffer[POINT_TEXT];
    for (long i = 0; i < o->sheet.rows; i++) {
        const char **text = o->sheet.row[i];
        if (!text) continue;
        if (i >= o->points.n)
            return fail(report, E_USAGE, "%s has a point %ld: this sweep has %ld", name, i + 1, o->points.n);
        for (int f = 0; f < o->points.nfactor; f++) {
            const char *value = points_value(&o->points, i, f, buffer);
            if (strcmp(text[1 + f], value) != 0)
                return fail(report, E_USAGE, "%s is of another sweep: at point %ld %s is %.40s there and %.40s here",
                            name, i + 1, o->points.factor[f].name, text[1 + f], value);
        }
        if (!is_final(text[o->sheet.n - 1]))
            o->sheet.row[i] = NULL;
        else if (strcmp(text[o->sheet.n - 1], "0") != 0)
            o->failed++;
    }
    return OK;
}

/* ---- is what was left of this deck? ---- */

struct again {
    struct work work;
    const char *name; /* of the table */
    const char **was; /* row */
};

static enum status compare(void *self, int i, const void *bytes, size_t n, struct report *report)
{
    const struct again *o = self;
    const struct sweep *s = o->work.sweep;
    const struct result *result = bytes;
    const double *value = (const double *)(result + 1);
    const char **was = o->was + 1 + s->points.nfactor;
    (void)n;
    for (int k = 0; k < s->wanted.n && result->status < E_FILE; k++) {
        const char *now = text_of(value[k], 0, s->sheet.life);
        if (strcmp(was[k], now) != 0)
            return fail(report, E_USAGE,
                        "%s is of another deck, other settings or another program: at point %ld %.60s is %.40s there "
                        "and %.40s here; without --resume all points are run",
                        o->name, o->work.todo[i] + 1, s->wanted.want[k].text, *was[k] ? was[k] : "nothing",
                        *now ? now : "nothing");
    }
    return OK;
}

/* One that ends from outside says nothing. */
static enum status forgive(void *self, int i, const struct report *end, struct report *report)
{
    (void)self, (void)i, (void)end, (void)report;
    return OK;
}

enum status sweep_compare(struct sweep *o, const char *name, struct arena *life, struct report *report)
{
    for (long i = 0; i < o->sheet.rows; i++) {
        if (!o->sheet.row[i] || strcmp(o->sheet.row[i][o->sheet.n - 1], "0") != 0) continue;
        struct again again = {{.sweep = o, .todo = &i}, name, o->sheet.row[i]};
        const struct crew crew = {
            .n = 1, .most = 1, .self = &again.work, .work = work, .hear = compare, .lost = forgive};
        return crew_run(&crew, life, report);
    }
    return OK;
}

/* ---- the points ---- */

static long *list_todo(int *n, const struct sweep *o, struct arena *life)
{
    long *todo = TAKE(life, long, o->points.n / o->shards + 1);
    *n = 0;
    for (long i = o->shard; i < o->points.n; i += o->shards)
        if (i >= o->sheet.rows || !o->sheet.row[i]) todo[(*n)++] = i;
    return todo;
}

enum status sweep_run(struct sweep *o, enum table_form form, struct stream *stream, struct arena *life,
                      struct report *report)
{
    struct work job = {
        .sweep = o, .form = form, .line = {.form = form}, .stream = stream, .next = o->shard, .begun = clock_wall()};
    int n;
    job.todo = list_todo(&n, o, life);
    job.all = n;
    const struct crew crew = {.n = n,
                              .most = o->jobs,
                              .any_order = true,
                              .self = &job,
                              .work = work,
                              .hear = hear,
                              .lost = lost,
                              .idle = show};
    TRY(sheet_begin(&o->sheet, &job.line, stream, report));
    enum status status = write_on(&job, false, report);
    if (status == OK) status = crew_run(&crew, life, report);
    clear_line(&job);
    if (job.shown > SHOWN) fprintf(o->log, "fmdsub: and %ld more points that failed\n", job.shown - SHOWN);
    struct report late = {0};
    const enum status rest = write_on(&job, true, &late), foot = sheet_end(&job.line, stream, &late);
    if (status != OK || (rest == OK && foot == OK)) return status;
    *report = late;
    return rest != OK ? rest : foot;
}
