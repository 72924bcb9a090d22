/* elements.h -- forces on a tree: loads, powers, slopes, stored energy; the same in the plane and in space.
 *
 * A sweep gives the motion and takes the forces; the elements know nothing of the recursion.  All functions
 * with a sweep read its last motion. */
#ifndef FMDSUB_FORCE_ELEMENTS_H
#define FMDSUB_FORCE_ELEMENTS_H

#include "base/arena.h"
#include "base/recall.h"
#include "model/model.h"
#include "system/ode2.h"
#include "tree/sweep.h"

struct elements;

/* What one element does at an instant. */
struct effect {
    double force;      /* along the measure; size of a load, of a bushing's force [N] or [N m] */
    double torque;     /* size of a bushing's torque on its second body, where its force acts [N m]; others: 0 */
    double elongation; /* the measure; a bushing's displacement; a load: 0 */
    double power;      /* on the mechanism [W] */
};

struct elements *elements_build(const struct model *m, const struct sweep_ops *ops, struct arena *life);

/* After forward() of the class: pushes the sweep's bodies, r -= what acts along coordinates, w += powers, dk = max
 * (w, dk may be NULL).  effect [nforce] is filled for the class if not NULL. */
void elements_load(struct elements *e, struct sweep *s, double *r, double *w, double *dk, struct effect *effect,
                   const struct instant *x, enum rate cls);

/* Contacts push with f from now on, NULL: none does; where ALL loads are asked for. */
struct contacts;
void elements_press(struct elements *e, const struct contacts *contacts, const double *f);

/* Does none of them ask for the ends of the interval? */
bool elements_are_pointwise(const struct elements *e);

/* K += dr/dq, C += dr/dv, by column, either may be NULL; after move(). */
void elements_slopes(struct elements *e, struct sweep *s, double *K, double *C, const struct instant *x, enum rate cls);

/* Rows y [n] of other coordinates in place of those of the tree. */
struct row;
struct reduction {
    int n;
    void *self;
    void (*row)(void *self, double *y, const struct row *row);
    double *y, *z; /* [n] work */
};

/* The same into K, C [n x n] of these coordinates. */
void elements_slopes_reduced(struct elements *e, struct sweep *s, double *K, double *C, const struct instant *x,
                             enum rate cls, const struct reduction *to);

/* Are there none that could have slopes? */
bool elements_are_none(const struct elements *e);
/* Is all that slopes() gives on the diagonals, whatever the state?  Then they are cheap: d += cc C + ck K. */
bool elements_are_diagonal(const struct elements *e);
void elements_diagonal(struct elements *e, double *d, double cc, double ck, const struct instant *x);

/* Sum of stored energies; after move(ALL). */
double elements_stored(const struct elements *e, const struct sweep *s, const double *q, const double *v);
/* Of what is known only from step to step, angles in space up to whole turns, energies that are sums, poles: is there any?
 * At the start, and at the end of each step (x: t, q and v there), after move() there. */
bool elements_follow(const struct elements *e);
void elements_begin(struct elements *e, const struct sweep *s, const struct instant *x);
void elements_stepped(struct elements *e, const struct sweep *s, const struct instant *x);
/* Angles in space alone, see measures_turned(), measures_look(): are there any? */
bool elements_turn(const struct elements *e);
void elements_turned(struct elements *e, const struct sweep *s, double dt);
void elements_look(struct elements *e, const struct sweep *view);
/* Did a law have a corner or a jump in the last step?  Has a force grown without bound since elements_no_pole(), or
 * would it on the way from the last step's end to x, after move() there?  Which one; -1: none. */
bool elements_may_bend(const struct elements *e);
/* Is there a force that is no linear law? */
bool elements_may_be_steep(const struct elements *e);
bool elements_bent(const struct elements *e);
bool elements_may_have_poles(const struct elements *e);
int elements_pole(const struct elements *e);
int elements_pole_to(struct elements *e, const struct sweep *s, const struct instant *x);
void elements_no_pole(struct elements *e);
/* Is there any that may be met and left again within a step? */
bool elements_may_be_passed(const struct elements *e);
/* Clear at instants a and b, may one have been met between, by as much as `deep`?  Nothing is quicker than at the ends, but
 * for what an arc of half a radian makes of it.  Is one met at `between`, if that is not NULL? */
enum met elements_passed(struct elements *e, struct sweep *s, const struct instant *a, const struct instant *between,
                         const struct instant *b, double deep);
/* The part of that way at which one has begun or ended to push, if gaps close and pushes grow evenly; see ode2's edge(). */
double elements_edge(const struct elements *e, enum edge_kind *edge);

/* Values that change sign where forces bend or jump, each with the force there; NAN: on neither side.  How many: side
 * NULL. */
int elements_sides(double *side, double *force, struct elements *e, struct sweep *s, const struct instant *x);

/* The value of an expression that jumps most on the way from a to b, two states: its force and the jump, behind infinite where it
 * grows without bound. */
struct leap {
    int force; /* -1: there is none */
    double before, behind;
};
void elements_leap(struct leap *o, struct elements *e, struct sweep *s, const struct instant *a,
                   const struct instant *b);
/* What is carried from step to step. */
void elements_recall(struct elements *e, struct recall *r);
void elements_set_measure(struct elements *e, int measure, double x);
/* The tilt of a force between markers, see strains in kind/force.h [rad]; 0: it has none. */
double elements_tilt(const struct elements *e, const struct sweep *s, int force);
void elements_measure(const struct elements *e, const struct sweep *s, double *value, double *rate, int measure,
                      const double *q, const double *v);

#endif
