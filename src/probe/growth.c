/* growth.c -- see growth.h
 *
 * States are taken in units of like energy: q_i in 1/(w_i sqrt(M_ii)), v_i in 1/sqrt(M_ii), accelerations in
 * 1/(H sqrt(M_ii)), where w_i is the coordinate's local frequency, so that round-off is small beside 1 and a motion without
 * frequency is no more than a step's length.  Accelerations are taken as what they are off (2-4); where a scheme does not
 * look at them, or leaves none, their part of the matrix is dropped. */
#include "probe/growth.h"

#include <complex.h>
#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "la/dense.h"
#include "la/schur.h"

static const double LARGE = 1e6; /* of unit states, so that no iteration takes them for round-off */

struct probe {
    struct ode2 *ode;
    int n, parts;          /* of the state: q, v, a, carried */
    double *M, *K, *C, *L; /* L: factor of M */
    double *w, *m;         /* [n] local frequencies, roots of masses */
    double H;              /* major step */
};

static enum status probe_open(struct probe *o, struct ode2 *ode, double H, struct arena *life, struct trouble *why)
{
    const int n = ode->n;
    double *zero = TAKE(life, double, n);
    const struct instant x = {.q = zero, .v = zero};
    *o = (struct probe){.ode = ode, .n = n, .H = H};
    o->M = TAKE_MATRIX(life, double, n, n);
    o->K = TAKE_MATRIX(life, double, n, n);
    o->C = TAKE_MATRIX(life, double, n, n);
    o->L = TAKE_MATRIX(life, double, n, n);
    o->w = TAKE(life, double, n);
    o->m = TAKE(life, double, n);
    TRY(ode->ops->mass(ode, o->M, zero, 0, ALL, why));
    TRY(ode->ops->slopes(ode, o->K, o->C, &x, ALL, why));
    memcpy(o->L, o->M, sizeof *o->M * (size_t)n * (size_t)n);
    const int pivot = dense_cholesky(o->L, n, n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, 0);
    for (int i = 0; i < n; i++) {
        const double m = o->M[i + (long)n * i], k = o->K[i + (long)n * i];
        o->m[i] = sqrt(m);
        o->w[i] = fmax(sqrt(fabs(k) / m), 1 / H);
    }
    return OK;
}

/* a := -M^-1 (C v + K q) */
static void consistent(const struct probe *o, double *a, const double *q, const double *v)
{
    memset(a, 0, sizeof *a * (size_t)o->n);
    dense_gemv(a, -1, o->K, q, o->n, o->n, o->n);
    dense_gemv(a, -1, o->C, v, o->n, o->n, o->n);
    dense_cholesky_solve(o->L, a, o->n, o->n);
}

/* The unit of number i of part p. */
static double unit(const struct probe *o, int p, int i)
{
    return p == 0 ? 1 / (o->w[i] * o->m[i]) : p == 1 ? 1 / o->m[i] : 1 / (o->H * o->m[i]);
}

/* ---- the matrix ------------------------------------------------------------------------------------------------ */

struct trial {
    struct stepper stepper;
    struct state x;
    double h;
    int ratio;
    double *y; /* [parts n] */
};

/* y in units to the state, and back. */
static void put(const struct probe *o, struct trial *t, double *carried)
{
    const int n = o->n;
    for (int i = 0; i < n; i++) {
        t->x.q[i] = unit(o, 0, i) * t->y[i];
        t->x.v[i] = unit(o, 1, i) * t->y[n + i];
    }
    consistent(o, t->x.a, t->x.q, t->x.v);
    for (int i = 0; carried && i < n; i++) carried[i] = t->x.a[i] + unit(o, 3, i) * t->y[3 * n + i];
    for (int i = 0; i < n; i++) t->x.a[i] += unit(o, 2, i) * t->y[2 * n + i];
}

static void get(const struct probe *o, struct trial *t, double *column, const double *carried, double *a)
{
    const int n = o->n;
    consistent(o, a, t->x.q, t->x.v);
    for (int i = 0; i < n; i++) {
        column[i] = t->x.q[i] / unit(o, 0, i) / LARGE;
        column[n + i] = t->x.v[i] / unit(o, 1, i) / LARGE;
        column[2 * n + i] = (t->x.a[i] - a[i]) / unit(o, 2, i) / LARGE;
        if (carried) column[3 * n + i] = (carried[i] - a[i]) / unit(o, 3, i) / LARGE;
    }
}

/* Column j [parts n] of the matrix, those before it known.  What is carried gives an iteration no measure of the motion:
 * it goes with accelerations, whose part is taken off. */
static enum status column(const struct probe *o, struct trial *t, double *to, int j, double *a, struct trouble *why)
{
    struct stepper *s = &t->stepper;
    memset(t->y, 0, sizeof *t->y * (size_t)(o->parts * o->n));
    t->y[j] = LARGE;
    if (j >= 3 * o->n) t->y[j - o->n] = LARGE;
    t->x.t = 0;
    s->fresh = 1;
    put(o, t, o->parts > 3 ? s->kind->carried(s, t->h, true) : NULL);
    TRY(s->kind->step(s, &t->x, t->h, t->ratio, t->h * t->ratio, why));
    get(o, t, to, o->parts > 3 ? s->kind->carried(s, t->h, false) : NULL, a);
    for (int i = 0; j >= 3 * o->n && i < o->parts * o->n; i++) to[i] -= to[i - (long)o->parts * o->n * o->n];
    for (int i = 0; i < o->parts * o->n; i++)
        if (!isfinite(to[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i % o->n, to[i], t->x.t);
    return OK;
}

/* Rows and columns of numbers that nothing follows from, or that nothing leaves: kept [size] := which are not.  Twice:
 * what is dropped may have been all that followed from another. */
static int keep(int *kept, const double *A, int size)
{
    static const double nothing = 1e-9;
    int count = size;
    for (int i = 0; i < size; i++) kept[i] = i;
    for (int pass = 0; pass < 2; pass++) {
        int left = 0;
        for (int k = 0; k < count; k++) {
            double row = 0, col = 0;
            for (int l = 0; l < count; l++) {
                row = fmax(row, fabs(A[kept[k] + (long)size * kept[l]]));
                col = fmax(col, fabs(A[kept[l] + (long)size * kept[k]]));
            }
            if (row > nothing && col > nothing) kept[left++] = kept[k];
        }
        count = left;
    }
    return count;
}

/* The coordinate of most energy in x of the kept numbers. */
static int most_moved(const struct probe *o, const double complex *x, const int *kept, int count)
{
    double *energy = NULL, top = -1;
    int most = 0;
    struct arena *scratch = arena_open();
    energy = TAKE(scratch, double, o->n);
    for (int k = 0; k < count; k++)
        if (kept[k] < 2 * o->n) energy[kept[k] % o->n] += creal(x[k] * conj(x[k]));
    for (int i = 0; i < o->n; i++)
        if (energy[i] > top) top = energy[i], most = i;
    arena_close(scratch);
    return most;
}

static enum status spectrum(struct growth *o, const struct probe *p, const double *A, int size, struct arena *life,
                            struct trouble *why)
{
    int *kept = TAKE(life, int, size), at = 0;
    const int count = keep(kept, A, size);
    double *B = TAKE_MATRIX(life, double, count, count);
    double complex *s = TAKE(life, double complex, count), *X = TAKE_MATRIX(life, double complex, count, count);
    *o = (struct growth){0};
    if (count == 0) return OK;
    for (int j = 0; j < count; j++)
        for (int i = 0; i < count; i++) B[i + (long)count * j] = A[kept[i] + (long)size * kept[j]];
    if (!schur_eigen(s, X, B, count, life)) return trouble_set(why, TROUBLE_NOT_FINITE, -1, NAN, 0);
    for (int j = 1; j < count; j++)
        if (cabs(s[j]) > cabs(s[at])) at = j;
    o->radius = cabs(s[at]);
    o->angle = fabs(carg(s[at]));
    o->most = most_moved(p, X + (long)count * at, kept, count);
    return OK;
}

static enum status find(struct growth *o, struct ode2 *linear, const struct stepper_kind *kind,
                        const struct step_options *options, double h, int ratio, struct arena *life,
                        struct trouble *why)
{
    struct probe p;
    struct trial t = {.h = h, .ratio = ratio};
    const int n = linear->n;
    TRY(probe_open(&p, linear, h * ratio, life, why));
    p.parts = kind->carried ? 4 : 3;
    const int size = p.parts * n;
    double *A = TAKE_MATRIX(life, double, size, size), *a = TAKE(life, double, n);
    stepper_open(&t.stepper, kind, linear, options, life);
    t.x = (struct state){0, TAKE(life, double, n), TAKE(life, double, n), TAKE(life, double, n)};
    t.y = TAKE(life, double, size);
    for (int j = 0; j < size; j++) {
        if (stop) return stop_status();
        TRY(column(&p, &t, A + (long)size * j, j, a, why));
    }
    return spectrum(o, &p, A, size, life, why);
}

/* The system is linear, and an iteration's second correction round-off, of more or less size: it is asked for what it
 * can give. */
enum status growth_find(struct growth *o, struct ode2 *linear, const struct stepper_kind *kind,
                        const struct step_options *options, double h, int ratio, struct trouble *why)
{
    static const double tolerance[] = {1e-12, 1e-9, 1e-6};
    enum status status = E_NUMERIC;
    struct step_options exact = *options;
    exact.tolerance = 0;
    for (size_t i = 0; i < sizeof tolerance / sizeof *tolerance && status == E_NUMERIC; i++) {
        struct arena *scratch = arena_open();
        exact.newton_tolerance = tolerance[i];
        status = find(o, linear, kind, &exact, h, ratio, scratch, why);
        arena_close(scratch);
        if (why->code != TROUBLE_DIVERGED) break;
    }
    return status;
}

/* ---- the motion itself ------------------------------------------------------------------------------------------ */

static double own(const struct probe *o, struct arena *life)
{
    static const double nothing = 1e-6; /* of the highest frequency: zero twice is found to the root of round-off */
    const int n = o->n, m = 2 * n;
    double *A = TAKE_MATRIX(life, double, m, m), *q = TAKE(life, double, n), *v = TAKE(life, double, n);
    double *a = TAKE(life, double, n), top = 0, most = 0;
    double complex *s = TAKE(life, double complex, m);
    for (int j = 0; j < m; j++) {
        double *x = j < n ? q : v;
        x[j % n] = unit(o, j / n, j % n);
        consistent(o, a, q, v);
        if (j >= n) A[j - n + (long)m * j] = x[j - n] / unit(o, 0, j - n);
        for (int i = 0; i < n; i++) A[n + i + (long)m * j] = a[i] / unit(o, 1, i);
        x[j % n] = 0;
    }
    if (!schur_eigen(s, NULL, A, m, life)) return NAN;
    for (int j = 0; j < m; j++) top = fmax(top, cabs(s[j]));
    for (int j = 0; j < m; j++)
        if (cabs(s[j]) > nothing * top && creal(s[j]) > 1e-9 * cabs(s[j])) most = fmax(most, creal(s[j]));
    return most;
}

double growth_own(struct ode2 *linear)
{
    struct arena *scratch = arena_open();
    struct probe p;
    struct trouble why;
    double slowest = 0, found = NAN;
    if (probe_open(&p, linear, INFINITY, scratch, &why) == OK) {
        for (int i = 0; i < p.n; i++) slowest = fmax(slowest, 1e-3 * p.w[i]);
        for (int i = 0; i < p.n; i++) p.w[i] = fmax(p.w[i], slowest > 0 ? slowest : 1);
        found = own(&p, scratch);
    }
    arena_close(scratch);
    return found;
}
