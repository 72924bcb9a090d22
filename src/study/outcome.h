/* outcome.h -- one run of a deck as it is compared: its records in memory, its counts, how it ended. */
#ifndef FMDSUB_STUDY_OUTCOME_H
#define FMDSUB_STUDY_OUTCOME_H

#include "sim/sim.h"
#include "study/price.h"

/* What is known of a deck before it is run. */
struct subject {
    const struct scene *scene;
    const char *version;
    double until; /* [s] end of all runs */
    double every; /* [s] between records */
    int n, ns;    /* independent coordinates; of these fast */
    int ncolumn;
    struct outcome_column {
        const char *name, *unit;
        int rate;      /* 1: a fast coordinate, 0: a slow one, -1: something else */
        bool compared; /* the deck asks for it, and it is of the motion */
        double usual;  /* a usual change of a coordinate; 0: not known */
    } * column;        /* [ncolumn] */
    struct price price;
    const double *rest; /* where the scene stands at rest, if that is its start: found once; NULL */
    struct diags *diags;
};

struct outcome {
    int n, rows, capacity;
    double *x; /* [rows x n] by row, t first */
    struct effort effort;
    double reached; /* [s] of the motion */
    double seconds; /* that its counts stand for */
    double work;    /* the same in evaluations of all bodies */
    double cpu;     /* [s] */
    double energy_share;
    bool over;          /* it was stopped on the way, since its work passed what it may take */
    enum status status; /* OK, E_VERDICT, or why it stopped: report */
    struct report report;
};

/* Opens the deck once.  rest: of a run of it that is open, see struct sim_options; NULL: there is none. */
enum status subject_open(struct subject *o, const struct scene *scene, const char *version, const double *rest,
                         struct diags *diags, struct arena *life, struct report *report);

/* [sim->chosen.n] of a run that is open. */
struct outcome_column *outcome_columns(const struct sim *sim, struct arena *life);
bool same_unit(const struct outcome_column *a, const struct outcome_column *b);

/* A way of running the deck: one scheme by a tolerance, or by a step and a ratio; NAN: not by that. */
struct setting {
    const struct stepper_kind *kind;
    double tolerance, step;
    int ratio;
    int order; /* of its steps; 0: the deck's, or what the tolerance is for */
};

/* Of one scheme at one ratio and order? */
bool setting_together(const struct setting *a, const struct setting *b);

/* Does the kind choose its steps by a tolerance? */
bool by_tolerance(const struct stepper_kind *kind);

/* The deck's plan changed so; how becomes its options. */
struct integrate outcome_plan(struct step_options *how, const struct setting *setting, const struct subject *subject);

/* A deck error that the setting brings, such as a step that does not fit the records, is told in the subject's diags. */
enum status outcome_check(const struct setting *setting, const struct subject *subject, struct report *report);

/* Until its counts pass `most` seconds.  A run that stops is an outcome. */
enum status outcome_run(struct outcome *o, const struct setting *setting, double most, const struct subject *subject,
                        struct arena *life, struct report *report);

/* The same, until `enough` of it is there, too, or it is `hopeless`: asked after every row, the latter every so many steps,
 * too, when o->seconds stand for the counts so far; NULL: not asked. */
struct outcome_watch {
    bool (*enough)(const void *self, const struct outcome *o);
    bool (*hopeless)(const void *self, const struct outcome *o);
    const void *self;
};
enum status outcome_watched(struct outcome *o, const struct setting *setting, double most,
                            const struct outcome_watch *watch, const struct subject *subject, struct arena *life,
                            struct report *report);

/* A row x [n] more. */
void outcome_keep(struct outcome *o, const double *x, struct arena *life);

/* Rows r [2] of a and of b at the next common time behind those; false: there is none. */
bool outcome_next(int *r, const struct outcome *a, const struct outcome *b);

static inline const double *outcome_row(const struct outcome *o, int row)
{
    return o->x + (size_t)row * (size_t)o->n;
}

#endif
