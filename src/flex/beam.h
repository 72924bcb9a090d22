/* beam.h -- a beam made into a reduced flexible body: finite elements, Craig-Bampton.
 *
 * The beam runs straight from a to b.  Nodes stand at its ends and at every interface, point, lump and section
 * station; between them equal elements, none longer than length / `elements`.  Elements bend (Euler-Bernoulli, or
 * Timoshenko where shear factors are given), stretch and twist by their own statics and have consistent mass: see
 * rod.h.  Beam axes: x along it, y and z across; body axes are where the deck puts them.  Between the stations
 * given sections change as section_between() has it (two at one station: a jump), beyond the first and last they stay.
 *
 * Modes: constraint modes of every interface node but the first, then the `modes` lowest modes with all interface nodes
 * clamped (Craig & Bampton, AIAA J. 6 (1968) 1313), then one diagonalisation of the whole: coordinates are modes with
 * the first interface node clamped, mass one, ascending, their largest displacement (without any: rotation) positive.
 * Stretch and torsion count among them. */
#ifndef FMDSUB_FLEX_BEAM_H
#define FMDSUB_FLEX_BEAM_H

#include "base/status.h"
#include "flex/body.h"
#include "flex/section.h"

struct flex_lump {
    double station, mass;
    double inertia[6]; /* xx yy zz xy xz yz, body axes; 0 allowed */
};

struct flex_probe { /* a stress wanted */
    const char *name;
    double station;
    double y, z; /* where in the section, in half sizes: -1 ... 1 */
};

struct flex_beam {
    int space;         /* 2: stretch and bending in the plane: rotation about body z, beam z is body z */
    double a[3], b[3]; /* ends, world axes as drawn [m] */
    double R[9];       /* body axes in the world, by column */
    double up[3];      /* space 3: beam z leans towards it (world); 0: towards world z, along z towards world y */
    int elements, modes;
    int nsection;
    const struct flex_section *section; /* [nsection] ascending; one holds for all */
    double E, G, density;
    double alpha, beta; /* Rayleigh damping D = alpha M + beta K [1/s], [s] */
    double zeta;        /* or modal damping, the same ratio in all modes */
    int ninterface;     /* stations of joints, [ninterface], the first is the reference; at least one */
    const double *interface;
    int npoint; /* further nodes for forces, measures and output */
    const double *point;
    int nlump;
    const struct flex_lump *lump;
    int nprobe;
    const struct flex_probe *probe;
    const bool *pick; /* [modes] which of the lowest are kept; NULL: all */
    bool raw;         /* for a choice of modes: coordinates are the lowest modes with all interfaces clamped, as many of
                       * `modes` as the mesh has, then the static displacements; K is not diagonal */
    bool stiffening;  /* geometric: second-order displacements by bending, torsion and stretch (beam.c) */
};

/* Nodes of the result: interfaces in order, then points in order, then both ends; the reference is node 0, the first
 * interface.  Interfaces at one station share its constraint modes.  at [3]: world place of the undeformed centre of
 * mass.  Stresses are xx by stretch and bending and, in sections of a known shape, xy and xz by torsion and transverse
 * forces, at the section's point in beam axes; exact for static loads at nodes as far as section_shear() is.  Fails
 * (E_MODEL) where there are more modes than freedoms, a matrix is not positive, or a stress point lies in a section of
 * unknown outline. */
enum status flex_beam_make(struct flex_body **out, double *at, const struct flex_beam *o, struct arena *life,
                           struct report *report);

#endif
