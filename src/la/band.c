/* band.c -- see band.h
 *
 * With K = L L' and x = L^-T w the pair becomes C w = mu w, C = L^-1 M L^-T, mu = 1 / lambda: the lowest of the pair
 * are the largest of C, found to full relative accuracy.  Subspace iteration (Bathe & Wilson, Int. J. Num. Meth. Eng. 6
 * (1973) 213; Golub & Van Loan, 4th ed., 8.2.4) multiplies p vectors by C, makes them orthonormal, and turns them to
 * the axes of W' C W; a wanted value converges as (mu_{p+1} / mu_i)^2 an iteration. */
#include "la/band.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "la/eigen.h"

struct band band_take(int n, int width, struct arena *life)
{
    return (struct band){n, width, TAKE(life, double, (size_t)(width + 1) * (size_t)n)};
}

struct band band_copy(const struct band *o, struct arena *life)
{
    struct band copy = band_take(o->n, o->width, life);
    memcpy(copy.a, o->a, (size_t)(o->width + 1) * (size_t)o->n * sizeof *o->a);
    return copy;
}

double *band_at(const struct band *o, int i, int j)
{
    return i >= j ? &o->a[i - j + (long)j * (o->width + 1)] : &o->a[j - i + (long)i * (o->width + 1)];
}

void band_isolate(struct band *o, int i, double pivot)
{
    int from = i > o->width ? i - o->width : 0, to = i + o->width < o->n ? i + o->width : o->n - 1;
    for (int j = from; j <= to; j++) *band_at(o, i, j) = j == i ? pivot : 0;
}

/* Rows of column j below the diagonal that lie in the matrix. */
static int below(const struct band *o, int j)
{
    return o->n - 1 - j < o->width ? o->n - 1 - j : o->width;
}

void band_mul(double *y, const struct band *A, const double *x)
{
    for (int i = 0; i < A->n; i++) y[i] = 0;
    for (int j = 0; j < A->n; j++) {
        const double *c = A->a + (long)j * (A->width + 1);
        double sum = c[0] * x[j];
        for (int k = 1, m = below(A, j); k <= m; k++) {
            y[j + k] += c[k] * x[j];
            sum += c[k] * x[j + k];
        }
        y[j] += sum;
    }
}

/* By columns, each subtracted from those to its right: Golub & Van Loan, 4th ed., algorithm 4.3.5. */
int band_cholesky(struct band *A)
{
    int ld = A->width + 1;
    double *diagonal = A->a;
    for (int j = 0; j < A->n; j++) {
        double *c = A->a + (long)j * ld;
        if (!(c[0] > 0) || c[0] > DBL_MAX) return j;
        c[0] = sqrt(c[0]);
        int m = below(A, j);
        for (int k = 1; k <= m; k++) c[k] /= c[0];
        for (int k = 1; k <= m; k++) {
            double *right = diagonal + (long)(j + k) * ld, f = c[k], before = right[0];
            if (f == 0) continue;
            for (int i = k; i <= m; i++) right[i - k] -= c[i] * f;
            if (!(right[0] > 4 * DBL_EPSILON * before)) return j + k;
        }
    }
    return -1;
}

void band_lower_solve(const struct band *L, double *x)
{
    for (int j = 0; j < L->n; j++) {
        const double *c = L->a + (long)j * (L->width + 1);
        if (x[j] == 0) continue;
        double xj = x[j] /= c[0];
        for (int k = 1, m = below(L, j); k <= m; k++) x[j + k] -= c[k] * xj;
    }
}

void band_upper_solve(const struct band *L, double *x)
{
    for (int j = L->n - 1; j >= 0; j--) {
        const double *c = L->a + (long)j * (L->width + 1);
        double sum = x[j];
        for (int k = 1, m = below(L, j); k <= m; k++) sum -= c[k] * x[j + k];
        x[j] = sum / c[0];
    }
}

void band_cholesky_solve(const struct band *L, double *x)
{
    band_lower_solve(L, x);
    band_upper_solve(L, x);
}

/* ---- subspace iteration ---- */

enum { MOST_ITERATIONS = 200, MORE = 2 }; /* MORE: iterations once values stand, for the vectors */
static const double SETTLED = 1e-10, LOST = 1e-13;

struct subspace {
    int n, p;
    double *W, *V;      /* [n x p] orthonormal vectors, C W */
    double *H, *Q;      /* [p x p] projection, turn */
    double *now, *last; /* [p] -mu, ascending */
};

static struct subspace subspace_take(int n, int p, struct arena *scratch)
{
    struct subspace o = {n, p, TAKE(scratch, double, n *p), TAKE(scratch, double, n *p), NULL, NULL, NULL, NULL};
    o.H = TAKE(scratch, double, p *p);
    o.Q = TAKE(scratch, double, p *p);
    o.now = TAKE(scratch, double, p);
    o.last = TAKE(scratch, double, p);
    return o;
}

static double dot(const double *x, const double *y, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += x[i] * y[i];
    return sum;
}

/* Gram and Schmidt, each column twice; what lies in the span of those before becomes zero. */
static void orthonormal(double *W, int n, int p)
{
    for (int j = 0; j < p; j++) {
        double *x = W + (long)j * n, size = sqrt(dot(x, x, n)), left = 0;
        for (int pass = 0; pass < 2; pass++) {
            for (int k = 0; k < j; k++) {
                const double *w = W + (long)k * n;
                double f = dot(w, x, n);
                for (int i = 0; i < n; i++) x[i] -= f * w[i];
            }
            left = sqrt(dot(x, x, n));
        }
        for (int i = 0; i < n; i++) x[i] = left > LOST * size ? x[i] / left : 0;
    }
}

/* Knuth's 64-bit congruential numbers, -1 ... 1. */
static double roll(uint64_t *dice)
{
    *dice = *dice * 6364136223846793005u + 1442695040888963407u;
    return (double)(*dice >> 11) * 0x1p-53 * 2 - 1;
}

/* Unit vectors where all are wanted, pseudo-random ones else. */
static void start(struct subspace *o, const bool *use, bool whole)
{
    uint64_t dice = 1;
    for (int i = 0, j = 0; whole && i < o->n; i++)
        if (use[i]) o->W[i + (long)o->n * j++] = 1;
    if (whole) return;
    for (int j = 0; j < o->p; j++)
        for (int i = 0; i < o->n; i++) o->W[i + (long)j * o->n] = use[i] ? roll(&dice) : 0;
    orthonormal(o->W, o->n, o->p);
}

/* V = C W, and the axes Q of W' C W. */
static void project(struct subspace *o, const struct band *L, const struct band *M, double *work)
{
    int n = o->n, p = o->p;
    for (int j = 0; j < p; j++) {
        memcpy(work, o->W + (long)j * n, (size_t)n * sizeof *work);
        band_upper_solve(L, work);
        band_mul(o->V + (long)j * n, M, work);
        band_lower_solve(L, o->V + (long)j * n);
    }
    memcpy(o->last, o->now, (size_t)p * sizeof *o->last);
    for (int j = 0; j < p; j++)
        for (int i = 0; i <= j; i++)
            o->H[i + p * j] = o->H[j + p * i] = -dot(o->W + (long)i * n, o->V + (long)j * n, n);
    eigen_symmetric(o->now, o->Q, o->H, p);
}

/* A [n x p] := A Q. */
static void turn(double *A, const double *Q, int n, int p, double *row)
{
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < p; j++) row[j] = A[i + (long)j * n];
        for (int j = 0; j < p; j++) A[i + (long)j * n] = dot(Q + (long)j * p, row, p);
    }
}

static bool settled(const struct subspace *o, int count)
{
    for (int j = 0; j < count; j++)
        if (!(fabs(o->now[j] - o->last[j]) <= SETTLED * fabs(o->now[j]))) return false;
    return true;
}

static int finish(double *lambda, double *X, const struct subspace *o, const struct band *L, int count, int k)
{
    for (int j = 0; j < count; j++) {
        double mu = -o->now[j], *x = X + (long)j * o->n;
        if (!(mu > 0) || !isfinite(mu)) return -1;
        lambda[j] = 1 / mu;
        memcpy(x, o->W + (long)j * o->n, (size_t)o->n * sizeof *x);
        band_upper_solve(L, x);
        for (int i = 0; i < o->n; i++) x[i] /= sqrt(mu);
    }
    return k;
}

int band_lowest(double *lambda, double *X, const struct band *L, const struct band *M, const bool *use, int count,
                struct arena *scratch)
{
    int size = 0, n = M->n, wide = count + count / 2 + 8;
    for (int i = 0; i < n; i++) size += use[i];
    if (count > size) return -1;
    bool whole = 4 * wide > 3 * size;
    struct subspace o = subspace_take(n, whole ? size : wide, scratch);
    double *work = TAKE(scratch, double, n > o.p ? n : o.p);
    start(&o, use, whole);
    for (int k = 1, left = whole ? 0 : MORE; k <= MOST_ITERATIONS; k++) {
        project(&o, L, M, work);
        if ((whole || settled(&o, count)) && left-- == 0) {
            turn(o.W, o.Q, n, o.p, work);
            return finish(lambda, X, &o, L, count, k);
        }
        turn(o.V, o.Q, n, o.p, work);
        memcpy(o.W, o.V, (size_t)n * (size_t)o.p * sizeof *o.W);
        orthonormal(o.W, n, o.p);
    }
    return -2;
}
