/* auto.h -- `scheme: auto` and `partition: auto`: what a deck that leaves it
 * open is stepped by.
 *
 * A run by dopri5 at the tolerance looks at the motion for LOOK evaluations.  Where 2 percent of what the run is foretold to
 * take is less than AUTO_LEAST evaluations nothing is tried.  Else that is what is spent on trials, of what the best is foretold to take:
 * the schemes that make sense, with the deck's fast coordinates or those that quick.h finds, all at one tolerance, race from the
 * start in rounds; what is far behind and does not gain drops out, and the least foretold work is taken.  Two rates by
 * steps of order 4, which are chosen once, join at the end: from what quick.h has seen their steps are sized by what they miss
 * beside half of them (order 4: 16 times), of usual changes, to half the tolerance.  What is taken of the
 * schemes of one rate that engine/relay.h has is a relay of them, which begins with a step as long as the first of
 * dopri5 that did not have to grow any more, and finds out in the run itself who is right when, unless the run is foretold less than
 * AUTO_LEAST evaluations.  With a `step` alone the tolerance is the one at which the midpoint rule would take
 * such steps, and schemes of fixed steps run with that step.
 *
 * All of it is counted: one deck, one choice. */
#ifndef FMDSUB_STUDY_AUTO_H
#define FMDSUB_STUDY_AUTO_H

#include "scene/scene.h"

/* Changes scene->integrate and scene->fast where the deck leaves them open;
 * E_...: ended from outside. */
enum status auto_choose(struct scene *scene, struct arena *life, struct report *report);

/* What was chosen for `from`, which is the same deck but for a little, is taken
 * for `scene`, too. */
void auto_same(struct scene *scene, const struct scene *from);

#endif
