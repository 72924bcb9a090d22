/* midpoint.h -- the implicit midpoint rule, also what sub-cycling is without fast coordinates. */
#ifndef FMDSUB_ENGINE_MIDPOINT_H
#define FMDSUB_ENGINE_MIDPOINT_H

#include "engine/stepper.h"

extern const struct stepper_kind step_midpoint;

struct midpoint;

struct midpoint *midpoint_new(struct stepper *s, struct arena *life);
/* One step h of x to time t1, work added to s->work; or x as it was. */
enum status midpoint_advance(struct midpoint *m, struct stepper *s, struct state *x, double h, double t1,
                             struct trouble *why);

#endif
