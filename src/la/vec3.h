/* vec3.h -- vectors of three and matrices of three by three, by column, in plain loops unrolled.
 *
 * Outputs come first and may not overlap the inputs unless the line says so. */
#ifndef FMDSUB_LA_VEC3_H
#define FMDSUB_LA_VEC3_H

#include <math.h>

static inline void v3_set(double *o, double x, double y, double z)
{
    o[0] = x;
    o[1] = y;
    o[2] = z;
}

/* o may be a. */
static inline void v3_copy(double *o, const double *a)
{
    v3_set(o, a[0], a[1], a[2]);
}

/* o = a + b; o may be a or b. */
static inline void v3_sum(double *o, const double *a, const double *b)
{
    v3_set(o, a[0] + b[0], a[1] + b[1], a[2] + b[2]);
}

/* o = a - b; o may be a or b. */
static inline void v3_diff(double *o, const double *a, const double *b)
{
    v3_set(o, a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/* o = s a; o may be a. */
static inline void v3_scale(double *o, double s, const double *a)
{
    v3_set(o, s * a[0], s * a[1], s * a[2]);
}

/* o += a. */
static inline void v3_add(double *o, const double *a)
{
    o[0] += a[0];
    o[1] += a[1];
    o[2] += a[2];
}

/* o -= a. */
static inline void v3_take(double *o, const double *a)
{
    o[0] -= a[0];
    o[1] -= a[1];
    o[2] -= a[2];
}

/* o += s a. */
static inline void v3_axpy(double *o, double s, const double *a)
{
    o[0] += s * a[0];
    o[1] += s * a[1];
    o[2] += s * a[2];
}

static inline double v3_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double v3_norm(const double *a)
{
    return sqrt(v3_dot(a, a));
}

/* o = a x b. */
static inline void v3_cross(double *o, const double *a, const double *b)
{
    o[0] = a[1] * b[2] - a[2] * b[1];
    o[1] = a[2] * b[0] - a[0] * b[2];
    o[2] = a[0] * b[1] - a[1] * b[0];
}

/* o += a x b. */
static inline void v3_cross_add(double *o, const double *a, const double *b)
{
    o[0] += a[1] * b[2] - a[2] * b[1];
    o[1] += a[2] * b[0] - a[0] * b[2];
    o[2] += a[0] * b[1] - a[1] * b[0];
}

/* o = A x. */
static inline void m3_mul(double *o, const double *A, const double *x)
{
    o[0] = A[0] * x[0] + A[3] * x[1] + A[6] * x[2];
    o[1] = A[1] * x[0] + A[4] * x[1] + A[7] * x[2];
    o[2] = A[2] * x[0] + A[5] * x[1] + A[8] * x[2];
}

/* o += A x. */
static inline void m3_mul_add(double *o, const double *A, const double *x)
{
    o[0] += A[0] * x[0] + A[3] * x[1] + A[6] * x[2];
    o[1] += A[1] * x[0] + A[4] * x[1] + A[7] * x[2];
    o[2] += A[2] * x[0] + A[5] * x[1] + A[8] * x[2];
}

/* o = A' x. */
static inline void m3_tmul(double *o, const double *A, const double *x)
{
    o[0] = v3_dot(A, x);
    o[1] = v3_dot(A + 3, x);
    o[2] = v3_dot(A + 6, x);
}

/* O = A B. */
static inline void m3_mulm(double *O, const double *A, const double *B)
{
    m3_mul(O, A, B);
    m3_mul(O + 3, A, B + 3);
    m3_mul(O + 6, A, B + 6);
}

/* O = A' B. */
static inline void m3_tmulm(double *O, const double *A, const double *B)
{
    m3_tmul(O, A, B);
    m3_tmul(O + 3, A, B + 3);
    m3_tmul(O + 6, A, B + 6);
}

/* O = A B'. */
static inline void m3_mulmt(double *O, const double *A, const double *B)
{
    for (int j = 0; j < 3; j++) m3_mul(O + 3 * j, A, (double[]){B[j], B[j + 3], B[j + 6]});
}

static inline void m3_unit(double *O)
{
    for (int i = 0; i < 9; i++) O[i] = i % 4 == 0;
}

/* A symmetric tensor in six numbers: xx yy zz xy xz yz. */

/* o = S x. */
static inline void s3_mul(double *o, const double *S, const double *x)
{
    o[0] = S[0] * x[0] + S[3] * x[1] + S[4] * x[2];
    o[1] = S[3] * x[0] + S[1] * x[1] + S[5] * x[2];
    o[2] = S[4] * x[0] + S[5] * x[1] + S[2] * x[2];
}

/* O = S^-1, not finite where S is singular. */
static inline void s3_invert(double *O, const double *S)
{
    const double xx = S[0], yy = S[1], zz = S[2], xy = S[3], xz = S[4], yz = S[5];
    const double C[6] = {yy * zz - yz * yz, xx * zz - xz * xz, xx * yy - xy * xy,
                         xz * yz - xy * zz, xy * yz - xz * yy, xy * xz - xx * yz};
    const double det = xx * C[0] + xy * C[3] + xz * C[4];
    for (int i = 0; i < 6; i++) O[i] = C[i] / det;
}

/* O = R S R'. */
static inline void s3_turn(double *O, const double *R, const double *S)
{
    double X[9]; /* R S, by column */
    m3_mul(X, R, (double[]){S[0], S[3], S[4]});
    m3_mul(X + 3, R, (double[]){S[3], S[1], S[5]});
    m3_mul(X + 6, R, (double[]){S[4], S[5], S[2]});
    O[0] = X[0] * R[0] + X[3] * R[3] + X[6] * R[6];
    O[1] = X[1] * R[1] + X[4] * R[4] + X[7] * R[7];
    O[2] = X[2] * R[2] + X[5] * R[5] + X[8] * R[8];
    O[3] = X[0] * R[1] + X[3] * R[4] + X[6] * R[7];
    O[4] = X[0] * R[2] + X[3] * R[5] + X[6] * R[8];
    O[5] = X[1] * R[2] + X[4] * R[5] + X[7] * R[8];
}

#endif
