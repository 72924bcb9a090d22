/* auto_parts.h -- what the files of auto.h share.
 *
 *     auto.c        what a deck leaves open, the race, what is taken
 *     auto_field.c  who takes part
 *     auto_sizes.c  steps that are chosen once
 *     auto_words.c  what is taken, in words
 */
#ifndef FMDSUB_STUDY_AUTO_PARTS_H
#define FMDSUB_STUDY_AUTO_PARTS_H

#include "study/quick.h"
#include "study/race.h"

enum { MOST_RACERS = 40 };
enum { AUTO_LEAST = 100 }; /* evaluations of trials that pay, and of a run in which a relay does */
enum { AUTO_QUOTA = 30 };  /* and of a first round */

struct choice {
    struct scene *scene;
    bool any_scheme, any_fast;
    double tolerance; /* that all aim at */
    double step;      /* the deck's, where it rules; NAN: it does not */
    double budget, foretold;
    double usual;      /* foretold of what is taken without trials, in place of dopri5 */
    struct racer *eye; /* that looks at the motion */
    double eye_hopes;  /* the work that it would take, to the tolerance given or the usual one */
    double looked;     /* its work, where it does not race */
    double first;      /* as long as its steps are at the start, once they do not grow [s]; 0: they do */
    double stiff;      /* what the quickest small motion turns by in the run [rad] */
    bool quiet;        /* and nothing has been seen of it */
    bool bounded;      /* it is what keeps the steps of an explicit scheme short */
    struct quick quick;
    int ncut;
    struct quick_cut cut[QUICK_CUTS];
    int n;
    struct racer *racer[MOST_RACERS]; /* [n] the first is what is taken without trials */
    struct diags *diags;
    struct arena *life, *own;
};

/* A key of 'integrate' that the deck gives; NULL: it does not. */
const struct node *auto_named(const struct scene *scene, const char *key);
/* The least that a run of that kind takes, in evaluations, where the quickest small motion turns by so much in it [rad]. */
double auto_least(const struct stepper_kind *kind, double stiff);
/* Are its steps as long as that quickest motion lets them be, whatever else moves? */
bool auto_bounded(const struct racer *r, double stiff);
/* What order 8 takes in a run of which dopri5 takes so much work, going by what most runs take; more than that: it does not pay. */
double auto_higher_order(const struct choice *o, double work);
/* One more, by a tolerance or a step; NAN: not by that.  cut: what is fast; NULL: what is in the deck.  NULL: it cannot be
 * opened, or there are too many. */
struct racer *auto_add(struct choice *o, const char *name, double tolerance, double step, int ratio,
                       const struct quick_cut *cut);
/* The same with steps of about so many times its own, that records are ends of. */
struct racer *auto_add_sized(struct choice *o, const struct racer *r, double by);
/* Two rates by steps of order 4, as long as what has been seen of the motion asks for, where that may take less than `most`
 * evaluations. */
void auto_add_fourths(struct choice *o, double most);
/* These, beside the best [evaluations], by steps that hold the tolerance.  They do not race: what they take is known from their
 * first steps on, which the others must not be measured by. */
void auto_size_fourths(struct choice *o, double best);
/* All the others but those whose first step is dear. */
void auto_add_all(struct choice *o);
/* Schemes of full matrices, where a few factorizations are little beside what may be spent. */
void auto_add_full(struct choice *o, double most);

/* Is it a relay that is taken in place of r?  One scheme for all of the run is right where that is short. */
bool auto_takes_turns(const struct choice *o, const struct racer *r);
/* What the relay is told of the scene. */
void auto_plan_relay(struct step_options *how, const struct choice *o, const struct racer *r);
/* What would be taken with r; what is fast then, by name: the first few. */
const char *auto_words(const struct choice *o, const struct racer *r, struct arena *life);
const char *auto_names(const struct racer *r, struct arena *life);

#endif
