/* planar.h -- a flexible body's inertia and nodes in the plane, for the step loop.
 *
 * The equations of motion.h with displacements in x and y and rotation about z.  In the axes of the frame, with
 * J (x, y) = (-y, x), a x b = a . (-J b) the scalar cross product, and the tables of body.h,
 *
 *     h = f q + 1/2 q' s q,  H = f + s q       first moment [2], dh/dq [2 x n]
 *     J = j0 + (e + y) . q,  y = e + W q       inertia about the origin; dJ/dq = 2 y
 *     G = g + B q                              [n]
 *     T = m v.v/2 + v . (w J h + H q') + J w2/2 + w G . q' + q' . Me q'/2
 *
 * where  j0 = tr xx + rot,  e = tr xf,  W = tr (ff + xs),  g = int x x phi_j + rpsi,  B = P' + X,
 * P_jk = int phi_j x phi_k,  X_jk = int x x S_jk,  Me = tr ff + ppsi.  Lagrange's equations, with p = dT/dv and
 * L = dT/dw in axes that turn with w (F = p' + w J p, N = L' + v x p) and a = v' + w J v, are
 *
 *     F   = m a + al J h - w2 h + 2 w J H q' + H q'' + q' s q'
 *     N   = h x a + J al + 2 w y . q' + G . q'' + q' X q'
 *     Q_k = H_k . a + G_k al + 2 w P_jk q'_j - w2 y_k + (Me q'')_k
 *
 * (the q'-terms of G' and dG/dq meet as B_kj - B_jk = 2 P_jk; P takes no part in q' B q').  Stiffness K q and
 * damping D q' stand apart. */
#ifndef FMDSUB_FLEX_PLANAR_H
#define FMDSUB_FLEX_PLANAR_H

#include "flex/body.h"

/* Tables, made once from the data; what is zero there is not multiplied. */
struct flex_planar;
struct flex_planar *flex_planar_build(const struct flex_body *o, struct arena *life);

/* What depends on q alone. */
struct flex_planar_shape {
    double h[2], J;
    const double *Hx, *Hy, *G, *y; /* [n] */
    double *work, *rates;          /* [4 n] where they stand; work of flex_planar_inertia() */
};
void flex_planar_shape_take(struct flex_planar_shape *o, const struct flex_planar *k, struct arena *life);
void flex_planar_shape_at(struct flex_planar_shape *o, const struct flex_planar *k, const double *q);

/* F [2], N, Q [n] (written) for the acceleration a of the origin (gravity in it as upward acceleration), w, al = w',
 * q1 = q', q2 = q''. */
void flex_planar_inertia(double *F, double *N, double *Q, const struct flex_planar *k, struct flex_planar_shape *o,
                         const double *a, double w, double al, const double *q1, const double *q2);
/* Q += K q + D q' */
void flex_planar_elastic(double *Q, const struct flex_planar *k, const double *q, const double *q1);

/* T for v of the origin, w, q' [J]. */
double flex_planar_kinetic(const struct flex_planar *k, const struct flex_planar_shape *o, const double *v, double w,
                           const double *q1);
const double *flex_planar_mass(const struct flex_planar *k); /* Me [n x n] */

/* A node's small body in the frame: it stands at x, turned by angle. */
struct flex_planar_place {
    double x[2], angle; /* x + phi q + 1/2 q' S q,  psi . q */
    double v[2], w;     /* against the frame, frame axes */
    double a[2], al;
    const double *dx, *dy, *dw; /* [n] velocities by q': phi + S q, psi */
    double *work;               /* [4 n] where dx and dy stand, and work */
};
void flex_planar_place_take(struct flex_planar_place *o, const struct flex_planar *k, int node, struct arena *life);
/* q1 NULL: velocities are not wanted, nor are accelerations; q2 NULL: these alone are not. */
void flex_planar_place_at(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q,
                          const double *q1, const double *q2);

#endif
