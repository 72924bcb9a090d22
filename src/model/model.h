/* model.h -- the mechanism in numbers: tree, loops, coordinates, elements.
 *
 * Made from a scene once, read by system/ as const.  Body 0 is the ground; every other body hangs on
 * one tree joint from a body of lower index; joints that are left over close loops.  Coordinates are those of the
 * tree, numbered fast first, then those of near bodies, then the rest.  SI units.
 * In the plane (space = 2) vectors are (x, y, 0), rotations are about z. */
#ifndef FMDSUB_MODEL_MODEL_H
#define FMDSUB_MODEL_MODEL_H

#include <stdbool.h>

#include "base/rate.h"
#include "flex/statics.h"
#include "kind/contact.h"
#include "kind/force.h"
#include "kind/joint.h"

struct model_body {
    const char *name;
    double mass;
    double inertia[6];            /* xx yy zz xy xz yz: tensor about the centre of mass, body axes [kg m2] */
    double at[3];                 /* drawn position of the centre of mass, world [m] */
    double R[9];                  /* drawn orientation, body to world, by column */
    const double *swung;          /* [6] inertia for w x J w; NULL: its own */
    double *held;                 /* [6] likewise: holds turns that move no mass, see system/idle.h; NULL: flexible */
    int parent;                   /* -1 for the ground */
    int joint;                    /* its tree joint; -1 for the ground */
    bool fast;                    /* a fast coordinate moves it */
    bool near;                    /* the fast class reads or moves the coordinates of its joint */
    const struct flex_body *full; /* with what effects have left out of flex; NULL: nothing */
    const struct flex_body *flex; /* NULL: rigid; mass and inertia are then those of the undeformed body */
    int nmode, *mode_q, *mode_v;  /* [nmode] places of its elastic coordinates in q and v: q' = v */
    int nmade;                    /* elastic coordinates that the deck asks for, and */
    const int *made;              /* [nmode] which of these they are: the others stay 0, see model/mirror.h */
    bool at_node;                 /* a massless body that stands at a node of its parent, which is flexible: fixed */
    int node;                     /* to it by a joint of no freedom; number of the node */
    int component;                /* of the loops that tie its elastic coordinates; -1: none */
};

struct model_joint {
    const char *name;
    enum joint_type type;
    int parent, child;   /* tree direction: parent < child */
    bool reversed;       /* the deck's first body is the child: model/ has turned the axes so that the
                          * coordinates still are of the deck's second body against its first; only
                          * reactions need to know */
    bool exchanged;      /* its two coordinates have changed places so */
    double a[3], b[3];   /* the joint's point: from the parent's centre in parent axes; child likewise [m] */
    double Ea[9], Eb[9]; /* joint axes x, y, z by column in parent axes, in child axes: equal in the
                          * world when the coordinates are 0 */
    const double *own;   /* [9] axes of its reactions by column, in axes of the deck's first body; NULL: the world's */
    double number;       /* of its kind, see kind/joint.h */
    int nq, nv;          /* as its kind has them */
    int iq[JOINT_MAX_Q]; /* places in q */
    int iv[JOINT_MAX_V]; /* places in v; for plain coordinates q' = v: iq[k] and iv[k] pair up */
};

/* A coordinate of the tree in a sum. */
struct model_term {
    int joint, k; /* its k-th position and rate, which pair up */
    bool angular;
    double factor;
};

/* A joint that closes a loop, or a tie: equations C(q) = 0 (2-2) between two bodies of the tree, which have no
 * coordinates.  A drive is one more: C(q, t) = 0. */
struct model_loop {
    const char *name;
    enum joint_type type;
    int first, second;   /* bodies, in the deck's order; gear, rack: those that the coordinates move */
    double a[3], b[3];   /* the joint's point: from the first body's centre, its axes; second likewise [m] */
    double Ea[9], Eb[9]; /* joint axes x, y, z by column in the axes of the first, the second body */
    double number;       /* of its kind, see kind/joint.h: length [m]; NAN: none */
    int nterm;           /* gear, rack: sum of factors times coordinates = 0; others: 0 */
    struct model_term term[2];
    const double *own;          /* as in model_joint */
    int component;              /* loops that share coordinates are one component */
    const struct signal *drive; /* not a joint but one equation, s(q) = c(t) of a measure; NULL: a joint */
    int measure;
};

/* A coordinate's plain positions and velocities have the same number k < n for q and v unless a
 * quaternion comes in; quaternions and displacements of free and spherical joints follow the rule:
 * free: q = (x, y, z, qw, qx, qy, qz), v = (x', y', z', wx, wy, wz). */

struct model_point {
    const char *name; /* "body.point" */
    int body;
    double p[3];     /* from the body's centre of mass, body axes [m] */
    int frame;       /* named points of a flexible body: that body, of a beam in segments the first; else 0 */
    double drawn[3]; /* from the frame's origin, its axes, undeformed [m] */
};

struct model_measure {
    const char *name;
    enum measure_type type;
    bool angular; /* [rad], else [m] */
    int iq, iv;
    struct model_point a, b;
    double axis[3]; /* unit, axes of a's body */
    bool in_world;  /* an angle in space as the world sees it: axis is in its axes */
    bool fast;      /* reads the relative motion of anything fast */
};

/* What an expression's slot stands for. */
enum slot_type { SLOT_TIME, SLOT_MEASURE, SLOT_MEASURE_RATE, SLOT_Q, SLOT_V };
struct model_slot {
    enum slot_type type;
    int index; /* measure, or place in q or v */
};

struct model_force {
    const char *name;
    enum force_type type;
    enum rate cls;                 /* FAST or SLOW; time-only loads are FAST */
    int measure;                   /* along which it acts: FORCE_LAW, FORCE_VALUE; -1: between a and b */
    const struct force_kind *kind; /* FORCE_LAW, FORCE_BETWEEN */
    const void *par;               /* the kind's block */
    struct signal value[3];        /* FORCE_VALUE: 1; FORCE_LOAD: x, y, z (plane: torque is z) */
    bool corners;                  /* are there known ones in any value, see signal_time()? */
    int nslot;
    const struct model_slot *slot; /* [nslot], slot 0 is t */
    struct model_point a, b;       /* FORCE_LOAD: point b, a the ground; FORCE_BETWEEN: the markers */
    bool torque, body_axes;        /* FORCE_LOAD */
};

/* A rigid contact, see kind/contact.h. */
struct model_contact {
    const char *name;
    enum contact_pair pair;
    struct contact_law law;
    int iq, iv;              /* PAIR_STOP, PAIR_FRICTION: its coordinate; -1: of a loop, it has none */
    int joint, loop;         /* PAIR_FRICTION: of the tree, or -1; or a loop */
    double side, limit;      /* and where it is closed, see contact/contact.h */
    bool angular;            /* its gap is an angle */
    struct model_point a, b; /* others: centre of the sphere; a point of the plane, centre of the other sphere */
    double normal[3];        /* of the plane, x axis of the outline, and */
    double along[3];         /* where its friction is counted from; axes of b's body */
    double radius, other;    /* of the sphere at a; of that at b.  PAIR_FRICTION: arm of the force, length of a guide */
    const struct outline *outline; /* PAIR_OUTLINE: from b */
    int across;                    /* directions of friction */
    bool fast;
};

struct model_coordinate {
    const char *name; /* "hub.angle" */
    int joint, k;     /* which one of its joint; a mode: its body's joint, and behind the joint's own */
    int iq, iv;       /* iv = -1: a quaternion part */
    bool fast;        /* or in a component that has a fast coordinate */
};

/* Of a beam's bending by a motion of the joints that carry it, by gravity or a load, what its modes have of the
 * whole mesh: see flex/statics.h. */
struct model_kept {
    int body;
    const char *name; /* "shaft.angle", a force's */
    bool asked;       /* the deck has a drive, a force or a load there */
    struct flex_kept kept;
};

/* Which floating trees (open/floating.h) keep their momenta only as far as the scheme does by itself: none; those of more
 * than a rigid body that no force but gravity acts on from outside; all. */
enum model_drift { DRIFT_NONE, DRIFT_ALONE, DRIFT_ALL };

struct model {
    int space;      /* 2 or 3 */
    bool flattened; /* in the plane, for a scene in space */
    double gravity[3];
    unsigned off; /* effects that the deck turns off, though there is some: effect_bit() */
    enum model_drift drift;
    int n, ns, near, nq; /* as in ode2.h */
    int nbody;
    const struct model_body *body; /* [nbody], 0 is the ground, parents first */
    int njoint;
    const struct model_joint *joint; /* tree joints, [njoint] = nbody - 1, joint i moves body i + 1 */
    int nloop;
    const struct model_loop *loop; /* [nloop] */
    int ncomponent;
    const int *component;   /* [njoint] of a tree joint, NULL without loops; -1: in no loop */
    const bool *urgent;     /* [n], NULL without loops: the deck calls the coordinate fast */
    const double *follow;   /* [n], NULL without loops: how readily it becomes dependent at the start, (0, 1] */
    const double *follow_q; /* [n] the same on the way there: positions that the deck gives lead */
    const double *follow_v; /* [n] likewise rates */
    int nmeasure;
    const struct model_measure *measure;
    int nforce;
    const struct model_force *force;
    int ncontact;
    const struct model_contact *contact;
    int npoint;
    const struct model_point *point; /* named points, for output */
    int ncoordinate;
    const struct model_coordinate *coordinate; /* every position, in q order */
    const double *q0, *v0;                     /* [nq], [n] initial state */
    const bool *given_q, *given_v;             /* [nq], [n] does the deck say so? NULL: of none */
    double t0;                                 /* when it starts [s] */
    double length;                             /* as the run that this one goes on from told it [m]; 0: there is none */
    bool assemble;                             /* it need not fit the loops: the nearest one that does */
    const int *body_of;                        /* model's index of the scene's body i (body 0: ground) */
    const int *joint_of;                       /* model's index of the scene's joint i; -1: not in the tree */
    const int *loop_of;                        /* likewise among the loops; -1: not there */
    int nkept;
    struct model_kept *kept; /* [nkept] */
    int ndrive;              /* the last ndrive loops are drives, in the scene's order */
};

/* The kind of one of its joints or loops. */
static inline const struct joint_kind *model_kind(const struct model *m, enum joint_type type)
{
    return joint_kind(type, m->space == 3);
}

/* Which of its rates is the k-th of the deck's joint, and the other way round. */
static inline int model_rate(const struct model_joint *j, int k)
{
    return j->exchanged ? 1 - k : k;
}

/* Which of its coordinates is the deck's mode k (from 0); -1: none, it stays 0. */
static inline int model_mode(const struct model_body *b, int k)
{
    for (int i = 0; i < b->nmode; i++)
        if (b->made[i] == k) return i;
    return -1;
}

/* The number of the first loop that is a drive; nloop where there are none. */
static inline int model_first_drive(const struct model *m)
{
    return m->nloop - m->ndrive;
}

#endif
