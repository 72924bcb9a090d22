/* coordinates.h -- the coordinates that a joint outside of the tree would have in it, from the motion of its bodies.
 *
 * With d, u, s the place, velocity and acceleration of the second body's point as the first body sees it from its own,
 * W the angular velocity of the second body against the first, and e the axis of a freedom:
 *
 *     slide   q = e.d,    q' = e.u,    q'' = e.s
 *     turn                q' = e.W,    q'' = e.W' + (w x e).W,    w of the body that carries e
 *
 * Axes of two turns are at right angles, so that each sees its own turn only.  Angles are those that take the axes of
 * the first body to those of the second; a ball's position is the unit quaternion that does. */
#ifndef FMDSUB_LOOP_COORDINATES_H
#define FMDSUB_LOOP_COORDINATES_H

#include "base/arena.h"
#include "base/recall.h"
#include "model/model.h"
#include "tree/sweep.h"

/* The k-th position (order 0), rate (1) or acceleration (2) of a joint that closes a loop, as joint_name() has them.
 * Angles in space are in [-pi, pi]: whole turns are not in the poses. */
double loop_coordinate(const struct model *m, int loop, int order, int k, const struct pose *first,
                       const struct pose *second);

/* Whole turns of these angles in space, followed from the start; in the plane poses know them. */
struct windings;
struct windings *windings_build(const struct model *m, const struct sweep_ops *ops, struct arena *life);
/* Screws have turned as far as their displacement tells: at the start. */
void windings_start(struct windings *o, const struct sweep *s);
/* Where the bodies are after an accepted step, or a piece of it, dt after the last time: no angle has gone by more than
 * half a turn less or more than the mean of its rates before and after tells.  Of `view` for itself. */
void windings_note(void *windings, const struct sweep *s, double dt);
/* The view's angles, of which windings_angle() tells, are those after the last step. */
void windings_look(void *windings, const struct sweep *view);
/* The angle k of a loop, in [-pi, pi], with its whole turns. */
double windings_angle(const struct windings *o, int loop, int k, double x);
void windings_recall(struct windings *o, struct recall *r);
/* It stands at x at the start. */
void windings_set(struct windings *o, int loop, int k, double x);
/* Is the k-th position of the joint such an angle? */
bool loop_winds(const struct model *m, int loop, int k);

#endif
