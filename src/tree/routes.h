/* routes.h -- the tree's ways: which velocities move a body, which body a velocity moves; for both recursions. */
#ifndef FMDSUB_TREE_ROUTES_H
#define FMDSUB_TREE_ROUTES_H

#include <stdbool.h>

#include "base/arena.h"
#include "model/model.h"

struct routes {
    int *owner, *local; /* [n] the body moved by v[k], and k's place in its joint; a mode's body, and behind the
                         * joint's velocities its number there: it moves what hangs on the body, not the frame */
    int *enter, *leave; /* [nbody] the tree in preorder: i is above j when enter_i <= enter_j < leave_i */
    int *npath, **path; /* [nbody] velocities that move the body, from the ground outwards */
};

void routes_build(struct routes *o, const struct model *m, struct arena *life);

/* Does body i move body j, or are they the same? */
static inline bool routes_above(const struct routes *o, int i, int j)
{
    return o->enter[i] <= o->enter[j] && o->enter[j] < o->leave[i];
}

#endif
