/* rows.h -- the rows of a study on their way out, each when it is done: a table for people, CSV, NDJSON or JSON.
 *
 * csv      scheme,tolerance,step,ratio,error,worst,error_fast,error_slow,work,cpu,cpu_ratio,slow,fast,factors,energy,
 *          status,uncertain,unit,order; a number that there is none of is an empty field
 * ndjson   one object a line with the same members, null for none
 * json     {"rows":[ ... ]} of these */
#ifndef FMDSUB_STUDY_ROWS_H
#define FMDSUB_STUDY_ROWS_H

#include "out/stream.h"
#include "out/table.h"
#include "study/study.h"

struct rows {
    struct table_line line; /* its form */
    bool absolute;          /* errors in the unit of the worst column */
    struct stream *stream;
    bool begun;
    int n;        /* written */
    double first; /* CPU time of the first row */
};

/* For study_options.done; the heading goes before the first. */
enum status rows_put(void *self, const struct study_row *row, struct report *report);
/* Of a study that ended so: one that failed before its first row has no heading either. */
enum status rows_end(struct rows *o, enum status status, struct report *report);

#endif
