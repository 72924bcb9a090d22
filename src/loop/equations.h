/* equations.h -- what one row of C(q, t) = 0 (2-2) may say of two bodies, or of coordinates. */
#ifndef FMDSUB_LOOP_EQUATIONS_H
#define FMDSUB_LOOP_EQUATIONS_H

#include "loop/loops_parts.h"

/* What it needs: an axis of the first body, of the second, in o->axes[i]; for C'' the acceleration of the second's point
 * as the first body sees it.  What it bears: a force, a moment; none if it is of coordinates. */
enum { FIRST = 1, SECOND = 2, SEEN_POINT = 4 };
enum { FORCE = 1, MOMENT = 2 };

/* Row i of the loops, whose bodies loops_place() has looked at. */
struct equation {
    unsigned needs, bears;
    double (*value)(const struct loops *o, int i);
    /* C'' after accelerate(), with the coordinates' own accelerations a. */
    double (*rate2)(const struct loops *o, int i, const double *a);
    /* What it bears, per unit: C' is f . (relative velocity at the second's point) + n . (relative angular velocity). */
    void (*wrench)(double *f, double *n, const struct loops *o, int i);
    /* Optional: what loops_force() shows for x = -lambda. */
    double (*shown)(const struct loops *o, int i, double x);
};

/* The acceleration of the second's point as the first body sees it, after accelerate(). */
void equations_seen(double *a, const struct loop_place *p);

extern const struct equation equation_helix;
/* How far a helix's second body has turned, in [-pi, pi]. */
double equations_turn(const struct loops *o, int i);

/* The rows of a loop, drive or tie: filled, and how many. */
int equations_of(struct loop_row *row, const struct model *m, int loop);

#endif
