/* rod.h -- finite elements of a straight beam, in beam axes: x along it, y and z across.
 *
 * Two nodes an element, freedoms u v w (displacement of the centre line) and rx ry rz (rotation of the section) of
 * each; in the plane u v rz.  Strains are those of Timoshenko's beam, to first order
 *
 *     Gamma = r' - theta x e_x = (u', v' - rz, w' + ry),     kappa = theta',
 *
 * with energies 1/2 int Gamma' diag(EA, shear) Gamma + kappa' diag(GJ, bending) kappa ds and
 * 1/2 int rho A r'.r' + theta' rho I theta' ds.  The shape functions of an element are its own statics: the fields that
 * forces and moments at its ends alone produce, whatever its section does in between.  Of a uniform element these are
 * Hermite's cubics, with shear those of Timoshenko's beam (Przemieniecki, Theory of Matrix Structural Analysis, 1968,
 * 5.6; Friedman & Kosmatka, Computers & Structures 47 (1993) 473); tapered or twisted, static loads at nodes still
 * bend the mesh exactly.  Sections are taken at five Gauss points an element. */
#ifndef FMDSUB_FLEX_ROD_H
#define FMDSUB_FLEX_ROD_H

#include "flex/beam.h"
#include "la/band.h"

enum { ROD_GAUSS = 5 };
static const double ROD_SAME = 1e-9; /* of the length: stations nearer to each other are one */
/* Rows of fields: displacement r, rotation theta, strains Gamma and kappa, three each. */
enum { ROD_R = 0, ROD_THETA = 3, ROD_GAMMA = 6, ROD_KAPPA = 9 };

/* Gauss' rule on 0 ... 1 and its running integral: int_0^x[g] f dx = sum over k of part[g][k] f(x[k]). */
struct rod_gauss {
    double x[ROD_GAUSS], w[ROD_GAUSS], part[ROD_GAUSS][ROD_GAUSS];
};
extern const struct rod_gauss rod_gauss;

struct rod_point {
    double s, ds;      /* place, weight [m] */
    double m, I[9];    /* rho A [kg/m], rho I [kg m] */
    double N[12 * 12]; /* [12 fields x 12 freedoms of the element] */
};

struct rod {
    const struct flex_beam *beam;
    int per;   /* freedoms of a node: 6, in the plane 3 */
    int nnode; /* elements and one */
    double *s; /* [nnode] place [m] */
    double length;
    struct rod_point *point; /* [ROD_GAUSS x elements] */
    double *G;               /* [6 x 12 x elements] force and moment at an element's right end, by its freedoms */
};

/* Mesh: nodes at every interface, point, lump and section station; equal elements between, none longer than
 * length / elements. */
void rod_build(struct rod *o, const struct flex_beam *beam, double length, struct arena *life);
/* Node at a station that the mesh has taken in. */
int rod_node(const struct rod *o, double station);

/* Freedom k of an element, of twelve, in the mesh; -1: held by the plane. */
int rod_freedom(const struct rod *o, int element, int k);

/* Numbers of the section there. */
void rod_section(struct flex_section *o, const struct flex_beam *beam, double station);

/* Stiffness and consistent mass of all freedoms; lumps' inertia has to come in beam axes, [9] each. */
void rod_matrices(struct band *K, struct band *M, const struct rod *o, const double *inertia, struct arena *life);

/* For n columns Phi [freedoms x n] of the mesh: W [12 x n], the fields at a Gauss point; displacement and rotation at
 * a node (the strains, which may jump there, are left zero). */
void rod_at_point(double *W, const struct rod *o, int point, const double *Phi, int n);
void rod_at_node(double *W, const struct rod *o, int node, const double *Phi, int n);
/* Q [6 x n], force and moment in the section at a station, on the side of x: those of the element that begins at or
 * before; force and torque linear between the middles of elements no load comes between. */
void rod_forces(double *Q, const struct rod *o, double station, const double *Phi, int n);

#endif
