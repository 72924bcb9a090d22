/* wanted.h -- numbers of a run that a sweep keeps: max(arm.root.bending), last(tip.y), rms(tip.y - 1).
 *
 * A function of one column, or of an expression of columns, over the records of the run; mean and rms are by time, with
 * straight lines between records. */
#ifndef FMDSUB_SWEEP_WANTED_H
#define FMDSUB_SWEEP_WANTED_H

#include "base/arena.h"
#include "base/status.h"
#include "out/columns.h"

struct want {
    const char *text;    /* "max(arm.root.bending)" */
    const char *column;  /* of the record */
    const char *formula; /* that it is to be; NULL: a column of the catalogue */
    int kind, index;     /* index: in the record */
};

struct wanted {
    int n;
    struct want *want; /* [n] */
};

/* "max(a.b), last(t)" */
enum status wanted_read(struct wanted *o, const char *list, struct arena *life, struct report *report);
/* last() of all of these but the first. */
void wanted_last(struct wanted *o, const struct column *columns, int n, struct arena *life);

/* A setting that makes the deck write what is wanted: output.columns=['t', ...]. */
const char *wanted_setting(const struct wanted *o, struct arena *life);
/* Where columns [n] of a record are. */
enum status wanted_find(struct wanted *o, const struct column *columns, int n, struct report *report);

/* So far in one run. */
struct tally {
    long rows;
    double t, first, last, least, most, sum, squares, time;
};
/* tally [o->n], zeroed before the first record x at time x[0]. */
void wanted_add(struct tally *tally, const struct wanted *o, const double *x);
double wanted_value(const struct tally *tally, const struct want *want);

#endif
