/* spatial.h -- what the files of the spatial recursion share.
 *
 * Every body carries an inner frame that lies along the axes of its tree joint (spherical and free joints: along the
 * body's own), so that a rotation about the joint's z turns two columns of R and costs no product.  What enters
 * and leaves goes through `turned`; the fixed pieces below are in inner frames. */
#ifndef FMDSUB_SYSTEM_SPATIAL_H
#define FMDSUB_SYSTEM_SPATIAL_H

#include "la/vec3.h"
#include "system/routes.h"
#include "system/sweep.h"

/* What stays: a joint and the body it moves. */
struct link {
    int parent;
    enum joint_type type;
    int nv, iq[JOINT_MAX_Q], iv[JOINT_MAX_V];
    bool straight;     /* Ea is the unit matrix */
    double Ea[9];      /* the child's inner frame in the parent's when all coordinates are 0 */
    double Et[9];      /* free: axes of the displacements in the parent's inner frame */
    double a[3], b[3]; /* the joint's point from the parent's, the child's centre [m] */
    double mass;
    double inertia[6]; /* about the centre */
    double turned[9];  /* inner axes by column in body axes */
};

/* What moves; world axes. */
struct part {
    double R[9];        /* inner frame to world */
    double w[3], al[3]; /* angular velocity and its rate */
    double r[3];        /* centre of mass */
    double v[3], a[3];  /* of it; gravity is in a as the ground's acceleration -g */
    double rho[3];      /* joint's point on the child from the parent's centre */
    double c[3];        /* the centre from the joint's point */
    double arm[3];      /* rho + c */
    double E[9];        /* axes that stay with the parent: planar, universal; free: of the displacements */
    double F[3], N[3];  /* force and moment about the centre that the joint must bring up */
};

/* A body and all that hangs on it, held stiff: mass, first moment and inertia about the body's centre. */
struct composite {
    double m, h[3], J[6];
};

/* Force F = H' w + M v and moment N = J w + H v for a twist of the centre (w, v): inertia of a body with
 * free joints beyond it. */
struct articulated {
    double J[6], H[9], M[6];
};

/* Angular part first. */
struct twist {
    double w[3], v[3];
};

struct sweep {
    const struct model *model;
    struct rosters rosters;
    int nbody, n;
    struct link *link;               /* [nbody] */
    struct part *part;               /* [nbody] */
    struct composite *composite;     /* [nbody] work of mass() */
    struct articulated *articulated; /* [nbody] work of factor() */
    struct twist *bias;              /* [nbody] work of solve(): forces, then twists */
    double *zero;                    /* [n] */
    struct routes routes;
    bool accelerated; /* the last motion had accelerations */
};

/* Is the k-th velocity of l a rotation? */
static inline bool spatial_turns(const struct link *l, int k)
{
    switch (l->type) {
    case JOINT_PRISMATIC:
        return false;
    case JOINT_CYLINDRICAL:
        return k == 0;
    case JOINT_PLANAR:
        return k == 2;
    case JOINT_FREE:
        return k >= 3;
    default:
        return true;
    }
}

/* Unit axis of the k-th velocity of l, world axes. */
static inline const double *spatial_axis(const struct part *x, const struct link *l, int k)
{
    switch (l->type) {
    case JOINT_UNIVERSAL:
        return k == 0 ? x->E : x->R + 3;
    case JOINT_SPHERICAL:
        return x->R + 3 * k;
    case JOINT_PLANAR:
        return k == 2 ? x->R + 6 : x->E + 3 * k;
    case JOINT_FREE:
        return k < 3 ? x->E + 3 * k : x->R + 3 * (k - 3);
    default:
        return x->R + 6;
    }
}

/* Twist of the child about its centre for unit rate of the k-th velocity. */
static inline void spatial_unit(struct twist *o, const struct part *x, const struct link *l, int k)
{
    const double *e = spatial_axis(x, l, k);
    if (spatial_turns(l, k)) {
        v3_copy(o->w, e);
        v3_cross(o->v, e, x->c);
    } else {
        v3_set(o->w, 0, 0, 0);
        v3_copy(o->v, e);
    }
}

struct sweep *spatial_build(const struct model *m, struct arena *life);

/* Positions of the bodies of cls. */
void spatial_place(struct sweep *s, const double *q, unsigned cls);

void spatial_mass(struct sweep *s, double *M, const double *q, unsigned cls);
size_t spatial_factor_size(const struct sweep *s);
int spatial_factor(struct sweep *s, void *F, double cm, const double *d, const double *q);
void spatial_solve(const struct sweep *s, const void *F, double *x);

#endif
