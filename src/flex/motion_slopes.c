/* motion_slopes.c -- how the inertia of motion.h changes with the coordinates and their rates, the motion of the frame
 * given.
 *
 * Q depends on q and q' by the inertia in the mean frame (affine_slopes.c) and by the three numbers theta = Theta q and
 * the three t1 = Theta q', on which the motion a1, w1, al1 of the mean frame depends, and T(theta).  With m the moment
 * about the pivot in the mean frame, T' R = T for R = exp(theta x) makes the share of the turn
 *
 *     Q_k += Theta_k . T m,
 *
 * and what is in a bracket here is found for each of the three directions by central differences: exact for t1, in
 * which the motion is quadratic, and to round-off and the square of the step for theta,
 *
 *     dQ/dq_j = dQ_in/dq_j + Theta_j . [dQ_in/d(a1, w1, al1) d(a1, w1, al1)/dtheta]
 *               + Theta . (T dm/dq_j + [dT/dtheta m]). */
#include <string.h>

#include "flex/motion_parts.h"

static const double STEP = 1e-5; /* [rad] */

struct going {
    double a[3], w[3], al[3];
};

/* o = (x - y) / h */
static void quotient(struct going *o, const struct going *x, const struct going *y, double h)
{
    for (int i = 0; i < 3; i++) {
        o->a[i] = (x->a[i] - y->a[i]) / h;
        o->w[i] = (x->w[i] - y->w[i]) / h;
        o->al[i] = (x->al[i] - y->al[i]) / h;
    }
}

/* The frame's motion and that of the coordinates' turn. */
struct given {
    const double *a, *w, *al;
    double t1[3], t2[3];
};

static void carry(struct going *o, const struct flex_shape *shape, const struct given *x)
{
    flex_carry(o->a, o->w, o->al, shape, x->a, x->w, x->al, x->t1, x->t2);
}

/* Along theta_i, and Tm = d(T m)/dtheta_i. */
static void along_turn(struct going *o, double *Tm, const struct flex_kernel *k, const struct flex_shape *shape,
                       const struct given *x, const double *m, int i)
{
    struct going to[2];
    double u[2][3];
    for (int way = 0; way < 2; way++) {
        struct flex_shape there = *shape;
        there.theta[i] += way ? -STEP : STEP;
        flex_turn(&there, k->pivot);
        carry(&to[way], &there, x);
        flex_turned(u[way], &there, m);
    }
    quotient(o, &to[0], &to[1], 2 * STEP);
    v3_diff(Tm, u[0], u[1]);
    v3_scale(Tm, .5 / STEP, Tm);
}

static void along_rate(struct going *o, const struct flex_shape *shape, const struct given *x, int i)
{
    struct going to[2];
    for (int way = 0; way < 2; way++) {
        struct given there = *x;
        there.t1[i] += way ? -1 : 1;
        carry(&to[way], shape, &there);
    }
    quotient(o, &to[0], &to[1], 2);
}

/* A += X psi_i', X [n] with row i of psi [3 x n]; m_j += dm psi_ij; all a share of direction i. */
static void spread(double *A, double *mA, const double *X, const double *dm, const double *psi, int i, int n)
{
    for (int j = 0; j < n; j++) {
        const double s = psi[3 * j + i];
        if (s == 0) continue;
        for (int l = 0; l < n; l++) A[l + n * j] += X[l] * s;
        v3_axpy(mA + 3 * j, s, dm);
    }
}

/* A_kj += psi_k . T m_j */
static void share(double *A, const struct flex_shape *shape, const double *mA, const double *psi, int n)
{
    for (int j = 0; j < n; j++) {
        double u[3];
        flex_turned(u, shape, mA + 3 * j);
        for (int l = 0; l < n; l++) A[l + n * j] += v3_dot(psi + 3 * l, u);
    }
}

void flex_slopes(double *K, double *C, const struct flex_kernel *k, const struct flex_shape *shape, const double *a,
                 const double *w, const double *al, const double *q1, const double *q2)
{
    const int n = k->n;
    const double *psi = k->mean.psi;
    double *mK = shape->work, *mC = mK + 3 * n, *X = mC + 3 * n, F[3], m[3];
    struct given x = {.a = a, .w = w, .al = al};
    struct going at, d;
    add3(x.t1, psi, q1, n);
    add3(x.t2, psi, q2, n);
    carry(&at, shape, &x);
    affine_inertia(F, m, X, k->in, &shape->in, at.a, at.w, at.al, q1, q2);
    v3_scale(F, -1, F);
    v3_cross_add(m, k->pivot, F);
    affine_slopes(K, C, mK, mC, k->in, &shape->in, k->pivot, at.a, at.w, at.al, q1, q2);
    for (int i = 0; i < 3; i++) {
        double dm[3], Tm[3];
        along_turn(&d, Tm, k, shape, &x, m, i);
        affine_along(X, dm, k->in, &shape->in, k->pivot, d.a, d.w, d.al, at.w, q1);
        for (int l = 0; l < n; l++) X[l] += v3_dot(psi + 3 * l, Tm);
        spread(K, mK, X, dm, psi, i, n);
        along_rate(&d, shape, &x, i);
        affine_along(X, dm, k->in, &shape->in, k->pivot, d.a, d.w, d.al, at.w, q1);
        spread(C, mC, X, dm, psi, i, n);
    }
    share(K, shape, mK, psi, n);
    share(C, shape, mC, psi, n);
}
