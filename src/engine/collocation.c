/* collocation.c -- see collocation.h.  A, b and d decide the result and come from the points alone; eigenvalues and
 * eigenvectors only serve the iteration. */
#include "engine/collocation.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "la/complex.h"

/* Zeros of the polynomial, checked by the order of the quadrature (t-collocation). */
static const double points3[] = {0.15505102572168219018, 0.64494897427831780982, 1};
static const double points5[] = {0.05710419611451768219, 0.27684301363812382768, 0.58359043236891682006,
                                 0.86024013565621944785, 1};

/* Gauss's three points and weights in (0, 1): exact up to degree 5. */
static const double gauss[] = {.11270166537925831148, .5, .88729833462074168852},
                    weight[] = {5. / 18, 8. / 18, 5. / 18};

void collocation_through(const struct collocation *o, double *w, double x)
{
    for (int j = 0; j < o->s; j++) {
        w[j] = 1;
        for (int k = 0; k < o->s; k++)
            if (k != j) w[j] *= (x - o->c[k]) / (o->c[j] - o->c[k]);
    }
}

void collocation_slope(const struct collocation *o, double *w, double x)
{
    double p[COLLOCATION_STAGES], zero[COLLOCATION_STAGES];
    collocation_through(o, p, x);
    collocation_through(o, zero, 0);
    w[0] = 1;
    for (int j = 0; j < o->s; j++) w[0] *= 1 - x / o->c[j];
    for (int j = 0; j < o->s; j++) w[j + 1] = p[j] - w[0] * zero[j];
}

void collocation_along(const struct collocation *o, double *w, double x)
{
    for (int j = 0; j <= o->s; j++) w[j] = 0;
    for (int k = 0; k < 3; k++) {
        double p[COLLOCATION_STAGES + 1];
        collocation_slope(o, p, x * gauss[k]);
        for (int j = 0; j <= o->s; j++) w[j] += x * weight[k] * p[j];
    }
}

static void widest(struct collocation *o)
{
    enum { PARTS = 1000 };
    double most = 0, integral = 0, largest = 0;
    for (int i = 0; i < PARTS; i++) {
        const double x = (i + .5) / PARTS;
        double product = x;
        for (int j = 0; j < o->s; j++) product *= x - o->c[j];
        integral += product / PARTS;
        if (fabs(integral) > largest) largest = fabs(integral);
        if (fabs(product) > most) {
            most = fabs(product);
            o->widest = x;
        }
    }
    o->share = largest / most;
}

/* A_ij, the j-th polynomial of Lagrange integrated from 0 to c_i: by Gauss's points. */
static void integrate(struct collocation *o)
{
    for (int i = 0; i < o->s; i++)
        for (int k = 0; k < 3; k++) {
            double w[COLLOCATION_STAGES];
            collocation_through(o, w, o->c[i] * gauss[k]);
            for (int j = 0; j < o->s; j++) o->A[i][j] += o->c[i] * weight[k] * w[j];
        }
    memcpy(o->b, o->A[o->s - 1], sizeof o->b);
}

/* The characteristic polynomial of A, z^s p(1/z) with p the denominator of the Pade approximation (s - 1, s) of exp(z)
 * (IV.3, (3.30)), and its zeros by the iteration of Durand and Kerner. */
static void eigenvalues(double complex *z, int s)
{
    double a[COLLOCATION_STAGES + 1] = {1};
    for (int m = 1; m <= s; m++) a[m] = -a[m - 1] * (s - m + 1) / (m * (2 * s - m));
    for (int i = 0; i < s; i++) z[i] = .2 * cpow(.4 + .9 * I, i);
    for (int round = 0; round < 200; round++)
        for (int i = 0; i < s; i++) {
            double complex value = 1, others = 1;
            for (int m = 1; m <= s; m++) value = value * z[i] + a[m];
            for (int k = 0; k < s; k++)
                if (k != i) others *= z[i] - z[k];
            z[i] -= value / others;
        }
}

/* A right (or left: rows) eigenvector by inverse iteration. */
static void eigenvector(double *re, double *im, const struct collocation *o, double complex z, int left)
{
    enum { N = COLLOCATION_STAGES };
    const int s = o->s;
    double Are[N * N], Aim[N * N];
    int swap[N];
    z *= 1 + 1e-9; /* not quite singular */
    for (int i = 0; i < s; i++)
        for (int j = 0; j < s; j++) {
            Are[i + j * s] = (left ? o->A[j][i] : o->A[i][j]) - (i == j ? creal(z) : 0);
            Aim[i + j * s] = i == j ? -cimag(z) : 0;
        }
    complex_lu(Are, Aim, swap, s);
    for (int i = 0; i < s; i++) re[i] = 1, im[i] = 0;
    for (int round = 0; round < 4; round++) {
        double most = 0;
        complex_lu_solve(Are, Aim, swap, re, im, s);
        for (int i = 0; i < s; i++) most = re[i] * re[i] + im[i] * im[i] > most ? re[i] * re[i] + im[i] * im[i] : most;
        for (int i = 0; i < s; i++) re[i] /= sqrt(most), im[i] /= sqrt(most);
    }
}

static void fill_mode(struct collocation_mode *m, const struct collocation *o, double complex z)
{
    double complex product = 0;
    m->re = creal(z);
    m->im = cimag(z);
    eigenvector(m->tre, m->tim, o, z, 0);
    eigenvector(m->lre, m->lim, o, z, 1);
    for (int i = 0; i < o->s; i++) product += (m->tre[i] + m->tim[i] * I) * (m->lre[i] + m->lim[i] * I);
    for (int i = 0; i < o->s; i++) {
        const double complex l = (m->lre[i] + m->lim[i] * I) / product;
        m->lre[i] = creal(l);
        m->lim[i] = cimag(l);
    }
}

void collocation_radau(struct collocation *o, int s)
{
    double complex z[COLLOCATION_STAGES];
    *o = (struct collocation){.s = s, .nmode = 1};
    memcpy(o->c, s == 3 ? points3 : points5, sizeof *o->c * (size_t)s);
    integrate(o);
    eigenvalues(z, s);
    for (int i = 0; i < s; i++) {
        const double im = cimag(z[i]), size = cabs(z[i]);
        if (im > 1e-6 * size) fill_mode(&o->mode[o->nmode++], o, z[i]);
        if (im <= 1e-6 * size && im >= -1e-6 * size) fill_mode(&o->mode[0], o, creal(z[i]));
    }
    collocation_through(o, o->d, 0);
    for (int i = 0; i < s; i++) o->d[i] *= -o->mode[0].re;
    widest(o);
}
