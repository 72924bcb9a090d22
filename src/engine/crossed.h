/* crossed.h -- what a step of fixed length leaves where a force bends or jumps within it.
 *
 * There a scheme is of first or of second order, whatever its order is, and the differences of missed.h, taken in some of
 * the steps, do not know it.  Let accelerations change by D from the step before the edge to the step behind it, in the
 * mean over each.  Where a force jumps at the part x of a step h, D is that jump, and the velocities are off by h D |y - w|
 * with y = 1 - x and w the weight that the scheme gives to what lies behind: by at most h D/2 with the trapezoidal
 * and the midpoint rule, by at most h D/3 with weights 1/6, 4/6, 1/6.  Where its rate jumps by J,
 * D is J h in the mean, and velocities are off by J h^2 y (1 - y)/2 with the trapezoidal rule, on the average h D/12, and
 * by at most h D/24 with those weights, by h D/66 in the root mean square, where D is more than J h if anything else bends.
 *
 * Each such step adds its own: no other one stands for it.  What it leaves in velocities goes on into positions, as
 * missed_drift() has it, but for bends with schemes of order 2, which over these are as good as elsewhere. */
#ifndef FMDSUB_ENGINE_CROSSED_H
#define FMDSUB_ENGINE_CROSSED_H

#include "base/arena.h"
#include "base/recall.h"
#include "engine/passing.h"

/* NULL: nothing could be crossed, or the steps are not looked at. */
struct crossed *crossed_open(const struct stepper *s, struct arena *life);
/* A step has been taken, of minor steps h; passing: what it has found of the step, NULL: it does not look. */
void crossed_step(struct crossed *o, struct stepper *s, const struct state *from, const struct state *to, double h,
                  const struct passing_look *passing);
/* The velocities are others now, by a new chart or by impulses. */
void crossed_break(struct crossed *o);
void crossed_recall(struct crossed *o, struct recall *r);

#endif
