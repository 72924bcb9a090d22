/* body.c -- see body.h */
#include "reduce/body.h"

#include <math.h>
#include <string.h>

#include "la/vec3.h"

/* O [9] += int a b' dm from a [3 x n] and M b [3 x n]. */
static void product(double *O, const double *a, const double *Mb, int n)
{
    for (int i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            for (int r = 0; r < 3; r++) O[r + 3 * c] += a[3 * i + r] * Mb[3 * i + c];
}

static void integrals(struct flex_body *o, const struct fe *fe, const struct basis *b, struct arena *scratch)
{
    double *x = TAKE(scratch, double, b->size), *Mx = TAKE(scratch, double, b->size);
    for (int i = 0; i < fe->n; i++) v3_diff(x + 3 * i, fe->x + 3 * i, fe->centre);
    sparse_mul(Mx, &fe->M, x);
    product(o->xx, x, Mx, fe->n);
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < c; r++) o->xx[r + 3 * c] = o->xx[c + 3 * r] = (o->xx[r + 3 * c] + o->xx[c + 3 * r]) / 2;
    for (int j = 0; j < b->n; j++) {
        const double *Mphi = b->MV + (size_t)j * (size_t)b->size;
        for (int i = 0; i < fe->n; i++) v3_add(o->f + 3 * j, Mphi + 3 * i);
        product(o->xf + 9 * j, x, Mphi, fe->n);
        for (int i = 0; i < b->n; i++)
            product(o->ff + 9 * (i + b->n * j), b->V + (size_t)i * (size_t)b->size, Mphi, fe->n);
    }
}

/* ff_ji = ff_ij' to the bit. */
static void symmetrise(double *ff, int n)
{
    for (int j = 0; j < n; j++)
        for (int i = 0; i <= j; i++)
            for (int k = 0; k < 9; k++) {
                double *a = ff + 9 * (i + n * j) + k, *b = ff + 9 * (j + n * i) + k / 3 + 3 * (k % 3);
                *a = *b = (*a + *b) / 2;
            }
}

static void node(struct flex_node *o, const struct fe *fe, const struct basis *b, const struct tie *tie, bool reference)
{
    o->name = tie->name;
    v3_diff(o->x, tie->x, fe->centre);
    for (int j = 0; !reference && j < b->n; j++) {
        double m[6];
        tie_motion(m, tie, b->V + (size_t)j * (size_t)b->size);
        v3_copy(o->phi + 3 * j, m);
        v3_copy(o->psi + 3 * j, m + 3);
    }
}

static void stiffness(struct flex_body *o, const struct basis *b, const struct body_damping *d)
{
    for (int j = 0; j < b->n; j++) {
        double omega = sqrt(b->lambda[j]);
        o->K[j + b->n * j] = b->lambda[j];
        o->hertz[j] = omega / 6.28318530717958647693;
        if (o->D) o->D[j + b->n * j] = 2 * d->zeta * omega + d->alpha + d->beta * b->lambda[j];
    }
}

struct flex_body *body_make(const struct fe *fe, const struct basis *basis, const struct tie *tie, int ntie,
                            int nstress, bool stiffening, const struct body_damping *damping, struct arena *life)
{
    struct arena *scratch = arena_open();
    struct flex_body *o = flex_body_take(basis->n, ntie, nstress, stiffening, life);
    bool damped = damping->zeta != 0 || damping->alpha != 0 || damping->beta != 0;
    o->mass = fe->mass;
    o->reference = 0;
    if (!damped) o->D = NULL;
    for (int i = 0; i < nstress; i++) o->stress[i].axial = o->stress[i].bending = NULL;
    integrals(o, fe, basis, scratch);
    symmetrise(o->ff, basis->n);
    stiffness(o, basis, damping);
    for (int t = 0; t < ntie; t++) node(o->node + t, fe, basis, tie + t, t == 0);
    arena_close(scratch);
    return o;
}
