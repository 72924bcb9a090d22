/* deck.h -- a deck in a file read as `fmdsub check` reads it; what is said of it is printed to nowhere. */
#ifndef FMDSUB_TESTS_FUZZ_DECK_H
#define FMDSUB_TESTS_FUZZ_DECK_H

#include <stdio.h>

#include "fuzz/fuzz.h"
#include "probe/modes.h"
#include "sim/load.h"
#include "sim/sim.h"

enum { FUZZ_BODIES = 30, FUZZ_JOINTS = 60, FUZZ_MODES = 40 };

/* Small enough for many in a second. */
static inline bool deck_is_small(const struct scene *s)
{
    int modes = 0;
    for (int i = 0; i < s->nbody; i++) modes += s->body[i].nmode;
    return s->nbody <= FUZZ_BODIES && s->njoint <= FUZZ_JOINTS && modes <= FUZZ_MODES;
}

static inline enum status deck_read(struct scene **scene, const char *path, struct arena *life)
{
    struct report report = {0};
    struct diags *diags = diags_open(life);
    struct sim sim;
    struct modes modes;
    const struct sim_options how = {.version = "fuzz"};
    enum status status = sim_load(scene, path, NULL, diags, life, &report);
    PROMISE(status == OK || report.text[0] || diags_errors(diags));
    if (status == OK) {
        PROMISE(!diags_errors(diags));
        if (deck_is_small(*scene)) {
            status = sim_open(&sim, *scene, &(*scene)->integrate, &how, diags, life, &report);
            PROMISE(status == OK || report.text[0] || diags_errors(diags));
            if (status == OK) (void)(modes_find(&modes, &sim, life, &report) == OK);
        }
    }
    FILE *to = fopen("/dev/null", "w");
    PROMISE(to);
    diags_print(to, diags, true);
    fclose(to);
    return status;
}

#endif
