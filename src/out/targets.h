/* targets.h -- the files that are to be written: none of them is read, and no two are one. */
#ifndef FMDSUB_OUT_TARGETS_H
#define FMDSUB_OUT_TARGETS_H

#include "base/files.h"
#include "base/status.h"

struct target {
    const char *option; /* "--output" */
    const char *path;   /* NULL: not asked for */
    bool parted;        /* written by stream_create, which takes a part file beside it, too */
};

/* To be asked before anything is opened for writing.  E_USAGE: the first two that clash are named. */
enum status targets_check(const struct target *target, int n, const struct files *read, struct arena *life,
                          struct report *report);

#endif
