/* pick.h -- a flexible body with some of its coordinates. */
#ifndef FMDSUB_FLEX_PICK_H
#define FMDSUB_FLEX_PICK_H

#include "flex/body.h"

/* Those with keep [o->n], in their order; of the others nothing is left. */
struct flex_body *flex_pick(const struct flex_body *o, const bool *keep, struct arena *life);

#endif
