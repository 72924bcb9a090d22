/* nearby.h -- gaps of many contacts of which few are near, with the list of those. */
#ifndef FMDSUB_BASE_NEARBY_H
#define FMDSUB_BASE_NEARBY_H

#include <math.h>

#include "base/arena.h"

struct nearby {
    double *gap; /* [m]; INFINITY of those that are not near */
    int *which;  /* [m], the first n of it: those that are, ascending */
    int n;
};

/* For m contacts: none is near. */
static inline void nearby_open(struct nearby *o, int m, struct arena *life)
{
    *o = (struct nearby){TAKE(life, double, m), TAKE(life, int, m), 0};
    for (int i = 0; i < m; i++) o->gap[i] = INFINITY;
}

static inline void nearby_clear(struct nearby *o)
{
    for (int k = 0; k < o->n; k++) o->gap[o->which[k]] = INFINITY;
    o->n = 0;
}

/* One more; cheap where they come in ascending order. */
static inline void nearby_add(struct nearby *o, int i, double gap)
{
    int k = o->n++;
    for (; k > 0 && o->which[k - 1] > i; k--) o->which[k] = o->which[k - 1];
    o->which[k] = i;
    o->gap[i] = gap;
}

static inline void nearby_copy(struct nearby *o, const struct nearby *from)
{
    nearby_clear(o);
    for (int k = 0; k < from->n; k++) nearby_add(o, from->which[k], from->gap[from->which[k]]);
}

#endif
