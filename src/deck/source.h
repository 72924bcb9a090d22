/* source.h -- the text of one deck file, read once into memory and checked to be UTF-8. */
#ifndef FMDSUB_DECK_SOURCE_H
#define FMDSUB_DECK_SOURCE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/status.h"
#include "deck/node.h"

struct source {
    const char *path; /* as the user gave it */
    bool set;         /* from the command line: --set, or an option that is short for it */
    bool option;      /* that option, path: its name.  What is wrong there is wrong usage */
    const char *text; /* without a byte order mark, 0-terminated */
    size_t len;
    int lines;
    const size_t *line; /* [lines + 1] offset of each line; the last one is len */
};

/* The end of the line at text[at], without its break: CR, LF, CR LF, NEL, LS or PS, as in YAML. */
size_t source_line_end(const struct source *s, int line);

/* Offset of a place, and the place of an offset. */
size_t source_offset(const struct source *s, struct mark at);
struct mark source_mark(const struct source *s, size_t offset);

/* A text in memory as a source: finds its lines. */
struct source *source_of(const char *path, const char *text, size_t len, struct arena *arena);

enum source_flaw { SOURCE_FINE, SOURCE_UTF8, SOURCE_UTF16, SOURCE_ZERO, SOURCE_CONTROL };
/* The first thing that has no place in a deck, at *offset. */
enum source_flaw source_check(const struct source *s, size_t *offset);

/* Reads all of an open file or pipe, as whole_read() does. */
enum status source_read(struct source **out, int fd, const char *path, size_t max, struct arena *arena,
                        struct report *report);

/* Opens a file named in a deck: relative, inside folder, a regular file, no way out by "..", or by links.  -1: *why
 * says what is wrong (an errno text or a rule). */
int source_open_beneath(const char *folder, const char *name, const char **why);

#endif
