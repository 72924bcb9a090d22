/* flat.h -- a spatial model whose motion stays in planes of one normal, as a model in the plane.
 *
 * Kinematic evidence: every joint of the tree leaves its bodies in such planes (revolute along the normal, prismatic
 * across it, planar, fixed), whatever loads do, and what closes loops holds nothing but motion in them.  Forces along
 * measures act within one plane each; loads across and moments about axes in it do nothing, and are left out.  All bodies
 * are rigid.
 *
 * Bodies, joints, loops, measures and forces keep their numbers; world and body axes are those of the plane when drawn,
 * x and y in it.  Coordinates are those of the spatial model, of the same places and values. */
#ifndef FMDSUB_MODEL_FLAT_H
#define FMDSUB_MODEL_FLAT_H

#include "base/arena.h"
#include "model/model.h"

struct model_flat {
    const struct model *full, *plane;
    double level; /* gravity's energy of what stands still along the normal [J] */
};

/* NULL: it does not stay in such planes, and *why says by what; static text, or the name of a joint ... */
struct model_spatial {
    const char *name, *why;
};
const struct model_flat *model_flatten(const struct model *full, struct model_spatial *why, struct arena *life);

#endif
