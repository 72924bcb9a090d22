/* race.h -- ways of stepping a deck that are tried side by side, each on an
 * open run of its own, and foretold by counts what the whole run would take. */
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
    double unit;              /* what all work is counted in: an evaluation of the deck as it
                  stands [s] */
    double least;             /* that the whole run takes, whatever is seen of it */
    double work;              /* so far */
    double t_mark, work_mark; /* where the last round of it began */
    long steps;               /* since then */
    double a_step;            /* work of its cheapest step; 0: there was none */
    double t_last, work_last; /* where its last step began */
    double h_before;          /* the step before that; 0: there was none */
    bool out;                 /* it does not open, has stopped, or is beaten */
};

/* Opens it; o->out where that cannot be.  every: [s] between the ends of its
 * major steps that have to be, 0: any. */
void racer_open(struct racer *o, const struct setting *setting, const struct scene *scene, struct diags *diags,
                struct arena *life);
/* On until its work is `most`; seen: at the end of every step, NULL: nobody
 * looks. */
void racer_go(struct racer *o, double most, void (*seen)(void *self, const struct sim *sim), void *self);
/* What the whole run is going to take, in evaluations. */
double racer_foretold(const struct racer *o);
/* The same by its last step, or the one that it will try next, if that is less: steps may still grow. */
double racer_hope(const struct racer *o);
/* Do its steps still grow, or are they too few to tell? */
bool racer_grows(const struct racer *o);
/* Has it seen nothing yet of what is going to keep its steps short? */
bool racer_quiet(const struct racer *o);

#endif
