/* motion.h -- a flexible body's inertia in motion, in the axes of its frame.
 *
 * The frame of the data is clamped to the reference node.  With second-order displacements the inertia is taken in
 * the body's mean frame: it stands on the reference node, too, and turns against the frame by the rotation vector
 * theta = Theta q, Theta = J^-1 int (x - x_0) x phi dm, so that in it motion of the coordinates has no angular momentum
 * about the node, to first order.  Seen there displacements of second order are small and the motion of frame and
 * coordinates do not nearly cancel where the node's joint is free to turn (affine.h has the inertia in a given frame).
 * With y from the node to the origin of the mean frame, d from origin to origin, wt and dw the turn's angular velocity
 * and its slopes by q', F, N and Q are those of the mean frame and
 *
 *     a  := a + w' x d + w x (w x d) + 2 w x (wt x y) + wt' x y + wt x (wt x y)
 *     w  := w + wt
 *     w' := w' + wt' + w x wt
 *     Q  := Q + dw.(N + y x F) + K q + D q'
 *     N  := N + d x F
 *
 * a = v' + w x v is the true acceleration of the origin in frame axes (gravity in it as upward acceleration).  All is
 * affine in (a, w', q''), with a symmetric positive matrix; energy is kept exactly: (T + q'Kq/2)' = v.F + w.N + q'.Q
 * without D.  N is about the origin.  Motions in the x-y plane stay there where the body's data do.
 *
 * Boltzmann, Sitz.-ber. Akad. Wien 111 (1902) 1603; the terms by order in q: Wallrapp, Mech. Struct. Mach. 22
 * (1994) 441. */
#ifndef FMDSUB_FLEX_MOTION_H
#define FMDSUB_FLEX_MOTION_H

#include "flex/affine.h"

/* Tables for evaluation, made once from the data. */
struct flex_kernel;
struct flex_kernel *flex_kernel_build(const struct flex_body *o, struct arena *life);

/* What depends on q alone. */
struct flex_shape {
    double h[3]; /* first moment */
    double J[6]; /* inertia about the origin: xx yy zz xy xz yz */
    double R[9]; /* mean frame to frame, by column */
    double theta[3], d[3], y[3];
    double a, b, a1, b1;    /* of the turn, and slopes by theta.theta */
    double *dw;             /* [3 x n] */
    double *work;           /* [7 n] of flex_slopes() */
    double *lever;          /* [3 x n] of flex_mass_column(), columns so far */
    struct affine_shape in; /* in the mean frame */
};
void flex_shape_take(struct flex_shape *o, const struct flex_kernel *k, struct arena *life);
void flex_shape_at(struct flex_shape *o, const struct flex_kernel *k, const double *q);

/* Column j of the mass matrix of the coordinates, its rows to j, of dP/dq' = H [3] and dL/dq' = G [3]; one after the
 * other from column 0. */
void flex_mass_column(double *M, double *H, double *G, const struct flex_kernel *k, struct flex_shape *o, int j);

/* F [3], N [3], Q [n] (written) for the motion a, w, al = w', q, q1 = q', q2 = q'' (each of the two may be NULL:
 * zero); shape is that of q.  Stiffness and damping are in Q where elastic is true. */
void flex_inertia(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *shape,
                  const double *a, const double *w, const double *al, const double *q, const double *q1,
                  const double *q2, bool elastic);

/* K = dQ/dq, C = dQ/dq' [n x n] += at fixed a, w, al and q'', without stiffness and damping: what turning about does to
 * the coordinates, unsymmetric.  After flex_shape_at(q). */
void flex_slopes(double *K, double *C, const struct flex_kernel *k, const struct flex_shape *shape, const double *a,
                 const double *w, const double *al, const double *q1, const double *q2);

/* Momentum P = dT/dv and angular momentum about the origin L = dT/dw; kinetic energy T, which may be NULL [J]. */
void flex_momentum(double *P, double *L, double *T, const struct flex_kernel *k, const struct flex_shape *shape,
                   const double *v, const double *w, const double *q1);
/* Kinetic energy; elastic energy q'Kq/2 [J]. */
double flex_kinetic(const struct flex_kernel *k, const struct flex_shape *shape, const double *v, const double *w,
                    const double *q1);
double flex_elastic(const struct flex_kernel *k, const double *q);

/* A node's small body in the frame. */
struct flex_place {
    double x[3], R[9]; /* where it stands; node axes (parallel to the frame's when undeformed) to frame, by column */
    double theta[3], c;
    double v[3], w[3]; /* velocity and angular velocity against the frame, frame axes */
    double a[3], al[3];
    double bias[3], turning[3]; /* of a and al: what q' alone makes */
    double *dx;                 /* [3 x n] dv/dq' = phi + S q */
    double *dw;                 /* [3 x n] dw/dq' */
    double *turn;               /* [3 x n] psi + T q */
    double *work;               /* [3 x n] */
};
void flex_place_take(struct flex_place *o, const struct flex_kernel *k, struct arena *life);
void flex_place_at(struct flex_place *o, const struct flex_kernel *k, int node, const double *q);
/* Velocities, after flex_place_at(); then accelerations. */
void flex_place_move(struct flex_place *o, const struct flex_kernel *k, int node, const double *q1);
void flex_place_accelerate(struct flex_place *o, const struct flex_kernel *k, const double *q2);

#endif
