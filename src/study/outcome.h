/* outcome.h -- one run of a deck as it is compared: its records in memory, its counts, how it ended. */
#ifndef FMDSUB_STUDY_OUTCOME_H
#define FMDSUB_STUDY_OUTCOME_H

#include "sim/sim.h"
#include "study/price.h"

/* What is known of a deck before it is run. */
struct subject {
    const struct scene *scene;
    const char *version;
    double until; /* end of all runs [s] */
    double every; /* between records [s] */
    int n, ns;    /* independent coordinates; fast ones of these */
    int ncolumn;
    struct outcome_column {
        const char *name, *unit;
        int rate;      /* 1: a fast coordinate, 0: a slow one, -1: something else */
        bool compared; /* the deck asks for it, and it is of the motion */
        double usual;  /* a usual change of a coordinate; 0: not known */
    } * column;        /* [ncolumn] */
    struct price price;
    const double *rest; /* static equilibrium, if the scene starts there, found once; else NULL: struct sim_options */
    struct diags *diags;
};

struct outcome {
    int n, rows, capacity;
    double *x; /* [rows x n] by row, t first */
    struct effort effort;
    double reached;      /* time of the motion that it came to [s] */
    double seconds;      /* cost predicted from its counts [s] */
    double work;         /* the same in evaluations of all bodies */
    double cpu;          /* time that it took [s] */
    double energy_share; /* error of the energy balance, relative: ledger_share() */
    bool over;           /* it was broken off as its cost passed what it may be */
    enum status status;  /* OK, E_VERDICT, or why it stopped: report */
    struct report report;
};

/* Opens the deck once.  rest: of a run of it that is open, see struct sim_options; NULL: there is none. */
enum status subject_open(struct subject *o, const struct scene *scene, const char *version, const double *rest,
                         struct diags *diags, struct arena *life, struct report *report);

/* Columns [sim->chosen.n] of a run that is open. */
struct outcome_column *outcome_columns(const struct sim *sim, struct arena *life);
/* Are both in the same unit, or without one? */
bool same_unit(const struct outcome_column *a, const struct outcome_column *b);

/* A way of running the deck: a scheme with a tolerance, or with a step [s] and a ratio; the other is NAN. */
struct setting {
    const struct stepper_kind *kind;
    double tolerance, step;
    int ratio;
    int order; /* of its steps; 0: the deck's, or with a tolerance the scheme's own */
};

/* Are both of one scheme, ratio and order, so that errors over work lie on one curve? */
bool setting_together(const struct setting *a, const struct setting *b);

/* Does the kind choose its steps by a tolerance? */
bool by_tolerance(const struct stepper_kind *kind);

/* The deck's plan with this setting; *how is filled and becomes its options. */
struct integrate outcome_plan(struct step_options *how, const struct setting *setting, const struct subject *subject);

/* Can the deck be opened with it?  An error that the setting brings, such as a step that does not fit the records,
 * goes to the diags of the subject. */
enum status outcome_check(const struct setting *setting, const struct subject *subject, struct report *report);

/* Runs the deck, until the cost by its counts passes `most` [s].  A run that stops by itself is an outcome, too:
 * o->status. */
enum status outcome_run(struct outcome *o, const struct setting *setting, double most, const struct subject *subject,
                        struct arena *life, struct report *report);

/* The same, broken off also where `enough` records are there or the run is `hopeless`.  Both (NULL: not) are asked
 * after every row, `hopeless` also every step; o->seconds is up to date then. */
struct outcome_watch {
    bool (*enough)(const void *self, const struct outcome *o);
    bool (*hopeless)(const void *self, const struct outcome *o);
    const void *self;
};
enum status outcome_watched(struct outcome *o, const struct setting *setting, double most,
                            const struct outcome_watch *watch, const struct subject *subject, struct arena *life,
                            struct report *report);

/* Appends a row x [n]. */
void outcome_keep(struct outcome *o, const double *x, struct arena *life);

/* r [2]: rows of a and of b at a common time, -1 before the first; moves both on to the next one; false: there is
 * none. */
bool outcome_next(int *r, const struct outcome *a, const struct outcome *b);

static inline const double *outcome_row(const struct outcome *o, int row)
{
    return o->x + (size_t)row * (size_t)o->n;
}

#endif
