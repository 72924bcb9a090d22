/* fe_check.c -- see fe_check.h */
#include "reduce/fe_check.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"
#include "reduce/factor.h"
#include "reduce/rigid.h"

static double entry(const struct sparse *A, int i, int j)
{
    const double *at = sparse_at(A, i, j);
    return at ? *at : 0;
}

/* Within 1e-9 of the matrix's scale. */
static enum status check_blocks(const struct fe *o, const char *path, struct arena *life, struct report *report)
{
    double scale = 0;
    for (int i = 0; i < o->M.n; i++) scale = fmax(scale, fabs(entry(&o->M, i, i)));
    for (int i = 0; i < o->M.n; i++)
        for (size_t k = o->M.row[i]; k < o->M.row[i + 1]; k++) {
            int j = o->M.col[k], I = i - i % 3, J = j - j % 3;
            double want = i % 3 == j % 3 ? entry(&o->M, I, J) : 0;
            if (fabs(o->M.v[k] - want) <= 1e-9 * scale) continue;
            return fail(report, E_MODEL,
                        "%s: error: the mass between %s and %s is %.6g, not %.6g: a mass matrix of solids has the same "
                        "mass along x, y and z and none across",
                        path, fe_freedom(o, i, life), fe_freedom(o, j, life), o->M.v[k], want);
        }
    return OK;
}

/* No motion has negative kinetic energy: M + 1e-10 max M_ii has a Cholesky factor.  (Masses of reduced integration are
 * singular, to round-off.) */
static enum status check_definite(const struct fe *o, const char *path, struct arena *life, struct report *report)
{
    struct arena *scratch = arena_open();
    struct factor band;
    double most = 0;
    int bad = -1;
    for (int i = 0; i < o->M.n; i++) most = fmax(most, entry(&o->M, i, i));
    enum status status = factor_make(&band, &bad, &o->M, TAKE(scratch, bool, o->M.n), 1e-10 * most, scratch, report);
    arena_close(scratch);
    TRY(status);
    if (bad < 0) return OK;
    return fail(report, E_MODEL, "%s: error: the mass matrix is not positive, at %s", path, fe_freedom(o, bad, life));
}

enum status fe_check_mass(struct fe *o, const char *path, struct arena *life, struct report *report)
{
    double *one = TAKE(life, double, o->n), *m = TAKE(life, double, o->n);
    TRY(check_blocks(o, path, life, report));
    for (int i = 0; i < o->n; i++) one[i] = 1;
    fe_mass_scalar(m, o, one);
    for (int i = 0; i < o->n; i++) {
        o->mass += m[i];
        v3_axpy(o->centre, m[i], o->x + 3 * i);
    }
    if (!(o->mass > 0)) return fail(report, E_MODEL, "%s: error: the whole mass is %.6g", path, o->mass);
    TRY(check_definite(o, path, life, report));
    v3_scale(o->centre, 1 / o->mass, o->centre);
    for (int i = 0; i < o->n; i++) {
        double d[3];
        v3_diff(d, o->x + 3 * i, o->centre);
        o->size = fmax(o->size, v3_norm(d));
    }
    return OK;
}

/* |A| |x|, the sum of what cancels. */
static double worst_sum(const struct sparse *A, const double *x)
{
    double worst = 0;
    for (int i = 0; i < A->n; i++) {
        double sum = 0;
        for (size_t k = A->row[i]; k < A->row[i + 1]; k++) sum += fabs(A->v[k] * x[A->col[k]]);
        worst = fmax(worst, sum);
    }
    return worst;
}

enum status fe_check_stiffness(const struct fe *o, const char *path, struct arena *life, struct report *report)
{
    static const char *const names[] = {"moved along x",  "moved along y",  "moved along z",
                                        "turned about x", "turned about y", "turned about z"};
    double *r = TAKE(life, double, o->K.n), *f = TAKE(life, double, o->K.n);
    for (int k = 0; k < 6; k++) {
        rigid_motion(r, o, o->centre, k);
        sparse_mul(f, &o->K, r);
        double scale = worst_sum(&o->K, r);
        int worst = 0;
        for (int i = 0; i < o->K.n; i++)
            if (fabs(f[i]) > fabs(f[worst])) worst = i;
        if (fabs(f[worst]) <= 1e-5 * scale) continue;
        return fail(report, E_MODEL,
                    "%s: error: %s as a rigid body it pushes back, most at %s (%.3g of the stiffness there): store the "
                    "matrices of the free body, and give the mesh they were made from",
                    path, names[k], fe_freedom(o, worst, life), fabs(f[worst]) / scale);
    }
    return OK;
}
