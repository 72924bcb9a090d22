/* recorded.h -- records that `fmdsub run` has written, read back: CSV, NDJSON, JSON, by the file's ending. */
#ifndef FMDSUB_CLI_RECORDED_H
#define FMDSUB_CLI_RECORDED_H

#include "cli/curves.h"
#include "out/columns.h"

/* Does the name end in .csv, .ndjson, .jsonl or .json? */
bool recorded_is(const char *path);

/* Fills o from the file o->file: names, units where the file tells them, rows; a value that there is none of is NAN. */
enum status recorded_read(struct curves *o, struct arena *life, struct report *report);

/* A new row of o, all NAN. */
double *recorded_row(struct curves *o, struct arena *life);
/* recorded_json.c: a line of NDJSON; the whole text of JSON.  "": it is well; else what is wrong with it. */
const char *recorded_line(struct curves *o, const char *line, struct arena *life);
const char *recorded_whole(struct curves *o, const char *text, struct arena *life);

#endif
