/* system.h -- a model as mechanics: (2-4) behind ode2.h, and what is wanted at an output instant. */
#ifndef FMDSUB_SYSTEM_SYSTEM_H
#define FMDSUB_SYSTEM_SYSTEM_H

#include "base/arena.h"
#include "base/recall.h"
#include "model/model.h"
#include "open/bent.h"
#include "system/ode2.h"
#include "tree/sweep.h"

struct system;

struct energies {
    double kinetic, elastic, gravity; /* [J] */
};

struct system *system_build(const struct model *m, struct arena *life);

/* The system of a spatial model in the plane that its motion stays in, with the same coordinates: steps are there, answers
 * of `full`. */
struct model_flat;
struct system *system_flatten(struct system *full, const struct model_flat *flat, struct arena *life);
bool system_is_flat(const struct system *s);
/* Trees whose momenta are kept to round-off. */
int system_floating(const struct system *s);

/* q [nq] and v [n of the door] at the start: of a mechanism with loops, closed.  Fails where it cannot be. */
enum status system_start(struct system *s, double *q, double *v, struct report *report);

/* What is carried from step to step, see base/recall.h; then the door's n is as it was. */
void system_recall(struct system *s, struct recall *r);

/* The door to the engine, which lets its chart change between steps; lives as long as the system. */
struct ode2 *system_ode2(struct system *s);

/* What is wanted of one instant, and no more; kept until the next call. */
enum {
    EVALUATE_NOTHING = 0,
    EVALUATE_MOTION = 1, /* rates, poses, measures, momenta, stresses */
    EVALUATE_ACCELERATION =
        2,                 /* the same with accelerations, by one fresh solve of (2-4), and the loops' multipliers */
    EVALUATE_FORCE = 4,    /* motion, and what each force does */
    EVALUATE_REACTION = 8, /* reactions of the tree's joints; accelerations and forces with them */
    EVALUATE_ENERGY = 16,  /* of motion, springs and gravity */
    EVALUATE_ALL = 31
};
enum status system_evaluate(struct system *s, const double *q, const double *v, double t, unsigned what,
                            struct trouble *why);

const double *system_rates(const struct system *s);         /* [n of the model] */
double system_length(const struct system *s);               /* of the mechanism [m], see tree/sizes.h */
const double *system_accelerations(const struct system *s); /* [n of the model] */
void system_pose(const struct system *s, struct pose *o, int body);
void system_point(const struct system *s, double *x, double *xv, double *xa, const struct model_point *p);
/* The same of a body's centre of mass, the pose itself of a rigid one: where it stands, how it moves; see at(), stir() of
 * tree/sweep.h. */
void system_centre_stands(const struct system *s, struct pose *o, int body);
void system_centre_moves(const struct system *s, struct pose *o, int body);
/* How far a named point of a flexible body is displaced, in the axes of its frame [3]. */
void system_displacement(const struct system *s, double *d, const struct model_point *p);
/* How far it is turned against that frame: rotation vector, axes of the frame [3]. */
void system_rotation(const struct system *s, double *turn, const struct model_point *p);
double system_stress(const struct system *s, int body, int stress, enum bent_stress part);
/* A measured angle in space, known up to whole turns, stands at x [rad]: for the start. */
void system_set_measure(struct system *s, int measure, double x);
void system_measure(const struct system *s, double *value, double *rate, int measure);
void system_reaction(const struct system *s, double *f, double *n, int joint); /* on the deck's second body */
void system_loop_reaction(const struct system *s, double *f, double *n, int loop);
/* The k-th position (order 0), rate (1) or acceleration (2) that a joint outside of the tree would have in it. */
double system_loop_coordinate(const struct system *s, int loop, int order, int k);
/* From the start on, such angles in space keep their whole turns; before the first step. */
void system_follow_turns(struct system *s, struct arena *life);
/* All angles in space, which forces may read, go on to q, at rest there; the split of loops stays. */
void system_count_turns(struct system *s, double *q, double t);
/* And one of them stands at x [rad] there. */
void system_set_loop_coordinate(struct system *s, int loop, int k, double x);
/* Of drive `loop`: its force along its measure, its power [W]. */
void system_drive(const struct system *s, double *force, double *power, int loop);
double system_loop_force(const struct system *s, int loop); /* of a tie: see loops_force() */
/* force: value along the measure, or size of the load; length: the measure; power [W]. */
void system_force(const struct system *s, double *force, double *elongation, double *power, int i);
void system_energies(const struct system *s, struct energies *e);

/* Of a bushing: its torque on the second body, where its force acts [N m]. */
double system_force_torque(const struct system *s, int i);

/* The loops, NULL: none.  Largest |C| of all states seen; the model's place in v of the door's number i. */
struct condense;
struct condense *system_loops(const struct system *s);
/* Of the plane, where steps are taken there: bodies that bend out of it hold what is across. */
struct condense *system_loops_stepped(const struct system *s);
double system_constraint_worst(const struct system *s);
/* The loops at q and t are looked at for it. */
void system_note_closure(struct system *s, const double *q, double t);
int system_place(const struct system *s, int i);
long system_charts(const struct system *s); /* partitions chosen since the start */

/* Energies alone, cheaply, for the ledger.  E_NUMERIC with *why: rates that fit the loops cannot be found there. */
enum status system_energy_at(struct system *s, struct energies *e, const double *q, const double *v, double t,
                             struct trouble *why);

/* Where positions are q: row [n of the door] := how fast a body turns about an axis of its own per unit of each velocity;
 * the sum of `many` such, each times its weight. */
struct turn_axis {
    int body;
    const double *axis; /* unit, body axes */
    double weight;
};
void system_spin_row(struct system *s, double *row, const double *q, double t, const struct turn_axis *of, int many);

/* Angular velocity of a body's frame in its own axes [3], at the last system_energy_at(). */
void system_frame_spin(const struct system *s, double *w, int body);

/* The mechanism's length [m], where only the start tells it, or the state that it goes on from; else 0. */
double system_start_length(const struct system *s);

/* Have forces along measures laws with corners or jumps?  Was there one in the last step?  That step is undone: q and v
 * at t are those before it. */
bool system_may_bend(const struct system *s);
bool system_bent(const struct system *s);
/* Forces given as expressions that divide?  Has one grown without bound since the start, or since system_back(); would one on the
 * way from where the last step has ended that is known of, to q, v at t?  Its number; -1: none. */
bool system_may_have_poles(const struct system *s);
int system_pole(const struct system *s);
int system_pole_to(struct system *s, const double *q, const double *v, double t);
enum status system_back(struct system *s, double *q, const double *v, double t, struct trouble *why);
/* The force that jumps most within h of the motion at q, v and t [s], and its values, behind infinite where it grows without
 * bound; -1: none does. */
int system_leap(struct system *s, double *before, double *behind, const double *q, const double *v, double t, double h);

/* From the first point of a measure to its second, world axes [3], at the last system_energy_at(). */
void system_apart(const struct system *s, double *d, const struct model_measure *m);

/* elements_tilt(), at the last system_energy_at(). */
double system_tilt(const struct system *s, int force);

/* Forces of contacts [rows of ode2_contact] in all that system_evaluate() looks at from now on. */
void system_push_contacts(struct system *s, const double *f);
double system_gap(const struct system *s, int contact);              /* at the last system_evaluate() */
void system_slip(const struct system *s, double *rate, int contact); /* likewise: rates along its rows */

/* Linear momentum and angular momentum about the world's origin [3] each, at the last system_evaluate(). */
void system_momentum(const struct system *s, double *p, double *L);

#endif
