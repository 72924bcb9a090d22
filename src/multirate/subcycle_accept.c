/* subcycle_accept.c -- a major step whose iteration has converged: the energy that its damping took (S10), its end
 * (S9), and what the next step begins from. */
#include <math.h>

#include "base/scalar.h"
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

/* Energy taken by the damping: sum of (d' M~_SS A d + dx' D dx)/2 (S10). */
static double damped(struct subcycle *c)
{
    int ns = c->ns;
    double sum = 0;
    if (c->alpha <= 0) return 0;
    copy(c->vs, c->v0, ns);
    for (int k = 0; k < c->ratio; k++) {
        const double *d = c->d + (long)k * ns;
        subcycle_fast_velocity(c, d);
        for (int i = 0; i < ns; i++) c->dx[i] = c->h * c->v[i];
        zero(c->s1, ns);
        zero(c->s2, ns);
        zero(c->s3, ns);
        dense_gemv(c->s1, 1, c->resp.A, d, ns, ns, ns);
        dense_gemv(c->s2, 1, c->dec.Mss, d, ns, ns, ns);
        dense_gemv(c->s3, 1, c->resp.D, c->dx, ns, ns, ns);
        sum += dot(c->s1, c->s2, ns) + dot(c->s3, c->dx, ns);
        for (int i = 0; i < ns; i++) c->vs[i] += d[i];
    }
    return sum / 2;
}

/* For the forecast of the next step.  After subcycle_compose(), when c->v is that of the last minor step. */
static void remember(struct subcycle *c)
{
    for (int i = 0; i < c->ns; i++) c->dx[i] = c->h * c->v[i];
    const struct found x = {c->h, c->H, c->ratio, c->d, c->du, c->w, c->dx, c->xn};
    c->last_local = forecast_error(&c->forecast, &x, c->newton.per);
    forecast_keep(&c->forecast, &c->resp, &x);
}

/* Corrects the end so that mechanisms that float freely under gravity alone keep their momenta (settle() of ode2.h). */
static enum status settle(struct subcycle *c, const struct state *x, struct trouble *why)
{
    const struct instant whole = {
        .t = c->t1, .q = c->qn, .v = c->v, .qa = x->q, .qb = c->qn, .va = x->v, .vb = c->v, .ta = c->t0, .tb = c->t1};
    return c->ode->settle ? c->ode->settle(c->ode, c->qn, c->v, &whole, why) : OK;
}

/* q_n cannot be closed: says why. */
static enum status no_end(struct subcycle *c, struct trouble *why)
{
    const struct instant end = {.t = c->t1, .q = c->qn, .v = c->v0, .ta = c->t1, .tb = c->t1};
    return c->ode->ops->resid(c->ode, c->r, NULL, NULL, &end, ALL, why);
}

enum status subcycle_accept(struct subcycle *c, struct stepper *s, struct state *x, struct trouble *why)
{
    int n = c->n;
    double per = 1 / c->H;
    s->lost = damped(c);
    s->left = fabs(c->push) * fmin(1, c->newton.remain);
    copy(s->work, c->work, POWER_CHANNELS);
    subcycle_compose(c);
    if (c->direct) subcycle_end(c);
    if (isnan(c->qn[0])) return no_end(c, why);
    remember(c);
    decouple_solved(&c->dec, c->newton.count, c->newton.worst, newton_contraction(&c->newton));
    subcycle_resolve(c, s);
    subcycle_last_keep(c);
    if (c->looked) subcycle_error_measure(c, s->missed != NULL);
    vector_move(c->u0, c->u0, 1, c->du, c->nl);
    decouple_out(&c->dec, c->v, c->u0, c->vs, c->nl);
    for (int i = 0; i < n; i++) c->abar[i] = per * (c->v[i] - x->v[i]);
    TRY(settle(c, x, why));
    copy(x->a, c->abar, n);
    copy(x->v, c->v, n);
    copy(x->q, c->qn, c->ode->nq);
    x->t = c->t1;
    newton_scale(&c->newton, x->v, x->a, c->H);
    s->effort.minors += c->ratio;
    return OK;
}
