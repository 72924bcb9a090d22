/* text.h -- words compared: near misses, patterns; text from outside as it is shown. */
#ifndef FMDSUB_BASE_TEXT_H
#define FMDSUB_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* Damerau-Levenshtein distance (optimal string alignment) of two short words; long words (over 63
 * bytes) count as far apart. */
int text_distance(const char *a, const char *b);

/* The same text, or neither is there (NULL). */
bool text_same(const char *a, const char *b);

/* Two components of one quantity: "bob.wx", "bob.wz". */
bool text_components(const char *a, const char *b);

/* The word of words[0..n) nearest to word, or NULL if none is within 1 + length/4 edits, which leave half of it; another
 * component of the same quantity comes before all else that is one edit away. */
const char *text_nearest(const char *word, const char *const *words, int n);

/* Does name match pattern, in which '*' stands for any run of characters and '?' for one? */
bool text_match(const char *pattern, const char *name);

/* Does text end so, in letters of either case, behind something else? */
bool text_ends(const char *text, const char *end);

/* A deck name: [A-Za-z][A-Za-z0-9_]* */
bool text_is_name(const char *text);

/* Bytes of the UTF-8 character at p, and its number; 0 if the bytes there are none. */
size_t text_character(unsigned *code, const char *p, const char *end);

/* Control characters, and those that turn the direction of writing: a terminal would obey them. */
bool text_hidden(unsigned code);

/* The character at p as it is shown, hidden ones and stray bytes as \x1b and \u202e; *columns: its width on a
 * terminal.  Returns its bytes in the text. */
size_t text_shown(char out[16], int *columns, const char *p, const char *end);

/* The whole text so. */
void text_put(FILE *to, const char *text);

#endif
