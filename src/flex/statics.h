/* statics.h -- what the modes that a beam keeps are, and what they leave of it.
 *
 * A mode's kind is that of its strain energy: stretch, torsion, bending along y and along z of the section (with their
 * shear).  What is kept is compared with the whole mesh, held at the reference node: the compliance C = E'K^-1 E at a node
 * with its part by modes, sum of phi phi'/lambda; and under the inertia loads B = M R of the six rigid motions R of the
 * reference node (displacements, then rotations about it, body axes) the energy W = B'K^-1 B and the effective mass
 * E = B'M^-1 B with theirs, of h = phi'B: sums of h h'/lambda and h h'.  6 x 6 each. */
#ifndef FMDSUB_FLEX_STATICS_H
#define FMDSUB_FLEX_STATICS_H

#include "flex/body.h"

struct rod;
struct band;

enum flex_kind { FLEX_STRETCH, FLEX_TORSION, FLEX_BENDING_Y, FLEX_BENDING_Z, FLEX_MIXED };

static inline const char *flex_kind_name(enum flex_kind kind)
{
    static const char *const names[] = {"stretch", "torsion", "bending y", "bending z", "mixed"};
    return names[kind];
}

struct flex_statics {
    enum flex_kind *kind;           /* [n] */
    double energy[36], part[36];    /* W, and what the modes have of it */
    double mass[36], mass_part[36]; /* E likewise; 0: not known */
    double *node;                   /* [36 x nnode] C; NULL: it is known what the modes are, but not what they keep */
    double along[3];                /* the beam's axis, body axes */
};

/* Statics and far from the mesh: modes Phi [freedoms x n] with lambda, the body's nodes at mesh nodes `mesh` [o->nnode],
 * `reference` one of them; axes: of the beam in the body, by column. */
void flex_statics_make(struct flex_body *o, const struct rod *rod, const struct band *K, const struct band *M,
                       const double *lambda, const double *Phi, const int *mesh, int reference, const double *axes,
                       struct arena *life, struct arena *scratch);

/* Modes by evidence (choice.h): what was found of one of them. */
struct flex_chosen_mode {
    double hertz; /* held at all joints */
    enum flex_kind kind;
    double share;        /* of what is looked at, if it alone were left out */
    const char *by, *of; /* the case and the view of that share; NULL: none asks for it */
    bool kept;
};
struct flex_chosen {
    int n;
    struct flex_chosen_mode *mode; /* [n] */
    double tolerance, left;        /* the share of all that are left out */
};

/* How much of a direction is kept. */
struct flex_kept {
    double share;  /* of the compliance or energy */
    double mass;   /* of the effective mass; -1: not known, or a load */
    double across; /* the share without what pulls along the beam, which is stiff: 1 where nothing is left */
    double weight; /* the whole across against the most of any direction of the same size */
};

/* Of a body whose statics are known, along d [6]: of a force and moment at a node; of a motion of the reference node. 
 * False: the direction does nothing. */
bool flex_kept_of_load(struct flex_kept *o, const struct flex_body *body, int node, const double *d);
bool flex_kept_of_motion(struct flex_kept *o, const struct flex_body *body, const double *d);

#endif
