/* outcome.h -- one run of a deck as it is compared: its records in memory, its counts, how it ended. */
#ifndef FMDSUB_STUDY_OUTCOME_H
#define FMDSUB_STUDY_OUTCOME_H

#include "sim/sim.h"

struct outcome {
    int n, rows, capacity;
    double *x; /* [rows x n] by row, t first */
    struct outcome_column {
        const char *name;
        int rate;      /* 1: a fast coordinate, 0: a slow one, -1: something else */
        bool compared; /* the deck asks for it, and it is of the motion */
    } * column;        /* [n] */
    struct effort effort;
    double work; /* evaluations of all bodies, matrices at their price in these: counts, whatever the machine */
    double cpu;  /* [s] */
    double energy_share;
    enum status status; /* OK, E_VERDICT, or why it stopped: report */
    struct report report;
    struct arena *life;
};

/* The deck's plan by a scheme that chooses its own steps, records `every` so often [s]; how becomes its options. */
struct integrate outcome_plan(struct step_options *how, const char *scheme, double tolerance, const struct scene *scene,
                              double every);

/* Independent coordinates of the scene. */
enum status outcome_size(int *n, const struct scene *scene, const struct integrate *plan, struct diags *diags,
                         struct report *report);

/* A deck error (a scheme that does not exist, a step that does not fit the records) is passed on; a run that stops is
 * an outcome. */
enum status outcome_run(struct outcome *o, const struct scene *scene, const struct integrate *plan, const char *version,
                        struct diags *diags, struct arena *life, struct report *report);

/* Rows r [2] of a and of b at the next common time behind those; false: there is none. */
bool outcome_next(int *r, const struct outcome *a, const struct outcome *b);

static inline const double *outcome_row(const struct outcome *o, int row)
{
    return o->x + (size_t)row * (size_t)o->n;
}

#endif
