/* read.h -- keys to values: plain structs filled from maps by key tables (base/keys.h).
 *
 * Every function tells diags what is wrong and goes on; what it could not read keeps its default.  Functions return
 * 0 if all was well, unless they say otherwise. */
#ifndef FMDSUB_DECK_READ_H
#define FMDSUB_DECK_READ_H

#include "base/keys.h"
#include "deck/deck.h"

struct reader {
    struct diags *diags;
    struct deck *deck;
    int space; /* 2 or 3; 0: not known yet, then keys of one space only are taken */
    const struct section
        *sections; /* [nsection] to tell where a key belongs that is unknown here; NULL: not asked for */
    int nsection;
};

/* Fills the struct at out from map: unknown keys (with a near miss among the table and `also`), missing ones, types,
 * ranges, keys of the other space.  Defaults are read from their deck text and join the map as implied nodes.
 * also: further keys the caller reads itself, ends with NULL; may be NULL.  what: "body 'rod'", for messages.
 * KEY_NODE members are set to the node (const struct node *).  Returns the number of errors reported. */
int read_keys(void *out, const struct key *keys, const struct node *map, const char *const *also, const char *what,
              struct reader *rd);

/* Fills a second struct from the same map: with keys that read_keys() was given as `also`. */
int read_also(void *out, const struct key *keys, const struct node *map, const char *what, struct reader *rd);

/* A number within the range of key (NULL: any). */
int read_number(double *out, const struct node *n, const struct key *key, struct reader *rd);
int read_int(int *out, const struct node *n, const struct key *key, struct reader *rd);
int read_bool(int *out, const struct node *n, struct reader *rd);

/* Exactly n numbers; what: "a point", for messages. */
int read_vector(double *x, int n, const struct node *list, const char *what, struct reader *rd);

/* what: NULL, or "a name", for messages. */
int read_text(const char **out, const struct node *n, const char *what, struct reader *rd);

/* rows.c: [[x, y], ...] with x increasing, or the name of such a one in the deck's `tables`; a CSV file beside the deck, by
 * name; a member of `tables`: rows, or {file: name}. */
int read_table(struct points *o, const struct node *n, struct reader *rd);
int read_table_file(struct points *o, const struct node *n, struct reader *rd);
int read_named_table(struct points *o, const struct node *n, struct reader *rd);

/* Is it of this type?  "expected a map, found a list". */
int read_map(const struct node *n, const char *what, struct reader *rd);
int read_list(const struct node *n, const char *what, struct reader *rd);

/* Tells "unknown 'x'" at n with the nearest of words[0..n), or all of them: for names of things, kinds, columns. */
void read_unknown(const struct node *n, enum diag_at at, const char *code, const char *what, const char *name,
                  const char *const *words, int nwords, struct reader *rd);

#endif
