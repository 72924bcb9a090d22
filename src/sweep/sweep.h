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
    struct deck_options options; /* common to all points */
    struct pointset points;
    struct wanted wanted;
    bool times;         /* with a column of CPU seconds */
    long shard, shards; /* runs points shard, shard + shards, ..., counted from 0 */
    int jobs;           /* processes at once; 0: as many as there are processors */
    FILE *log;          /* messages of points that failed; NULL: none */
    FILE *progress;     /* a terminal; NULL: none */
    struct sheet sheet; /* rows that are in it already are not run again */
    long failed;        /* points that did not end with 0 */
};

/* Finds the paths of the factors in the deck: parameters by their names, else paths as --set takes them. */
enum status sweep_resolve(struct sweep *o, const struct deck *deck, struct arena *life, struct report *report);

/* The columns of the table. */
void sweep_head(struct sweep *o, struct arena *life);
/* Checks that the rows in the sheet are of these points, and drops those that ended with 6 or more.  name: of their
 * file. */
enum status sweep_check(struct sweep *o, const char *name, struct report *report);
/* Runs the first of them that ended with 0 again, to see that they are of this deck and these settings. */
enum status sweep_compare(struct sweep *o, const char *name, struct arena *life, struct report *report);

/* Runs the points and writes their rows in order.  If it is ended early, the rows done so far have been written. */
enum status sweep_run(struct sweep *o, enum table_form form, struct stream *stream, struct arena *life,
                      struct report *report);

#endif
