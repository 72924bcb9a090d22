/* schemes.h -- all schemes by name, single-rate ones and those of this room. */
#ifndef FMDSUB_MULTIRATE_SCHEMES_H
#define FMDSUB_MULTIRATE_SCHEMES_H

#include "engine/stepper.h"

/* All kinds, NULL at the end, in the order `fmdsub list` shows. */
extern const struct stepper_kind *const stepper_kinds[];
const struct stepper_kind *stepper_find(const char *name);
/* Those that this build is without, for want of the library that they need: only to be told of.  NULL at the end. */
extern const struct stepper_kind *const stepper_absent[];
const struct stepper_kind *stepper_find_absent(const char *name);

/* The options of all schemes, over struct step_options. */
struct key_block stepper_options(struct arena *life);
/* The brief of one of them, with the names of the schemes that read it where these are few. */
const char *stepper_brief(const struct key *key, struct arena *life);

#endif
