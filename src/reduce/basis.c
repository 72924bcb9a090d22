/* basis.c -- see basis.h */
#include "reduce/basis.h"

#include <math.h>
#include <string.h>

#include "la/eigen.h"
#include "reduce/loads.h"
#include "reduce/modes.h"

static const double two_pi = 6.28318530717958647693;

static double dot(const double *a, const double *b, int n)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* The modes of the held body into V [size x modes]; one more is looked at, to tell what is left out. */
static enum status held_modes(struct basis *o, double *V, const struct hold *hold, int modes, struct arena *scratch,
                              struct report *report)
{
    int wanted = modes + 1 < hold->freedom ? modes + 1 : modes;
    o->fixed = modes;
    if (!modes) return OK;
    double *lambda = TAKE(scratch, double, wanted), *X = TAKE(scratch, double, (size_t)wanted *(size_t)o->size);
    TRY(modes_lowest(lambda, X, hold, wanted, report));
    memcpy(V, X, (size_t)modes * (size_t)o->size * sizeof *V);
    o->last = sqrt(lambda[modes - 1]) / two_pi;
    if (wanted > modes) o->next = sqrt(lambda[modes]) / two_pi;
    return OK;
}

/* Every static motion of every tie but the reference; returns how many. */
static int static_modes(double *V, const struct hold *hold, const struct tie *tie, int ntie)
{
    int n = 0;
    for (int t = 1; t < ntie; t++)
        for (int k = 0; k < tie[t].motions; k++) {
            if (V) hold_static(V + (size_t)n * (size_t)hold->size, hold, tie + t, k);
            n++;
        }
    return n;
}

/* The largest entry is positive; of entries as large to 1e-6, the first: round-off must not choose. */
static void fix_sign(double *x, int n)
{
    double most = 0;
    int at = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(x[i]));
    while (at < n && fabs(x[at]) < (1 - 1e-6) * most) at++;
    if (at < n && x[at] < 0)
        for (int i = 0; i < n; i++) x[i] = -x[i];
}

/* Fields of like size first: a turn and a shift differ by a length. */
static void scale_columns(struct basis *o, const struct fe *fe)
{
    for (int j = 0; j < o->n; j++) {
        double *v = o->V + (size_t)j * (size_t)o->size, *mv = o->MV + (size_t)j * (size_t)o->size;
        sparse_mul(mv, &fe->M, v);
        double s = 1 / sqrt(dot(v, mv, o->size));
        for (int i = 0; i < o->size; i++) v[i] *= s;
    }
}

/* K = V' K V, M = V' M V, symmetric to the bit; MV is made. */
static void project(double *K, double *M, struct basis *o, const struct fe *fe, double *Kv)
{
    int n = o->n;
    for (int j = 0; j < n; j++) {
        const double *v = o->V + (size_t)j * (size_t)o->size;
        double *mv = o->MV + (size_t)j * (size_t)o->size;
        sparse_mul(Kv, &fe->K, v);
        sparse_mul(mv, &fe->M, v);
        for (int i = 0; i <= j; i++) {
            const double *w = o->V + (size_t)i * (size_t)o->size;
            K[i + j * n] = K[j + i * n] = dot(w, Kv, o->size);
            M[i + j * n] = M[j + i * n] = dot(w, mv, o->size);
        }
    }
}

static enum status diagonalise(struct basis *o, const struct fe *fe, struct arena *scratch, struct report *report)
{
    int n = o->n;
    double *K = TAKE(scratch, double, n *n), *M = TAKE(scratch, double, n *n), *Y = TAKE(scratch, double, n *n);
    double *Kv = TAKE(scratch, double, o->size), *row = TAKE(scratch, double, n);
    scale_columns(o, fe);
    project(K, M, o, fe, Kv);
    int bad = eigen_general(o->lambda, Y, K, M, n);
    if (bad >= 0)
        return fail(report, E_MODEL, "mode %d of %d depends on those before it: take fewer modes", bad + 1, n);
    for (int i = 0; i < o->size; i++) {
        for (int j = 0; j < n; j++) {
            row[j] = 0;
            for (int k = 0; k < n; k++) row[j] += o->V[i + (size_t)k * (size_t)o->size] * Y[k + j * n];
        }
        for (int j = 0; j < n; j++) o->V[i + (size_t)j * (size_t)o->size] = row[j];
    }
    for (int j = 0; j < n; j++) {
        fix_sign(o->V + (size_t)j * (size_t)o->size, o->size);
        sparse_mul(o->MV + (size_t)j * (size_t)o->size, &fe->M, o->V + (size_t)j * (size_t)o->size);
        if (!(o->lambda[j] > 0))
            return fail(report, E_MODEL, "mode %d has no stiffness, %.3g / s2", j + 1, o->lambda[j]);
    }
    return OK;
}

/* u = K^-1 f of the loads wished for. */
static void load_modes(double *V, const struct hold *hold, const struct basis_options *options, struct arena *scratch)
{
    for (int k = 0; k < options->nload; k++) {
        double *v = V + (size_t)k * (size_t)hold->size;
        load_forces(v, hold->fe, options->load[k], scratch);
        hold_solve(v, hold, v);
    }
}

/* The fields one after another: static motions, modes, answers to loads. */
static enum status fields(struct basis *o, const struct hold *hold, const struct tie *tie, int nheld,
                          const struct basis_options *options, struct arena *scratch, struct arena *life,
                          struct report *report)
{
    int statics = static_modes(NULL, hold, tie, nheld);
    size_t size = (size_t)o->size;
    o->n = statics + options->modes + options->nload;
    if (!o->n) return fail(report, E_MODEL, "no modes: one interface, and --modes 0");
    o->V = TAKE(life, double, (size_t)o->n *size);
    o->MV = TAKE(life, double, (size_t)o->n *size);
    o->lambda = TAKE(life, double, o->n);
    static_modes(o->V, hold, tie, nheld);
    load_modes(o->V + (size_t)(statics + options->modes) * size, hold, options, scratch);
    return held_modes(o, o->V + (size_t)statics * size, hold, options->modes, scratch, report);
}

enum status basis_make(struct basis *o, const struct fe *fe, const struct tie *tie, int ntie,
                       const struct basis_options *options, struct arena *life, struct report *report)
{
    struct arena *scratch = arena_open();
    struct hold hold;
    const struct tie **held = TAKE(scratch, const struct tie *, ntie);
    int nheld = options->method == CRAIG_BAMPTON ? ntie : 1;
    for (int t = 0; t < nheld; t++) held[t] = tie + t;
    *o = (struct basis){.size = 3 * fe->n};
    enum status status = hold_make(&hold, fe, held, nheld, scratch, report);
    if (status == OK) status = fields(o, &hold, tie, nheld, options, scratch, life, report);
    if (status == OK) status = diagonalise(o, fe, scratch, report);
    arena_close(scratch);
    return status;
}
