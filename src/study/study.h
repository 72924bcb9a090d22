/* study.h -- what accuracy costs: one deck run by several schemes, ratios, steps and tolerances.
 *
 * Errors are against a reference (reference.h), at the instants that a run's records have in common with its: of each of the
 * deck's columns over its range, the worst one named, and of the joint coordinates over their largest value, the fast
 * ones and the slow ones apart.  What a run costs is counted, in evaluations of all bodies; times stand beside. */
#ifndef FMDSUB_STUDY_STUDY_H
#define FMDSUB_STUDY_STUDY_H

#include <stdio.h>

#include "out/table.h"
#include "study/reference.h"

struct study_options {
    const char *version;
    FILE *log; /* the reference and the answer in sentences; NULL: silent */
    int nscheme, nratio, nstep, ntolerance;
    const char *const *scheme; /* [nscheme] */
    const int *ratio;          /* [nratio] for schemes of two rates; the others run at 1 */
    const double *step;        /* [nstep] minor steps [s] */
    const double *tolerance;   /* [ntolerance] for schemes that choose their own steps */
    bool usual;                /* nobody has asked for these schemes: what is hopeless is left out */
    int repeats;               /* each run is timed so often; the least counts */
};

/* A run. */
struct study_row {
    const char *scheme;
    double tolerance, step; /* one of them; the other is NAN */
    int ratio;
    struct errors errors;
    const char *worst; /* name of the column */
    double uncertain;  /* the reference's in that column, as a share of its range */
    double work, cpu;
    struct effort effort;
    double energy;
    enum status status;
};

struct study {
    struct reference reference;
    int nrow, capacity;
    struct study_row *row; /* [nrow] */
    struct arena *life;
};

enum status study_run(struct study *o, const struct scene *scene, const struct study_options *options,
                      struct diags *diags, struct arena *life, struct report *report);

/* Columns: scheme, tolerance, step, ratio, error, worst, error_fast, error_slow, work, cpu, cpu_ratio, slow, fast, factors,
 * energy, status. */
struct table *study_table(const struct study *o, struct arena *life);

/* The row of the least work whose error is at most `error`; NULL: there is none. */
const struct study_row *study_pick(const struct study *o, double error);
/* answer.c: what the rows say, in sentences. */
void study_answer(const struct study *o, FILE *to);
/* The row as lines of a deck. */
void study_print_pick(const struct study_row *row, FILE *to);

#endif
