/* checkpoint.h -- all that a run needs to go on, in a file, and a run that goes on from there.
 *
 * The file is text: a line with a checksum of what follows, then a span of base/recall.h a line: how far the run and
 * its stream of records had come, and its memory (memory.c).  It belongs to one deck, with its tables and bodies and
 * all that --set says, and to one form of records.  A run that goes on is built from the deck's start like the first
 * one, so that nothing but what moves must be kept. */
#ifndef FMDSUB_SIM_CHECKPOINT_H
#define FMDSUB_SIM_CHECKPOINT_H

#include "sim/sim.h"

/* Takes a run that sim_open() has built, and that has not begun, to the checkpoint at `path`; *bytes: length of its
 * stream of records there.  E_FILE: it is no checkpoint, or not whole; E_MODEL: it is of another deck or form of
 * records. */
enum status checkpoint_take(struct sim *sim, const char *path, const char *format, long long *bytes, struct arena *life,
                            struct report *report);

/* Prepares checkpoints as the deck asks for them, of a run whose records go to `stream` in this form.  E_FILE: their
 * file exists and is something else. */
enum status checkpoint_open(struct sim *sim, struct stream *stream, const char *format, struct report *report);

#endif
