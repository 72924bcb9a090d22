/* joint.h -- the kinds of joints, as lists of their freedoms, and of ties.
 *
 * A joint lets its second body move against its first.  Joint axes x, y, z are fixed in both bodies and coincide in the
 * drawn position, where every coordinate is 0.  In 2-D z stands out of the plane; where a joint slides along z, it is
 * the axis given, a vector of the plane, and y stands out of it.
 *
 * What a joint lets its bodies do is a list of elementary freedoms, one for each rate: turns about and slides along
 * joint axes; one may do both.  Sizes, names and units of its coordinates, the motion of a tree, usual sizes, and the
 * equations of a loop (which hold what the list leaves) all follow from it.  Order of a list: slides along axes of the
 * first body; turns, about one axis or about one of the first and then one of the second body; a ball, three freedoms that come
 * last: their rates are the angular velocity of the second body against the first in axes of the second, and their
 * positions a unit quaternion, one more than rates.  A slide along the axis of the only turn may stand behind it.
 *
 * Ties are equations and nothing else: they have no coordinates and never carry a body in the tree. */
#ifndef FMDSUB_KIND_JOINT_H
#define FMDSUB_KIND_JOINT_H

#include <stdbool.h>

#include "base/keys.h"

enum joint_type {
    JOINT_FIXED,
    JOINT_REVOLUTE,
    JOINT_PRISMATIC,
    JOINT_CYLINDRICAL,
    JOINT_SCREW,
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

enum { JOINT_MAX_Q = 7, JOINT_MAX_V = 6 };

/* What a deck says of a joint; the same struct for all kinds, each table names its own part. */
struct node;
struct joint_keys {
    const struct node *bodies;   /* [first, second] under the kind's own word */
    const struct node *at;       /* where it stands: a point; default for free: the second body's centre */
    const struct node *axis;     /* that of the first freedom; normal of a plane */
    const struct node *axis2;    /* that of the second turn; x of a plane */
    const struct node *range;    /* [lowest, highest] of the only coordinate */
    const struct node *friction; /* along it */
    int loop;                    /* better one that closes a loop than one of the tree */
    int frame;                   /* 1: reactions in joint axes */
    double number;               /* the kind's own; NAN: not given */
};

struct freedom {
    int axis;              /* 0: x, 1: y, 2: z */
    bool turns, slides;    /* about it, along it */
    bool second;           /* an axis of the second body, else of the first */
    bool ball;             /* one of a ball's three */
    const char *q, *v, *a; /* names of position (of a ball: behind "qw"), rate and acceleration */
};

/* What a tie ties. */
enum joint_tie {
    NO_TIE,         /* a joint */
    TIE_BODIES,     /* two bodies, as a joint in a loop would: it holds what its freedoms leave */
    TIE_POINTS,     /* two points: the number is their distance [m], by default as drawn */
    TIE_COORDINATES /* two coordinates: second = number * first */
};
/* Of a tie of coordinates: those that it takes. */
enum joint_end { END_LIKE_OTHER, END_ANGLE, END_DISPLACEMENT };

struct joint_kind {
    enum joint_type type;
    const char *name;
    const char *brief;
    const struct key *keys; /* besides [first, second] under the kind's own word; the kind's own number comes first */
    bool spatial;           /* not in 2-D */
    struct freedom freedom[JOINT_MAX_V + 1]; /* up to one that neither turns nor slides */
    enum joint_tie tie;
    enum joint_end end[2];
    const char *hint; /* where ends are wrong */
};

/* Index space 0: 2-D, 1: 3-D.  NULL if the kind does not exist there. */
const struct joint_kind *joint_kind(enum joint_type type, int space);
const struct joint_kind *joint_find(const char *name);
/* The i-th word, NULL past the end; a type may have two words, "fixed" and "weld". */
enum { JOINT_WORDS = JOINT_TYPES + 1 };
const struct joint_kind *joint_kind_at(int i);

/* ---- what follows from the freedoms ---- */

/* Numbers of positions (order 0), rates (1) and accelerations (2); a tie has none. */
int joint_size(const struct joint_kind *j, int order);
/* The k-th of them: "angle", "angle_rate", "angle_accel"; its unit. */
const char *joint_name(const struct joint_kind *j, int order, int k);
const char *joint_unit(const struct joint_kind *j, int order, int k);
/* Are its last four positions a quaternion?  All positions before it have the rate of their own number. */
static inline bool joint_turns_freely(const struct joint_kind *j)
{
    return joint_size(j, 0) > joint_size(j, 1);
}

/* How the second body turns against the first; by rates that follow each other in the list, from *first on (NULL: not
 * asked for). */
enum joint_turning {
    TURNS_NEVER,
    TURNS_ABOUT_ONE, /* axis, which both bodies carry */
    TURNS_CROSSED,   /* about an axis of the first body, then about one of the second */
    TURNS_FREELY     /* ball */
};
enum joint_turning joint_turning(const struct joint_kind *j, int *first);
/* Its freedom that slides along the axis; NULL: none does. */
const struct freedom *joint_slide(const struct joint_kind *j, int axis);
/* How far a freedom slides per unit of its coordinate: 0, 1, or [m/rad] by the joint's number [m] for each whole turn. */
double joint_along(const struct freedom *f, double number);

static inline bool joint_is_tie(const struct joint_kind *j)
{
    return j->tie != NO_TIE;
}

/* Does it hold its bodies together for good? */
bool joint_is_fixed(const struct joint_kind *j);
/* Do all its freedoms have one axis?  Then, turned end for end, it has the same coordinates. */
bool joint_has_one_axis(const struct joint_kind *j);

#endif
