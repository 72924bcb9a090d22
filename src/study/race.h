/* race.h -- settings of schemes tried side by side on a deck, each on an open run of its own; from the evaluations
 * that it has taken so far, what the whole run would take is extrapolated. */
#ifndef FMDSUB_STUDY_RACE_H
#define FMDSUB_STUDY_RACE_H

#include "study/outcome.h"

struct racer {
    struct setting setting;
    int nfast;
    struct scene_choice *fast; /* [nfast] what takes its minor steps */
    struct scene scene;
    struct integrate plan;
    struct step_options how;
    struct sim sim;
    struct price price;
    double unit;              /* unit of all work: an evaluation of the deck as it stands [s] */
    double least;             /* lower bound of the work of the whole run [evaluations] */
    double work;              /* so far [evaluations] */
    double t_mark, work_mark; /* time [s] and work at which its last round began */
    long steps;               /* taken since then */
    double a_step;            /* work of its cheapest step; 0: it has taken none */
    double t_last, work_last; /* time [s] and work at which its last step began */
    double h_before;          /* length of the step before that [s]; 0: there was none */
    bool holds; /* steps chosen once: half of them have shown that they are as fine as the tolerance asks for */
    bool out;   /* it does not open, has stopped, or is beaten */
};

/* Opens a run with this setting; o->nfast, fast, unit and least are the caller's.  o->out: it cannot be opened. */
void racer_open(struct racer *o, const struct setting *setting, const struct scene *scene, struct diags *diags,
                struct arena *life);
/* Steps on until o->work is `most` or the run is at its end.  seen (NULL: none) is called at the end of every step. */
void racer_go(struct racer *o, double most, void (*seen)(void *self, const struct sim *sim), void *self);
/* Work of the whole run, extrapolated from its last round [evaluations]; INFINITY: it is out. */
double racer_foretold(const struct racer *o);
/* The same as if it went on with its last step, or with the one that it will try next, whichever is least: an
 * optimistic figure, as steps may still grow. */
double racer_hope(const struct racer *o);
/* Was its last step longer than the one before by more than 30 %? */
bool racer_grows(const struct racer *o);
/* Does the extrapolation fall so far below o->least that what keeps the steps short cannot have come yet? */
bool racer_quiet(const struct racer *o);

#endif
