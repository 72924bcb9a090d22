/* potential.h -- a force along a measure that is an expression of this measure alone. */
#ifndef FMDSUB_KIND_POTENTIAL_H
#define FMDSUB_KIND_POTENTIAL_H

#include "kind/force.h"

/* Slot 0 is t, which it does not read, slot 1 the measure. */
struct potential {
    const struct expr *expr;
};
extern const struct force_kind force_potential;

#endif
