/* flat_parts.h -- what flat.c and mirror.c share. */
#ifndef FMDSUB_MODEL_FLAT_PARTS_H
#define FMDSUB_MODEL_FLAT_PARTS_H

#include "model/flat.h"

struct flattening {
    const struct model *full;
    struct model *plane;
    struct arena *life;
    struct model_spatial *why;
    bool bent;      /* bodies may bend, in any way: those of the plane are not what they are, then */
    double P[9];    /* x, y and the normal by column, world */
    double (*T)[9]; /* [nbody] body axes to those of the plane when drawn; the ground's are the world's */
    double size;    /* of the mechanism, for what stands at one height [m] */
};

/* The model in the plane; false: it does not stay in one, and *why says by what. */
bool flatten(struct flattening *o);
struct flattening flattening_of(const struct model *full, struct model_spatial *why, struct arena *life);
/* How far above the origin a body's point p stands, along the normal [m]. */
double flat_height(const struct flattening *o, int body, const double *p);
/* Are two heights the same? */
bool flat_level(const struct flattening *o, double a, double b);

#endif
