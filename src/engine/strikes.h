/* strikes.h -- how often what pushes only where bodies meet has begun or ended to push, and otherwise than the times before.
 *
 * Between two such edges small differences of the motion grow or shrink by no more than the motion is bent there, but each
 * of them makes of a difference in place another one in time: a mass that bounces between stops that a drive has no need
 * to meet at the same phase may go wholly astray within some dozens of them, though every step is accurate.  A motion
 * that settles into a cycle strikes over and over as it did before, and there differences do not grow; so a strike counts
 * where velocities before it, and the time since the last one, are unlike those of each of the last few.  Of the edges of
 * forces that bend or jump by the state, most of which are no strikes, those count between which velocities change by a good
 * part, several times as quickly as between those before or behind: backlash, buffers given by expressions. */
#ifndef FMDSUB_ENGINE_STRIKES_H
#define FMDSUB_ENGINE_STRIKES_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/recall.h"

enum { STRIKES_KEPT = 8 };

struct strikes {
    int n;             /* velocities */
    long seen, unlike; /* edges of pushes so far; those unlike each of the last few */
    long anew;         /* edges that are no longer comparable, in another chart */
    double t;          /* of the last one */
    double longest;    /* time between two of them so far [s] */
    double changed,
        pace;    /* between the last two: velocities, most of all, by this part of their largest; the same per second */
    double *top; /* [n] largest |velocity| at one so far */
    double gap[STRIKES_KEPT]; /* times since the one before, of the last few */
    double *v[STRIKES_KEPT];  /* [n] velocities there */
};

void strikes_open(struct strikes *o, int n, struct arena *life);
/* A push begins or ends in the step from t, with velocities v [n]; else a force bends or jumps by the state. */
void strikes_note(struct strikes *o, const double *v, double t, bool pushes);
/* Velocities are those of another chart from here on. */
void strikes_rechart(struct strikes *o);
void strikes_recall(struct strikes *o, struct recall *r);

#endif
