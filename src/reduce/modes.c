/* modes.c -- see modes.h */
#include "reduce/modes.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "reduce/lapack.h"

enum { MOST_RESTARTS = 3000 };

/* The Lanczos process between its calls. */
struct lanczos {
    int n, nev, ncv, lworkl, info, ido;
    int iparam[11], ipntr[14];
    double tol;
    double *resid, *v, *workd, *workl;
};

static void take(struct lanczos *o, int n, int nev, int most, struct arena *scratch)
{
    int ncv = 2 * nev + 10;
    if (ncv > most) ncv = most;
    *o = (struct lanczos){.n = n, .nev = nev, .ncv = ncv, .lworkl = ncv * (ncv + 8), .info = 1};
    o->iparam[0] = 1; /* exact shifts */
    o->iparam[2] = MOST_RESTARTS;
    o->iparam[6] = 3; /* shift and invert */
    o->resid = TAKE(scratch, double, n);
    o->v = TAKE(scratch, double, (size_t)n *(size_t)ncv);
    o->workd = TAKE(scratch, double, 3 * (size_t)n);
    o->workl = TAKE(scratch, double, o->lworkl);
}

/* The same numbers everywhere: a linear congruential sequence (Knuth's MMIX). */
static void start(struct lanczos *o)
{
    uint64_t state = 1;
    for (int i = 0; i < o->n; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        o->resid[i] = (double)(state >> 11) * 0x1p-53 * 2 - 1;
    }
}

/* What the process asks for: y = K^-1 M x, or M x. */
static void answer(struct lanczos *o, const struct hold *hold)
{
    double *x = o->workd + o->ipntr[0] - 1, *y = o->workd + o->ipntr[1] - 1;
    if (o->ido == 2) {
        sparse_mul(y, &hold->fe->M, x);
        return;
    }
    if (o->ido == 1)
        memcpy(y, o->workd + o->ipntr[2] - 1, (size_t)o->n * sizeof *y); /* M x is there already */
    else
        sparse_mul(y, &hold->fe->M, x);
    hold_solve(y, hold, y);
}

static enum status iterate(struct lanczos *o, const struct hold *hold, struct report *report)
{
    do {
        dsaupd_(&o->ido, "G", &o->n, "LM", &o->nev, &o->tol, o->resid, &o->ncv, o->v, &o->n, o->iparam, o->ipntr,
                o->workd, o->workl, &o->lworkl, &o->info, 1, 2);
        if (abs(o->ido) == 1 || o->ido == 2) answer(o, hold);
    } while (o->ido != 99);
    if (o->info == 0) return OK;
    return fail(report, E_NUMERIC, "the eigenmodes do not converge: dsaupd %d, %d of %d modes after %d restarts",
                o->info, o->iparam[4], o->nev, o->iparam[2]);
}

static enum status extract(double *lambda, double *X, struct lanczos *o, struct arena *scratch, struct report *report)
{
    const int yes = 1;
    const double zero = 0;
    int *select = TAKE(scratch, int, o->ncv);
    dseupd_(&yes, "A", select, lambda, X, &o->n, &zero, "G", &o->n, "LM", &o->nev, &o->tol, o->resid, &o->ncv, o->v,
            &o->n, o->iparam, o->ipntr, o->workd, o->workl, &o->lworkl, &o->info, 1, 1, 2);
    if (o->info == 0) return OK;
    return fail(report, E_NUMERIC, "the eigenmodes cannot be extracted: dseupd %d", o->info);
}

/* Ascending, by insertion. */
static void sort(double *lambda, double *X, int n, int count, double *keep)
{
    size_t bytes = (size_t)n * sizeof *X;
    for (int i = 1; i < count; i++)
        for (int j = i; j > 0 && lambda[j - 1] > lambda[j]; j--) {
            double *a = X + (size_t)(j - 1) * (size_t)n, *b = a + n, l = lambda[j];
            lambda[j] = lambda[j - 1];
            lambda[j - 1] = l;
            memcpy(keep, a, bytes);
            memcpy(a, b, bytes);
            memcpy(b, keep, bytes);
        }
}

/* |K x - lambda M x| against |K x|, at free freedoms only: held ones and constraints carry reactions, which a solve
 * takes away. */
static enum status check(const double *lambda, const double *X, const struct hold *hold, int count,
                         struct arena *scratch, struct report *report)
{
    int n = hold->size;
    double *r = TAKE(scratch, double, n);
    for (int j = 0; j < count; j++) {
        const double *x = X + (size_t)j * (size_t)n;
        double off = 0, most = 0;
        sparse_mul(r, &hold->fe->M, x);
        hold_solve(r, hold, r);
        for (int i = 0; i < n; i++) {
            off = fmax(off, fabs(lambda[j] * r[i] - x[i]));
            most = fmax(most, fabs(x[i]));
        }
        if (!(lambda[j] > 0) || !(off <= 1e-7 * most))
            return fail(report, E_NUMERIC, "mode %d, %.6g Hz, misses its equation by %.3g", j + 1,
                        sqrt(fabs(lambda[j])) / 6.283185307179586, off / most);
    }
    return OK;
}

enum status modes_lowest(double *lambda, double *X, const struct hold *hold, int n, struct report *report)
{
    struct lanczos lanczos;
    if (n >= hold->freedom)
        return fail(report, E_MODEL, "%d modes are asked for, the held body has %d freedoms", n, hold->freedom);
    struct arena *scratch = arena_open();
    take(&lanczos, hold->size, n, hold->freedom, scratch);
    start(&lanczos);
    enum status status = iterate(&lanczos, hold, report);
    if (status == OK) status = extract(lambda, X, &lanczos, scratch, report);
    if (status == OK) {
        sort(lambda, X, hold->size, n, lanczos.resid);
        status = check(lambda, X, hold, n, scratch, report);
    }
    arena_close(scratch);
    return status;
}
