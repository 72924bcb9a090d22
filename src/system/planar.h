/* planar.h -- what the files of the planar recursion share.
 *
 * Every body carries a frame that is parallel to the world when drawn, so that its orientation is one angle
 * phi = sum of turn_k q_k over its path, and one sincos.  A joint is a list of unit velocities: displacements
 * along axes fixed in the parent, then a rotation (turn = +1 or -1: the joint's z axis stands out of the
 * plane or into it). */
#ifndef FMDSUB_SYSTEM_PLANAR_H
#define FMDSUB_SYSTEM_PLANAR_H

#include "system/routes.h"
#include "system/sweep.h"

/* HELD: no freedom; TURN: revolute; SLIDE: prismatic; GLIDE: two displacements, one rotation. */
enum planar_type { HELD, TURN, SLIDE, GLIDE };

/* What stays: a joint and the body it moves. */
struct link {
    int parent;
    enum planar_type type;
    int iq[3], iv[3], nv;
    double turn;
    double a[2], b[2]; /* the joint's point from the parent's, the child's centre; drawn axes [m] */
    double e[2][2];    /* directions of the displacements, drawn axes */
    double mass, inertia;
    double drawn[2]; /* cos, sin of the drawn orientation */
};

/* What moves; world axes. */
struct part {
    double phi, c, s;     /* angle since drawn, its cosine and sine */
    double w, al;         /* its rates */
    double r[2];          /* centre of mass */
    double v[2], a[2];    /* of it; gravity is in a as the ground's acceleration -g */
    double arm[2];        /* from the parent's centre */
    double c_b[2];        /* from the joint's point */
    double e[2][2];       /* directions of the displacements */
    double F[2], N;       /* force and moment about the centre that the joint must bring up */
    double cm, cs[2], cj; /* composite body: mass, first moment and inertia about the centre */
    double I[6];          /* articulated body: ww wx wy xx xy yy */
};

struct sweep {
    const struct model *model;
    struct rosters rosters;
    int nbody, n;
    struct link *link; /* [nbody] */
    struct part *part; /* [nbody] */
    double (*bias)[3]; /* [nbody] work of solve(): moment and force, then twist */
    double *zero;      /* [n] */
    struct routes routes;
    struct bend **bend;   /* [nbody] NULL: not flexible; the list is NULL if none is; see planar_flex.h */
    struct stand **stand; /* [nbody] NULL: not at a node; likewise */
    size_t for_modes;     /* numbers that they take in a factor */
    bool accelerated;     /* the last motion had accelerations */
};

/* Position of body x of link l hanging on p, and its world axes and arms. */
void planar_place(struct sweep *s, const double *q, unsigned cls);

/* One body on its joint; v, a NULL: not wanted. */
void planar_hang(struct part *x, const struct part *p, const struct link *l, const double *q, const double *v,
                 const double *a);
/* The joint's rows of r; force and moment go to the parent. */
void planar_bring_up(double *r, const struct part *x, struct part *p, const struct link *l);

/* Is the k-th velocity of l its rotation? */
static inline bool planar_turns(const struct link *l, int k)
{
    return l->type == TURN || (l->type == GLIDE && k == 2);
}

/* The twist (w, vx, vy of the centre) of its body by the k-th velocity of l. */
static inline void planar_unit(double *u, const struct part *x, const struct link *l, int k)
{
    bool turns = planar_turns(l, k);
    u[0] = turns ? l->turn : 0;
    u[1] = turns ? -l->turn * x->c_b[1] : x->e[k][0];
    u[2] = turns ? l->turn * x->c_b[0] : x->e[k][1];
}

void planar_mass(struct sweep *s, double *M, const double *q, unsigned cls);
size_t planar_factor_size(const struct sweep *s);
int planar_factor(struct sweep *s, void *F, double cm, const double *d, const double *q);
void planar_solve(const struct sweep *s, const void *F, double *x);
void planar_gather(struct sweep *s, struct bulk *o, const int *body, int n, int what);
void planar_hasten(struct sweep *s, const struct change *o, const struct bulk *now, const int *body, int n);

#endif
