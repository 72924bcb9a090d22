/* curves.h -- records of a run, or of a CSV file, as `fmdsub plot` draws them. */
#ifndef FMDSUB_CLI_CURVES_H
#define FMDSUB_CLI_CURVES_H

#include "cli/cli.h"

struct curves {
    const char *file; /* as it was named */
    int n, rows, capacity;
    struct column *column; /* [n] the first is what the others are drawn over; unit NULL: not known */
    double *x;             /* [rows x n] by row */
};

/* Of each of the request's words: decks are run, those that end in .csv read, each in a process of its own that is confined
 * to the file's folder.  A run that stops on the way is drawn as far as it came, and fails after that: status. */
enum status curves_make(struct curves *o, const struct request *request, enum status *ended, struct arena *life,
                        struct report *report);

#endif
