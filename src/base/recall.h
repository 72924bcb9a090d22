/* recall.h -- what an object carries from step to step, kept in a file and taken back.
 *
 * An object names its spans once, in one function that serves both ways:
 *
 *     void newton_recall(struct newton *nt, struct recall *r)
 *     {
 *         recall_list(r, "scale", nt->scale, nt->ode->n);
 *         recall_one(r, "top", nt->top);
 *     }
 *
 * A span is a name and numbers: of a double the bits, of a whole number itself, in hexadecimal, with blanks between; z and
 * a decimal number stand for so many zeros.  Names are unique; "newton.top" is inside of "newton".  What is not a span
 * either stays as it was built or is found anew from what does. */
#ifndef FMDSUB_BASE_RECALL_H
#define FMDSUB_BASE_RECALL_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

struct recalled {
    const char *name, *text;
};

struct recall {
    bool back; /* spans are taken back; else they are kept */
    bool amid; /* of a run that goes on to the same bytes; else of its end, where more has been evaluated since */
    int n, capacity;
    struct recalled *span; /* [n] */
    int next;              /* of those to be taken back, most likely */
    char within[80];       /* the objects under way, "newton." */
    char wrong[80];        /* the first span that was not there, or another; "": none */
    size_t size;           /* of the texts */
    struct arena *arena;
};

/* For keeping; for taking back the n spans that were kept. */
void recall_keep(struct recall *r, struct arena *arena);
void recall_back(struct recall *r, struct recalled *span, int n);

/* Spans of an object inside follow; no more. */
void recall_within(struct recall *r, const char *object);
void recall_without(struct recall *r);

/* Whether an object's spans are there: always, where they are kept. */
bool recall_has(const struct recall *r, const char *object);

/* n numbers, `stride` bytes apart. */
void recall_doubles(struct recall *r, const char *name, double *x, size_t n, size_t stride);
void recall_ints(struct recall *r, const char *name, int *x, size_t n, size_t stride);
void recall_longs(struct recall *r, const char *name, long *x, size_t n, size_t stride);
void recall_bools(struct recall *r, const char *name, bool *x, size_t n, size_t stride);

#define RECALL_OF(x) _Generic((x), double : recall_doubles, int : recall_ints, long : recall_longs, bool : recall_bools)
/* A member; a list; of each item of a list one member. */
#define recall_one(r, name, x) RECALL_OF(x)(r, name, &(x), 1, sizeof(x))
#define recall_list(r, name, x, n) RECALL_OF (*(x))(r, name, x, (size_t)(n), sizeof *(x))
#define recall_each(r, name, list, member, n)                                                                          \
    RECALL_OF((list)->member)(r, name, &(list)->member, (size_t)(n), sizeof *(list))

#endif
