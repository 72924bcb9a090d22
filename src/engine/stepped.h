/* stepped.h -- a scheme of fixed steps, its steps chosen by its error: what `tolerance` makes of a scheme of second order.
 *
 * One trial is one major step of the scheme.  Its error is that of local_error.h, of schemes of two rates their own, in each
 * coordinate against the scales of adaptive.h; the largest counts.  The next step follows by the digital filter H211b of
 * Soderlind (ACM Trans. Math. Softw. 29 (2003) 1), b = 4; as long as it would change by little it is kept, and with it the
 * iteration matrix.  With two rates the slow coordinates choose H, the fast ones h, and the ratio is what goes into H. */
#ifndef FMDSUB_ENGINE_STEPPED_H
#define FMDSUB_ENGINE_STEPPED_H

#include "engine/adaptive.h"

struct stepped_scheme {
    struct adaptive_scheme scheme; /* first */
    const struct stepper_kind *fixed;
};

void stepped_open(struct stepper *s, struct adaptive *m, struct arena *life);
void stepped_forget(struct adaptive *m);
enum status stepped_attempt(struct stepper *s, struct adaptive *m, double *err, double t, double h,
                            struct trouble *why);
void stepped_take(struct stepper *s, struct adaptive *m, double h);
void stepped_off(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h);
double stepped_shrink(const struct adaptive *m, double err);
double stepped_grow(const struct adaptive *m, double err);
void stepped_between(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x);
enum status stepped_recall(struct stepper *s, struct adaptive *m, struct recall *r);

/* A struct stepped_scheme: of the fixed kind, of one rate; of two. */
#define STEPPED(fixed_, between_)                                                                                      \
    {                                                                                                                  \
        .scheme = {.stages = 2,                                                                                        \
                   .order = 2,                                                                                         \
                   .plain = true,                                                                                      \
                   .drifts = .5,                                                                                       \
                   .open = stepped_open,                                                                               \
                   .forget = stepped_forget,                                                                           \
                   .attempt = stepped_attempt,                                                                         \
                   .take = stepped_take,                                                                               \
                   .shrink = stepped_shrink,                                                                           \
                   .grow = stepped_grow,                                                                               \
                   .between = between_,                                                                                \
                   .off = stepped_off,                                                                                 \
                   .recall = stepped_recall},                                                                          \
        .fixed = fixed_                                                                                                \
    }

/* Slots of its stepper_kind. */
#define TOLERANT(formulas_)                                                                                            \
    .formulas = formulas_, .adaptive = 1, .open = adaptive_open, .step = adaptive_step, .recall = adaptive_recall

/* The part of (omega h)^3 that the trapezoidal and the midpoint rule are late by: 1/12. */
double stepped_late(const struct step_options *o);

#endif
