/* diag.h -- what is wrong with a deck, all of it at once, each with its place and a cure.
 *
 *     arm.yaml:4:9: error: unknown key 'masss' in body 'rod' [E-unknown-key]
 *         4 |   rod: {masss: 2, at: [1, 0]}
 *           |         ^~~~~
 *           | did you mean 'mass'?
 *
 * Stages add and go on; the status is asked at the end of a stage.  Messages are shown in the order of
 * places, at most 20; whatever comes from a deck is shown without control characters. */
#ifndef FMDSUB_DECK_DIAG_H
#define FMDSUB_DECK_DIAG_H

#include <stdbool.h>
#include <stdio.h>

#include "base/arena.h"
#include "base/status.h"
#include "deck/node.h"
#include "deck/source.h"

enum { DIAGS_SHOWN = 20 };

struct diags;

struct diags *diags_open(struct arena *arena);

/* A text that marks can point into; returns its number, a node's `file`. */
int diags_add_source(struct diags *d, const struct source *s);
const struct source *diags_source(const struct diags *d, int file);

enum diag_at { AT_VALUE, AT_KEY };

/* code: a word of the table below.  "E-limit..." makes the status E_LIMIT.  AT_KEY of what has no key is its value. */
__attribute__((format(printf, 5, 6))) void diag_error(struct diags *d, const struct node *at, enum diag_at which,
                                                      const char *code, const char *format, ...);
__attribute__((format(printf, 5, 6))) void diag_warn(struct diags *d, const struct node *at, enum diag_at which,
                                                     const char *code, const char *format, ...);

/* What could be said better, and runs as it is: --strict does not mind. */
__attribute__((format(printf, 5, 6))) void diag_tip(struct diags *d, const struct node *at, enum diag_at which,
                                                    const char *code, const char *format, ...);

/* A second place of the last message: "first given here". */
__attribute__((format(printf, 4, 5))) void diag_note(struct diags *d, const struct node *at, enum diag_at which,
                                                     const char *format, ...);

/* What to try, below the last message; may be called more than once. */
__attribute__((format(printf, 2, 3))) void diag_hint(struct diags *d, const char *format, ...);

/* The same for a place without a node. */
struct span {
    int file;
    struct mark from, to;
};
struct span diag_span(const struct node *at, enum diag_at which);
__attribute__((format(printf, 4, 5))) void diag_error_in(struct diags *d, struct span at, const char *code,
                                                         const char *format, ...);
__attribute__((format(printf, 3, 4))) void diag_note_in(struct diags *d, struct span at, const char *format, ...);

/* The word of words[0..n) that was probably meant, or NULL: a near miss, but not one letter for another. */
const char *diag_nearest(const char *word, const char *const *words, int n);

/* "did you mean 'x'?" if a word of words[0..n) is near; else the words themselves, where they are few. */
void diag_suggest(struct diags *d, const char *word, const char *const *words, int n);

/* "known here: a, b, c": the words themselves. */
void diag_words(struct diags *d, const char *const *words, int n);

/* Was the last message kept, and are so many more words to compare not too many? */
bool diag_may_suggest(struct diags *d, int n);

/* Names a letter of word that may look like one of a-z and is not. */
void diag_foreign(struct diags *d, const char *word);

/* Text of a deck for a message: at most 40 characters, no control characters. */
const char *diag_clip(struct diags *d, const char *text);

/* OK, E_DECK, or E_LIMIT; E_USAGE: all that is wrong came by options.  Warnings and tips do not count. */
enum status diags_status(const struct diags *d);
int diags_errors(const struct diags *d);
/* So many errors that no more are kept: loops over what a deck holds may end. */
bool diags_full(const struct diags *d);
int diags_warnings(const struct diags *d);
/* The first error, in words; NULL: there is none. */
const char *diags_first(const struct diags *d);
void diags_print(FILE *to, const struct diags *d, bool color);

/* ---- all codes, each with its cure, for `fmdsub explain CODE`; ends with a NULL code ---- */
struct diag_help {
    const char *code;
    const char *cure;
};
extern const struct diag_help diag_helps[];
/* NULL: no such code.  Case does not matter. */
const char *diag_cure(const char *code);

#endif
