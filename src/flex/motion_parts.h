/* motion_parts.h -- what motion.c and motion_slopes.c share. */
#ifndef FMDSUB_FLEX_MOTION_PARTS_H
#define FMDSUB_FLEX_MOTION_PARTS_H

#include "flex/affine_parts.h"
#include "flex/motion.h"

/* The second-order tables of a node. */
struct second {
    struct sift S, T;
};

struct flex_kernel {
    const struct flex_body *body;
    int n;
    double pivot[3];       /* the reference node */
    struct flex_node mean; /* psi: Theta */
    struct affine *in;
    struct second *node;         /* [nnode] */
    bool K_diagonal, D_diagonal; /* as of modes */
};

/* The turn by o->theta: R, a, b and their slopes, y, d. */
void flex_turn(struct flex_shape *o, const double *pivot);
/* y = T x */
void flex_turned(double *y, const struct flex_shape *o, const double *x);
/* The motion of the mean frame: a, w, al from those of the frame, in its own axes; t1 = Theta q', t2 = Theta q''. */
void flex_carry(double *a1, double *w1, double *al1, const struct flex_shape *o, const double *a, const double *w,
                const double *al, const double *t1, const double *t2);

#endif
