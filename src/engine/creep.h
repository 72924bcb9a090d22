/* creep.h -- steps that lead nowhere.
 *
 * Where a force jumps against both ways, as friction that is written as the sign of a rate does at rest, there is no way on.
 * Steps stop at the jump again and again; or the stages of each are on both sides of it by turns, so that its ends
 * agree, and steps of hardly more than the round-off of the time go on for ever.  Of the latter kind are a hundred thousand steps
 * that have not led through a ten-thousandth of the way to the next record, where a force jumps as near as ten of them lead. */
#ifndef FMDSUB_ENGINE_CREEP_H
#define FMDSUB_ENGINE_CREEP_H

#include "engine/adaptive.h"

/* The step m->came was taken to t, on the way to the end: does it lead nowhere, as those before? */
bool creep_found(struct adaptive *m, double t, double end);

#endif
