/* joint.h -- the kinds of joints and the names of their coordinates.
 *
 * A joint lets its second body move against its first.  Joint axes x, y, z are fixed in both bodies
 * and coincide in the drawn position, where every coordinate is 0.
 *
 *   fixed        none
 *   revolute     angle about z (in 2-D: out of the plane)
 *   prismatic    displacement along z (in 2-D: z is the axis given, a vector of the plane)
 *   cylindrical  angle about and displacement along z
 *   universal    angle1 about x of the first body, then angle2 about y of the second
 *   spherical    unit quaternion; rates: angular velocity of second against first, in axes of the second
 *   planar       displacements x, y along x, y of the first body, angle about z
 *   free         displacements along x, y, z of the first body, then as spherical; in 2-D: planar
 *
 * Ties are equations and nothing else: they have no coordinates and never carry a body in the tree.
 *
 *   distance       a point of the second body stays at one distance from a point of the first: a massless rod
 *   point-on-line  a point of the second body stays on the line along z through it, fixed in the first
 *   gear           a coordinate is ratio times another, both angles or both displacements
 *   rack           a displacement is radius times an angle */
#ifndef FMDSUB_KIND_JOINT_H
#define FMDSUB_KIND_JOINT_H

#include <stdbool.h>

#include "base/keys.h"

enum joint_type {
    JOINT_FIXED,
    JOINT_REVOLUTE,
    JOINT_PRISMATIC,
    JOINT_CYLINDRICAL,
    JOINT_UNIVERSAL,
    JOINT_SPHERICAL,
    JOINT_PLANAR,
    JOINT_FREE,
    JOINT_DISTANCE,
    JOINT_POINT_ON_LINE,
    JOINT_GEAR,
    JOINT_RACK,
    JOINT_TYPES
};

static inline bool joint_is_tie(enum joint_type type)
{
    return type > JOINT_FREE;
}

enum { JOINT_MAX_Q = 7, JOINT_MAX_V = 6 };

/* What a deck says of a joint; the same struct for all kinds, each table names its own part. */
struct node;
struct joint_keys {
    const struct node *bodies; /* [first, second] under the kind's own word */
    const struct node *at;     /* where it stands: a point; default for free: the second body's centre */
    const struct node *axis;   /* z (revolute, prismatic, cylindrical, point-on-line), normal (planar) */
    const struct node *axis2;  /* universal: y; planar: x */
    const struct node *range;  /* revolute, prismatic: [lowest, highest] of the coordinate */
    int loop;                  /* better one that closes a loop than one of the tree */
    int frame;                 /* 1: reactions in joint axes */
    double length;             /* distance; NAN: as drawn */
    double ratio, radius;      /* gear: c2 = ratio c1; rack: displacement = radius angle */
};

struct joint_kind {
    enum joint_type type;
    const char *name;
    const char *brief;
    const struct key *keys; /* besides [first, second] under the kind's own word */
    int nq[2], nv[2];       /* sizes in 2-D and in 3-D; -1: not in that space */
    const char *const *q;   /* names of positions, "angle"; nq of them (2-D ones first where they differ) */
    const char *const *qunit;
    const char *const *v; /* names of rates, "angle_rate", "omega_x" */
    const char *const *vunit;
    const char *const *a; /* names of accelerations, "angle_accel" */
    const char *const *aunit;
};

/* Index space 0: 2-D, 1: 3-D.  NULL if the kind does not exist there. */
const struct joint_kind *joint_kind(enum joint_type type, int space);
const struct joint_kind *joint_find(const char *name);
/* The i-th word, NULL past the end; a type may have two words, "fixed" and "weld". */
enum { JOINT_WORDS = JOINT_TYPES + 1 };
const struct joint_kind *joint_kind_at(int i);

#endif
