/* sweep.h -- one deck at many points, each in a process of its own: a point that fails is a row like the others. */
#ifndef FMDSUB_SWEEP_SWEEP_H
#define FMDSUB_SWEEP_SWEEP_H

#include <stdio.h>

#include "deck/deck.h"
#include "sweep/points.h"
#include "sweep/sheet.h"
#include "sweep/wanted.h"

struct sweep {
    const char *version, *deck;
    struct deck_options options; /* of all points */
    struct pointset points;
    struct wanted wanted;
    bool times;         /* a column of CPU seconds */
    long shard, shards; /* of every `shards` points the one of this number, from 0 */
    int jobs;           /* at once; 0: as many as there are processors */
    FILE *log;          /* words of points that failed; NULL: none */
    FILE *progress;     /* a terminal; NULL: none */
    struct sheet sheet; /* what is in it is not run again */
    long failed;
};

/* Where the sweep's factors are in the deck: parameters by their names, else paths as --set takes them. */
enum status sweep_resolve(struct sweep *o, const struct deck *deck, struct arena *life, struct report *report);

/* The columns of the table. */
void sweep_head(struct sweep *o, struct arena *life);
/* Rows that are there are of these points, and ended for good. */
enum status sweep_check(struct sweep *o, const char *name, struct report *report);
/* The first of them that ended well is run again, to see that they are of this deck as well. */
enum status sweep_compare(struct sweep *o, const char *name, struct arena *life, struct report *report);

/* Rows go to the stream in the order of the points; what ends it early has those that were done, in that order. */
enum status sweep_run(struct sweep *o, enum table_form form, struct stream *stream, struct arena *life,
                      struct report *report);

#endif
