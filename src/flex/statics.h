/* statics.h -- the kinds of the modes that a beam keeps, and how much of its compliance and mass they represent.
 *
 * The kind of a mode is that of its strain energy: stretch, torsion, bending along y or along z of the section (with
 * shear).
 *
 * The modes kept are compared with the whole mesh, held at its reference node.  Compliance C = E'K^-1 E at a node:
 * their part is sum phi phi'/lambda.  Under the inertia loads B = M R of the six rigid motions R of the reference
 * node (displacements, then rotations about it, body axes): energy W = B'K^-1 B and effective mass E = B'M^-1 B;
 * their parts, with h = phi'B, are sum h h'/lambda and sum h h'.  All are 6 x 6. */
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
    double energy[36], part[36];    /* W, and its part by the modes */
    double mass[36], mass_part[36]; /* E, and its part by the modes; 0: not known */
    double *node;                   /* [36 x nnode] C; NULL: only the kinds are known */
    double along[3];                /* axis of the beam, body axes */
};

/* Fills o->statics from the mesh: modes Phi [freedoms x n] with eigenvalues lambda [n]; the body's nodes are mesh
 * nodes `mesh` [o->nnode], `reference` is one of the mesh's; axes: of the beam in the body, by column. */
void flex_statics_make(struct flex_body *o, const struct rod *rod, const struct band *K, const struct band *M,
                       const double *lambda, const double *Phi, const int *mesh, int reference, const double *axes,
                       struct arena *life, struct arena *scratch);

/* Result of choice.h for a mode. */
struct flex_chosen_mode {
    double hertz; /* frequency with all joints held [Hz] */
    enum flex_kind kind;
    double share;        /* relative change of the results if it alone were left out */
    const char *by, *of; /* load case and view of that share; NULL: none needs it */
    bool kept;
};
struct flex_chosen {
    int n;
    struct flex_chosen_mode *mode; /* [n] */
    double tolerance, left;        /* share that was allowed; share of all modes left out together */
};

/* How much of a direction the modes represent. */
struct flex_kept {
    double share;  /* of the compliance or energy */
    double mass;   /* of the effective mass; -1: not known, or the direction is a load's */
    double across; /* `share` without the part along the beam, which is stiff; 1 where nothing else is left */
    double weight; /* the whole of that, relative to the largest of any direction of the same size */
};

/* Along d [6]: a force and moment at a node; a motion of the reference node.  The statics of the body must be known.
 * false: the direction has no effect. */
bool flex_kept_of_load(struct flex_kept *o, const struct flex_body *body, int node, const double *d);
bool flex_kept_of_motion(struct flex_kept *o, const struct flex_body *body, const double *d);

#endif
