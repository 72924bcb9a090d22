/* schemes.h -- all schemes by name, single-rate ones and those of this room. */
#ifndef FMDSUB_MULTIRATE_SCHEMES_H
#define FMDSUB_MULTIRATE_SCHEMES_H

#include "engine/stepper.h"

/* All kinds, NULL at the end, in the order `fmdsub list` shows. */
extern const struct stepper_kind *const stepper_kinds[];
const struct stepper_kind *stepper_find(const char *name);

/* The options of all schemes, over struct step_options; where only a few schemes read a key its brief names them. */
struct key_block stepper_options(struct arena *life);

#endif
