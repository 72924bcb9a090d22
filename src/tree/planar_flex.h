/* planar_flex.h -- what the planar recursion does otherwise where there are flexible bodies. */
#ifndef FMDSUB_TREE_PLANAR_FLEX_H
#define FMDSUB_TREE_PLANAR_FLEX_H

#include "flex/planar.h"
#include "tree/planar.h"

/* A flexible body: its frame is a part like all others, whose link has no mass; this is the rest. */
struct flexible {
    const struct flex_planar *kernel;
    struct flex_planar_shape shape;
    int n;
    const int *iq, *iv;     /* [n] places of its modes */
    bool abreast;           /* these follow one another, in q and in v */
    double *q, *v, *a, *Q;  /* [n] gathered; the modes' rows */
    double drawn[2], cs[2]; /* cos, sin of its axes drawn and now */
    double *U, *M;          /* [3 x n], [n x n] its columns of M^, frame and modes; M its lower triangle */
    size_t at;              /* its place in a factor */
    /* What was worked out for these q is good until they change: loops are closed by joints, modes stand still. */
    long change, shaped; /* count of changes; that of the shape */
    long push;           /* count of changes of a */
};

/* A body at a node of `of`. */
struct node_body {
    struct flexible *of;
    int node;
    struct flex_planar_place place;
    long change; /* of the modes that place is for */
    long push;   /* of their accelerations that place.a is for */
    bool biased; /* place.bias is that of their rates */
    size_t at;   /* its place in a factor */
};

/* Leaves bend and node_body NULL in a model without flexible bodies; none of the others is then called. */
void planar_flex_build(struct sweep *s, struct arena *life);

static inline struct flexible *planar_flexible(const struct sweep *s, int body)
{
    return s->bend ? s->bend[body] : NULL;
}

static inline struct node_body *planar_node_body(const struct sweep *s, int body)
{
    return s->node_body ? s->node_body[body] : NULL;
}

/* The three passes of motion for what is not in x, the frame; then its inertia into x and the modes' Q, which go to
 * the rows of r. */
void planar_flexible_place(struct flexible *b, const struct part *x, const double *q);
void planar_flexible_move(struct flexible *b, const double *v);
void planar_flexible_accelerate(struct flexible *b, const double *a);
void planar_flexible_load(struct part *x, struct flexible *b, bool bears);
void planar_flexible_collect_forces(double *r, const struct flexible *b);

/* For the table of the sweep (sweep.h). */
void planar_bend_slopes(const struct sweep *s, double *K, double *C, int body);

/* The three passes for x at its node of p; its force and moment to the modes' Q. */
void planar_node_body_place(struct part *x, struct node_body *o, const struct part *p);
void planar_node_body_move(struct part *x, struct node_body *o, const struct part *p);
void planar_node_body_accelerate(struct part *x, struct node_body *o, const struct part *p);
void planar_node_body_collect_forces(struct node_body *o, const struct part *x);
/* row() of the modes that move x, which stands there. */
void planar_node_body_row(double *g, const struct node_body *o, const struct part *at, const double *x, const double *f,
                          double n);

/* partial() of a mode; energies of the flexible bodies are added. */
void planar_flex_partial(const struct sweep *s, double *xv, double *w, int body, const double *x, int k);
void planar_flex_energy(const struct sweep *s, double *kinetic, double *gravity);

/* Composite bodies: what the flexible ones are by themselves; then all columns of M^. */
void planar_flex_compose(struct sweep *s, const struct roster *o);
void planar_flex_columns(double *M, struct sweep *s, const struct roster *o);

/* U and M of the body alone; what is added by that which hangs on the node with inertia I (ww wx wy xx xy yy). */
void planar_flex_own(struct flexible *b);
void planar_flex_couple(const struct node_body *o, const double *I, const double *arm);

/* Articulated bodies: I, U, M of the bodies alone; the modes of a body eliminated (0: no pivot), or their part in
 * what hangs on a node added to the body there; then the same with forces p inwards and twists V outwards.  F is
 * [for_modes]. */
void planar_flex_start(struct sweep *s, double cm, const double *d, const bool *only);
int planar_flex_eliminate(struct sweep *s, double *F, int body, const double *d);
void planar_flex_forces(const struct sweep *s, const double *F, double *p, double *x, int body);
void planar_flex_twist(const struct sweep *s, const double *F, double *V, double *x, int body);

/* What depends on q alone, once for each q, where it is wanted. */
static inline void planar_flex_shape(struct flexible *b)
{
    if (b->shaped == b->change) return;
    flex_planar_shape_at(&b->shape, b->kernel, b->q);
    b->shaped = b->change;
}

/* First moment in the world. */
static inline void planar_flex_first_moment(double *h, const struct flexible *b)
{
    h[0] = b->cs[0] * b->shape.h[0] - b->cs[1] * b->shape.h[1];
    h[1] = b->cs[1] * b->shape.h[0] + b->cs[0] * b->shape.h[1];
}

/* The twist of a body at a node by the k-th mode there. */
static inline void planar_node_body_unit(double *u, const struct node_body *o, int k)
{
    const double *cs = o->of->cs, dx = o->place.dx[k], dy = o->place.dy[k];
    u[0] = o->place.dw[k];
    u[1] = cs[0] * dx - cs[1] * dy;
    u[2] = cs[1] * dx + cs[0] * dy;
}

#endif
