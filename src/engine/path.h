/* path.h -- the way within a step, as its ends tell it: Hermite's cubic through positions and rates at both.
 *
 * With dx the displacement from one end to the other, v0 and v1 its rates there, and y = 1 - x, at the part x of the step
 *
 *     u = x^2 (3 - 2 x) dx + h x y (y v0 - x v1). */
#ifndef FMDSUB_ENGINE_PATH_H
#define FMDSUB_ENGINE_PATH_H

#include "base/arena.h"
#include "engine/stepper.h"

struct path {
    const struct ode2 *ode;
    const struct state *from, *to;
    double *dx, *rate, *u; /* [n] from one to the other; its rate there; on the way */
};

void path_open(struct path *o, const struct ode2 *ode, struct arena *life);
/* The way from one state to another; the states stay the caller's. */
void path_between(struct path *o, const struct state *from, const struct state *to);
/* When it is at the part x, q [nq] there, and about its velocity v [n]. */
double path_time(const struct path *o, double x);
void path_place(struct path *o, double *q, double x);
void path_velocity(const struct path *o, double *v, double x);

#endif
