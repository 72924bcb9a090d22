/* local_error.h -- what one step of a second-order scheme is off by, from velocities alone.
 *
 * With the mean accelerations of steps, A_k = (v_k+1 - v_k)/h_k, the third and the fourth derivative of the positions are
 *
 *     j_k = 2 (A_k - A_k-1)/(h_k + h_k-1),      s_k = (j_k - j_k-1)/h_k-1,
 *
 * and the step is off by c h^3 j in its positions and c h^3 s in its velocities: c = 1/12 for the trapezoidal and the
 * midpoint rule (Zienkiewicz & Xie, Earthq. Eng. Struct. Dyn. 20 (1991) 871); of others, the part of (omega h)^3 that a
 * vibration is late by in a step.
 *
 * A scheme that looks at the middle of its steps alone has no idea of a force that begins behind it: the accelerations at the
 * end tell, and A + h j/2 is what they would be. */
#ifndef FMDSUB_ENGINE_LOCAL_ERROR_H
#define FMDSUB_ENGINE_LOCAL_ERROR_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/recall.h"

struct local_error {
    int n;
    double *mean, *jerk;         /* [n] A and j of the last step that was kept */
    double h;                    /* its length; 0: there was none */
    int known;                   /* of A and j: how many */
    double *new_mean, *new_jerk; /* [n] of the step under trial */
    double *position, *velocity; /* [n] what that step is off by */
};

void local_error_open(struct local_error *o, int n, struct arena *life);
void local_error_forget(struct local_error *o);
/* A step h in which velocities change by dv [n]; a0 [n] the accelerations at its start, read where nothing is known of
 * steps before. */
void local_error_try(struct local_error *o, const double *dv, const double *a0, double h, double c);
/* How far the accelerations a at that step's end are apart from those that its mean A leads on to, A + h j/2 [n]; kept: it
 * was taken already. */
void local_error_end(const struct local_error *o, double *apart, bool kept, const double *a, double h);
/* What the step is off by for that, if it is more: h/6 of it in velocities (of a force that begins in the step at most h/4,
 * of a smooth motion 3/4 of what is there), h^2/12 in positions. */
void local_error_apart(double *position, double *velocity, const double *apart, double h, int n);
/* That step was taken. */
void local_error_keep(struct local_error *o, double h);
/* What `to` knows of steps before becomes what `from` knows. */
void local_error_copy(struct local_error *to, const struct local_error *from);
void local_error_recall(struct local_error *o, struct recall *r);

#endif
