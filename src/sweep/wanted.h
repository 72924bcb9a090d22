/* wanted.h -- the numbers of a run that a sweep keeps: max(arm.root.bending), last(tip.y), rms(tip.y - 1).
 *
 * Each is a function of one column, or of an expression of columns, over the records of the run; mean and rms are
 * over time, with straight lines between records. */
#ifndef FMDSUB_SWEEP_WANTED_H
#define FMDSUB_SWEEP_WANTED_H

#include "base/arena.h"
#include "base/status.h"
#include "out/columns.h"

struct want {
    const char *text;    /* "max(arm.root.bending)" */
    const char *column;  /* its name in the record */
    const char *formula; /* the expression that this column is to be; NULL: it is a column of the catalogue */
    int kind, index;     /* the function; number of the column in the record */
};

struct wanted {
    int n;
    struct want *want; /* [n] */
};

/* From a list, "max(a.b), last(t)".  E_USAGE: it is wrong. */
enum status wanted_read(struct wanted *o, const char *list, struct arena *life, struct report *report);
/* Without a list: last() of columns [n], except the first, t. */
void wanted_last(struct wanted *o, const struct column *columns, int n, struct arena *life);

/* The setting with which a deck writes these columns: output.columns=['t', ...]. */
const char *wanted_setting(const struct wanted *o, struct arena *life);
/* Finds them among the columns [n] of a record. */
enum status wanted_find(struct wanted *o, const struct column *columns, int n, struct report *report);

/* One number, while its run is under way. */
struct tally {
    long rows;
    double t;                        /* of the last record [s] */
    double first, last, least, most; /* values */
    double sum, squares, time;       /* integrals of the value and of its square over time; that time [s] */
};
/* Takes in a record x, at time x[0].  tally [o->n], zeroed before the first. */
void wanted_add(struct tally *tally, const struct wanted *o, const double *x);
/* The number, after the last record. */
double wanted_value(const struct tally *tally, const struct want *want);

#endif
