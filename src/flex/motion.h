/* motion.h -- a flexible body's inertia in motion, in the axes of its frame.
 *
 * From one kinetic energy of the frame's velocity v (of its origin), w and q', with
 *     h(q)  = f q + 1/2 q' s q                 first moment,   H = dh/dq = f + s q
 *     J(q)  = tr A 1 - A + rot,  A = xx + sym(2 xf q) + q' (ff + sym xs) q
 *     G(q)  = int (x + u) x (phi_j + S_j q) dm + rpsi, to first order in q     [3 x n]
 *     T = m v.v/2 + v.(w x h + H q') + w.J w/2 + w.G q' + q'.Me q'/2
 * by the Boltzmann-Hamel equations F = P' + w x P, N = L' + w x L + v x P with P = dT/dv, L = dT/dw,
 * Q = (dT/dq')' - dT/dq.  With a = v' + w x v the true acceleration of the origin in frame axes (gravity in it as
 * upward acceleration):
 *     F = m a + w' x h + w x (w x h) + 2 w x h' + H q'' + q' s q'
 *     N = h x a + J w' + w x J w + J' w + G q'' + G' q' + w x G q'
 *     Q = H^T a + G^T w' + Me q'' + 2 w . (int phi_k x phi_j dm) q_k' - 1/2 w . dJ/dq w + K q + D q'
 * Affine in (a, w', q''), with a symmetric matrix; energy is kept exactly: (T + q'Kq/2)' = v.F + w.N + q'.Q
 * without D.  N is about the origin.  Motions in the x-y plane stay there where the body's data do.
 *
 * Boltzmann, Sitz.-ber. Akad. Wien 111 (1902) 1603; the terms by order in q: Wallrapp, Mech. Struct. Mach. 22
 * (1994) 441. */
#ifndef FMDSUB_FLEX_MOTION_H
#define FMDSUB_FLEX_MOTION_H

#include "flex/body.h"

/* Tables for evaluation, made once from the data. */
struct flex_kernel;
struct flex_kernel *flex_kernel_build(const struct flex_body *o, struct arena *life);
const double *flex_kernel_mass(const struct flex_kernel *k); /* Me [n x n] */

/* What depends on q alone. */
struct flex_shape {
    double h[3];
    double J[6];  /* about the origin: xx yy zz xy xz yz */
    double *H;    /* [3 x n] */
    double *dJ;   /* [6 x n] dJ/dq */
    double *G;    /* [3 x n] */
    double *work; /* [9 x n] */
};
void flex_shape_take(struct flex_shape *o, const struct flex_kernel *k, struct arena *life);
void flex_shape_at(struct flex_shape *o, const struct flex_kernel *k, const double *q);

/* F [3], N [3], Q [n] (written) for the motion a, w, al = w', q, q1 = q', q2 = q'' (each of the two may be NULL:
 * zero); shape is that of q.  Stiffness and damping are in Q where elastic is true. */
void flex_inertia(double *F, double *N, double *Q, const struct flex_kernel *k, const struct flex_shape *shape,
                  const double *a, const double *w, const double *al, const double *q, const double *q1,
                  const double *q2, bool elastic);

/* Momentum P = dT/dv and angular momentum about the origin L = dT/dw. */
void flex_momentum(double *P, double *L, const struct flex_kernel *k, const struct flex_shape *shape, const double *v,
                   const double *w, const double *q1);
/* Kinetic energy; elastic energy q'Kq/2 [J]. */
double flex_kinetic(const struct flex_kernel *k, const struct flex_shape *shape, const double *v, const double *w,
                    const double *q1);
double flex_elastic(const struct flex_kernel *k, const double *q);

/* A node's small body in the frame at q, q', q''.  q' NULL: position only, q'' NULL: no accelerations. */
struct flex_place {
    double x[3], R[9]; /* where it stands; node axes (parallel to the frame's when undeformed) to frame, by column */
    double v[3], w[3]; /* velocity and angular velocity against the frame, frame axes */
    double a[3], al[3];
    double *dx; /* [3 x n] dv/dq' = phi + S q */
    double *dw; /* [3 x n] dw/dq' */
};
void flex_place_take(struct flex_place *o, const struct flex_kernel *k, struct arena *life);
void flex_place_at(struct flex_place *o, const struct flex_kernel *k, int node, const double *q, const double *q1,
                   const double *q2);

#endif
