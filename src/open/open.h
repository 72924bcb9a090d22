/* open.h -- a tree of bodies as mechanics: the equations of motion (2-4) by inverse dynamics.
 *
 *     r(q, v, a, t) = M^ a - Q^                                              (2-4)
 *
 * is one sweep outwards, the elements, one sweep inwards; M^ comes from composite bodies, a from r(a = 0) by
 * articulated bodies, or by M^ where these do not go (flexible bodies in space).  All works in one sweep; others, who
 * close loops over the tree, share it, so that what depends on positions alone is found once for each of them. */
#ifndef FMDSUB_OPEN_OPEN_H
#define FMDSUB_OPEN_OPEN_H

#include "force/elements.h"
#include "open/elastic.h"
#include "open/floating.h"
#include "open/posture.h"
#include "open/turns.h"
#include "tree/moves.h"
#include "tree/sweep.h"

struct open_tree {
    const struct model *model;
    const struct sweep_ops *ops;
    struct sweep *sweep;
    struct posture posture; /* where all of its bodies were placed last */
    bool placed;            /* they still stand there */
    long moved;             /* and move as open_move() has been told: number of the posture, else 0 */
    struct elements *elements;
    bool diagonal;          /* elements_are_diagonal() */
    struct elastic elastic; /* flexible bodies */
    struct moves moves;
    struct floating floating; /* what flies freely */
    struct ode2 ode;          /* of the tree */
    struct ode2_direct direct;
    struct ode2_breaks breaks;
    double *M;                     /* [n x n] of flexible bodies */
    void *factor;                  /* of M^, for accel() */
    double *d, *zero;              /* [n] */
    double *size;                  /* [n] usual changes of the coordinates */
    double length;                 /* of the mechanism [m] */
    struct effect *suspect;        /* [nforce] for naming the element that is not finite */
    const struct follower *follow; /* NULL: nobody does */
    void *follower;
    struct turns turns; /* whole turns from step to step */
};

void open_build(struct open_tree *o, const struct model *m, struct arena *life);
/* direct.c: its factor and its `direct`, as open_build() has the rest. */
void open_direct(struct open_tree *o, struct arena *life);

/* The number of the posture q; where it is another than the last, no body stands there yet. */
long open_take(struct open_tree *o, const double *q);
/* All bodies at q, unless they stand there; then moving with v.  Returns the number of the posture (posture.h). */
long open_place(struct open_tree *o, const double *q);
long open_move(struct open_tree *o, const double *q, const double *v);

/* Who wants to know where the bodies are after each accepted step, and in a view; before the first. */
struct follower {
    void (*note)(void *self, const struct sweep *s, double dt);
    void (*look)(void *self, const struct sweep *view);
};
void open_follow(struct open_tree *o, const struct follower *follow, void *follower);
/* The start, after move() there. */
void open_begin(struct open_tree *o, const struct instant *x);
/* Angles of another sweep that looks between steps at q, v, t: whole turns there; moves it. */
void open_look(struct open_tree *o, struct sweep *view, const double *q, const double *v, double t);
void open_recall(struct open_tree *o, struct recall *r);

/* The bodies where they stand, moving with v and accelerations a. */
void open_stir_up(struct open_tree *o, const double *v, const double *a);

/* resid() of the ode, where open_move() or open_stir_up() has been with x->q and x->v. */
enum status open_resid(struct open_tree *o, double *r, double *w, double *dk, const struct instant *x, enum rate cls,
                       struct trouble *why);

#endif
