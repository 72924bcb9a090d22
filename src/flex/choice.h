/* choice.h -- `modes: auto`: which modes a flexible body needs, from the loads on it and the results that are wanted.
 *
 * The body is held at its reference node, or free to recoil there along `rigid` motions.  With all coordinates its
 * answer to a load case p is that of linear modes, x(t) = sum X g/lambda cos(w t), g = X'p: a sudden load makes it
 * vibrate; one that varies smoothly at W is answered in phase, with the factor 1/(1 - (W/w)^2).  With fewer
 * coordinates the modes and the answer are others.  The share of the coordinates left out is the largest difference
 * of a view c'x at sampled times, relative to the largest value of the views of its group in the cases of its
 * family.  It includes static parts, shifted frequencies and resonance.
 *
 * Modes are ordered by their shares when each is left out alone, and kept from the largest on until the share of all
 * that are left out together is below the tolerance.  Modes of one frequency, as of a round shaft, are kept
 * together; a body that has no other coordinates keeps at least one. */
#ifndef FMDSUB_FLEX_CHOICE_H
#define FMDSUB_FLEX_CHOICE_H

#include "base/status.h"
#include "flex/body.h"
#include "flex/statics.h"

/* A load case. */
struct flex_case {
    const char *name;
    const double *p; /* [n] generalized forces of the coordinates */
    double rigid[6]; /* and of the rigid motions, in their order */
    double omega;    /* frequency at which it varies, if it is not sudden [rad/s] */
    bool sudden;
    int family; /* number, from 0: cases of comparable size, judged together */
};

/* A result that is wanted, c'x. */
struct flex_view {
    const char *name;
    const double *c; /* [n] */
    int group;       /* number, from 0: views of comparable size, judged together */
    bool tension;    /* axial: counts by its effect on bending alone, a change of phase over the span */
};

/* A further joint: the mass of the body that hangs there moves along b'x, or a loop that is closed there holds it. */
struct flex_tie {
    const double *b; /* [n] */
    double rigid[6]; /* and along the rigid motions */
    double mass;     /* [kg]; 0 where it is held */
    bool held;
};

struct flex_choosing {
    const struct flex_body *all;
    int movable; /* the first so many coordinates may be left out; K is diagonal there */
    int ncase, nview, ntie, nfamily, ngroup, nrigid;
    const int *like; /* [ngroup] the group beside which a group may be negligible: itself or another */
    const struct flex_case *cases;
    const struct flex_view *view;
    const struct flex_tie *tie;
    const double (*rigid)[6]; /* [nrigid] motions of the reference node: displacement, rotation; body axes */
    const double *mass;       /* [nrigid x nrigid] inertia of the other bodies that move with it */
    /* Its centrifugal load stiffens the body where `all` has second-order displacements. */
    double spin[3], about[3]; /* largest driven angular velocity [rad/s], about a point (from the centre of mass) [m] */
    double pull;              /* axial acceleration by gravity and rotation over the length, g/l + W^2 [1/s2] */
    double alpha, beta, zeta; /* damping, as of struct flex_beam */
    double span, tolerance;   /* duration of the run [s]; share that may be left out */
    int least;                /* so many of the lowest modes are kept in any case */
};

/* keep [movable] := whether each is kept; returns the shares, in memory of life. */
const struct flex_chosen *flex_choose(bool *keep, const struct flex_choosing *o, struct arena *life);

/* p [n] := generalized inertia forces on the coordinates by a unit acceleration of the reference node along d
 * (displacement, rotation); and the inertia of the body, as rigid, between two such motions. */
void flex_inertia_load(double *p, const struct flex_body *o, const double *d);
double flex_inertia_between(const struct flex_body *o, const double *d, const double *e);
/* p [n] := generalized centrifugal forces by an angular velocity w about the point x (from the centre of mass). */
void flex_centrifugal_load(double *p, const struct flex_body *o, const double *w, const double *x);

#endif
