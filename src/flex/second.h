/* second.h -- the second order of a flexible body's displacements as further coordinates that follow.
 *
 * Of q'S q/2 the forces and moments of inertia feel int S dm and int x S' dm.  A field that is affine in x has the same
 * ones,
 *
 *     S_ij ~ s_ij/m + sum over b of (x.p_b) xs_ij' p_b/l_b,      xx p_b = l_b p_b,
 *
 * and so the body moves, to the order that S is good for, like one of first order in n + m coordinates (q, z), where
 * the last m are coefficients of unit fields e_a and (x.p_b) e_a and follow the others,
 *
 *     z = y - c y'M y/(2 c'M c),     y_k = q'B_k q/2,
 *
 * with M the fields' own mass matrix.
 *
 * A body whose frame turns with something else (a blade clamped to its hub) keeps of its kinetic energy what is linear
 * in z, the classical theory: good to the second order of the deflection, and to a few parts in a thousand where a tip
 * has moved by a tenth of the length.  Cut off so, T is not a sum of squares, and where the frame is free to turn,
 * on a hinge, modes and frame can trade places at next to no energy: M^ would turn singular at a few hundredths of the
 * length.  There T is kept whole, the energy of a motion, positive at any deflection.  The term in c, the coefficients
 * of x - x_0 with x_0 the reference, makes up for the square that the whole has more: the distances |x - x_0 + u| stay
 * what second order has them, int of their squares to the fourth order, as bending without stretching leaves them (a
 * rod that turns by an angle of sine v/x is not longer for it). */
#ifndef FMDSUB_FLEX_SECOND_H
#define FMDSUB_FLEX_SECOND_H

#include "flex/body.h"

struct flex_second {
    int n, m;                /* coordinates of the body; those that follow, m = 0 where there is no second order */
    double *B;               /* [n x n x m] */
    double *M;               /* [m x m] */
    double *c;               /* [m] over c'M c; 0: these fields do not stretch the body */
    struct flex_body *whole; /* of first order in n + m coordinates: all integrals, no stiffness */
};

struct flex_second *flex_second_build(const struct flex_body *o, struct arena *life);

/* Numbers in Bq below, [n x m] = dz/dq by column and what comes behind. */
size_t flex_second_room(const struct flex_second *o);
/* x [n + m] := (q, z), and Bq. */
void flex_second_at(double *x, double *Bq, const struct flex_second *o, const double *q);
/* x1 := (q1, z'). */
void flex_second_rate(double *x1, const struct flex_second *o, const double *Bq, const double *q1);
/* x2 := (q2, z''); q1, q2 NULL: zero. */
void flex_second_acceleration(double *x2, const struct flex_second *o, const double *Bq, const double *q1,
                              const double *q2);

/* Y [rows x n] := the first n columns of X [rows x (n + m)] and what follows of the others. */
static inline void flex_second_fold(double *Y, const double *X, const struct flex_second *o, const double *Bq, int rows)
{
    const int n = o->n;
    for (int j = 0; j < n * rows; j++) Y[j] = X[j];
    for (int k = 0; k < o->m; k++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < rows; i++) Y[i + rows * j] += Bq[j + n * k] * X[i + rows * (n + k)];
}

/* Me [n x n] of the body as it is bent, folded from that of the whole [(n + m) x (n + m)]. */
void flex_second_mass(double *Me, const struct flex_second *o, const double *Bq, const double *whole);

#endif
