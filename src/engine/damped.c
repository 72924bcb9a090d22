/* damped.c -- the implicit midpoint rule with rho_infinity = rho below 1: what the step does not resolve is damped.
 *
 *     dx = h (v0 + B d/2),  v1 = v0 + d,  d = h a,      r(q0 (+) dx/2, dx/h, a, t0 + h/2) + D dx/2 = 0
 *     A = alpha (M^ + X)^-1 X,  X = (h^2/4) K,  D = K A,  B = 1 + A,      alpha = (1 - rho)/(1 + rho)
 *
 * with M^ and K, symmetrized, of the start of the step: (S3), (S6) and (S7) of multirate/subcycle.c with all coordinates
 * fast.  Its order stays 2.  As dx/h is what forces are multiplied by for their work, and M^ A and K A are symmetric, the
 * energy of a linear system falls by exactly what dampers take and
 *
 *     lost = (d' M^ A d + dx' D dx)/2 >= 0.
 *
 * A vibration of omega h = z = 2 sqrt(x) loses alpha z^4/8 of its size in a step, and is late by z^3/12 as without; of one
 * that is not resolved, B goes to 2/(1 + rho) and v1 to -rho v0.
 *
 * Newton for a with J = M^ + V B/2, V = h C + h^2/2 (K + D), formed with A and D for every step: those of another posture would
 * damp what moves slowly there. */
#include "base/scalar.h"
#include "engine/midpoint.h"
#include "la/dense.h"

struct damped {
    struct equations plain; /* without damping */
    double alpha;
    bool formed;       /* A, D and J for this step */
    double *A, *D, *M; /* [n x n], of the start of the step; all are taken with the first one */
    double *m, *K, *C, *J, *spare;
    int *swap; /* [n] */
    enum matrix_form form;
    double *d, *y; /* [n] */
};

/* ---- matrices ------------------------------------------------------------------------------------------------- */

static enum status need(struct damped *o, int n, struct implicit *m, struct trouble *why)
{
    double **square[] = {&o->A, &o->D, &o->M, &o->m, &o->K, &o->C, &o->J, &o->spare};
    for (size_t i = 0; i < sizeof square / sizeof *square; i++)
        TRY(matrix_need(square[i], n, n, m->J.J.life, m->x.ta, why));
    return OK;
}

/* A and D of M and K. */
static enum status damping(struct damped *o, double h, int n, double t, struct trouble *why)
{
    const double s = h * h / 8;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            o->A[i + j * n] = s * (o->K[i + j * n] + o->K[j + i * n]);
            o->spare[i + j * n] = o->M[i + j * n] + o->A[i + j * n];
        }
    const int pivot = dense_cholesky(o->spare, n, n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_SINGULAR, pivot, 0, t);
    dense_cholesky_solves(o->spare, o->A, n, n, n, n);
    for (int i = 0; i < n * n; i++) o->A[i] *= o->alpha;
    zero(o->D, n * n);
    dense_gemm(o->D, .5, o->K, o->A, n, n, n, n, n, n);
    dense_gemtm(o->D, .5, o->K, o->A, n, n, n, n, n, n);
    return OK;
}

/* J of m, K, C, A and D, factored. */
static enum status factor(struct damped *o, double h, int n, double t, struct trouble *why)
{
    double *V = o->C;
    for (int i = 0; i < n * n; i++) {
        V[i] = h / 2 * V[i] + h * h / 4 * (o->K[i] + o->D[i]);
        o->J[i] = o->m[i] + V[i];
    }
    dense_gemm(o->J, 1, V, o->A, n, n, n, n, n, n);
    const int pivot = factor_dense(o->J, o->swap, o->spare, &o->form, n);
    return pivot < 0 ? OK : trouble_set(why, TROUBLE_SINGULAR, pivot, 0, t);
}

static enum status look(struct implicit *m, const struct instant *x, struct trouble *why)
{
    const struct damped *o = m->own;
    const struct ode2 *ode = m->ode;
    m->effort->slow++;
    m->effort->fast++;
    m->effort->factors++;
    TRY(ode->ops->slopes(ode, o->K, o->C, x, ALL, why));
    return ode->ops->mass(ode, o->m, x->q, x->t, ALL, why);
}

static enum status form(struct implicit *m, struct trouble *why)
{
    struct damped *o = m->own;
    const int n = m->ode->n;
    const double t = m->x.ta;
    const struct instant start = {.t = t, .q = m->q0, .v = m->v0, .a = m->a0, .ta = t, .tb = t};
    TRY(need(o, n, m, why));
    TRY(look(m, &start, why));
    copy(o->M, o->m, n * n);
    TRY(damping(o, m->h, n, t, why));
    TRY(factor(o, m->h, n, t, why));
    o->formed = true;
    return OK;
}

/* ---- the step ------------------------------------------------------------------------------------------------- */

static void begin(struct implicit *m)
{
    ((struct damped *)m->own)->formed = false;
}

static void rates(struct implicit *m, const double *a)
{
    const struct damped *o = m->own;
    const int n = m->ode->n;
    const double h = m->h;
    copy(o->y, a, n);
    dense_gemv(o->y, 1, o->A, a, n, n, n);
    for (int i = 0; i < n; i++) {
        m->v[i] = m->v0[i] + h / 2 * o->y[i];
        m->v1[i] = m->v0[i] + h * a[i];
        m->dx[i] = h * m->v[i];
    }
}

static enum status resid(void *self, double *r, double *dk, const double *z, struct trouble *why)
{
    struct implicit *m = self;
    const struct damped *o = m->own;
    const int n = m->ode->n;
    if (!o->formed) TRY(form(m, why));
    TRY(o->plain.resid(m, r, dk, z, why));
    dense_gemv(r, .5, o->D, m->dx, n, n, n);
    return OK;
}

/* J by what the iterate shows; A and D are the step's.  The first one has been formed with them. */
static enum status refresh(void *self, const double *z, struct trouble *why)
{
    struct implicit *m = self;
    struct damped *o = m->own;
    (void)z;
    if (m->newton.count == 0) return OK;
    TRY(look(m, &m->x, why));
    return factor(o, m->h, m->ode->n, m->x.t, why);
}

static void solve(void *self, double *dz, const double *r)
{
    const struct implicit *m = self;
    const struct damped *o = m->own;
    copy(dz, r, m->ode->n);
    solve_dense(o->J, o->swap, o->form, dz, m->ode->n);
}

static enum status accept(struct implicit *m, struct stepper *s, struct trouble *why)
{
    const struct damped *o = m->own;
    const int n = m->ode->n;
    (void)why;
    for (int i = 0; i < n; i++) o->d[i] = m->h * m->z[i];
    zero(o->y, n);
    dense_gemv(o->y, .5, o->A, o->d, n, n, n);
    zero(m->hs, n);
    dense_gemv(m->hs, 1, o->M, o->y, n, n, n);
    s->lost += dot(o->d, m->hs, n);
    zero(o->y, n);
    dense_gemv(o->y, .5, o->D, m->dx, n, n, n);
    s->lost += dot(o->y, m->dx, n);
    return OK;
}

static void open(struct implicit *m, struct arena *life)
{
    struct damped *o = m->own = TAKE(life, struct damped, 1);
    const double rho = m->options->rho_infinity;
    o->plain = m->equations;
    o->alpha = (1 - rho) / (1 + rho);
    o->swap = TAKE(life, int, m->ode->n);
    o->d = TAKE(life, double, m->ode->n);
    o->y = TAKE(life, double, m->ode->n);
    m->equations = (struct equations){m, &m->x, resid, refresh, solve, NULL};
}

const struct implicit_scheme midpoint_damped = {
    .middle = true, .begin = begin, .rates = rates, .open = open, .accept = accept};
