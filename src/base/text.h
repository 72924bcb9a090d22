/* text.h -- words compared: near misses, patterns. */
#ifndef FMDSUB_BASE_TEXT_H
#define FMDSUB_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Damerau-Levenshtein distance (optimal string alignment) of two short words; long words (over 63
 * bytes) count as far apart. */
int text_distance(const char *a, const char *b);

/* The word of words[0..n) nearest to word, or NULL if none is within 1 + length/4 edits. */
const char *text_nearest(const char *word, const char *const *words, int n);

/* Does name match pattern, in which '*' stands for any run of characters and '?' for one? */
bool text_match(const char *pattern, const char *name);

/* A deck name: [A-Za-z][A-Za-z0-9_]* */
bool text_is_name(const char *text);

#endif
