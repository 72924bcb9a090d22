/* load.h -- a deck from its file to a checked scene. */
#ifndef FMDSUB_SIM_LOAD_H
#define FMDSUB_SIM_LOAD_H

#include "scene/scene.h"

/* Errors of the deck are in diags (E_DECK); what keeps it from being read is in report (E_FILE, E_LIMIT). */
enum status sim_load(struct scene **scene, const char *path, const struct deck_options *options, struct diags *diags,
                     struct arena *life, struct report *report);
/* Likewise, but what the deck says against these effects (effect_bit()) is not heard. */
enum status sim_load_with(struct scene **scene, const char *path, const struct deck_options *options, unsigned unheard,
                          struct diags *diags, struct arena *life, struct report *report);

/* The i-th section of a deck: the scene's, with the options of all schemes in `integrate`.  false past the end. */
bool sim_section(struct section *o, int i, struct arena *life);

#endif
