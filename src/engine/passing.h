/* passing.h -- what is met and left again within a step, unseen at both its ends: a touch that the step passes over.
 *
 * The step is looked at along the cubic of path.h, in halves where a touch may lie between (ode2's passed()), as far as a
 * 256th of it. */
#ifndef FMDSUB_ENGINE_PASSING_H
#define FMDSUB_ENGINE_PASSING_H

#include "base/arena.h"
#include "engine/stepper.h"

struct passing_look;

/* NULL: there is nothing that could be passed. */
struct passing_look *passing_open(const struct ode2 *o, struct arena *life);
/* Between a and b, a step with nothing at work but what both show? */
bool passing_found(struct passing_look *o, const struct state *a, const struct state *b);

#endif
