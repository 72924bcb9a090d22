/* touch.h -- what a force takes hold of and what it reads: pairs of bodies, single coordinates. */
#ifndef FMDSUB_MODEL_TOUCH_H
#define FMDSUB_MODEL_TOUCH_H

#include "model/model.h"

struct touched {
    int a, b;   /* two bodies; a load's first is the ground; -1: not bodies but a coordinate */
    int iq, iv; /* its place in q, in v; -1: not that one */
};

struct touched measure_touched(const struct model_measure *s);

/* The i-th thing that force f touches; false past the end.  On the first it acts, the others its expressions read (t
 * is one of them, and is nothing of the model). */
bool model_touched(struct touched *o, const struct model *m, const struct model_force *f, int i);

#endif
