/* body.h -- a reduced flexible body as data.
 *
 * A floating frame and n elastic coordinates q: a particle drawn at x stands, in the frame, at
 *
 *     x + u,   u = Phi q + 1/2 q' S q                                                          [m]
 *
 * (second-order kinematics: S is the shortening that comes with bending; it carries all of the geometric
 * stiffness), and a node's small body turns by the Cayley map of theta = Psi q + 1/2 q' T q.  The frame is that of the
 * reference node, which does not move in it: Phi = Psi = S = T = 0 there.  Its axes are the body's, its origin the
 * undeformed centre of mass, so that the integral of x is zero.
 *
 * All inertia terms come from one kinetic energy T(v, w, q, q'); the integrals below are all it needs (the standard
 * input data of Wallrapp, Mech. Struct. Mach. 22 (1994) 441, in another order).  dm runs over the body; integrals
 * of products ab' are 3 x 3, by column.  SI units. */
#ifndef FMDSUB_FLEX_BODY_H
#define FMDSUB_FLEX_BODY_H

#include <stdbool.h>

#include "base/arena.h"

/* Where a joint, force or measure may take hold. */
struct flex_node {
    const char *name; /* NULL: none */
    double x[3];      /* undeformed, from the centre of mass, body axes [m] */
    double *phi;      /* [3 x n] displacement by coordinate */
    double *psi;      /* [3 x n] rotation [rad] */
    double *S;        /* [3 x n x n], S[a + 3 (i + n j)], symmetric in i and j; NULL: zero */
    double *T;        /* [3 x n x n] rotation of second order, likewise */
};

/* A stress at a named point, linear in the coordinates: six rows xx yy zz xy xz yz of the tensor in the axes that
 * the maker chose (a beam's: x along it), and a beam's parts of xx. */
struct flex_stress {
    const char *name;
    double *tensor;  /* [6 x n] [Pa] by coordinate */
    double *axial;   /* [n], NULL: not told apart */
    double *bending; /* [n] */
    bool shear;      /* a beam's: xy and xz are known */
};

/* Where the modes with all joints clamped end. */
struct flex_edge {
    double hertz[2]; /* the highest that is kept and the lowest that is left out; 0, 0: not known */
    bool parted;     /* they are one frequency, of which some modes are kept and some are not */
    int whole[2];    /* then: numbers of modes below and above that keep all or none; 0: there are no more */
};

struct flex_statics;
struct flex_chosen;
struct flex_body {
    int n;         /* elastic coordinates */
    int inner;     /* for a choice of modes: the first of them, which move no joint; else 0 */
    int reference; /* number of the reference node */
    bool affine;   /* in the plane: with the shapes split and the nodes turned as in space, see planar.h */
    int nnode;
    struct flex_node *node; /* [nnode] */
    int nstress;
    struct flex_stress *stress; /* [nstress] */
    double mass;
    double xx[9];  /* int x x' dm; symmetric */
    double rot[9]; /* int rho I: rotary inertia of sections, body axes; symmetric */
    double *f;     /* [3 x n]         int phi_j dm */
    double *xf;    /* [9 x n]         int x phi_j' dm */
    double *ff;    /* [9 x n x n]     int phi_i phi_j' dm, block i + n j */
    double *rpsi;  /* [3 x n]         int rho I psi_j */
    double *ppsi;  /* [n x n]         int psi_i' rho I psi_j */
    double *s;     /* [3 x n x n]     int S_ij dm; NULL with xs: no geometric stiffening */
    double *xs;    /* [9 x n x n]     int x S_ij' dm */
    double *K;     /* [n x n] stiffness; symmetric >= 0 [N/m] */
    double *D;     /* [n x n] damping; NULL: none */
    struct flex_edge edge;
    struct flex_statics *statics; /* of a beam held at its reference node, see statics.h; NULL: not known */
    double *far; /* [2 x n] how far a coordinate moves [m] and turns [rad] a particle at most, per unit; NULL: no
                    * farther than nodes, as far as is known */
    const struct flex_chosen
        *chosen;   /* of which modes its own were chosen, see choice.h; NULL: the deck says how many */
    double *hertz; /* [n] frequencies with the reference node clamped, by coordinate, where coordinates are modes;
                    * NULL: they are not */
};

/* Takes all arrays for n coordinates, nnode nodes and nstress stresses, zero; stiffening: with s, xs and S. */
struct flex_body *flex_body_take(int n, int nnode, int nstress, bool stiffening, struct arena *life);

/* Adds to all integrals the mass m at x (from the centre of mass) with rotary inertia `spin` [9], where the fields are
 * phi, psi [3 x n], S [3 x n x n] (NULL: zero).  With T [3 x n x n] in a body with s the small body turns by
 * 1 + [theta]x + [theta]x^2/2 + [1/2 q'Tq]x, theta = psi q, and its inertia with it: it is a cloud of particles then,
 * with nothing in rot, rpsi and ppsi.  What exceeds a cloud's inertia (one principal moment above the sum of the others)
 * turns about its axis but does not tilt against the frame.
 * T NULL: its inertia keeps the axes of the frame. */
void flex_body_add(struct flex_body *o, const double *x, double m, const double *spin, const double *phi,
                   const double *psi, const double *S, const double *T);

/* The same body with the frame at another node: the same coordinates, every field less the rigid motion of that node,
 *     phi' = phi - phi_0 - psi_0 x (x - x_0),  psi' = psi - psi_0,
 * and S', T' to second order in the same way.  Stiffness, damping and stresses do not change; hertz is gone where the
 * node moves, since the coordinates are no modes of the body so held. */
struct flex_body *flex_refer(const struct flex_body *o, int node, struct arena *life);

/* Mass matrix of the coordinates with the frame at rest, q = 0: Me = tr ff + ppsi [n x n]. */
void flex_mass(double *Me, const struct flex_body *o);

#endif
