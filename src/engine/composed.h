/* composed.h -- a symmetric scheme of order 2 made one of order 4: `order: 4`.
 *
 * Five of its steps one after the other, of the lengths
 *
 *     b h, b h, (1 - 4 b) h, b h, b h,   b = 1/(4 - 4^(1/3)) = .4145,
 *
 * of which the third goes back in time, so that the errors of third order cancel (M. Suzuki, Phys. Lett. A 146 (1990) 319);
 * those of fourth order vanish with the symmetry.  All times are within the step, and what a linear system keeps in each of
 * the five it keeps in all: vibrations neither grow nor fade, whatever h is.  What damps, though, feeds on the way back: a
 * step in which dampers and friction bring more there than they take on the way is given up, for a smaller one. */
#ifndef FMDSUB_ENGINE_COMPOSED_H
#define FMDSUB_ENGINE_COMPOSED_H

#include "engine/stepper.h"

void composed_open(struct stepper *s, struct arena *life);
enum status composed_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why);
enum status composed_recall(struct stepper *s, struct recall *r);
/* May the options go with order 4? */
bool composed_fits(const struct step_options *o, struct misfit *why);

#define KEY_ORDER                                                                                                      \
    PARAM_INT(struct step_options, order, "order", 2, 4, KEY_META, "2",                                                \
              "4: five steps, one of them back in time, make one; for small errors of motion without stiff dampers")

/* Slots of a stepper_kind, of the kind that is composed. */
#define COMPOSED(of_) .formulas = of_, .open = composed_open, .step = composed_step, .recall = composed_recall

#endif
