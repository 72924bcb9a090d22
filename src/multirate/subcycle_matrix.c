/* subcycle_matrix.c -- what a major step forms at its start: W and u0 (S1), the damping A, D (S7), J of the minor
 * steps (S11), and the slow rows' matrix (S12).
 *
 * Slopes stay from step to step while the iteration contracts; W follows every step, and J and the matrix of the slow rows
 * where the masses have changed by as much as the iteration would feel. */
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

static enum status singular(const struct subcycle *c, int pivot, struct trouble *why)
{
    return trouble_set(why, TROUBLE_SINGULAR, pivot, 0, c->t0);
}

/* (S7) A = alpha (M~_SS + X)^-1 X and D = K~_SS A, both symmetrized: what the minor step does not resolve is damped. */
static enum status damping(struct subcycle *c, struct trouble *why)
{
    struct response *p = &c->resp;
    const double *K = p->one.K;
    double s = c->h * c->h / 8, *MX = p->dd; /* X = (h^2/4) K~, symmetrized */
    int n = c->n, ns = c->ns;
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++) {
            p->A[i + j * ns] = s * (K[i + j * n] + K[j + i * n]);
            MX[i + j * ns] = p->Mss[i + j * ns] + p->A[i + j * ns];
        }
    int pivot = dense_cholesky(MX, ns, ns);
    if (pivot >= 0) return singular(c, pivot, why);
    dense_cholesky_solves(MX, p->A, ns, ns, ns, ns);
    for (int i = 0; i < ns * ns; i++) p->A[i] *= c->alpha;
    zero(p->D, ns * ns);
    dense_gemm(p->D, .5, K, p->A, ns, ns, ns, ns, n, ns);
    dense_gemtm(p->D, .5, K, p->A, ns, ns, ns, ns, n, ns);
    return OK;
}

enum status subcycle_decouple(struct subcycle *c, const double *q, double t, enum others others, struct trouble *why)
{
    const long slow = c->effort->slow, fast = c->effort->fast;
    c->centre = (struct instant){.t = t, .q = q, .v = c->v0, .ta = t, .tb = t};
    TRY(decouple_at(&c->dec, &c->centre, others, why));
    subcycle_spent(c, SPENT_ON_MATRICES, slow, fast);
    copy(c->u0, c->v0 + c->ns, c->nl);
    decouple_recoil(&c->dec, c->u0, 1, c->v0);
    return OK;
}

/* The slow rows' matrix (S12); where the structure does not allow it, with M^ formed from now on. */
static enum status slow_matrix(struct subcycle *c, struct trouble *why)
{
    enum status status = response_slow(&c->resp, &c->dec, c->centre.q, c->centre.t, why);
    if (status == OK || !c->dec.structured) return status;
    decouple_dense(&c->dec);
    TRY(subcycle_decouple(c, c->centre.q, c->centre.t, ANEW, why));
    response_masses(&c->resp, &c->dec);
    return response_slow(&c->resp, &c->dec, c->centre.q, c->centre.t, why);
}

/* F = K_s/2 + C_s/H of the slow class, slow rows and columns. */
static void slow_force(struct subcycle *c, const double *K, const double *C)
{
    int n = c->n, ns = c->ns, nl = c->nl;
    for (int j = 0; j < nl; j++)
        for (int i = 0; i < nl; i++) {
            long at = (ns + i) + (long)(ns + j) * n;
            c->resp.F[i + j * nl] = K[at] / 2 + C[at] / c->H;
        }
}

/* K~ and C~ of the fast class at x: P' K P, P' C P. */
static enum status fast_slopes(struct subcycle *c, struct minor *m, const struct instant *x, struct trouble *why)
{
    TRY(c->ode->ops->slopes(c->ode, m->K, m->C, x, FAST, why));
    decouple_slopes(&c->dec, m->K, c->dec.ml);
    decouple_slopes(&c->dec, m->C, c->dec.ml);
    return OK;
}

bool subcycle_refresh_due(const struct subcycle *c)
{
    const bool changed = c->resp.h != c->h || c->resp.H != c->H || c->resp.ratio != c->ratio;
    return c->newton.stale || c->local || changed;
}

enum status subcycle_refresh(struct subcycle *c, struct trouble *why)
{
    struct response *p = &c->resp;
    struct minor *m = &p->one;
    struct instant x = {.t = c->t0, .q = c->q0, .v = c->v0, .a = c->a0, .ta = c->t0, .tb = c->t0};
    c->effort->factors++;
    decouple_failed(&c->dec);
    if (c->dec.lags) TRY(subcycle_decouple(c, c->centre.q, c->centre.t, ANEW, why));
    m->h = p->h = c->h;
    p->H = c->H;
    p->ratio = c->ratio;
    TRY(c->ode->ops->slopes(c->ode, m->K, m->C, &x, SLOW, why));
    slow_force(c, m->K, m->C);
    TRY(fast_slopes(c, m, &x, why));
    response_masses(p, &c->dec);
    if (c->alpha > 0) TRY(damping(c, why));
    int pivot = minor_factor(m);
    if (pivot >= 0) return singular(c, pivot, why);
    response_freeze(p, &c->dec);
    subcycle_resolve_refresh(c);
    TRY(slow_matrix(c, why));
    c->local = 0;
    newton_refreshed(&c->newton);
    c->newton.newest = true;
    return OK;
}

static enum status renew(struct subcycle *c, bool slow, struct trouble *why)
{
    slow |= response_lacks(&c->resp, &c->dec);
    if (response_masses(&c->resp, &c->dec)) {
        int pivot = minor_mass(&c->resp.one);
        if (pivot >= 0) return singular(c, pivot, why);
        if (slow) {
            c->effort->factors += response_factors(&c->resp, &c->dec);
            TRY(slow_matrix(c, why));
        }
    }
    return c->alpha > 0 ? damping(c, why) : OK;
}

enum status subcycle_renew(struct subcycle *c, struct trouble *why)
{
    return renew(c, true, why);
}

enum status subcycle_renew_fast(struct subcycle *c, struct trouble *why)
{
    return renew(c, false, why);
}

enum status subcycle_refresh_here(struct subcycle *c, const struct instant *x, struct trouble *why)
{
    c->effort->factors++;
    c->here.h = c->h;
    TRY(fast_slopes(c, &c->here, x, why));
    int pivot = minor_factor(&c->here);
    if (pivot >= 0) return singular(c, pivot, why);
    c->local = 1;
    return OK;
}
