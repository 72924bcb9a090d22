/* edge.h -- steps of a scheme's own beside what pushes only where bodies meet: a trial may pass over a touch unseen, or go over
 * the edge where a push begins or ends.
 *
 * Over an edge estimates of error are of no order, and 0 by chance for some places of it in the step: steps that are tried
 * shorter and shorter end at such a place.  So the edge has an error of its own, h y |a1 - a0| / 2 with y the part of the
 * step on the edge's shorter side: that of what a push at constant rate of growth does there, at most.  A trial in which it
 * is too large is taken again to just behind the edge. */
#ifndef FMDSUB_ENGINE_EDGE_H
#define FMDSUB_ENGINE_EDGE_H

#include "engine/adaptive.h"

/* What of the trial from t by m->came to take instead; 1: all of it, or what its error says, `err` of its `share` of the
 * tolerance. */
double edge_cut(const struct stepper *s, const struct adaptive *m, double t, double err, double share);

#endif
