/* schur.c -- see schur.h */
#include "la/schur.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/stop.h"

struct schur {
    int n;
    double complex *T, *U; /* [n x n] A = U T U*, T upper Hessenberg, then triangular; U: NULL, not wanted */
};

/* ---- Hessenberg's form ---- */

/* A := (1 - b v v') A, or A (1 - b v v') from the right; rows (columns) of v are first ... n - 1. */
static void reflect_left(double *A, const double *v, double b, int first, int n)
{
    for (int j = 0; j < n; j++) {
        double sum = 0, *a = A + (long)n * j;
        for (int i = first; i < n; i++) sum += v[i] * a[i];
        for (int i = first; i < n; i++) a[i] -= b * sum * v[i];
    }
}

static void reflect_right(double *A, const double *v, double b, int first, int n, double *work)
{
    memset(work, 0, (size_t)n * sizeof *work);
    for (int j = first; j < n; j++)
        for (int i = 0; i < n; i++) work[i] += v[j] * A[i + (long)n * j];
    for (int j = first; j < n; j++)
        for (int i = 0; i < n; i++) A[i + (long)n * j] -= b * v[j] * work[i];
}

/* A := Q'AQ, U := Q, where U is not NULL. */
static void hessenberg(double *A, double *U, int n, struct arena *scratch)
{
    double *v = TAKE(scratch, double, n), *work = TAKE(scratch, double, n);
    for (int i = 0; U && i < n; i++) U[i + (long)n * i] = 1;
    for (int k = 0; k + 2 < n && !stop; k++) {
        double norm = 0, square = 0;
        for (int i = k + 1; i < n; i++) norm = hypot(norm, v[i] = A[i + (long)n * k]);
        if (norm == 0) continue;
        v[k + 1] += copysign(norm, v[k + 1]);
        for (int i = k + 1; i < n; i++) square += v[i] * v[i];
        reflect_left(A, v, 2 / square, k + 1, n);
        reflect_right(A, v, 2 / square, k + 1, n, work);
        if (U) reflect_right(U, v, 2 / square, k + 1, n, work);
    }
}

/* ---- QR ---- */

/* The eigenvalue of the lower right 2 x 2 that is nearer to its corner. */
static double complex shift(const struct schur *o, int high)
{
    const double complex *t = o->T + (long)o->n * high + high; /* the corner */
    const double complex a = t[-o->n - 1], b = t[-1], c = t[-o->n], d = t[0];
    const double complex half = (a - d) / 2, root = csqrt(half * half + b * c);
    const double complex far = cabs(half + root) > cabs(half - root) ? half + root : half - root;
    return far == 0 ? d : d - b * c / far;
}

/* Rows and columns k, k + 1 turned so that (x, y) becomes (r, 0), r real times the phase of x. */
static void rotate(struct schur *o, int k, int first, int last, double complex x, double complex y)
{
    const int n = o->n;
    const double size = hypot(cabs(x), cabs(y));
    if (size == 0) return;
    const double complex c = conj(x) / size, s = conj(y) / size;
    for (int j = first; j < n; j++) {
        double complex *t = o->T + (long)n * j + k, u = t[0], w = t[1];
        t[0] = c * u + s * w;
        t[1] = conj(c) * w - conj(s) * u;
    }
    for (int side = 0; side < (o->U ? 2 : 1); side++) {
        double complex *t = (side ? o->U : o->T) + (long)n * k;
        for (int i = 0; i < (side ? n : last + 1); i++) {
            const double complex u = t[i], w = t[i + n];
            t[i] = conj(c) * u + conj(s) * w;
            t[i + n] = c * w - s * u;
        }
    }
}

/* One sweep over the block low ... high. */
static void sweep(struct schur *o, int low, int high, double complex mu)
{
    const int n = o->n;
    double complex x = o->T[low + (long)n * low] - mu, y = o->T[low + 1 + (long)n * low];
    for (int k = low; k < high; k++) {
        const int first = k > low ? k - 1 : low, last = k + 2 < high ? k + 2 : high;
        rotate(o, k, first, last, x, y);
        if (k > low) o->T[k + 1 + (long)n * (k - 1)] = 0;
        if (k + 1 < high) {
            x = o->T[k + 1 + (long)n * k];
            y = o->T[k + 2 + (long)n * k];
        }
    }
}

/* The first row of the block that ends at high: the entry before it is next to nothing. */
static int block(struct schur *o, int high)
{
    int k = high;
    for (; k > 0; k--) {
        double complex *t = o->T + (long)o->n * k + k;
        double complex *below = t - o->n;
        if (cabs(*below) > DBL_EPSILON * (cabs(*t) + cabs(t[-o->n - 1]))) continue;
        *below = 0;
        break;
    }
    return k;
}

static bool triangular(struct schur *o)
{
    enum { MOST = 60 };
    int tries = 0;
    for (int high = o->n - 1; high > 0;) {
        const int low = block(o, high);
        if (low == high) {
            high--;
            tries = 0;
            continue;
        }
        if (++tries > MOST || stop) return false;
        double complex mu = shift(o, high);
        if (tries % 10 == 0) mu += cabs(o->T[high + (long)o->n * (high - 1)]); /* out of a circle */
        sweep(o, low, high, mu);
    }
    return true;
}

/* ---- vectors ---- */

/* x of T x = T_jj x with x_j = 1, then U x, of length 1. */
static void vector(double complex *x, const struct schur *o, int j, double size, double complex *work)
{
    const int n = o->n;
    const double complex s = o->T[j + (long)n * j];
    double norm = 0;
    work[j] = 1;
    for (int i = 0; i < j; i++) work[i] = -o->T[i + (long)n * j];
    for (int k = j - 1; k >= 0; k--) {
        double complex gap = o->T[k + (long)n * k] - s;
        if (cabs(gap) < DBL_EPSILON * size) gap = DBL_EPSILON * size;
        work[k] /= gap;
        for (int i = 0; i < k; i++) work[i] -= o->T[i + (long)n * k] * work[k];
    }
    for (int i = 0; i < n; i++) {
        x[i] = 0;
        for (int k = 0; k <= j; k++) x[i] += o->U[i + (long)n * k] * work[k];
        norm = hypot(norm, cabs(x[i]));
    }
    for (int i = 0; i < n; i++) x[i] /= norm;
}

/* The Schur form of A, which is destroyed; false: not finite, no convergence, or a wish to end. */
static bool decompose(struct schur *o, double *A, bool vectors, struct arena *scratch)
{
    const int n = o->n;
    double *U = vectors ? TAKE(scratch, double, n *n) : NULL;
    o->T = TAKE(scratch, double complex, n *n);
    o->U = vectors ? TAKE(scratch, double complex, n *n) : NULL;
    for (int i = 0; i < n * n; i++)
        if (!isfinite(A[i])) return false;
    hessenberg(A, U, n, scratch);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) o->T[i + (long)n * j] = i > j + 1 ? 0 : A[i + (long)n * j];
    for (int i = 0; vectors && i < n * n; i++) o->U[i] = U[i];
    return triangular(o);
}

bool schur_eigen(double complex *s, double complex *X, double *A, int n, struct arena *scratch)
{
    struct schur o = {.n = n};
    double size = 0;
    for (int i = 0; i < n * n; i++) size = fmax(size, fabs(A[i]));
    if (!decompose(&o, A, X != NULL, scratch)) return false;
    for (int j = 0; j < n; j++) s[j] = o.T[j + (long)n * j];
    double complex *work = TAKE(scratch, double complex, n);
    for (int j = 0; X && j < n && !stop; j++) vector(X + (long)n * j, &o, j, size > 0 ? size : 1, work);
    return !stop;
}
