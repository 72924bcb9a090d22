/* spin.c -- see spin.h
 *
 * The largest mu = 1/W^2 of Z x = mu K x.  Over all axes: with x the best axis is the one that takes least from
 * x'Zx = tr X - e'X e, X = sum x_i x_j sym ff_ij, the eigenvector of its least eigenvalue; with e the best x is the
 * eigenvector.  In turns mu only grows. */
#include "flex/spin.h"

#include <math.h>

#include "la/eigen.h"
#include "la/vec3.h"

static int count(const struct flex_body *o)
{
    return o->hertz && o->n > SPIN_MOST ? SPIN_MOST : o->n;
}

static double softening(const double *A, const double *e)
{
    double Ae[3];
    m3_mul(Ae, A, e);
    return A[0] + A[4] + A[8] - v3_dot(e, Ae);
}

/* mu and its x [count]; 0 where there is none, or K is not positive. */
static double largest(double *x, const struct flex_body *o, const double *e, struct arena *scratch)
{
    const int n = count(o);
    struct arena_mark mark = arena_mark(scratch);
    double *Z = TAKE(scratch, double, n *n), *K = TAKE(scratch, double, n *n), *X = TAKE(scratch, double, n *n);
    double *mu = TAKE(scratch, double, n), most = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            K[i + n * j] = o->K[i + o->n * j];
            Z[i + n * j] = (softening(o->ff + 9 * (i + o->n * j), e) + softening(o->ff + 9 * (j + o->n * i), e)) / 2;
        }
    if (n > 0 && eigen_general(mu, X, Z, K, n) < 0 && mu[n - 1] > 0) {
        most = mu[n - 1];
        for (int i = 0; i < n; i++) x[i] = X[i + n * (n - 1)];
    }
    arena_rewind(scratch, mark);
    return most;
}

static void best_axis(double *e, const struct flex_body *o, const double *x)
{
    const int n = count(o);
    double X[9] = {0}, V[9], lambda[3];
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const double *A = o->ff + 9 * (i + o->n * j);
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++) X[a + 3 * b] += x[i] * x[j] * (A[a + 3 * b] + A[b + 3 * a]) / 2;
        }
    eigen_symmetric(lambda, V, X, 3);
    v3_copy(e, V);
}

double flex_spin_limit(const struct flex_body *o, const double *e, struct arena *scratch)
{
    return 1 / sqrt(largest(TAKE(scratch, double, o->n), o, e, scratch));
}

double flex_spin_worst(double *e, const struct flex_body *o, int space, struct arena *scratch)
{
    enum { MOST_TURNS = 20 };
    double *x = TAKE(scratch, double, o->n), most = 0;
    v3_set(e, 0, 0, 1);
    if (space == 2) return flex_spin_limit(o, e, scratch);
    for (int start = 0; start < 3; start++) {
        double axis[3] = {start == 0, start == 1, start == 2}, last = 0, mu = largest(x, o, axis, scratch);
        for (int k = 0; k < MOST_TURNS && mu > last * (1 + 1e-9); k++) {
            if (mu > most * (1 + 1e-9)) v3_copy(e, axis);
            most = fmax(most, mu);
            last = mu;
            best_axis(axis, o, x);
            mu = largest(x, o, axis, scratch);
        }
    }
    return 1 / sqrt(most);
}
