/* edge.h -- steps of a scheme's own beside what pushes only where bodies meet: a trial may pass over a touch unseen, or
 * go over the edge where a push begins or ends.
 *
 * Over an edge estimates of error are of no order, and 0 by chance for some places of it in the step: steps that are
 * tried shorter and shorter end at such a place.  So the edge has an error of its own, h y |a1 - a0| / 2 with y the
 * part of the step before it, at most a half: that of what a push at constant rate of growth does there, at most; and
 * of an edge close before the end, where all of a1 - a0 is of what lies behind it, that of the weight which a stage has
 * at the end, above y.  A trial in which it is too large is taken again to just behind the edge.
 *
 * Where the push of a damper begins accelerations jump by J, and a step is off by h J times the difference between what
 * lies beyond and the weights of the stages there: of a step that has but one of its ends on the other side, however
 * little of it, by that stage's whole weight.  There steps end close before the touch, and one over it is so short that
 * h |a1 - a0| / 2 is a hundredth of the tolerance; the next one is as long as before. */
#ifndef FMDSUB_ENGINE_EDGE_H
#define FMDSUB_ENGINE_EDGE_H

#include "engine/adaptive.h"

/* What of the trial from t by m->came to take instead; 1: all of it, or what its error says, `err` of its `share` of the
 * tolerance, which is of no matter if m->leaps.  m->beyond follows. */
double edge_cut(const struct stepper *s, struct adaptive *m, double t, double err, double share);
/* Of the trial that is taken, what it is off by [n] grows by the edge's. */
void edge_add(const struct adaptive *m, double *position, double *velocity, int n);

#endif
