/* checkpoint.c -- see checkpoint.h */
#include "sim/checkpoint.h"

#include <assert.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/hash.h"
#include "base/recall.h"
#include "base/whole.h"
#include "sim/parts.h"

static const char MAGIC[] = "fmdsub checkpoint 1 ";
enum { HASH_DIGITS = 16, HEAD = sizeof MAGIC - 1 + HASH_DIGITS + 1 };

/* ---- what is kept ---------------------------------------------------------------------------------------------- */

/* Whose it is. */
struct whose {
    long deck, format, steps;
};

static struct whose whose_of(const struct sim *sim, const char *format)
{
    static const char *const none[] = {NULL};
    return (struct whose){(long)deck_fingerprint(sim->scene->deck, none, true),
                          (long)hash_bytes(HASH_NOTHING, format, strlen(format)), (long)memory_of_steps(sim)};
}

static void owner_recall(struct whose *o, struct recall *r)
{
    recall_within(r, "owner");
    recall_one(r, "deck", o->deck);
    recall_one(r, "format", o->format);
    recall_one(r, "steps", o->steps);
    recall_without(r);
}

static void effort_recall(struct effort *o, struct recall *r)
{
    recall_within(r, "effort");
    recall_one(r, "majors", o->majors);
    recall_one(r, "minors", o->minors);
    recall_one(r, "slow", o->slow);
    recall_one(r, "fast", o->fast);
    recall_one(r, "factors", o->factors);
    recall_one(r, "sweeps", o->sweeps);
    recall_one(r, "rejected", o->rejected);
    recall_without(r);
}

/* How far the run has come. */
static void run_recall(struct sim *sim, long *bytes, struct recall *r)
{
    recall_within(r, "run");
    recall_one(r, "t", sim->x.t);
    recall_one(r, "step", sim->place.step);
    recall_one(r, "due", sim->place.due);
    recall_one(r, "seen", sim->place.seen);
    recall_one(r, "bytes", *bytes);
    recall_one(r, "rows", sim->rows);
    recall_one(r, "recorded", sim->recorded);
    recall_one(r, "warnings", sim->warnings);
    recall_one(r, "rejected", sim->rejected);
    recall_one(r, "cut", sim->cut);
    recall_one(r, "unresolved_energy", sim->stepper.unresolved.energy);
    recall_one(r, "unresolved_motion", sim->stepper.unresolved.motion);
    recall_one(r, "unresolved_omega_h", sim->stepper.unresolved.omega_h);
    recall_one(r, "unresolved_t", sim->stepper.unresolved.t);
    recall_one(r, "unresolved_coordinate", sim->stepper.unresolved.coordinate);
    recall_one(r, "balance_told", sim->guard.told);
    recall_one(r, "balance_t", sim->guard.t);
    recall_one(r, "balance_broken", sim->guard.broken);
    recall_one(r, "balance_taking", sim->guard.taking);
    recall_one(r, "balance_taken", sim->guard.taken);
    recall_one(r, "balance_t_taken", sim->guard.t_taken);
    recall_one(r, "balance_there", sim->guard.there);
    recall_one(r, "balance_looks", sim->guard.looks);
    recall_one(r, "balance_next", sim->guard.next);
    recall_each(r, "pass_x", sim->pass, d[0], sim->npass);
    recall_each(r, "pass_y", sim->pass, d[1], sim->npass);
    recall_each(r, "pass_z", sim->pass, d[2], sim->npass);
    recall_each(r, "pass_reported", sim->pass, reported, sim->npass);
    effort_recall(&sim->stepper.effort, r);
    trust_recall(sim, r);
    if (sim->neglects.n) neglects_recall(sim, r);
    lateral_recall(sim, r);
    recall_without(r);
}

/* ---- written --------------------------------------------------------------------------------------------------- */

static enum status put(struct stream *s, const struct recall *r, struct arena *scratch, struct report *report)
{
    char head[HEAD + 1];
    uint64_t hash = HASH_NOTHING;
    const char **line = TAKE(scratch, const char *, r->n);
    for (int i = 0; i < r->n; i++) {
        line[i] = arena_print(scratch, "%s %s\n", r->span[i].name, r->span[i].text);
        hash = hash_bytes(hash, line[i], strlen(line[i]));
    }
    snprintf(head, sizeof head, "%s%016" PRIx64 "\n", MAGIC, hash);
    TRY(stream_put(s, head, strlen(head), report));
    for (int i = 0; i < r->n; i++) TRY(stream_put(s, line[i], strlen(line[i]), report));
    return OK;
}

static enum status write_file(struct sim *sim, struct arena *scratch, struct report *report)
{
    struct stream stream;
    struct recall r;
    struct whose owner = whose_of(sim, sim->saves.format);
    long bytes = (long)(sim->saves.stream->before + sim->saves.stream->written);
    recall_keep(&r, scratch);
    r.amid = true;
    owner_recall(&owner, &r);
    run_recall(sim, &bytes, &r);
    TRY(memory_recall(sim, &r));
    TRY(stream_create(&stream, sim->scene->checkpoint.file, scratch, report));
    return stream_finish(&stream, put(&stream, &r, scratch, report), report);
}

enum status checkpoint_write(struct sim *sim, struct report *report)
{
    TRY(stream_flush(sim->saves.stream, report)); /* what it says has been written, has been */
    struct arena *scratch = arena_open();
    const enum status status = write_file(sim, scratch, report);
    arena_close(scratch);
    return status;
}

/* The first whole multiple of `every` behind the run's time. */
static double next_save(const struct sim *sim)
{
    const double every = sim->scene->checkpoint.every;
    return (floor(sim->x.t / every * (1 + 1e-12)) + 1) * every;
}

bool checkpoint_due(struct sim *sim)
{
    const struct checkpoint *c = &sim->scene->checkpoint;
    if (c->steps > 0) return sim->place.step % c->steps == 0;
    if (sim->x.t < sim->saves.next) return false;
    sim->saves.next = next_save(sim);
    return true;
}

static enum status check_place(const char *path, struct report *report)
{
    char head[sizeof MAGIC];
    FILE *file = file_to_read(path);
    if (!file) return OK; /* it is not there, or writing it will tell */
    const size_t n = fread(head, 1, sizeof MAGIC - 1, file);
    (void)fclose(file);
    if (n == 0 || (n == sizeof MAGIC - 1 && memcmp(head, MAGIC, n) == 0)) return OK;
    return fail(report, E_FILE, "checkpoint: '%s' is there already and is something else", path);
}

enum status checkpoint_open(struct sim *sim, struct stream *stream, const char *format, struct report *report)
{
    const struct checkpoint *c = &sim->scene->checkpoint;
    if (!c->file) return OK;
    TRY(check_place(c->file, report));
    sim->saves.stream = stream;
    sim->saves.format = format;
    if (c->every > 0) sim->saves.next = next_save(sim);
    return OK;
}

/* ---- taken back ------------------------------------------------------------------------------------------------ */

static enum status read_file(char **text, const char *path, struct arena *life, struct report *report)
{
    struct report why;
    struct stat st;
    char *bytes;
    size_t n;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* a pipe is not waited for */
    if (fd < 0) return fail(report, E_FILE, "cannot read '%s'", path);
    if (fstat(fd, &st) != 0 || !S_ISREG(st.st_mode)) {
        close(fd);
        return fail(report, E_FILE, "cannot read '%s': it is no plain file", path);
    }
    const enum status status = whole_read(&bytes, &n, fd, path, SIZE_MAX - 1, life, &why);
    close(fd);
    if (status == E_FILE) return fail(report, E_FILE, "cannot read '%s'", path);
    TRY(status);
    *text = bytes;
    if (n < HEAD || strlen(bytes) != n || strncmp(bytes, MAGIC, sizeof MAGIC - 1) != 0)
        return fail(report, E_FILE, "'%s' is no checkpoint of this version", path);
    if (strtoull(bytes + sizeof MAGIC - 1, NULL, 16) != hash_bytes(HASH_NOTHING, bytes + HEAD, n - HEAD))
        return fail(report, E_FILE, "checkpoint '%s' is damaged: its checksum does not fit", path);
    return OK;
}

static int count_lines(const char *text)
{
    int n = 0;
    for (; *text; text++) n += *text == '\n';
    return n;
}

/* Lines "name numbers" apart, in place; how many of these there are. */
static int split(struct recalled *span, char *text)
{
    int n = 0;
    for (char *line = text, *end; (end = strchr(line, '\n')); line = end + 1) {
        char *blank = strchr(line, ' ');
        *end = 0;
        if (!blank || blank > end) continue;
        *blank = 0;
        span[n++] = (struct recalled){line, blank + 1};
    }
    return n;
}

static enum status check_owner(const struct sim *sim, struct recall *r, const char *format, const char *path,
                               struct report *report)
{
    const struct whose want = whose_of(sim, format);
    struct whose have = {0};
    owner_recall(&have, r);
    if (have.deck != want.deck || *r->wrong)
        return fail(report, E_MODEL,
                    "no start: checkpoint '%s' is of another deck: it goes with this one's text, tables, bodies, "
                    "--set and --until as they were",
                    path);
    if (have.format != want.format)
        return fail(report, E_MODEL, "no start: the records of checkpoint '%s' are not in form %s", path, format);
    if (have.steps != want.steps)
        return fail(report, E_MODEL, "no start: checkpoint '%s' is of another version of the program", path);
    return OK;
}

enum status checkpoint_take(struct sim *sim, const char *path, const char *format, long long *bytes, struct arena *life,
                            struct report *report)
{
    struct recall r;
    char *text = NULL;
    long written = 0;
    TRY(read_file(&text, path, life, report));
    assert(text);
    struct recalled *span = TAKE(life, struct recalled, count_lines(text + HEAD));
    recall_back(&r, span, split(span, text + HEAD));
    r.amid = true;
    TRY(check_owner(sim, &r, format, path, report));
    run_recall(sim, &written, &r);
    TRY(memory_recall(sim, &r));
    if (*r.wrong) return fail(report, E_MODEL, "no start: checkpoint '%s' does not fit this run ('%s')", path, r.wrong);
    *bytes = written;
    sim->place.resumed = true;
    return OK;
}
