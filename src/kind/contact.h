/* contact.h -- what may not be passed, and what holds back: rigid contacts and their laws.
 *
 * A contact has a gap g(q), open where it is positive, and pushes with a force N >= 0 along its gradient where it is
 * closed: 0 <= g, N >= 0, one of them 0 (Signorini).  An impact turns the speed of approach round by Newton's
 * restitution.  Across, a friction force of at most mu N resists sliding (Coulomb).
 *
 * What has a stiffness is no such contact but forces: kind/unilateral.h, kind/sliding.h.
 *
 * Friction in a joint has no gap: N is the joint's own force, of the same motion, along its arm. */
#ifndef FMDSUB_KIND_CONTACT_H
#define FMDSUB_KIND_CONTACT_H

enum contact_pair {
    PAIR_STOP,     /* an end of the range of a joint's coordinate: g = side (s - limit) */
    PAIR_PLANE,    /* a sphere, or with radius 0 a point, over a plane */
    PAIR_SPHERES,  /* two spheres side by side */
    PAIR_HOLE,     /* a sphere inside of another */
    PAIR_OUTLINE,  /* a disc, or with radius 0 a point, on a profile or a cam of a planar body */
    PAIR_FRICTION, /* no gap: friction along the coordinate of a joint */
    CONTACT_PAIRS
};

struct contact_law {
    double restitution;      /* speed after over speed before, [0, 1] */
    double holding, sliding; /* coefficients of friction where it sticks and where it slides; 0: smooth */
    double preload;          /* of a joint: friction that no force of it changes [N] or [N m] */
    double speed;            /* of the surface, along its direction [m/s] */
};

#endif
