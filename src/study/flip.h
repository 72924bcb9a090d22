/* flip.h -- a deck run with an effect and without it: what that costs, and what it changes. */
#ifndef FMDSUB_STUDY_FLIP_H
#define FMDSUB_STUDY_FLIP_H

#include "sim/sim.h"

struct flip {
    int n, rows, capacity;
    double *x;              /* [rows x n] records */
    struct column *columns; /* [n] */
    bool *compared;         /* [n] of the motion */
    double seconds;         /* that its counts stand for, see price.h */
    double steps;           /* major ones */
    double until;           /* when it ended [s] */
    double spin;            /* fastest turn of a flexible body's frame at a record [rad/s] */
    struct sim sim;
    enum status status; /* OK, E_VERDICT, or why it has stopped */
};

/* Of scene as its plan says, to `until` (0: its end).  Fails where it does not open. */
enum status flip_run(struct flip *o, const struct scene *scene, double until, struct diags *diags, struct arena *life,
                     struct report *report);

/* The largest change of a column over its largest value in a, over the time that both ran, and whose; NULL: there is no
 * column to compare. */
double flip_change(const char **column, const struct flip *a, const struct flip *b);

#endif
