/* planar.h -- what the files of the planar recursion share.
 *
 * Every body carries a frame that is parallel to the world when drawn, so that its orientation is one angle
 * phi = sum of turn_k q_k over its path, and one sincos.  A joint is a list of unit velocities: displacements
 * along axes fixed in the parent, then a rotation (turn = +1 or -1: the joint's z axis stands out of the
 * plane or into it). */
#ifndef FMDSUB_TREE_PLANAR_H
#define FMDSUB_TREE_PLANAR_H

#include "base/inline.h"
#include "la/vec2.h"
#include "tree/routes.h"
#include "tree/sweep.h"

/* Compiled twice, with and without flexible bodies: trees of rigid bodies pay nothing for them. */
#define TWICE INTO static inline

/* HELD: no freedom; TURN: revolute; SLIDE: prismatic; GLIDE: two displacements, one rotation. */
enum planar_type { HELD, TURN, SLIDE, GLIDE };

/* What stays: a joint and the body it moves. */
struct link {
    int parent;
    enum planar_type type;
    int iq[3], iv[3], nv;
    int limb;  /* the body on the ground that carries it */
    int last;  /* of a body on the ground: the last one that it carries */
    int pivot; /* velocities of the bodies before it */
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
    double rho[2];        /* the joint's point from there */
    double c_b[2];        /* from the joint's point */
    double e[2][2];       /* directions of the displacements */
    double F[2], N;       /* force and moment about the centre that the joint must bring up */
    double cm, cs[2], cj; /* composite body: mass, first moment and inertia about the centre */
    double I[6];          /* articulated body: ww wx wy xx xy yy */
};

/* Of a body with free joints beyond it, in the whole matrix of moving bodies; see planar_moving.c. */
struct moving {
    double I[9]; /* by row: moment and force for changes of its motion */
    double mu[2];
};

struct sweep {
    const struct model *model;
    struct rosters rosters;
    int nbody, n;
    int limbs;             /* bodies on the ground */
    int *limb;             /* [n] where nothing bends: of each joint's coordinates that which carries them */
    struct link *link;     /* [nbody] */
    struct part *part;     /* [nbody] */
    double (*bias)[3];     /* [nbody] work of solve(): moment and force, then twist */
    double *zero;          /* [n] */
    struct moving *moving; /* [nbody] work of moving_factor() */
    struct routes routes;
    struct flexible **bend;       /* [nbody] NULL: not flexible; the list is NULL if none is; see planar_flex.h */
    struct node_body **node_body; /* [nbody] NULL: not at a node; likewise */
    size_t for_modes;             /* numbers that they take in a factor */
    bool accelerated;             /* the last motion had accelerations */
};

static inline void planar_turn(double *y, double c, double s, const double *x)
{
    y[0] = c * x[0] - s * x[1];
    y[1] = s * x[0] + c * x[1];
}

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

/* See sweep.h. */
void planar_place(struct sweep *s, const double *q, unsigned cls);
void planar_move(struct sweep *s, const double *q, const double *v, unsigned cls);
void planar_accelerate(struct sweep *s, const double *v, const double *a, unsigned cls);
void planar_stir_up(struct sweep *s, const double *v, const double *a, unsigned cls);
void planar_forward(struct sweep *s, const double *q, const double *v, const double *a, unsigned cls);
void planar_backward(struct sweep *s, double *r, unsigned cls);
void planar_point(const struct sweep *s, double *x, double *xv, int body, const double *p);
void planar_pose(const struct sweep *s, struct pose *o, int body);
void planar_at(const struct sweep *s, struct pose *o, int body);
void planar_stand(const struct sweep *s, struct pose *o, int body);
void planar_stir(const struct sweep *s, struct pose *o, int body);
void planar_push(struct sweep *s, int body, const double *x, const double *f);
void planar_twist(struct sweep *s, int body, const double *n);
void planar_partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k);
void planar_row(const struct sweep *s, double *g, int body, int from, const double *x, const double *f,
                const double *n);
void planar_rows(const struct sweep *s, double *g, int stride, int body, int from, const double *x, double sign, int m,
                 const struct pull *on);
int planar_path(const struct sweep *s, const int **k, int body);
void planar_energy(const struct sweep *s, double *kinetic, double *gravity);
void planar_reaction(const struct sweep *s, double *f, double *n, int joint);
void planar_mass(struct sweep *s, double *M, const double *q, unsigned cls);
size_t planar_factor_size(const struct sweep *s);
int planar_factor(struct sweep *s, void *F, double cm, const double *d, const double *q, unsigned cls);
void planar_solve(const struct sweep *s, const void *F, double *x);
size_t planar_moving_size(const struct sweep *s);
int planar_moving_factor(struct sweep *s, void *F, double cm, double cc, double ck, const double *d, const double *v,
                         const double *a);
void planar_moving_solve(const struct sweep *s, const void *F, double *x);
void planar_aggregate(struct sweep *s, struct aggregate *o, const int *body, int n, int what);
void planar_adjust_motion(struct sweep *s, const struct motion_change *o, const struct aggregate *now, const int *body,
                          int n);

#endif
