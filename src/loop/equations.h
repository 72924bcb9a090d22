/* equations.h -- what one row of C(q, t) = 0 (2-2) may say of two bodies, or of coordinates. */
#ifndef FMDSUB_LOOP_EQUATIONS_H
#define FMDSUB_LOOP_EQUATIONS_H

#include "loop/loops_parts.h"

/* Row i of the loops, whose bodies loops_look() has looked at. */
struct equation {
    bool first, second; /* it has an axis of the first body, of the second: in o->axes[i] */
    bool seen;          /* C'' takes the acceleration of the second's point as the first body sees it */
    double (*value)(const struct loops *o, int i);
    /* C'' after speed_up(), with the coordinates' own accelerations a. */
    double (*rate2)(const struct loops *o, int i, const double *a);
    /* Of two bodies: C' is f . (relative velocity at the second's point) + n . (relative angular velocity); writes those
     * that it has.  NULL: of coordinates. */
    bool force, moment;
    void (*wrench)(double *f, double *n, const struct loops *o, int i);
    /* Optional: what loops_force() shows for x = -lambda. */
    double (*shown)(const struct loops *o, int i, double x);
};

/* The acceleration of the second's point as the first body sees it, after speed_up(). */
void equations_seen(double *a, const struct loop_place *p);

/* The rows of a loop, drive or tie: filled, and how many. */
int equations_of(struct loop_row *row, const struct model *m, int loop);

#endif
