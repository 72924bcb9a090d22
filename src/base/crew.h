/* crew.h -- jobs done by several processes at once; what they tell is heard in the order of the jobs, whichever ends
 * first.
 *
 * A job runs in a child with the caller's memory as it stands, so what it tells may hold pointers into that.  A signal
 * that asks the caller to end (base/stop.h) is passed on to the children; what they have told is heard still. */
#ifndef FMDSUB_BASE_CREW_H
#define FMDSUB_BASE_CREW_H

#include <stddef.h>

#include "base/arena.h"
#include "base/status.h"

struct crew {
    int n; /* jobs */
    void *self;
    /* Required.  In a child: job i tells by crew_tell(to, ...). */
    enum status (*work)(void *self, int i, int to, struct report *report);
    /* Required.  In the caller: one piece of what job i has told, aligned for any type. */
    enum status (*hear)(void *self, int i, const void *bytes, size_t n, struct report *report);
};

/* As many at once as there are processors.  The first job that fails ends all: its status and words. */
enum status crew_run(const struct crew *o, struct arena *life, struct report *report);

enum status crew_tell(int to, const void *bytes, size_t n);

#endif
