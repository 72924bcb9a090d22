/* decks.h -- decks opened as `fmdsub run` opens them, from a file or from a text; what came of it is in status. */
#ifndef FMDSUB_TESTS_DECKS_H
#define FMDSUB_TESTS_DECKS_H

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "sim/load.h"
#include "sim/sim.h"

struct opened {
    struct arena *life;
    struct scene *scene;
    struct diags *diags;
    struct sim sim;
    struct report report;
    enum status status;
};

static inline void open_as(struct opened *o, const char *path, int nset, const char *const *set,
                           const struct sim_options *how)
{
    const struct deck_options options = {.nset = nset, .set = set};
    memset(o, 0, sizeof *o);
    o->life = arena_open();
    o->diags = diags_open(o->life);
    o->status = sim_load(&o->scene, path, &options, o->diags, o->life, &o->report);
    if (o->status == OK)
        o->status = sim_open(&o->sim, o->scene, &o->scene->integrate, how, o->diags, o->life, &o->report);
}

static inline void open_path(struct opened *o, const char *path, int nset, const char *const *set)
{
    open_as(o, path, nset, set, &(struct sim_options){.version = "test"});
}

static inline void open_text(struct opened *o, const char *text)
{
    char path[] = "/tmp/fmdsub-deck-XXXXXX";
    const int fd = mkstemp(path);
    const size_t len = strlen(text);
    const int whole = fd >= 0 && write(fd, text, len) == (ssize_t)len;
    if (fd >= 0) close(fd);
    open_path(o, whole ? path : "", 0, NULL);
    unlink(path);
}

/* What is wrong with it, for the reader of a test that needs it open. */
static inline void print_wrong(const struct opened *o)
{
    if (o->status == OK) return;
    diags_print(stderr, o->diags, false);
    fprintf(stderr, "%s\n", o->report.text);
}

static inline void shut(struct opened *o)
{
    arena_close(o->life);
}

#endif
