/* sweep.h -- what the planar and the spatial recursion promise the rest of system/.
 *
 * A sweep walks the tree outwards for motion and inwards for forces (recursive Newton-Euler, Luh,
 * Walker & Paul 1980; composite bodies, Walker & Orin 1982; articulated bodies, Featherstone 1983).
 * Bodies come in three lists by rate class: FAST holds the fast bodies and, for motion only, the
 * slow ones on their path to the ground and those on which fast loads act; SLOW the slow bodies;
 * ALL all.  A sweep may have other bodies for its FAST ones.  LIMBS, for factors: all that stands on the ground on a limb with
 * fast ones.  W is the sweep's work memory: written by forward(), read by the rest, never kept between evaluations. */
#ifndef FMDSUB_TREE_SWEEP_H
#define FMDSUB_TREE_SWEEP_H

#include "base/arena.h"
#include "model/model.h"
#include "system/ode2.h"

/* A body's motion in world axes; velocities and accelerations of the centre of mass. */
struct pose {
    double r[3], R[9];  /* [m]; body to world, by column */
    double v[3], w[3];  /* [m/s], [rad/s] */
    double a[3], al[3]; /* [m/s2], [rad/s2], true ones: gravity not in them */
    double angle;       /* plane: rotation about z since drawn, continuous [rad] */
};

/* A force and a torque, world axes. */
struct pull {
    double f[3], n[3];
};

/* Some bodies as one; world axes. */
struct aggregate {
    double m, c[3];       /* mass, centre of mass */
    double p[3], L[3];    /* momentum, angular momentum about the centre */
    double T;             /* kinetic energy of the motion about the centre: without p.p/(2 m) */
    double J[6];          /* inertia about the centre, xx yy zz xy xz yz; in the plane zz, and xx = yy = 1 */
    double F[3], N[3], W; /* what their inertia takes: force, moment about the centre, power in the motion about it */
};
enum { AGGREGATE_MOTION, AGGREGATE_INERTIA, AGGREGATE_FORCES }; /* as far as T, J, W */

/* A change of their motion: displacement dr and velocity dv of all of them; accelerations a + al x (r - c) + k v,
 * al + k w, k q', with velocities v against that of the centre. */
struct motion_change {
    double dr[3], dv[3], a[3], al[3], k;
};

struct sweep;

/* Nodes of flexible bodies that only the output looks at stand still in sweeps of the step loop. */
enum purpose { FOR_STEPS, FOR_RECORDS };

struct sweep_ops {
    /* Takes work memory for forward() and everything that does not depend on the state.  bodies [nbody]: those that are
     * FAST in this sweep; NULL: the fast ones, and those that fast forces touch. */
    struct sweep *(*build)(const struct model *m, enum purpose purpose, const bool *bodies, struct arena *life);

    /* Poses of the bodies of cls. */
    void (*place)(struct sweep *s, const double *q, unsigned cls);
    /* Motion only down to velocities (measures, energies); q NULL: where place() has left the bodies. */
    void (*move)(struct sweep *s, const double *q, const double *v, unsigned cls);
    /* Accelerations where move() has been, with its v (gravity taken as upward acceleration of the ground). */
    void (*accelerate)(struct sweep *s, const double *v, const double *a, unsigned cls);
    /* Both, where place() has left the bodies. */
    void (*stir_up)(struct sweep *s, const double *v, const double *a, unsigned cls);
    /* All three, a NULL: zero; q NULL: where move() has been, with its v.  Then the body forces are those of their
     * inertia alone. */
    void (*forward)(struct sweep *s, const double *q, const double *v, const double *a, unsigned cls);

    /* World position x and velocity xv [3] of the point p (body axes, from the centre). */
    void (*point)(const struct sweep *s, double *x, double *xv, int body, const double *p);
    void (*pose)(const struct sweep *s, struct pose *o, int body);
    /* r of it, in the plane its angle, too; with R; then the rest.  In the plane what is 0 there, and R[8], which is 1, are as
     * they have been. */
    void (*at)(const struct sweep *s, struct pose *o, int body);
    void (*stand)(const struct sweep *s, struct pose *o, int body);
    void (*stir)(const struct sweep *s, struct pose *o, int body);
    /* Applied force f at world point x, or torque n, both world axes [3]. */
    void (*push)(struct sweep *s, int body, const double *x, const double *f);
    void (*twist)(struct sweep *s, int body, const double *n);

    /* r += what the bodies of cls need to move so (all rows on their paths): inertia minus pushed. */
    void (*backward)(struct sweep *s, double *r, unsigned cls);

    /* M [n x n] by column, of the bodies of cls, all rows and columns that are `near` these; q NULL: where place() has
     * left them. */
    void (*mass)(struct sweep *s, double *M, const double *q, unsigned cls);

    /* Partial velocities at the last forward() or move(): velocity of the world point x carried by the body,
     * and its angular velocity, per unit v[k]; both [3]; zero where k does not move it. */
    void (*partial)(const struct sweep *s, double *xv, double *w, int body, const double *x, int k);
    /* The velocities that move the body, from the ground outwards; returns how many. */
    int (*path)(const struct sweep *s, const int **k, int body);

    /* Power of the force f (NULL: none) at world point x of the body and of the torque n (NULL: none) per unit of each
     * velocity on its path, behind the first `from` of them; these end with those of a body. */
    void (*row)(const struct sweep *s, double *g, int body, int from, const double *x, const double *f,
                const double *n);

    /* `sign` times that of m pulls `on` at once: that of pull i to g + i stride. */
    void (*rows)(const struct sweep *s, double *g, int stride, int body, int from, const double *x, double sign, int m,
                 const struct pull *on);

    /* cm M + diag(d), d [n], factored at q (NULL: where place(ALL) has left the bodies) by articulated
     * bodies into F; 0 when a pivot is not positive.  LIMBS: what belongs to other bodies is in F and stays. */
    size_t (*factor_size)(const struct sweep *s);
    int (*factor)(struct sweep *s, void *F, double cm, const double *d, const double *q, unsigned cls);
    void (*solve)(const struct sweep *s, const void *F, double *x);

    /* cm M + cc C + ck K + diag(d), with C and K all that the inertia of moving bodies and turning arms bring, where
     * forward(ALL), with v and a, and backward() have been; factored into F; 0 when there is no such factor.  Unsymmetric.
     * NULL: not known how. */
    size_t (*moving_size)(const struct sweep *s);
    int (*moving_factor)(struct sweep *s, void *F, double cm, double cc, double ck, const double *d, const double *v,
                         const double *a);
    void (*moving_solve)(const struct sweep *s, const void *F, double *x);

    /* K = dQ/dq, C = dQ/dq' [nmode x nmode] += of a flexible body's coordinates, while its frame moves as it does;
     * after accelerate() or forward() with a.  NULL: flex_slopes() has it. */
    void (*bend_slopes)(const struct sweep *s, double *K, double *C, int body);

    /* Kinetic energy and energy in the field of gravity (0 in the drawn position at the world's origin level:
     * V = -sum m g.r) at the last move() or forward() [J]. */
    void (*energy)(const struct sweep *s, double *kinetic, double *gravity);

    /* After forward(ALL, with a) and backward: force and moment that joint i of the model exerts
     * on its child, about the joint's point on the child, world axes, [3] each, with the free directions
     * (which carry only elements along the joint's own coordinates) projected out. */
    void (*reaction)(const struct sweep *s, double *f, double *n, int joint);

    /* The n bodies `body` as one, the first of them a tree's root, at the last move() or forward(); forces after
     * forward() and before anything is pushed. */
    void (*aggregate)(struct sweep *s, struct aggregate *o, const int *body, int n, int what);
    /* Changes their motion between forward() and backward(): places, velocities, and for the accelerations what they
     * need. */
    void (*adjust_motion)(struct sweep *s, const struct motion_change *o, const struct aggregate *now, const int *body,
                          int n);
};

extern const struct sweep_ops sweep_planar, sweep_spatial;

/* Which bodies a class list holds, parents first; for both recursions. */
struct roster {
    int n;
    int near;          /* these move by the first `near` velocities, and by no others */
    const int *body;   /* [n] indices, ascending */
    const char *bears; /* [n] 1: with its mass, 0: motion (and pushed forces) only */
};
struct rosters {
    struct roster of[5]; /* by class: FAST, SLOW, ALL, LIMBS */
    const bool *limbs;   /* [nbody] LIMBS, with what stands still in sweeps of the step loop */
};
/* bodies: as in build(). */
void rosters_build(struct rosters *o, const struct model *m, enum purpose purpose, const bool *bodies,
                   struct arena *life);
/* The bodies of LIMBS as a share of all. */
double rosters_limbs(const struct model *m, struct arena *life);
/* M [n x n] := 0 where bodies of that list may have mass. */
void roster_clear(const struct roster *o, double *M, int n);

#endif
