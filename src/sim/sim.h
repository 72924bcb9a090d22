/* sim.h -- one run, from a scene to a stream of records.
 *
 * sim_open builds everything and finds the consistent accelerations at t = 0; sim_run steps to the end and
 * tells a sink what is due.  A step that fails is halved, never accepted; below 2^-10 of the deck's major
 * step the run stops.  Nothing partial passes for whole: the status and the summary tell how it ended. */
#ifndef FMDSUB_SIM_SIM_H
#define FMDSUB_SIM_SIM_H

#include <stdio.h>

#include "engine/stepper.h"
#include "ledger/ledger.h"
#include "model/flat.h"
#include "out/meant.h"
#include "out/sink.h"
#include "scene/scene.h"
#include "sim/catalogue.h"
#include "sim/lateral.h"
#include "sim/neglects.h"
#include "sim/trust.h"
#include "system/idle.h"

enum sim_progress { PROGRESS_NEVER, PROGRESS_ALWAYS };

/* What the caller may say besides the deck. */
struct sim_options {
    const char *version;
    FILE *log;      /* plan line, progress, end summary; NULL: silent */
    FILE *warnings; /* those of the run; NULL: log */
    enum sim_progress progress;
    const double *rest; /* where this scene stands at rest, as another run of it has found it [nq of the model]; NULL */
    bool drawn;   /* in the deck's own space, even where the motion stays in a plane: small motions are looked at */
    bool general; /* ratio 1: the sub-cycling stepper itself, not the single-rate one it equals */
    bool
        counting; /* columns are all coordinates, rates and measures, then those that the deck names, and it runs to the
                    * latest end: no condition ends it (study, modes) */
};

/* events.c: what a run looks for at the end of every major step. */
struct watch {
    unsigned needs;             /* SEE_... */
    const struct origin **slot; /* [nslot] of the condition; NULL: there is none */
    double *value;              /* [nslot] */
    bool was;                   /* the condition, last looked at */
    bool met;                   /* it has ended the run */
    int nrange;
    struct watched_range {
        const struct scene_joint *joint;
        const char *name; /* of the coordinate */
        const struct origin *place;
        int side;      /* -1 below, 0 inside, 1 above */
        bool reported; /* to people */
    } * range;         /* [nrange] */
};

/* formulas.c: a column that is an expression of others. */
struct formula {
    const struct expr *expr;
    int n, capacity;
    int *from; /* [n] the columns that it reads, of the catalogue */
    double *x; /* [n] their values */
};

enum { NEUTRAL_NAMES = 3 };
struct neutral {
    int n;                 /* motions that a static start does not hold */
    int at[NEUTRAL_NAMES]; /* a coordinate of each of the first */
};

struct sim {
    const struct scene *scene;
    const struct model *model;
    struct sim_options options;
    struct integrate plan; /* as run: scheme, step, ratio, until */
    struct system *system;
    struct model_spatial spatial; /* why a spatial model's motion does not stay in a plane */
    const struct model *whole;    /* with the modes that stay 0, which `model` is without; NULL: there are none */
    const int *from_whole;        /* [n of it] which of the model's coordinates its are; -1: left out */
    bool flat;                    /* it does, and steps are taken there */
    struct lateral lateral;       /* does it still stand there? */
    struct idle idle;             /* turns that move no mass */
    struct neutral neutral;
    struct stepper stepper;
    struct state x;
    bool filled_in;      /* the tolerance is not the deck's */
    struct guess guess;  /* of the first step, where a tolerance makes steps the scheme's own */
    long rejected;       /* steps, when such a scheme's last record was due */
    struct single *look; /* records between the ends of such steps */
    bool noting;         /* there are watches of the step */
    bool onto_records;   /* of a scheme that chooses its steps: it steps onto records, as it cannot look back */
    bool looks_at_once;  /* energies are looked at as each step is booked: watches read what that leaves */
    bool looks_always;   /* energies are looked at after every step */
    bool undone;         /* steps may be: */
    bool watched;        /* what their forces do is looked at, */
    struct passing_look *passing; /* or whether they pass over a touch; NULL: it is not */
    struct single *keep;          /* then the state before, */
    struct ledger kept;           /* and the ledger */
    double kept_t;                /* [s] when it was */
    int went_back;                /* from the last event, to step onto the next */
    struct ledger ledger;
    struct catalogue catalogue;
    int nformula;
    struct formula *formula; /* [nformula] */
    struct selection chosen;
    int ncounted;           /* of these the first ones are not the deck's own choice, while there is one */
    struct column *columns; /* [chosen.n] */
    double *row;            /* [chosen.n] */
    unsigned needs;         /* SEE_... */
    long majors, every;     /* major steps in all; between records */
    long before;            /* major steps from t = 0 to the start, where it is the end of one */
    struct meant origin;    /* when steps are counted from [s]: 0, or the start */
    struct meant step;      /* plan.step as the deck means it */
    struct watch watch;
    double last_h;       /* minor step of the last step */
    bool cut;            /* and it ended where no step of a longer run does */
    const char *forgets; /* why what is in the state besides coordinates is left there; NULL: it is not */
    long rows;
    double recorded; /* [s] the last of these */
    bool pulses;     /* loads come and go within a step */
    struct trust trust;
    struct neglects neglects;
    double min_h; /* smallest minor step taken */
    int nrotation;
    int *rotation;       /* [nrotation] ball and free joints */
    double turn, t_turn; /* their farthest turn in one step [rad], when */
    int turn_joint;      /* and whose */
    int ndeflection;
    struct deflection {
        int body, node; /* of the model: flexible; its node farthest from the reference */
        double size;    /* how far [m] */
        double most, t; /* largest displacement there at the end of a step [m], when */
    } * deflection;     /* [ndeflection] */
    int nspin;
    struct turning {
        int body;                /* of the model: flexible, without geometric stiffening */
        double most, axis[3], t; /* fastest turn of its frame at the end of a step [rad/s], about what, when */
    } * spin;                    /* [nspin] */
    int ntilt;
    struct tilting {
        int force;
        double most, t; /* largest tilt at the end of a step [rad], when */
    } * tilt;           /* [ntilt] */
    int negative;       /* first body with an inertia that is negative about an axis; 0: none */
    double *M;          /* [n x n] where there is one */
    int npass;
    struct passing {
        int force;   /* of the model: along a distance */
        double d[3]; /* from its first end to its second at the end of the last step, world axes [m] */
        bool reported;
    } * pass;      /* [npass] */
    double *press; /* [rows of contacts] their forces where a record is due */
    int njump;
    struct jumping {
        int loop;     /* of the model: a drive that may jump */
        double t;     /* where it was looked at last, */
        double x[3];  /* it and its rates there */
        double most;  /* its largest value so far [m] or [rad] */
        double clear; /* it is known not to jump before that time */
        bool reported;
    } * jump; /* [njump] */
    struct {
        bool *borne; /* [ncontact] at the last look it rubbed or was closed */
        int *above;  /* [nbody] bodies that hand impulses on to each other, as trees */
        bool met;    /* the rate of a drive has jumped meanwhile, */
        bool told;   /* which this run, not one that it goes on from, has said */
    } corner;
    struct {
        bool told, acted;
        bool broken; /* beside energies that are there, and motion that the step does not resolve */
        bool taking,
            taken;        /* the scheme has damped away much, and that of motion that the step does not resolve, from */
        double t_taken;   /* [s] on */
        double t, there;  /* the most energy that has been there [J] */
        long looks, next; /* at what moves there; that with which the next one is due */
        int depth,
            calm;    /* where it acts: halvings that major steps begin with, and major steps since the last one more */
        int most;    /* of these halvings */
        long parted; /* major steps that were taken in parts */
        bool may_damp;
        double t_damped; /* [s] when damping set in, if it did */
    } guard;             /* the balance has been lost, when */
    struct run_place {
        bool resumed; /* the run goes on from a checkpoint */
        long step;    /* steps that have been taken: major ones, or those that a scheme chooses */
        long due;     /* of such a scheme: the record that is due next, */
        double seen;  /* and how far drives have been looked at */
    } place;          /* at a checkpoint */
    struct {
        struct stream *stream; /* of records; NULL: no checkpoints are written */
        const char *format;
        double next; /* [s] */
    } saves;
    struct arena *beside;   /* of watches over what is left out; NULL: there is nothing */
    double cpu;             /* seconds of stepping, without records */
    int warnings;           /* told in the course of the run and at its end */
    struct trouble trouble; /* why it stopped */
    enum status status;     /* how it ended */
};

/* Builds a run of scene as plan says (the deck's own, or changed by a study).  Deck errors go to diags and give E_DECK;
 * a right deck that cannot start gives E_MODEL with a message. */
enum status sim_open(struct sim *sim, const struct scene *scene, const struct integrate *plan,
                     const struct sim_options *options, struct diags *diags, struct arena *life, struct report *report);

/* Steps to the end.  sink may be NULL.  Signals (base/stop.h) end it after a major step. */
enum status sim_run(struct sim *sim, struct sink *sink, struct report *report);

/* Writes coordinates and rates at the end, for `initial: {from: FILE}`. */
struct stream;
enum status sim_write_state(struct sim *sim, struct stream *stream, struct report *report);

/* What closes loops, and drives, for `fmdsub check`. */
struct closure {
    const char *name, *kind, *first, *second; /* bodies; of gears and racks coordinates */
    int equations, redundant;
    bool unique; /* its reactions */
};
struct closures {
    int n;
    struct closure *closure; /* [n] */
    int nloose;
    const char **loose; /* [nloose] joints of the tree whose reactions are not unique */
    int components, equations, rank;
    double pivots;        /* least over largest pivot of C_qd */
    double drawn, closed; /* max |C| as drawn, and now, in lengths */
    double length;        /* of the mechanism [m] */
};
/* n = 0: none. */
void sim_closures(struct closures *o, const struct sim *sim, struct arena *life);
/* What `initial: {assemble: true}` has changed, in words; nothing without it. */
void sim_print_assembly(const struct sim *sim, FILE *to);
/* What `initial: static` has left where it was, in words; nothing where all is held. */
void sim_print_neutral(const struct sim *sim, FILE *to);

/* K [n x n] := K without what it says of turns that move no mass, where the run stands (idle_clear()). */
void sim_clear_idle(const struct sim *sim, double *K);

/* Mass, and centre of mass as the bodies stand [3], world axes. */
enum status sim_mass(double *mass, double *centre, struct sim *sim, struct report *report);

/* The chosen columns [chosen.n] at another state at the run's time; the run stays.  q moved by dx [n]. */
enum status sim_row(double *row, struct sim *sim, const double *q, const double *v, struct report *report);
void sim_move(const struct sim *sim, double *q, const double *dx);

/* May forces or drives bend or jump where nobody knows of it beforehand: by the state, not at known times? */
bool sim_bends_unseen(const struct sim *sim);

/* Is chosen column i asked for by the deck, and of the motion, so that two runs may be compared by it? */
bool sim_column_compared(const struct sim *sim, int i);
/* Of chosen column i: 1: a fast coordinate, 0: a slow one, -1: something else. */
int sim_column_rate(const struct sim *sim, int i);
/* A usual change of such a coordinate: 1 rad, the mechanism's length [m]; 0: of any other column, and of modes. */
double sim_column_usual(const struct sim *sim, int i);

/* "planar", "spatial", "spatial, in a plane". */
const char *sim_space(const struct sim *sim);
/* traits.c: is it stepped in a plane?  Trees whose momenta are kept to round-off.  Largest rate at which a flexible body turns
 * now [rad/s], 0 where it cannot be told. */
bool sim_in_plane(const struct sim *sim);
int sim_floating(const struct sim *sim);
double sim_spin(struct sim *sim);

/* What small motions and equilibria leave out is refused where there are rigid contacts; what: "modes". */
enum status sim_without_contacts(const struct sim *sim, const char *what, struct report *report);

/* The run's settings and its summary as facts, for sinks and for people.  The summary has at most so many. */
enum { MOST_SIM_FACTS = 40 };
int sim_settings(const struct sim *sim, struct pair *facts, int most);
int sim_facts(const struct sim *sim, struct pair *facts, int most);

/* The name of coordinate or rate number i of the state's v. */
const char *sim_coordinate_name(const struct sim *sim, int i);
/* The same by its place in the model's v: with loops, v holds the independent ones only. */
const char *sim_place_name(const struct sim *sim, int iv);

#endif
