/* floating.h -- mechanisms that fly freely keep their momenta and their energy over a step.
 *
 * A tree whose root joint is free, and whose loops do not reach the ground, is `floating`.  Let its momentum p, angular
 * momentum L and kinetic energy T of the motion about the centre of mass c be known at the ends a and b of a step, and
 * at its middle, where M^ a + .. has bodies with accelerations of which the rates p', L', T' would come.  To these
 * accelerations is added what makes the balances exact: one rigid motion, da in the centre and al, and k times the
 * velocities v_rel that are not part of the whole's motion with p/m and J^-1 L:
 *
 *     m da + p' = (p_b - p_a)/h,   J al + L' = (L_b - L_a)/h,   k v_rel.M^ v_rel + al.L + T' = (T_b - T_a)/h
 *
 * All three are of second order in h and the same both ways in time.  The velocity of the centre is the mean over the
 * step, too:
 *
 *     c_b = c_a + h (p_a + p_b)/(2 m)
 *
 * r = 0 then reads, in the rows of the root's joint, change of momenta = h times the forces from outside and their
 * moments, and along v, p.p/(2m) + T rises by h v.Q, the work of all forces: the ledger's own sum.  What the root's
 * quasi-velocities are and how fast the whole flies does not matter to what happens inside; in the plane it does not
 * matter either which body is the root.  settle() puts the tree where the centre is at the end of a step, by the
 * displacements of its root, and a midpoint where the mean of its ends is.  Trees that act on each other are a group;
 * its moments sum up to nothing where each force has its opposite on the same line at the middle of the step
 * (force/remainder.c), and so the sum of its momenta is kept.  Where gravity is the only force on a group from outside,
 * settle() also takes away what the iteration has left in that sum, by one rigid motion of all, and of a rigid body by
 * itself in the energy (tumble.h).
 *
 * Without k v_rel the energy drifts (a robot of three links: 0.8 % in 50 000 steps): what turns is not what it is when
 * all goes backwards, so that a step that is the same both ways does not hold it.  Balances along the velocities:
 * LaBudde & Greenspan, Numer. Math. 25 (1976) 323; of rigid and elastic bodies: Simo, Tarnow & Wong, Comput. Methods
 * Appl. Mech. Eng. 100 (1992) 63. */
#ifndef FMDSUB_OPEN_FLOATING_H
#define FMDSUB_OPEN_FLOATING_H

#include "base/arena.h"
#include "model/model.h"
#include "open/tumble.h"
#include "system/ode2.h"
#include "tree/sweep.h"

struct floater {
    int n, *body;            /* its bodies, the root first */
    int nv, nslide;          /* velocities of its root, the first nslide displacements */
    const int *slide, *iv;   /* places of these displacements in q, of the velocities in v */
    double e[3][3], hung[3]; /* directions of the displacements; the point that they displace, undisplaced; world */
    struct aggregate end[2]; /* its momenta at the ends; c for an undisplaced root */
};

/* Floating trees that act on each other. */
struct group {
    int first, n; /* of the list of floaters */
    bool alone;   /* no force acts on them from outside but gravity: the sum of their momenta is known */
};

struct floating {
    int n;
    struct floater *part; /* [n] group by group */
    int ngroup;
    struct group *group; /* [ngroup] */
    int ntumbler;
    struct tumbler *tumbler; /* [ntumbler] rigid bodies by themselves: settle() turns them to the last digit */
    const struct model *model;
    const struct sweep_ops *ops;
    struct sweep *there; /* its FAST bodies are those that float */
    double *q[2], *v[2]; /* the ends that end[] is for; displacements of roots are 0 there */
    bool known[2];
    double *still;            /* [nq] 0: a displacement of a root, else 1 */
    double *at, *to, *moving; /* [nq], [nq], [n] */
    double (*centre[2])[3];   /* [n] of a group's trees at the ends of a step */
    double (*behind)[3];      /* [n] how far these are from where their momenta lead */
};

/* n = 0 where nothing floats.  A rigid body on a joint in its centre does not, unless others that fly turn it: the
 * midpoint rule is exact there, and by itself it is a tumbler. */
void floating_build(struct floating *o, const struct model *m, const struct sweep_ops *ops, struct arena *life);

/* x, whose va and vb are of the whole tree, with qb settled, and with a q and v that floating_balance() moves. */
void floating_place(struct floating *o, struct instant *settled, const struct instant *x);
/* After forward() of all bodies at the settled x: moves them, and x->q and
 * x->v, as their centre goes, and accelerates them as the balances ask. */
void floating_balance(struct floating *o, struct sweep *s, const struct instant *x);
/* As in ode2.h. */
void floating_settle(struct floating *o, double *q1, double *v1, const struct instant *x);

#endif
