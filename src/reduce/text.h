/* text.h -- a file of text by lines and words, with the line's number for messages.
 *
 * What is wrong in a file is E_DECK, worded `file:line: error: ...`; a file that cannot be read is E_FILE. */
#ifndef FMDSUB_REDUCE_TEXT_H
#define FMDSUB_REDUCE_TEXT_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/status.h"

struct text {
    const char *path;
    char *next, *end; /* what is not read yet */
    int line;         /* number of the line last read */
    int lines;        /* of the whole file */
    struct report *report;
};

enum status text_open(struct text *o, const char *path, struct arena *life, struct report *report);
/* The next line, without its end, 0-terminated, the caller's to change; NULL: no more. */
char *text_line(struct text *o);

#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
enum status
text_bad(const struct text *o, const char *format, ...);

/* What stands at *at is read and *at moves behind it; false: there is no such thing (*at stays).  Blanks before it
 * are passed over; word_end: nothing but blanks is left. */
bool word_int(char **at, int *value);
bool word_real(char **at, double *value); /* finite or not: the caller asks */
bool word_mark(char **at, char mark);     /* the character, such as ',' */
bool word_end(char *at);

#endif
