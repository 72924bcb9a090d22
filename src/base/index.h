/* index.h -- which of many things has a name: a table of hashes over a list that grows.
 *
 * The things stay where they are, each with its name at the same place of its struct; of two with one name the first is
 * found, of one whose name is NULL nothing.  A thing's name does not change once it has been looked for. */
#ifndef FMDSUB_BASE_INDEX_H
#define FMDSUB_BASE_INDEX_H

#include "base/arena.h"

struct index {
    struct arena *life;
    int n;    /* things known so far */
    int room; /* of the table, a power of 2, more than twice n; 0: none yet */
    int *at;  /* [room] number of a thing and 1; 0: none */
};

/* The number of the first of `count` things whose name is the text of len bytes; -1: there is none.  name: that of the
 * first, the others follow each `stride` bytes behind. */
int index_find(struct index *o, const char *text, size_t len, const char *const *name, size_t stride, int count);

#endif
