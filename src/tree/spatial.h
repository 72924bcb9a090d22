/* spatial.h -- what the files of the spatial recursion share.
 *
 * Every body carries an inner frame that lies along the axes of its tree joint (one that turns freely: along the
 * body's own), so that a rotation about the joint's z turns two columns of R and costs no product.  What enters
 * and leaves goes through `turned`; the fixed pieces below are in inner frames. */
#ifndef FMDSUB_TREE_SPATIAL_H
#define FMDSUB_TREE_SPATIAL_H

#include "flex/motion.h"
#include "la/vec3.h"
#include "tree/routes.h"
#include "tree/sweep.h"

/* What stays: a joint and the body it moves.  A rate turns its body, or slides it, or slides it as it turns. */
struct link {
    int parent;
    enum joint_turning turning;
    int nv, iq[JOINT_MAX_Q], iv[JOINT_MAX_V];
    int turn;                  /* the first rate that turns; their axes: z; x and y; those of a ball */
    int slide, nslide;         /* the first rate that slides, and how many do; their axes: columns side by side */
    bool turns[JOINT_MAX_V];   /* does the k-th rate? */
    double along[JOINT_MAX_V]; /* how far it slides per unit, 0: not at all; 1 of all but the first */
    size_t axis[JOINT_MAX_V];  /* its axis: where this stands in the part, as offsetof() counts */
    bool apart;                /* they slide along axes that the turn moves away from */
    bool straight;             /* Ea is the unit matrix */
    double Ea[9];              /* the child's inner frame in the parent's when all coordinates are 0 */
    double Et[9];              /* ball: axes of the displacements in the parent's inner frame */
    double a[3], b[3];         /* the joint's point from the parent's, the child's centre [m] */
    double mass;
    double inertia[6]; /* about the centre */
    double swung[6];   /* the same for w x J w */
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
    double E[9];        /* joint axes that stay with the parent, where the child turns away from one in use */
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

/* A flexible body: its part is the frame, its inertia the kernel's. */
struct flexible {
    const struct flex_kernel *kernel;
    struct flex_shape shape;
    long change, shaped; /* count of changes of q; that of the shape */
    double mass;
    int body, n;
    const int *iq, *iv;     /* [n] its coordinates */
    double *q, *q1, *q2;    /* [n] at hand */
    double *Q;              /* [n] what the rows of its coordinates need */
    double *dQ;             /* [n] work of spatial_adjust_motion() */
    double R[9];            /* body axes to world */
    int nnode[4], *node[4]; /* bodies at its nodes by class, as the rosters have them */
};

/* A body that stands at a node of a flexible one. */
struct node_body {
    const struct flexible *on; /* NULL: it hangs on a joint */
    int node;
    struct flex_place place;
    long change; /* of the coordinates that place is for */
    double E[9]; /* its inner frame in the node's axes */
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
    int nflexible;
    struct flexible *flexible;     /* [nflexible], parents first */
    struct flexible **flexible_of; /* [nbody] NULL: rigid; itself NULL where all are, like the next */
    struct node_body *node_body;   /* [nbody] */
    bool accelerated;              /* the last motion had accelerations */
};

/* Unit axis of the k-th velocity of l, world axes. */
static inline const double *spatial_axis(const struct part *x, const struct link *l, int k)
{
    return (const double *)(const void *)((const char *)x + l->axis[k]);
}

/* Twist of the child about its centre for unit rate of the k-th velocity. */
static inline void spatial_unit(struct twist *o, const struct part *x, const struct link *l, int k)
{
    const double *e = spatial_axis(x, l, k);
    if (!l->turns[k]) {
        v3_set(o->w, 0, 0, 0);
        v3_copy(o->v, e);
        return;
    }
    v3_copy(o->w, e);
    v3_cross(o->v, e, x->c);
    if (l->along[k] != 0) v3_axpy(o->v, l->along[k], e);
}

/* Power of a force f and a moment n about the joint's point on the child for unit rate of the k-th velocity. */
static inline double spatial_power(const struct part *x, const struct link *l, int k, const double *f, const double *n)
{
    const double *e = spatial_axis(x, l, k);
    if (!l->turns[k]) return v3_dot(e, f);
    return l->along[k] == 0 ? v3_dot(e, n) : v3_dot(e, n) + l->along[k] * v3_dot(e, f);
}

/* Moment about the joint's point on the child. */
static inline void spatial_moment(double *n, const struct part *x)
{
    v3_copy(n, x->N);
    v3_cross_add(n, x->c, x->F);
}

struct sweep *spatial_build(const struct model *m, enum purpose purpose, const bool *bodies, struct arena *life);

void spatial_place(struct sweep *s, const double *q, unsigned cls);

static inline struct flexible *spatial_flexible(const struct sweep *s, int body)
{
    return s->nflexible ? s->flexible_of[body] : NULL;
}

static inline struct node_body *spatial_node_body(const struct sweep *s, int body)
{
    return s->nflexible && s->node_body[body].on ? &s->node_body[body] : NULL;
}

/* Flexible bodies: see spatial_flex.c. */
void spatial_flex_build(struct sweep *s, const struct model *m, struct arena *life);
void spatial_flex_place(struct flexible *f, const struct part *x, const struct link *l, const double *q);
void spatial_flex_move(struct flexible *f, const double *v);
void spatial_flex_accelerate(struct flexible *f, const double *a);
void spatial_flex_collect_forces(struct part *x, struct flexible *f);
void spatial_flex_rows(double *r, const struct flexible *f);
/* Its shape, once for each q, where it is wanted. */
void spatial_flex_shape(struct flexible *f);
void spatial_flex_energy(double *T, double *V, const struct part *x, struct flexible *f, const double *gravity);
void spatial_node_body_place(struct part *x, struct node_body *o, const struct part *p);
void spatial_node_body_move(struct part *x, struct node_body *o, const struct part *p);
void spatial_node_body_accelerate(struct part *x, struct node_body *o, const struct part *p);
void spatial_node_body_load(struct node_body *o, const struct part *x);
/* The body at a node that i hangs on, or is; both of one flexible body f. */
int spatial_node_body_below(const struct sweep *s, const struct flexible *f, int i);
/* Velocity of the node (v) and angular velocity for a unit rate of the j-th coordinate, world axes. */
void spatial_node_body_unit(struct twist *u, const struct node_body *o, int j);
/* The same the other way: what force F and moment N at the node do on the j-th coordinate; both in body axes. */
static inline double spatial_node_body_row(const struct node_body *o, int j, const double *F, const double *N)
{
    return v3_dot(o->place.dx + 3 * j, F) + v3_dot(o->place.dw + 3 * j, N);
}

/* See sweep.h. */
void spatial_point(const struct sweep *s, double *x, double *xv, int body, const double *p);
void spatial_pose(const struct sweep *s, struct pose *o, int body);
void spatial_at(const struct sweep *s, struct pose *o, int body);
void spatial_stand(const struct sweep *s, struct pose *o, int body);
void spatial_stir(const struct sweep *s, struct pose *o, int body);
void spatial_push(struct sweep *s, int body, const double *x, const double *f);
void spatial_twist(struct sweep *s, int body, const double *n);
void spatial_partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k);
void spatial_rows(const struct sweep *s, double *g, int stride, int body, int from, const double *x, double sign, int m,
                  const struct pull *on);
void spatial_row(const struct sweep *s, double *g, int body, int from, const double *x, const double *f,
                 const double *n);
int spatial_path(const struct sweep *s, const int **k, int body);
void spatial_energy(const struct sweep *s, double *kinetic, double *gravity);
void spatial_reaction(const struct sweep *s, double *f, double *n, int joint);
void spatial_mass(struct sweep *s, double *M, const double *q, unsigned cls);
size_t spatial_factor_size(const struct sweep *s);
int spatial_factor(struct sweep *s, void *F, double cm, const double *d, const double *q, unsigned cls);
void spatial_solve(const struct sweep *s, const void *F, double *x);
void spatial_aggregate(struct sweep *s, struct aggregate *o, const int *body, int n, int what);
void spatial_adjust_motion(struct sweep *s, const struct motion_change *o, const struct aggregate *now, const int *body,
                           int n);

#endif
