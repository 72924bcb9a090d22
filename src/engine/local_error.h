/* local_error.h -- the local error of a step of a second-order scheme, from velocities alone.
 *
 * With the mean accelerations of steps, A_k = (v_k+1 - v_k)/h_k, the third and the fourth derivative of the
 * positions are
 *
 *     j_k = 2 (A_k - A_k-1)/(h_k + h_k-1),      s_k = (j_k - j_k-1)/h_k-1,
 *
 * and the local error is c h^3 j in the positions and c h^3 s in the velocities, with c = 1/12 for the trapezoidal
 * and the midpoint rule (Zienkiewicz & Xie, Earthq. Eng. Struct. Dyn. 20 (1991) 871); for other schemes c is the
 * factor of their phase error c (omega h)^3 in a step.
 *
 * A scheme that evaluates forces only at the middle of its steps does not see a force that sets in behind it.  The
 * accelerations at the end do: they are compared with their extrapolation A + h j/2. */
#ifndef FMDSUB_ENGINE_LOCAL_ERROR_H
#define FMDSUB_ENGINE_LOCAL_ERROR_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/recall.h"

struct local_error {
    int n;
    double *mean, *jerk;         /* [n] A and j of the last step that was taken */
    double h;                    /* its length [s]; 0: there was none */
    int known;                   /* 0: neither A nor j, 1: A, 2: both */
    double *new_mean, *new_jerk; /* [n] of the step under trial */
    double *position, *velocity; /* [n] its local error, with signs */
};

void local_error_open(struct local_error *o, int n, struct arena *life);
/* Steps before are no longer of this motion. */
void local_error_forget(struct local_error *o);
/* The local error of a step h in which velocities change by dv [n]; a0 [n]: accelerations at its start, used where
 * no step before is known. */
void local_error_try(struct local_error *o, const double *dv, const double *a0, double h, double c);
/* apart [n] := accelerations a [n] at the end of that step less their extrapolation A + h j/2.  kept:
 * local_error_keep() has been called for it already. */
void local_error_end(const struct local_error *o, double *apart, bool kept, const double *a, double h);
/* The local error by that difference, where it is larger: h/6 of it in velocities (the error of a force that sets in
 * within the step is at most h/4, that of a smooth motion 3/4 of it), h^2/12 in positions. */
void local_error_apart(double *position, double *velocity, const double *apart, double h, int n);
/* The step was taken. */
void local_error_keep(struct local_error *o, double h);
/* `to` takes over the steps before from `from`. */
void local_error_copy(struct local_error *to, const struct local_error *from);
void local_error_recall(struct local_error *o, struct recall *r);

#endif
