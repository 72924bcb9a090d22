/* columns.h -- what can be written, and what is chosen of it. */
#ifndef FMDSUB_OUT_COLUMNS_H
#define FMDSUB_OUT_COLUMNS_H

#include "base/arena.h"
#include "base/status.h"

struct column {
    const char *name;  /* "hub.angle" */
    const char *unit;  /* "rad"; NULL: none */
    const char *brief; /* one line for the manual */
};

/* The one of all[0..n) that is called so; -1: none. */
int columns_find(const struct column *all, int n, const char *name);

struct selection {
    int n;
    int *index; /* [n] into the columns, t first */
    int wrong;  /* index of the pattern that matched nothing; -1: none */
};

/* Columns of all[0..n), of which the first is what the others are written over, t, by patterns with '*' and '?', in the
 * order given: that comes first always, within a pattern the order of `all`, and of duplicates the first stays.  A
 * pattern that matches nothing fails with `blame` (E_USAGE, E_DECK) and words that name the nearest. */
enum status columns_select(struct selection *to, const struct column *all, int n, const char *const *patterns,
                           int npatterns, enum status blame, struct arena *life, struct report *report);

/* The items of "t,hub.*, speed=hypot(rod.vx, rod.vy)", between commas outside of parentheses: blanks around them are
 * dropped, empty ones left out. */
const char **columns_split(int *n, const char *list, struct arena *life);

/* The name of such an item: what stands before '=', if there is one. */
const char *columns_item_name(const char *item, struct arena *life);

/* The setting of a deck that asks for such items: output.columns=['t', {'speed': 'hypot(rod.vx, rod.vy)'}]. */
const char *columns_setting(const char *const *item, int n, struct arena *life);

#endif
