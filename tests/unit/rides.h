/* rides.h -- a deck from its text, run to the end, its records kept.
 *
 *     struct ride r;
 *     ride_open(&r, text);
 *     double x = ride_last(&r, "hub.angle");
 *     ride_close(&r); */
#ifndef FMDSUB_TESTS_RIDES_H
#define FMDSUB_TESTS_RIDES_H

#include <string.h>
#include <unistd.h>

#include "sim/load.h"
#include "sim/sim.h"

enum { RIDE_ROWS = 4096, RIDE_COLUMNS = 40 };

struct ride {
    struct arena *life;
    struct scene *scene;
    struct sim sim;
    struct report report;
    enum status status; /* of opening, else of the run */
    int n;              /* rows */
    double (*row)[RIDE_COLUMNS];
};

static enum status ride_meta(struct sink *sink, const struct run_meta *meta, struct report *report)
{
    (void)sink, (void)meta, (void)report;
    return OK;
}

static enum status ride_row(struct sink *sink, const double *x, struct report *report)
{
    struct ride *r = sink->self;
    (void)report;
    if (r->n < RIDE_ROWS) memcpy(r->row[r->n++], x, sizeof *x * (size_t)r->sim.chosen.n);
    return OK;
}

/* Opened, not run. */
static inline void ride_build(struct ride *r, const char *text)
{
    const struct deck_options options = {0};
    const struct sim_options quiet = {.version = "test"};
    char path[] = "/tmp/fmdsub-ride-XXXXXX";
    int fd = mkstemp(path);
    ssize_t put = fd < 0 ? -1 : write(fd, text, strlen(text));
    if (fd >= 0) close(fd);
    memset(r, 0, sizeof *r);
    r->life = arena_open();
    r->row = arena_take(r->life, RIDE_ROWS, sizeof *r->row);
    struct diags *diags = diags_open(r->life);
    r->status = put < 0 ? E_FILE : sim_load(&r->scene, path, &options, diags, r->life, &r->report);
    if (r->status == OK)
        r->status = sim_open(&r->sim, r->scene, &r->scene->integrate, &quiet, diags, r->life, &r->report);
    unlink(path);
    if (r->status == E_DECK) diags_print(stderr, diags, false);
}

static inline void ride_open(struct ride *r, const char *text)
{
    static const struct sink_ops ops = {.meta = ride_meta, .row = ride_row};
    ride_build(r, text);
    if (r->status != OK) return;
    struct sink sink = {.ops = &ops, .self = r};
    r->status = sim_run(&r->sim, &sink, &r->report);
}

static inline int ride_column(const struct ride *r, const char *name)
{
    for (int i = 0; i < r->sim.chosen.n; i++)
        if (strcmp(r->sim.columns[i].name, name) == 0) return i;
    fprintf(stderr, "no column '%s'\n", name);
    return 0;
}

/* A column of record i; of the last one. */
static inline double ride_at(const struct ride *r, int i, const char *name)
{
    return i >= 0 && i < r->n ? r->row[i][ride_column(r, name)] : 0. / 0.;
}

static inline double ride_last(const struct ride *r, const char *name)
{
    return ride_at(r, r->n - 1, name);
}

static inline void ride_close(struct ride *r)
{
    arena_close(r->life);
}

#endif
