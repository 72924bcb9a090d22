/* subcycle_slow.c -- slow bodies, once a sweep (S5); the slow rows R = 0 (S8) and the correction of du, which takes
 * all d_k along by their linearized answer (S11), (S12). */
#include <math.h>

#include "la/dense.h"
#include "multirate/subcycle_parts.h"

/* qbar, vbar, abar of (S5), from q_n, and their time. */
static double slow_place(struct subcycle *c)
{
    double per = 1 / c->H, mid = subcycle_middle(c);
    decouple_out(&c->dec, c->abar, c->du, c->dsum, c->nl);
    vector_times(c->vbar, per, c->dq, c->n);
    vector_times(c->abar, per, c->abar, c->n);
    return mid;
}

enum status subcycle_slow_bodies(struct subcycle *c, struct trouble *why)
{
    int ns = c->ns, nl = c->nl;
    double power[POWER_CHANNELS], dk = 0, per = 1 / c->H, mid = slow_place(c);
    struct instant x = {
        .t = mid, .q = c->qbar, .v = c->vbar, .a = c->abar, .qa = c->q0, .qb = c->qn, .ta = c->t0, .tb = c->t1};
    TRY(c->ode->ops->resid(c->ode, c->r, power, &dk, &x, SLOW, why));
    c->effort->slow++;
    sharpened(&dk);
    if (dk > STALE_SLOPE) c->newton.stale = 1;
    subcycle_book(c, c->H, power);
    vector_times(c->slow, c->H, c->r + ns, nl);
    vector_times(c->pull, per, c->du, c->near);
    for (int i = 0; i < ns; i++) c->dmean[i] = c->dsum[i] / c->ratio;
    zero(c->cs, ns);
    if (c->dec.reach) dense_gemtv(c->cs, -1. / c->ratio, c->dec.W, c->slow, c->dec.reach, ns, nl);
    return OK;
}

/* R complete: slow bodies over the whole step; their inertia where d_k has moved on since they were asked
 * (dsum holds the difference); the last corrections of the minor steps. */
static void complete(struct subcycle *c)
{
    int ns = c->ns, nl = c->nl, ml = c->dec.ml;
    for (int i = ml; i < nl; i++) c->R[i] = 0;
    if (c->dec.reach) gemv_few(c->R, 1, c->dec.MsW, c->dsum, ml, ns, ml);
    vector_move(c->R, c->R, 1, c->slow, nl);
    double push = c->push;
    for (int i = 0; i < nl; i++) push += c->R[i] * c->w[i];
    c->push = push;
    if (c->resp.drives) dense_gemv(c->R, -1, c->resp.Q, c->esum, ml, ns, ml);
}

/* du corrected, and all d_k with it. */
static void correct(struct subcycle *c)
{
    int ns = c->ns, nl = c->nl;
    for (int i = 0; i < ns; i++) c->s1[i] = c->coarse.on ? 0 : c->xn[i] - c->xbefore[i];
    response_correct(&c->resp, &c->dec, c->Du, c->moved, c->R, c->s1);
    c->square += fabs(dot(c->R, c->Du, nl));
    vector_move(c->du, c->du, 1, c->Du, nl);
    if (!c->resp.drives && !c->coarse.on) return;
    if (c->coarse.on) vector_move(c->coarse.left, c->coarse.left, 1, c->moved, 2 * ns);
    const struct powers rest =
        c->coarse.on ? (struct powers){c->coarse.left, COARSE_POINTS} : (struct powers){c->moved, 2};
    zero(c->s1, ns);
    zero(c->s2, ns);
    response_run(&c->resp, c->d, &rest, c->s1, c->s2, c->s3, 1);
}

void subcycle_slow_rows(struct subcycle *c)
{
    complete(c);
    correct(c);
}
