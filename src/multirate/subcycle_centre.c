/* subcycle_centre.c -- where W is formed: at the start of the major step or, `symmetric`, at the average of both ends.
 *
 * The end is not known when W is formed.  `symmetric` alone solves the step twice, with W at its start and then at the
 * average of the ends found.  A stage of a step of order 4 has the place foreseen with the W of the stage before, which takes no
 * evaluation, and moved between sweeps where these show that the average lies elsewhere: half the evaluations. */
#include <math.h>

#include "base/scalar.h"
#include "multirate/subcycle_parts.h"

/* How far the place of a stage may lie beside the average, of the largest displacement in a step.  What W brings into
 * errors is of third order itself, and a place off by p makes them differ back in time by p of that.  Over 20000 steps of
 * t-subcycle's chain with H = 0.1 s order 4 drifts by 2.5e-6 of its energy; by 5e-5 with .03, which takes 7 percent less for
 * decks/satellite-instrument, and by 1.4e-8 where each stage is solved twice. */
static const double BESIDE = 1e-3;

/* M_LL that lags may cost a sweep more: one evaluation of the slow bodies and, in such evaluations, at most DEAR of the fast
 * ones. */
static const double DEAR = 2;

/* W at qbar, which is at the time t; what the step has found stays. */
static enum status move(struct subcycle *c, double t, struct trouble *why)
{
    copy(c->qcentre, c->qbar, c->ode->nq);
    decouple_recoil(&c->dec, c->du, -1, c->dsum);
    const enum others others = response_factors(&c->resp, &c->dec) ? LEFT : WHERE_FAR; /* it has a factor of its own */
    TRY(subcycle_decouple(c, c->qcentre, t, others, why));
    decouple_recoil(&c->dec, c->du, 1, c->dsum);
    return OK;
}

/* qbar of the step that begins, by W, slopes and forces of the one before it; false: there was none of its kind. */
static bool foreseen(struct subcycle *c, double *t)
{
    const struct response *p = &c->resp;
    if (c->last.h != c->h || p->h != c->h || p->H != c->H || p->ratio != c->ratio || c->dec.reach == 0) return false;
    copy(c->u0, c->v0 + c->ns, c->nl);
    decouple_recoil(&c->dec, c->u0, 1, c->v0);
    forecast_make(&c->forecast, p, c->du, c->d, c->u0, c->v0);
    subcycle_compose(c);
    c->ended = false;
    *t = subcycle_middle(c);
    for (int i = 0; i < c->ode->nq; i++)
        if (!isfinite(c->qbar[i])) return false;
    return true;
}

enum status subcycle_centre(struct subcycle *c, const struct step_options *options, bool fresh, struct trouble *why)
{
    double t = c->t0;
    const bool ahead = options->stage && !fresh && foreseen(c, &t);
    if (ahead) copy(c->qcentre, c->qbar, c->ode->nq);
    const bool anew = fresh || subcycle_refresh_due(c) || c->ratio * c->dec.limbs > DEAR;
    TRY(subcycle_decouple(c, ahead ? c->qcentre : c->q0, ahead ? t : c->t0, anew ? ANEW : WHERE_FAR, why));
    const bool recoils = c->dec.reach > 0 || c->alpha > 0; /* else W is nothing at either end */
    c->follows = options->symmetric && recoils && options->stage;
    c->again = options->symmetric && recoils && !options->stage;
    return OK;
}

enum status subcycle_follow(struct subcycle *c, bool *moved, struct trouble *why)
{
    double beside = 0;
    *moved = false;
    if (!c->follows || c->newton.count == 0) return OK;
    const double t = subcycle_middle(c);
    motion_diff(c->ode, c->dq, c->qbar, c->centre.q);
    for (int i = 0; i < c->n; i++) beside = larger(beside, fabs(c->dq[i]) * c->newton.per[i]);
    *moved = beside > BESIDE * fabs(c->H);
    if (!*moved) return OK;
    TRY(move(c, t, why));
    TRY(subcycle_renew_fast(c, why));
    subcycle_compose(c);
    return OK;
}

enum status subcycle_centre_again(struct subcycle *c, struct trouble *why)
{
    subcycle_compose(c);
    const double t = subcycle_middle(c);
    TRY(move(c, t, why));
    return subcycle_renew(c, why);
}
