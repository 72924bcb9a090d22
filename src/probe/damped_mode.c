/* damped_mode.c -- see damped_mode.h
 *
 * The eigenvalues of y' = A y, y = (w p, p'), with w of the order of the frequencies. */
#include "probe/damped_mode.h"

#include <math.h>
#include <stdlib.h>

#include "la/schur.h"

/* A [2n x 2n] */
static void first_order(double *A, const double *w, const double *K, const double *D, int n)
{
    const int m = 2 * n;
    for (int j = 0; j < n; j++) {
        A[j + m * (n + j)] = w[j];
        for (int i = 0; i < n; i++) {
            A[n + i + m * j] = -K[i + n * j] / w[j];
            A[n + i + m * (n + j)] = -D[i + n * j];
        }
    }
}

struct found {
    double s;
    int column;
};

static int by_value(const void *x, const void *y)
{
    const struct found *a = x, *b = y;
    return a->s > b->s ? 1 : a->s < b->s ? -1 : a->column - b->column;
}

static int by_frequency(const void *x, const void *y)
{
    const struct damped_mode *a = x, *b = y;
    return a->omega > b->omega ? 1 : a->omega < b->omega ? -1 : 0;
}

/* p of column y. */
static double *shape(const double complex *y, const double *w, int n, struct arena *life)
{
    double *p = TAKE(life, double, 2 * n);
    for (int j = 0; j < n; j++) {
        p[j] = creal(y[j]) / w[j];
        p[n + j] = cimag(y[j]) / w[j];
    }
    return p;
}

/* Of two eigenvalues by their sum and product. */
static struct damped_mode pair(double sum, double product, double *p)
{
    static const double nothing = 1e-9;
    struct damped_mode o = {.omega = product > 0 ? sqrt(product) : 0, .p = p};
    if (o.omega > 0) o.damping = -sum / (2 * o.omega);
    if (fabs(o.damping) < nothing) o.damping = 0;
    return o;
}

static void sort_out(struct damped_mode *o, const double complex *s, const double complex *Y, const double *w,
                     double top, int n, struct arena *life)
{
    static const double nothing = 1e-6; /* of the highest frequency: zero twice is found to the root of round-off */
    const int m = 2 * n;
    struct found *real = TAKE(life, struct found, m);
    int count = 0, k = 0;
    for (int j = 0; j < m; j++) {
        const bool zero = cabs(s[j]) < nothing * top;
        if (zero || fabs(cimag(s[j])) <= 1e-12 * cabs(s[j]))
            real[k++] = (struct found){zero ? 0 : creal(s[j]), j};
        else if (cimag(s[j]) > 0 && count < n)
            o[count++] = pair(2 * creal(s[j]), creal(s[j] * conj(s[j])), shape(Y + (long)m * j, w, n, life));
    }
    qsort(real, (size_t)k, sizeof *real, by_value);
    for (int i = 0; 2 * i + 1 < k && count < n; i++) {
        const struct found *a = &real[k - 1 - i], *b = &real[i];
        double *p = shape(Y + (long)m * a->column, w, n, life);
        o[count++] = a->s > 0 ? (struct damped_mode){-a->s, 0, p} : pair(a->s + b->s, a->s * b->s, p);
    }
    qsort(o, (size_t)count, sizeof *o, by_frequency);
}

bool damped_modes_find(struct damped_mode *o, const double *K, const double *D, int n, struct arena *life)
{
    const int m = 2 * n;
    double *A = TAKE_MATRIX(life, double, m, m), *w = TAKE(life, double, n), top = 0;
    double complex *s = TAKE(life, double complex, m), *Y = TAKE_MATRIX(life, double complex, m, m);
    for (int j = 0; j < n; j++) top = fmax(top, sqrt(fabs(K[j * (n + 1)])));
    for (int j = 0; j < n; j++) w[j] = fmax(sqrt(fabs(K[j * (n + 1)])), 1e-6 * top + (top == 0));
    first_order(A, w, K, D, n);
    if (!schur_eigen(s, Y, A, m, life)) return false;
    for (int j = 0; j < n; j++) /* where pairs are torn by round-off */
        o[j] = (struct damped_mode){.p = shape(Y + (long)m * 2 * j, w, n, life)};
    sort_out(o, s, Y, w, top, n, life);
    return true;
}
