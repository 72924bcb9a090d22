/* sliding.h -- friction of a compliant contact, of a curve its push, too: parameters, for who makes one without a deck's keys. */
#ifndef FMDSUB_KIND_SLIDING_H
#define FMDSUB_KIND_SLIDING_H

#include "kind/contact.h"
#include "kind/force.h"
#include "kind/outline.h"
#include "kind/unilateral.h"

struct sliding {
    struct markers on; /* on the second surface's body and on that of the first: points, a ball */
    enum contact_pair pair;
    double radius, other;          /* of the first, of the second [m] */
    double normal[3];              /* of a plane, axes of its body; of an outline its x axis */
    const struct outline *outline; /* PAIR_OUTLINE, its x axis along normal: here the push is added, too */
    struct unilateral push;
    double mu;   /* coefficient of friction */
    double slip; /* speed at which friction has reached 0.7 of its bound [m/s] */
};

extern const struct force_kind force_sliding;

#endif
