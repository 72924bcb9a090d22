/* passing.h -- contacts that close and open again within a step, so that neither end of the step shows them.
 *
 * The motion within the step is interpolated by the cubic of path.h.  Where a contact may lie in it (ode2's
 * passed()) it is halved, again and again, down to a 256th of the step.
 *
 * How far things are apart, and how fast they come near, at both ends tells of a way between them that is about straight.  What
 * has turned far meanwhile may be back where it was.  So a step is looked at in parts in which no coordinate moves by more than
 * half a usual change, half a radian of an angle. */
#ifndef FMDSUB_ENGINE_PASSING_H
#define FMDSUB_ENGINE_PASSING_H

#include "base/arena.h"
#include "engine/stepper.h"

struct passing_look;

/* NULL: the system has nothing that could be passed over. */
struct passing_look *passing_open(const struct ode2 *o, struct arena *life);
/* Does the step from a to b pass over a touch that neither end shows? */
bool passing_found(struct passing_look *o, const struct state *a, const struct state *b);
/* Does it, or may it still where it has been halved that often? */
bool passing_may(struct passing_look *o, const struct state *a, const struct state *b);

/* Of a step between two states: how many parts those are, at the pace of both ends and of what is driven; at most one more than
 * PASSING_PARTS. */
enum { PASSING_PARTS = 16 };
int passing_parts(const struct ode2 *o, const struct state *a, const struct state *b);

/* Where a push has begun or ended in the step that was looked at last, as ode2's edge() has it. */
enum edge_kind passing_edge(const struct passing_look *o, double *at);

#endif
