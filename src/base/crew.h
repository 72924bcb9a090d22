/* crew.h -- jobs done by several processes at once; what they tell is heard in the order of the jobs, whichever ends
 * first, unless any order will do.
 *
 * A job runs in a child with the caller's memory as it stands, so what it tells may hold pointers into that.  A signal
 * that asks the caller to end (base/stop.h) is passed on to the children; what they have told is heard still. */
#ifndef FMDSUB_BASE_CREW_H
#define FMDSUB_BASE_CREW_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/status.h"

struct crew {
    int n;          /* jobs */
    int most;       /* at once; 0: as many as there are processors */
    bool any_order; /* heard as they come; bytes that are heard are gone after that */
    void *self;
    /* Required.  In a child: job i tells by crew_tell(to, ...). */
    enum status (*work)(void *self, int i, int to, struct report *report);
    /* Required.  In the caller: one piece of what job i has told, aligned for any type. */
    enum status (*hear)(void *self, int i, const void *bytes, size_t n, struct report *report);
    /* Optional.  Job i has failed, or was ended from outside.  NULL: the first job that fails ends all, with its status and
     * words. */
    enum status (*lost)(void *self, int i, const struct report *end, struct report *report);
    /* Optional.  Often, while others are at work: for a line of progress. */
    void (*idle)(void *self);
};

enum status crew_run(const struct crew *o, struct arena *life, struct report *report);

enum status crew_tell(int to, const void *bytes, size_t n);

#endif
