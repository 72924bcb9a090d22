/* curves.h -- records of a run, or of a file, as `fmdsub plot` draws and `fmdsub diff` compares them. */
#ifndef FMDSUB_CLI_CURVES_H
#define FMDSUB_CLI_CURVES_H

#include "cli/cli.h"
#include "out/columns.h"

struct curves {
    const char *file; /* as it was named */
    int n, rows, capacity;
    struct column *column; /* [n] the first is what the others are drawn over; unit NULL: not known */
    double *x;             /* [rows x n] by row */
};

/* The column that is called so; -1: none. */
static inline int curves_find(const struct curves *o, const char *name)
{
    return columns_find(o->column, o->n, name);
}

/* Of each of the request's words: decks are run, files of records
 * (recorded.h) read, each in a process of its own that is confined
 * to the file's folder.  A run that stops on the way is kept as far as it came, and fails after that: ended.  fine: a
 * deck that says nothing else is given as many records as a picture wants. */
enum status curves_make(struct curves *o, const struct request *request, bool fine, enum status *ended,
                        struct arena *life, struct report *report);

/* As many records as a picture wants, unless the caller says how many: before the run is built, and behind that. */
struct sim;
void curves_refine(struct scene *scene, const struct request *request);
void curves_refine_steps(struct sim *sim, const struct request *request);

#endif
