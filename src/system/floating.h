/* floating.h -- mechanisms that fly freely keep their momenta over a step.
 *
 * A tree whose root joint is free, and whose loops do not reach the ground, is `floating`.  Over a step from q_a, v_a
 * to q_b, v_b its acceleration as a whole is that which makes the balances of momentum exact:
 *
 *     sum m a = (p_b - p_a)/h,   sum (d x m a + ..) = (L_b - L_a)/h             about its centre of mass
 *
 * To what M^ a + .. of the midpoint has, one rigid motion of acceleration da in the centre of mass c, and al, is added:
 *
 *     m da = (p_b - p_a)/h - sum m a,   J al = (L_b - L_a)/h - sum (d x m a + ..)
 *
 * of second order in h.  In the rows of the root's joint r = 0 then reads change of momentum = h times the external
 * forces; and what the root's own quasi-velocities are, and which body is the root, no longer matters to the others,
 * whose rows are those of the midpoint rule seen from the centre of mass.  The centre itself goes
 *
 *     c_b = c_a + h (p_a + p_b)/(2 m)
 *
 * so that c x p, the energy p.p/2m - m g.c and the step itself are the same in every frame that moves with constant
 * velocity: settle() puts the tree there, along the displacements of its root, and a midpoint by half of that.  Where
 * gravity is the only force from outside, it also takes away what the iteration has left in the momenta. */
#ifndef FMDSUB_SYSTEM_FLOATING_H
#define FMDSUB_SYSTEM_FLOATING_H

#include "base/arena.h"
#include "model/model.h"
#include "system/ode2.h"
#include "system/sweep.h"

struct floater {
    int n, *body;            /* its bodies, the root first */
    int nv, nslide;          /* velocities of its root, the first nslide displacements */
    const int *slide, *iv;   /* places of these displacements in q, of the velocities in v */
    double e[3][3], hung[3]; /* directions of the displacements; the point that they displace, undisplaced; world */
    bool alone;              /* no force acts on it from outside but gravity */
    struct bulk end[2];      /* its momenta at the ends; c for an undisplaced root */
};

struct floating {
    int n;
    struct floater *part; /* [n] */
    const struct model *model;
    const struct sweep_ops *ops;
    struct sweep *there; /* its FAST bodies are those that float */
    int stands;          /* the end where it stands */
    double *q[2], *v[2]; /* the ends that end[] is for; displacements of roots are 0 there */
    bool known[2];
    double *try, *at, *to, *moving; /* [nq]; [n] */
};

/* n = 0 where nothing floats.  A rigid body by itself on a joint in its centre does not: the midpoint rule is exact
 * there. */
void floating_build(struct floating *o, const struct model *m, const struct sweep_ops *ops, struct arena *life);

/* x, whose va and vb are of the whole tree, with q and qb settled. */
void floating_place(struct floating *o, struct instant *settled, const struct instant *x);
/* After forward() of all bodies at the settled x: accelerates them as the balances ask, and moves them, and x->v, as
 * their centre goes. */
void floating_balance(struct floating *o, struct sweep *s, struct instant *x);
/* As in ode2.h. */
void floating_settle(struct floating *o, double *q1, double *v1, const struct instant *x);

#endif
