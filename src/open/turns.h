/* turns.h -- whole turns of angles in space from one posture to another.
 *
 * A posture gives such an angle up to whole turns.  Joint coordinates know theirs, and so the angle is followed along the
 * straight way from the one posture to the other in the coordinates of the tree: whichever way the motion has taken between,
 * it can be drawn over to that one.  The way is gone in pieces in which no angle turns far; where all of it is short, in
 * one, at whose ends the rates are those of the motion.  So it is, too, where a ball joint has turned too far for its
 * quaternion to tell, in the minor steps of a major one: then the rates must do. */
#ifndef FMDSUB_OPEN_TURNS_H
#define FMDSUB_OPEN_TURNS_H

#include "base/arena.h"
#include "base/recall.h"
#include "tree/moves.h"
#include "tree/sweep.h"

/* Where the angles have been counted last. */
struct turns {
    const struct model *model;
    const struct moves *moves;
    bool begun;
    double *q, t; /* [nq]; NULL: in the plane, where postures know them */
    double *at;   /* [nq] on the way */
    double *dx;   /* [n] the way */
    double *body; /* [nbody] by how much its joint turns on it [rad] */
    int *first;   /* [nbody + 1] the first of its joint's in turning; [0], [1]: 0 */
    int *turning; /* [n] places of all velocities that turn, body by body */
};

/* Told of the sweep's motion, `dt` after it was told last, there. */
typedef void turns_told(void *self, const struct sweep *s, double dt);

void turns_build(struct turns *o, const struct model *m, const struct moves *moves, struct arena *life);
/* Counted at q, t. */
void turns_begin(struct turns *o, const double *q, double t);
/* Pieces of the way to q, t, with velocities v there; 1: it is short.  loops: angles of joints that close loops are
 * followed, too. */
int turns_pieces(struct turns *o, const double *q, const double *v, double t, bool loops);
/* Tells of that way, all but its end if it is short; moves the sweep.  After turns_pieces(). */
void turns_go(struct turns *o, const struct sweep_ops *ops, struct sweep *s, int pieces, turns_told *told, void *self);
void turns_recall(struct turns *o, struct recall *r);

#endif
