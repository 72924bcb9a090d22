/* path.h -- the motion within a step, interpolated by Hermite's cubic from positions and rates at both ends.
 *
 * With dx the displacement from one end to the other, v0 and v1 its rates there, the displacement at the fraction x
 * of the step is, y = 1 - x,
 *
 *     u = x^2 (3 - 2 x) dx + h x y (y v0 - x v1). */
#ifndef FMDSUB_ENGINE_PATH_H
#define FMDSUB_ENGINE_PATH_H

#include "base/arena.h"
#include "engine/stepper.h"

struct path {
    const struct ode2 *ode;
    const struct state *from, *to;
    double *dx, *rate, *u; /* [n] displacement from one end to the other; its rate at the end; scratch */
};

void path_open(struct path *o, const struct ode2 *ode, struct arena *life);
/* Interpolates between two states, which must stay as they are. */
void path_between(struct path *o, const struct state *from, const struct state *to);
/* Time, position q [nq] and, approximately, velocity v [n] at the fraction x of the step, 0 to 1. */
double path_time(const struct path *o, double x);
void path_place(struct path *o, double *q, double x);
void path_velocity(const struct path *o, double *v, double x);

#endif
