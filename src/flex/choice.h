/* choice.h -- which modes a flexible body needs, by what moves it and what is looked at.
 *
 * Of a body held at its reference node, or free to recoil there along `rigid` motions, all coordinates answer a load case
 * p as linear modes do, x(t) = sum X g/lambda cos(w t), g = X'p: what begins at once rings, what comes smoothly at W
 * stands, with 1/(1 - (W/w)^2).  With fewer coordinates the modes are others, and so is the answer: the share of what is
 * left out is the largest difference of a view c'x at sampled times, over the largest value of views of its group in cases
 * of its family.  Static shares, shifted frequencies and resonance are all in it.  Modes are taken by their shares when
 * left out alone, the largest first, until the share of all that is left out is below the tolerance; modes of one frequency,
 * as a round shaft's, together; of a body that has no other coordinates one at
 * least. */
#ifndef FMDSUB_FLEX_CHOICE_H
#define FMDSUB_FLEX_CHOICE_H

#include "base/status.h"
#include "flex/body.h"
#include "flex/statics.h"

/* Something that moves the body. */
struct flex_case {
    const char *name;
    const double *p; /* [n] forces of the coordinates */
    double rigid[6]; /* and along the rigid motions, in their order */
    double omega;    /* how quickly it changes [rad/s]; for what does not begin at once */
    bool sudden;
    int family; /* cases of like size; from 0 */
};

/* Something that is looked at: c'x. */
struct flex_view {
    const char *name;
    const double *c; /* [n] */
    int group;       /* views of like size; from 0 */
    bool tension;    /* it counts for what loads along the body do to its bending alone: by pull over the square of the
                      * first frequency, times half its turns in the span: as phase */
};

/* At a further joint: what hangs there moves along b'x, or what closes a loop there holds it. */
struct flex_tie {
    const double *b; /* [n] */
    double rigid[6]; /* and along the rigid motions */
    double mass;     /* [kg]; held: 0 */
    bool held;
};

struct flex_choosing {
    const struct flex_body *all;
    int movable; /* the first of its coordinates, which may be left out; K is diagonal there */
    int ncase, nview, ntie, nfamily, ngroup, nrigid;
    const int *like; /* [ngroup] the group that one belongs to, itself or another: beside it it may be nothing */
    const struct flex_case *cases;
    const struct flex_view *view;
    const struct flex_tie *tie;
    const double (*rigid)[6]; /* [nrigid] motions of the reference node: displacement, rotation; body axes */
    const double *mass;       /* [nrigid x nrigid] of what it carries along there, besides the body */
    double spin[3], about[3]; /* the fastest turn it is driven to, about a point (from the centre of mass) [rad/s]: its
                               * centrifugal load stiffens the body where `all` has second-order displacements */
    double pull;              /* how far gravity and turns may pull at it, g/l + W^2 [1/s2] */
    double alpha, beta, zeta; /* damping, as a beam's */
    double span, tolerance;   /* of the run [s] */
    int least;                /* of the lowest modes kept in any case */
};

/* keep [movable]; life: for the answer. */
const struct flex_chosen *flex_choose(bool *keep, const struct flex_choosing *o, struct arena *life);

/* The forces on the coordinates of a unit acceleration of the reference node along d (displacement, rotation), inertia
 * against it: p [n].  And the body's own inertia between two such motions. */
void flex_inertia_load(double *p, const struct flex_body *o, const double *d);
double flex_inertia_between(const struct flex_body *o, const double *d, const double *e);
/* Of a turn about the axis w through the point x (from the centre of mass), centrifugal: p [n]. */
void flex_centrifugal_load(double *p, const struct flex_body *o, const double *w, const double *x);

#endif
