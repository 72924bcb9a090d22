/* chosen.h -- modes by evidence, in words and as JSON. */
#ifndef FMDSUB_CLI_CHOSEN_H
#define FMDSUB_CLI_CHOSEN_H

#include <stdio.h>

#include "out/facts.h"
#include "sim/sim.h"

/* Each mode with its share, and why it is kept or not. */
void chosen_print(FILE *to, const struct flex_chosen *o);
cJSON *chosen_json(const struct flex_chosen *o);

#endif
