/* strikes.h -- how often something has struck, otherwise than the times before.
 *
 * A force bends or jumps where a stop, a contact or an expression begins to push, and where it ends to.  A strike is what lies
 * between two such edges if it is brief beside what is between others and changes a velocity several times as quickly as before.  It makes of a difference in place one in
 * time: a mass that bounces between stops, which a drive has no need to meet at the same phase, may go wholly astray within
 * some dozens of them, though every step is accurate.  A motion that settles into a cycle strikes over and over as it did before, and
 * there differences do not grow; so a strike counts where velocities, and the time that it takes, are unlike those of each of
 * the last few. */
#ifndef FMDSUB_ENGINE_STRIKES_H
#define FMDSUB_ENGINE_STRIKES_H

#include "base/arena.h"
#include "base/recall.h"

enum { STRIKES_KEPT = 16 };

struct strikes {
    int n;             /* velocities */
    long seen, unlike; /* edges so far; strikes unlike each of the last few */
    long anew;         /* edges that are no longer comparable, in another chart */
    double t;          /* of the last one */
    double longest;    /* time between two of them so far [s] */
    double pace; /* of the change of velocities between the last two, in their largest per second; -1: not known */
    double *top; /* [n] largest |velocity| at one so far */
    double gap[STRIKES_KEPT]; /* times since the one before, of the last few */
    double *v[STRIKES_KEPT];  /* [n] velocities there */
};

void strikes_open(struct strikes *o, int n, struct arena *life);
/* A force bends or jumps in the step from t, with velocities v [n]. */
void strikes_note(struct strikes *o, const double *v, double t);
/* Velocities are those of another chart from here on. */
void strikes_rechart(struct strikes *o);
void strikes_recall(struct strikes *o, struct recall *r);

#endif
