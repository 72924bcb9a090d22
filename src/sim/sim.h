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
    const double *rest; /* [nq of the model] static equilibrium of this scene that another run has found; NULL: none */
    bool drawn;         /* stay in the deck's own space even where the motion stays in a plane, for small motions */
    bool general;       /* ratio 1: the sub-cycling stepper itself, not the single-rate one that it equals */
    /* For study and modes: the columns are all coordinates, rates and measures, then those that the deck names, and no
     * condition ends the run before its latest end. */
    bool counting;
};

/* ---- what the parts of a run remember (sim/parts.h has their functions) ---------------------------------------- */

/* events.c: what a run looks for at the end of every major step. */
struct watch {
    unsigned needs;             /* EVALUATE_..., NEED_... */
    const struct origin **slot; /* [nslot] columns that the condition reads; NULL: there is no condition */
    double *value;              /* [nslot] */
    bool was;                   /* the condition at the last look */
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
    int *from; /* [n] the columns of the catalogue that it reads */
    double *x; /* [n] their values */
};

/* rest_neutral.c: motions that a static start does not hold. */
enum { NEUTRAL_NAMES = 3 };
struct neutral {
    int n;
    int at[NEUTRAL_NAMES]; /* a coordinate of each of the first */
};

/* deflections.c: of a flexible body. */
struct deflection {
    int body, node; /* of the model; the node farthest from the reference */
    double size;    /* its distance [m] */
    double most, t; /* largest displacement there at the end of a step [m], when [s] */
};

/* spins.c: of a flexible body without geometric stiffening. */
struct turning {
    int body; /* of the model */
    double most, axis[3],
        t; /* largest angular velocity of its frame at the end of a step [rad/s], its axis, when [s] */
};

/* tilts.c: of a bushing whose rotations are shared by convention. */
struct tilting {
    int force;
    double most, t; /* largest tilt at the end of a step [rad], when [s] */
};

/* passes.c: of a force along a distance. */
struct passing {
    int force;   /* of the model */
    double d[3]; /* from its first end to its second at the end of the last step, world axes [m] */
    bool reported;
};

/* jumps.c: of a drive whose value may jump. */
struct jumping {
    int loop;     /* of the model */
    double t;     /* last look [s] */
    double x[3];  /* value and its rates there */
    double most;  /* largest |value| so far [m] or [rad] */
    double clear; /* it is known not to jump before that time [s] */
    bool reported;
};

/* corners.c: drives whose rate jumps beside friction or closed contacts. */
struct cornering {
    bool *borne; /* [ncontact] rubbed or was closed at the last look */
    int *above;  /* [nbody] union-find forest of bodies that hand impulses on to each other */
    bool met;    /* the rate of a drive has jumped meanwhile, */
    bool told;   /* and this run, not one that it goes on from, has said so */
};

/* guard.c: the first loss of the energy balance, and what is done about it. */
struct guarding {
    bool told;        /* the loss has been told, */
    double t;         /* at this time [s] */
    bool broken;      /* the balance is off by more than delta of the energy in the system, beside unresolved motion */
    double there;     /* largest energy in the system so far [J] */
    bool taking;      /* numerical damping has taken more than delta of it, */
    bool taken;       /* of unresolved motion, which was told, */
    double t_taken;   /* since this time [s] */
    long stood;       /* major steps in which all works were near nothing */
    long looks, next; /* looks at unresolved motion so far; number of the next one that is due */
    /* Where the guard acts: major steps are halved from their start, then damped. */
    bool acted;  /* this has been told */
    int depth;   /* halvings with which major steps begin now, */
    int calm;    /* major steps since one had to be halved, */
    int most;    /* largest depth so far */
    long parted; /* major steps that were taken in parts */
    bool may_damp;
    double t_damped; /* when damping set in [s] */
};

/* checkpoint.c: where a run stands when a checkpoint is written. */
struct run_place {
    bool resumed; /* the run goes on from a checkpoint */
    long step;    /* steps taken: major ones, or the scheme's own if it chooses them */
    long due;     /* of such a scheme: the record that is due next, */
    double seen;  /* and the time up to which drives have been looked at [s] */
};

struct saving {
    struct stream *stream; /* of records; NULL: no checkpoints are written */
    const char *format;
    double next; /* when the next one is due [s] */
};

/* ---- a run ----------------------------------------------------------------------------------------------------- */

struct sim {
    const struct scene *scene;
    const struct model *model;
    struct sim_options options;
    struct integrate plan; /* scheme, step, ratio, until: as they are run */
    struct system *system;
    struct stepper stepper;
    struct state x;

    /* A motion that stays in a plane is stepped there (flatten.c). */
    bool flat;                    /* it is */
    struct model_spatial spatial; /* why not, of a spatial scene */
    const struct model *whole;    /* the model with the modes that stay 0, left out in `model`; NULL: none are */
    const int *from_whole;        /* [n of whole] number of its coordinate in `model`; -1: left out */
    struct lateral lateral;       /* does the motion stay in the plane? */

    /* Plan of the steps. */
    bool filled_in;      /* the tolerance is not the deck's */
    struct guess guess;  /* of the first step, for schemes that choose their steps */
    long majors, every;  /* major steps in all; between records */
    long before;         /* major steps from t = 0 to the start, where the start is the end of one */
    struct meant origin; /* from when steps are counted [s]: 0, or the start */
    struct meant step;   /* plan.step as the deck means it */
    bool onto_records;   /* a scheme that chooses its steps ends steps at records, as it cannot interpolate */

    /* What is done with every step. */
    bool noting;                  /* some of the watches below are on */
    bool looks_at_once;           /* energies are looked at as each step is booked: watches read them */
    bool looks_always;            /* energies are looked at after every step */
    bool undone;                  /* steps may be undone: */
    bool watched;                 /* what forces do in a step is looked at, */
    struct passing_look *passing; /* or whether the step passes over a contact; NULL: it is not looked at */
    struct crossed *crossed;      /* or what it leaves at edges of forces; NULL: likewise */
    struct single *keep;          /* then: the state before the step, */
    struct ledger kept;           /* its ledger, */
    double kept_t;                /* its time [s] */

    /* Where the run stands. */
    struct ledger ledger;
    double last_h;       /* minor step of the last step [s] */
    double min_h;        /* smallest minor step taken [s] */
    bool cut;            /* the last step ended where no step of a longer run does */
    int went_back;       /* steps undone since the last event, to step onto the next */
    long rejected;       /* of a scheme that chooses its steps: rejected steps when the last record was due */
    const char *forgets; /* why a run that goes on has only coordinates and rates of the state kept; NULL: it has all */
    struct run_place place; /* at a checkpoint */
    struct saving saves;

    /* Records. */
    struct catalogue catalogue;
    int nformula;
    struct formula *formula; /* [nformula] */
    struct selection chosen;
    int ncounted;           /* the first of these are options.counting's; 0: all are the deck's choice */
    struct column *columns; /* [chosen.n] */
    double *row;            /* [chosen.n] */
    unsigned needs;         /* EVALUATE_..., NEED_... of all chosen columns */
    struct single *look;    /* the state of a record between the ends of steps */
    double *press;          /* [rows of contacts] their forces where a record is due */
    long rows;              /* written */
    double recorded;        /* time of the last one [s] */

    /* Watches, each with its file. */
    struct watch watch;
    struct idle idle; /* rotations that move no mass */
    struct neutral neutral;
    bool pulses; /* a load comes and goes within a step: pulses.c */
    struct trust trust;
    struct neglects neglects;
    int nrotation;
    int *rotation;       /* [nrotation] ball and free joints: rotations.c */
    double turn, t_turn; /* their farthest turn in one step [rad], when [s], */
    int turn_joint;      /* of which joint */
    int ndeflection;
    struct deflection *deflection; /* [ndeflection] */
    int nspin;
    struct turning *spin; /* [nspin] */
    int ntilt;
    struct tilting *tilt; /* [ntilt] */
    int negative;         /* first body with a negative principal moment of inertia; 0: none: inertias.c */
    double *M;            /* [n x n] where there is one */
    int npass;
    struct passing *pass; /* [npass] */
    int njump;
    struct jumping *jump; /* [njump] */
    struct cornering corner;
    struct guarding guard;

    /* The end. */
    struct arena *beside;   /* memory of watches over what is left out; NULL: there is nothing */
    double cpu;             /* time of stepping, without records [s] */
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
/* traits.c: is it stepped in a plane?  Trees whose momenta are kept to round-off.  Largest rate at which a flexible
 * body turns now [rad/s], 0 where it cannot be told. */
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
