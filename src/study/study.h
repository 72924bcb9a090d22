/* study.h -- what accuracy costs: one deck run by several schemes, ratios, steps and tolerances.
 *
 * Errors are against a reference (reference.h), at the instants that a run's records have in common with its: of each of the
 * deck's columns over its range, the worst one named, and of the joint coordinates over their largest value, the fast
 * ones and the slow ones apart.  What a run costs is counted (price.h), in evaluations of all bodies; times stand beside and
 * decide nothing.  So does the budget: two studies of one deck differ in their times only. */
#ifndef FMDSUB_STUDY_STUDY_H
#define FMDSUB_STUDY_STUDY_H

#include <stdio.h>

#include "study/reference.h"

struct study_row;

struct study_options {
    const char *version;
    FILE *log;      /* the reference, what is left out, and why; NULL: silent */
    FILE *progress; /* a terminal; NULL: none */
    double budget;  /* [s] of a machine like that of price.c; INFINITY: none */
    /* What is asked for; none: what makes sense for the deck. */
    int nscheme, nratio, nstep, ntolerance;
    const struct stepper_kind *const *scheme; /* [nscheme] */
    const int *ratio;                         /* [nratio] for schemes of two rates; the others run at 1 */
    const double *step;                       /* [nstep] minor steps [s] */
    const double *tolerance;                  /* [ntolerance] for schemes that choose their own steps */
    int repeats;                              /* times are the least of so many; 0: none is taken; -1: as it pays */
    /* Required.  Each row when it is done; self is the caller's. */
    enum status (*done)(void *self, const struct study_row *row, struct report *report);
    void *self;
};

/* A run. */
struct study_row {
    struct setting setting;
    struct errors errors;
    const char *worst, *unit; /* of that column; "": none */
    double uncertain;         /* the reference's in that column, as a share of its range */
    bool doubtful;            /* the error is within ten times that */
    double seconds, work;     /* by its counts: predicted; in evaluations */
    double cpu;               /* [s]; NAN: not taken */
    struct effort effort;
    double energy;
    enum status status;
};

/* Settings that were not run, from this one on. */
struct study_gap {
    struct setting from;
    int chain;   /* of the grid */
    bool all;    /* nothing of this scheme was run to its end */
    bool budget; /* it is not in the budget; else the reference itself costs less */
    double work; /* that it would take, or has taken when it was stopped */
};

struct study {
    struct subject subject;
    struct reference reference;
    int nrow, rows;
    struct study_row *row; /* [nrow] */
    int ngap, gaps;
    struct study_gap *gap; /* [ngap] */
    struct study_row *own; /* of the deck's own setting; NULL: it has none, or was not run */
    double fastest;        /* vibration at the start [rad/s]; 0: not known */
    struct arena *life;
};

/* What a signal ends has the rows that were done. */
enum status study_run(struct study *o, const struct scene *scene, const struct study_options *options,
                      struct diags *diags, struct arena *life, struct report *report);

/* The row of the least work whose error is at most `error`; NULL: there is none. */
const struct study_row *study_pick(const struct study *o, double error);
/* By what a further digit multiplies the work of the row's scheme, from its coarsest and its finest row; NAN: unknown. */
double study_digit(const struct study *o, const struct study_row *of);
/* answer.c: what the rows say, in sentences. */
void study_answer(const struct study *o, FILE *to);
/* The part of the deck's run in which errors were measured. */
double study_share(const struct study *o);
/* The row as lines of a deck. */
void study_print_pick(const struct study *o, const struct study_row *row, FILE *to);
/* "newmark at tolerance 1e-4" */
void study_print_setting(const struct setting *setting, FILE *to);

#endif
