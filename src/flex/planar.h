/* planar.h -- a flexible body's inertia and nodes in the plane, for the step loop.
 *
 * Displacements in x and y, rotation about z.  With J (x, y) = (-y, x), a x b = a . (-J b) the scalar cross product,
 * jx = int x.x and m, each shape is a similar motion of the body and a rest, phi_j = f_j/m + (e_j + g_j J) x/jx +
 * phi^_j,
 *
 *     e = int x . phi,   g = int x x phi,   W^_jk = int phi^_j . phi^_k,   P^_jk = int phi^_j x phi^_k,
 *
 * and the rest is square to the similar motions.  Of the second-order displacements 1/2 q'Sq the integrals know the
 * similar part; this part is what the body gets, so that in the axes of the frame a particle stands at
 *
 *     h/m + (rho + tau J) x/jx + phi^ q,      h = f q + 1/2 q' s q,  H = dh/dq          first moment [2], [2 x n]
 *     rho = jx + e.q + 1/2 q' tr(xs) q,       E = drho/dq = int x . (phi + S q)
 *     tau = g.q + 1/2 q' (int x x S) q,       C = dtau/dq = int x x (phi + S q)
 *
 * and its energy is a square whatever q is: were the terms in q counted one by one to some order, the mass matrix of a
 * beam pinned where its modes are clamped would be negative at small q already, for there the motion of the frame and
 * of the modes nearly cancel.  With r = rot + q'W^ q and the constant M^ = W^ + ppsi,
 *
 *     2 T = |m v + w J h + H q'|^2/m + ((E.q' - w tau)^2 + (C.q' + w rho)^2)/jx
 *           + r w^2 + 2 w (rpsi + P^'q).q' + q'.M^ q'
 *
 *     J   = r + |h|^2/m + (rho^2 + tau^2)/jx                           inertia about the origin
 *     G_k = rpsi_k + (P^'q)_k + h x H_k/m + (rho C_k - tau E_k)/jx
 *     Me  = M^ + H'H/m + (EE' + CC')/jx
 *
 * and with a = v' + w J v (of d'Alembert, part by part)
 *
 *     F   = m a + al J h - w2 h + 2 w J H q' + H q'' + q' s q'
 *     A   = -al tau - w2 rho - 2 w tau' + rho'',    B = al rho - w2 tau + 2 w rho' + tau''
 *     N   = h x F/m + (rho B - tau A)/jx + r al + 2 w (W^ q).q' + (rpsi + P^'q).q''
 *     Q_k = H_k . F/m + (E_k A + C_k B)/jx + al (rpsi + P^'q)_k + 2 w (P^'q')_k - w2 (W^ q)_k + (M^ q'')_k
 *
 * All this is in the body's mean frame, which stands on the reference node and turns against the frame of the data by
 * the angle Theta q, Theta = int (x - x_0) x phi dm / J, so that in it motion of the coordinates has no angular
 * momentum about the node, to first order (without second-order displacements Theta = 0).  With y from the node to the
 * origin of the mean frame, d from origin to origin, t1 = Theta q', t2 = Theta q'', in the axes of the frame
 *
 *     a := a + al J d - w2 d + t2 J y - t1 (t1 + 2 w) y,   w := w + t1,   al := al + t2,
 *     Q := Q + Theta (N + y x F),   N := N + d x F.
 *
 * Stiffness K q and damping D q' stand apart.
 *
 * A body of space that moves in a plane (flex_body's `affine`) has its shapes split as there (affine.h): int x x' dm =
 * l_1 e_1 e_1' + l_2 e_2 e_2', and in place of the similar motions those of e_1 and of e_2, each with its own
 *
 *     rho = l + e.int (phi q + ...) (x.e) dm,  tau = Je.int (phi q + ...) (x.e) dm,  jx = l,
 *
 * so that the square is there twice; the second one is the body `across`, which has nothing else.  Its nodes turn by
 * 2 atan(psi q/2), the angle of Cayley's map. */
#ifndef FMDSUB_FLEX_PLANAR_H
#define FMDSUB_FLEX_PLANAR_H

#include "flex/body.h"

/* Tables, made once from the data; what is zero there is not multiplied. */
struct flex_planar;
struct flex_planar *flex_planar_build(const struct flex_body *o, struct arena *life);

/* What depends on q alone. */
/* Motion that flex_planar_inertia() has seen last, in the mean frame, and what it has made of it: F, A, B; h', rho',
 * tau' by q', (W^ q).q'. */
struct flex_planar_now {
    double a[2], w, al, F[2], A, B, h[2], rho, tau, W;
};
struct flex_planar_core {                  /* in the mean frame */
    double h[2], rho, tau, J, rest;        /* rest: r */
    const double *Hx, *Hy, *E, *C, *W, *P; /* [n]; W^ q, P^'q */
    double *work, *rates;                  /* where they stand; work of flex_planar_inertia() */
    const double *se, *sc;                 /* [n] of the across: what is made of q' for E and C */
    struct flex_planar_now now;
};
struct flex_planar_shape {
    double h[2], J;
    double cs[2], d[2], y[2];             /* of the mean frame: cos, sin; its origin; the same from the pivot */
    struct flex_planar_core core, across; /* the second: of a body as in space, below */
};
void flex_planar_shape_take(struct flex_planar_shape *o, const struct flex_planar *k, struct arena *life);
void flex_planar_shape_at(struct flex_planar_shape *o, const struct flex_planar *k, const double *q);

/* F [2], N, Q [n] (written) for the acceleration a of the origin (gravity in it as upward acceleration), w, al = w',
 * q1 = q', q2 = q''. */
void flex_planar_inertia(double *F, double *N, double *Q, const struct flex_planar *k, struct flex_planar_shape *o,
                         const double *a, double w, double al, const double *q1, const double *q2);
/* K = dQ/dq, C = dQ/dq' [n x n] += at fixed a, w, al and q'', as flex_slopes() of motion.h; after flex_planar_inertia()
 * with the same q1 and q2. */
void flex_planar_slopes(double *K, double *C, const struct flex_planar *k, const struct flex_planar_shape *o,
                        const double *q1, const double *q2);
/* Q += K q + D q' */
void flex_planar_elastic(double *Q, const struct flex_planar *k, const double *q, const double *q1);

/* For v of the origin, w, q': momentum P = dT/dv [2], angular momentum about the origin L = dT/dw, kinetic energy T,
 * which may be NULL [J]. */
void flex_planar_momentum(double *P, double *L, double *T, const struct flex_planar *k,
                          const struct flex_planar_shape *o, const double *v, double w, const double *q1);
double flex_planar_kinetic(const struct flex_planar *k, const struct flex_planar_shape *o, const double *v, double w,
                           const double *q1);
/* M^ of the coordinates [n x n], its lower triangle; U [3 x n] their columns of G, Hx, Hy. */
void flex_planar_mass(double *M, double *U, const struct flex_planar *k, const struct flex_planar_shape *o);

/* A node's small body in the frame: it stands at x, turned by angle. */
struct flex_planar_place {
    double x[2], angle; /* x + phi q + 1/2 q' S q,  psi . q */
    double cs[2];       /* cos, sin of the angle */
    double v[2], w;     /* against the frame, frame axes */
    double a[2], al;
    double bias[2], turning;    /* of a: q1' S q1; of al */
    const double *dx, *dy, *dw; /* [n] velocities by q': phi + S q, psi */
    double theta;               /* psi q */
    double *turn;               /* [n] where dw stands, of a body as in space; NULL: it does not change */
    double *work;               /* where dx and dy stand, and work */
};
void flex_planar_place_take(struct flex_planar_place *o, const struct flex_planar *k, int node, struct arena *life);
void flex_planar_place_at(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q);
/* Velocities, after flex_planar_place_at(); what they are to accelerations; then these. */
void flex_planar_place_move(struct flex_planar_place *o, const struct flex_planar *k, const double *q1);
void flex_planar_place_bias(struct flex_planar_place *o, const struct flex_planar *k, int node, const double *q1);
void flex_planar_place_accelerate(struct flex_planar_place *o, const struct flex_planar *k, const double *q2);
/* What force f, in the body's axes, and moment at the node are to the coordinates: g [n]; added to Q [n]. */
void flex_planar_place_row(double *restrict g, const struct flex_planar_place *o, const struct flex_planar *k,
                           const double *f, double moment);
void flex_planar_place_load(double *restrict Q, const struct flex_planar_place *o, const struct flex_planar *k,
                            const double *f, double moment);

#endif
