/* beam.h -- a beam made into a reduced flexible body: finite elements, Craig-Bampton.
 *
 * The beam runs straight from a to b, `elements` elements of equal length, two nodes each, cubic bending
 * (Euler-Bernoulli, or Timoshenko's with the consistent shear correction where shear factors are given: Przemieniecki
 * 1968), linear stretch and torsion, consistent mass with rotary inertia.  Beam axes: x along it, y and z across; body
 * axes are where the deck puts them.  Sections vary linearly between the stations given and are taken at the
 * integration points.  Modes: constraint modes of every interface node but the first, then the `modes` lowest modes
 * with all interface nodes clamped (Craig & Bampton, AIAA J. 6 (1968) 1313), then one diagonalisation of the whole:
 * coordinates are modes with the first interface node clamped, mass one, ascending, their largest displacement or
 * rotation positive. */
#ifndef FMDSUB_FLEX_BEAM_H
#define FMDSUB_FLEX_BEAM_H

#include "base/status.h"
#include "flex/body.h"

/* A cross-section at a station; y, z beam axes before twist. */
struct flex_section {
    double station; /* 0 ... 1 along the beam */
    double A;       /* area [m2] */
    double Iy, Iz;  /* int z2, int y2 dA [m4] */
    double J;       /* torsion constant [m4] */
    double ky, kz;  /* shear area over area, for forces along y, z; 0: no shear deformation */
    double twist;   /* of the section's axes about x [rad] */
    double rotary;  /* 1: rotary inertia rho I counts, 0: it does not */
    double y, z;    /* half sizes: where the corners are, for stresses [m]; 0: not known */
};

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
    double up[3];      /* space 3: beam z leans towards it (world); 0: any, chosen as for joints */
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
    bool stiffening; /* geometric: shortening by bending */
};

/* Nodes of the result: interfaces in order, then points in order, then both ends.  at [3]: world place of its
 * undeformed centre of mass. An interface or point between two nodes of the mesh gets its own node there: the mesh
 * takes it in. Fails (E_MODEL) where there are more modes than freedoms, or a matrix is not positive. */
enum status flex_beam_make(struct flex_body **out, double *at, const struct flex_beam *o, struct arena *life,
                           struct report *report);

#endif
