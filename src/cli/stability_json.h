/* stability_json.h -- `fmdsub stability -f json`: the linearised system, the columns of the deck along it, and all rows. */
#ifndef FMDSUB_CLI_STABILITY_JSON_H
#define FMDSUB_CLI_STABILITY_JSON_H

#include "study/stability.h"

/* On standard output.  M, C, G, K, N [n x n] by row, and of each column of the deck its value and what a unit of each
 * coordinate and of each velocity changes it by, at rest as the matrices are. */
enum status stability_json(const struct stability *o, struct sim *sim, struct arena *life, struct report *report);

#endif
