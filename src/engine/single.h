/* single.h -- a major step of a single-rate scheme: ratio plain steps of h, all or none. */
#ifndef FMDSUB_ENGINE_SINGLE_H
#define FMDSUB_ENGINE_SINGLE_H

#include "engine/motion.h"
#include "engine/stepper.h"

struct single {
    double *q, *v, *a; /* the state before the major step */
};

void single_open(struct single *keep, const struct ode2 *ode, struct arena *life);
void single_save(struct single *keep, const struct ode2 *o, const struct state *x);
void single_restore(const struct single *keep, const struct ode2 *o, struct state *x, double t);

/* one() takes x from its t to t1 by a step h, or fails and leaves x as it was. */
enum status single_steps(struct single *keep, struct stepper *s, struct state *x, double h, int ratio, double to,
                         enum status (*one)(struct stepper *s, struct state *x, double h, double t1,
                                            struct trouble *why),
                         struct trouble *why);

#endif
