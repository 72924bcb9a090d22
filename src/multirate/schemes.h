/* schemes.h -- all schemes by name, single-rate ones and those of this room. */
#ifndef FMDSUB_MULTIRATE_SCHEMES_H
#define FMDSUB_MULTIRATE_SCHEMES_H

#include "engine/stepper.h"

/* All kinds, NULL at the end, in the order `fmdsub list` shows. */
extern const struct stepper_kind *const stepper_kinds[];
const struct stepper_kind *stepper_find(const char *name);

#endif
