/* verify.h -- a run, and a second one at half its step or a tenth of its tolerance: what differs, column by column.
 *
 * A sink between the run and where it writes to: it keeps the rows, and makes the second run before it lets the summary
 * pass, with what differs in it. */
#ifndef FMDSUB_STUDY_VERIFY_H
#define FMDSUB_STUDY_VERIFY_H

#include "study/reference.h"

struct verify {
    struct sink sink; /* for the run */
    struct sink *to;
    struct sim *sim;     /* the run; opened when sink's meta comes */
    struct diags *diags; /* those of the second run: all warnings were told of the first */
    struct arena *life;
    struct outcome first;
    struct reference second;
    struct subject subject;
    double finer;    /* the second run's step [s], or its tolerance */
    int common;      /* records at the same instants */
    double *differs; /* [columns] largest there */
    bool done;
    int worst; /* column; -1: none is compared */
};

void verify_open(struct verify *o, struct sim *sim, struct sink *to, struct diags *diags, struct arena *life);
/* The table. */
void verify_print(const struct verify *o, FILE *to);

#endif
