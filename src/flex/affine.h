/* affine.h -- a flexible body's inertia in motion, in the axes of the frame that its data are given in.
 *
 * The shapes are split into an affine motion of the body and a rest that is square to all affine motions,
 * phi_j = f_j/m + Phi_j x + phi^_j.  With the principal axes of int x x' dm = sum l_a e_a e_a' an affinely moved body
 * is four particles of mass 1 (fewer where it has no extension),
 *
 *     c_0 = h/sqrt(m),   h = f q + 1/2 q' s q            first moment,  H = dh/dq = f + s q
 *     c_a = sqrt(l_a) e_a + (xf'q + 1/2 q' xs'q) e_a/sqrt(l_a),
 *
 * for int p p' dm = sum c_a c_a' where p is affine in x.  Of the second-order displacements 1/2 q'Sq, s and xs know the
 * affine part, and this is what the body gets.  So its energy is a square whatever q is,
 *
 *     2 T = |sqrt(m) v + w x c_0 + c_0'|^2 + sum |w x c_a + c_a'|^2 + w.J^ w + 2 w.G^ q' + q'.M^ q'
 *     J^ = rot + int (phi^ q.phi^ q - phi^ q (phi^ q)'),  G^ = rpsi + int phi^ q x phi^,  M^ = int phi^'phi^ + ppsi;
 *
 * were the terms counted one by one to some order in q, the mass matrix of a beam pinned where its modes are clamped
 * would be negative at small q already, for there the motion of the frame and of the modes nearly cancel.  In sum, with
 * J = J^ + sum (c_a.c_a 1 - c_a c_a'),  G = G^ + sum c_a x dc_a/dq,  Me = M^ + sum (dc_a/dq)'(dc_a/dq),
 *
 *     T = m v.v/2 + v.(w x h + H q') + w.J w/2 + w.G q' + q'.Me q'/2.
 *
 * Forces are d'Alembert's of the particles, and of the rest those of the Boltzmann-Hamel equations F = P' + w x P,
 * N = L' + w x L + v x P with P = dT/dv, L = dT/dw, Q = (dT/dq')' - dT/dq.  With a = v' + w x v the true acceleration
 * of the origin in frame axes (gravity in it as upward acceleration)
 *
 *     g_a = [sqrt(m) a] + w' x c_a + w x (w x c_a) + 2 w x c_a' + c_a''      (a: of c_0 alone)
 *     F   = sqrt(m) g_0
 *     N   = sum c_a x g_a + J^ w' + w x J^ w + J^' w + G^ q'' + w x G^ q'
 *     Q   = sum dc_a/dq . g_a + G^T w' + M^ q'' + 2 w . (int phi^_k x phi^_j dm) q_k' - 1/2 w . dJ^/dq w
 *
 * Affine in (a, w', q''), with a symmetric matrix; T' = v.F + w.N + q'.Q.  N is about the origin. */
#ifndef FMDSUB_FLEX_AFFINE_H
#define FMDSUB_FLEX_AFFINE_H

#include "flex/body.h"

/* Tables, made once from the data. */
struct affine;
struct affine *affine_build(const struct flex_body *o, struct arena *life);

/* What depends on q alone. */
struct affine_shape {
    double h[3];
    double J[6], Jrest[6]; /* about the origin: xx yy zz xy xz yz; J^ */
    double c[4][3];        /* c_a */
    double *C;             /* [3 x n] each: dc_a/dq */
    double *dJ;            /* [6 x n] dJ^/dq */
    double *rest;          /* [3 x n] G^ */
    double *work, *later;  /* [nfast] */
    double *aside;         /* [9 n] of affine_slopes() */
};
void affine_take(struct affine_shape *o, const struct affine *k, struct arena *life);
void affine_at(struct affine_shape *o, const struct affine *k, const double *q);

/* Column j of Me, its rows to j, of H [3] and G [3]. */
void affine_mass_column(double *M, double *H, double *G, const struct affine *k, const struct affine_shape *o, int j);

/* F [3], N [3], Q [n] (written); each of q1 = q', q2 = q'' may be NULL: zero. */
void affine_inertia(double *F, double *N, double *Q, const struct affine *k, const struct affine_shape *shape,
                    const double *a, const double *w, const double *al, const double *q1, const double *q2);

/* K = dQ/dq, C = dQ/dq' [n x n] += at fixed a, w, al, q'', and dm/dq, dm/dq' [3 x n] (written) of the moment
 * m = N - p x F about the point p. */
void affine_slopes(double *K, double *C, double *mK, double *mC, const struct affine *k,
                   const struct affine_shape *shape, const double *p, const double *a, const double *w,
                   const double *al, const double *q1, const double *q2);
/* What Q [n] and m [3] (written) change by along da, dw, dal; after affine_slopes() at the same w, q1. */
void affine_along(double *Q, double *m, const struct affine *k, const struct affine_shape *shape, const double *p,
                  const double *da, const double *dw, const double *dal, const double *w, const double *q1);

/* P = dT/dv, L = dT/dw, T [J], which may be NULL. */
void affine_momentum(double *P, double *L, double *T, const struct affine *k, const struct affine_shape *o,
                     const double *v, const double *w, const double *q1);

#endif
