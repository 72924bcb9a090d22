/* subcycle.c -- energy-consistent, inertially decoupled sub-cycling
 *
 * Slow coordinates L take major steps H = n h, fast ones S minor steps h.  With W and P of decouple.h
 * from M^ at the start of the step, q = q0 (+) P (y, x), u0 = v_L + W v_S, the unknowns are du and
 * d_k = dv_S,k, k = 0..n-1:
 *
 *     slow      w = u0 + du/2,   y moves by h w in each minor step
 *     fast      dx_k = h (v_S,k + B d_k/2),   v_S,k+1 = v_S,k + d_k
 *     point     q_k+1/2 = q_k (+) P (h w, dx_k) / 2,   v_k = P (w, dx_k / h),   a_k = P (du/n, d_k) / h
 *     minor     r_k = P' { h r_fast(q_k+1/2, v_k, a_k) + r_s / n },   r_k,S += W' M_s W (d_k - sum d / n)
 *     slow bodies, once per sweep, at the average of the two ends and the mean acceleration:
 *               r_s = H r_slow(qbar, vbar, P (du, sum d) / H),  qbar = q_0 (+) (q_n (-) q_0)/2,
 *               vbar = (q_n (-) q_0)/H
 *     damping   r_k,S += h D dx_k / 2,   A = alpha (M~_SS + X)^-1 X,  X = (h^2/4) K~_SS,  D = K~_SS A,  B = 1 + A,
 *               alpha = (1 - rho)/(1 + rho)
 *     equations r_k,S = 0 for all k,   R = sum r_k,L = 0
 *     end       q1 = q_n,   v1 = P (u0 + du, v_S,n)
 *
 * For constant symmetric M^ > 0, K >= 0, C >= 0: multiply R by w and r_k,S by dx_k/h and add.  Forces
 * are constant over segments and taken at their midpoints, so potentials give V1 - V0 (slow ones over
 * the whole step); w is the mean of u and, without common inertia, the inertia of S gives the change
 * of its energy; dampers take h v'C v.  Hence E1 - E0 = - sum (d' M~_SS A d + dx' D dx)/2 - h v'C v <= 0
 * for any partition, any n, any h.  The slow bodies' inertia M_s is in r_s by its mean over the step; how
 * the minor steps differ from the mean adds up to nothing in the slow rows, and in the fast ones is W' M_s W
 * (d_k - sum d / n), with M_s of the start.  For constant M_s this is the same as M_s P (du/n, d_k) in every
 * minor step; else the difference is of third order.  Velocities other than P (w, dx/h) in dampers or gyroscopic
 * forces, or slow bodies at the mean of the minor midpoints, break the identity and the stability with it.
 *
 * Where M^ depends on q the identity is no longer exact.  W at the average of both ends
 * (`symmetric`) makes the step symmetric in time, and the energy error does not drift.
 *
 * One Newton iteration for the whole major step: each sweep corrects every d_k once, with J, and the
 * slow unknown through the linearized answer of the minor steps (response.h).  A minor step whose
 * slopes have changed gets its own J and iterates by itself.
 *
 * The minor steps move only what fast bodies and elements know of the slow coordinates, the first `near`; the
 * others follow at the end (all of them where positions have a move of their own). */
#include <math.h>

#include "engine/decouple.h"
#include "engine/forecast.h"
#include "engine/midpoint.h"
#include "engine/motion.h"
#include "engine/newton.h"
#include "engine/response.h"
#include "la/dense.h"

enum { ROOM = 64, INNER = 12, PASSES = 2, SWEEPS = 16 };
static const double STALE_SLOPE = .2; /* relative change of a slope that asks for a fresh factor */

struct subcycle {
    const struct ode2 *ode;
    struct effort *effort;
    struct midpoint *plain; /* without fast coordinates */
    struct newton newton;
    struct decouple dec;
    struct response resp; /* frozen */
    struct minor here;    /* J of a minor step whose slopes have changed */
    int local;            /* it is in use */
    struct forecast forecast;
    int guessed;       /* d_k are the forecast's */
    double last_local; /* local error of the last step; negative: unknown */
    int n, ns, nl, ratio, room;
    int near; /* slow coordinates that the minor steps move */
    double alpha, h, H, t0, t1;
    const double *q0, *v0, *a0;
    struct instant centre; /* where W stands */

    double *d, *dbefore;                        /* [ns x ratio] */
    double *du, *u0, *w, *pull;                 /* [nl]; pull = du/H */
    double *R, *slow, *Du;                      /* [nl]: slow rows; slow bodies' share; correction */
    double *vs, *dx, *xn, *xbefore;             /* [ns] */
    double *dsum, *dmean, *esum;                /* [ns] sum of d_k when the slow bodies were asked, mean; .. */
    double *es, *cs, *c, *g, *x, *v_, *s_;      /* [ns] */
    double *q, *qmid, *qend, *qn, *qbar;        /* [nq] */
    double *dq, *v, *a, *r, *vbar, *abar, *sum; /* [n]; sum: size of the correction */
    double work[POWER_CHANNELS];
    double push, square; /* power of what is left, energy of the correction */
};

static void room_for(struct subcycle *c, int ratio, struct arena *life)
{
    if (ratio <= c->room) return;
    c->room = ratio < ROOM ? ROOM : ratio;
    c->d = TAKE(life, double, c->ns * c->room);
    c->dbefore = TAKE(life, double, c->ns * c->room);
}

static void take_vectors(struct subcycle *c, struct arena *life)
{
    double **slow[] = {&c->du, &c->u0, &c->w, &c->pull, &c->R, &c->slow, &c->Du};
    double **fast[] = {&c->vs, &c->dx, &c->xn, &c->xbefore, &c->dsum, &c->dmean, &c->esum,
                       &c->es, &c->cs, &c->c,  &c->g,       &c->x,    &c->v_,    &c->s_};
    double **place[] = {&c->q, &c->qmid, &c->qend, &c->qn, &c->qbar};
    double **whole[] = {&c->dq, &c->v, &c->a, &c->r, &c->vbar, &c->abar, &c->sum};
    for (size_t i = 0; i < sizeof slow / sizeof *slow; i++) *slow[i] = TAKE(life, double, c->nl);
    for (size_t i = 0; i < sizeof fast / sizeof *fast; i++) *fast[i] = TAKE(life, double, c->ns);
    for (size_t i = 0; i < sizeof place / sizeof *place; i++) *place[i] = TAKE(life, double, c->ode->nq);
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) *whole[i] = TAKE(life, double, c->n);
}

static void open(struct stepper *s, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct subcycle *c = TAKE(life, struct subcycle, 1);
    s->self = c;
    c->ode = o;
    c->effort = &s->effort;
    c->n = o->n;
    c->ns = o->ns;
    c->nl = o->n - o->ns;
    c->alpha = (1 - s->options.rho_infinity) / (1 + s->options.rho_infinity);
    c->plain = midpoint_new(s, life);
    newton_open(&c->newton, o, &s->effort, &s->options, life);
    if (s->options.sweeps <= 0) c->newton.limit = SWEEPS;
    c->newton.trust = .1;
    c->newton.pairs = 1;
    decouple_open(&c->dec, o, &s->effort, life);
    response_open(&c->resp, &c->dec, life);
    minor_open(&c->here, &c->resp, life);
    forecast_open(&c->forecast, &c->dec, life);
    c->near = o->move ? c->nl : c->dec.ml;
    take_vectors(c, life);
    room_for(c, ROOM, life);
}

/* ---- matrices ---------------------------------------------------------------------------------- */

static enum status singular(const struct subcycle *c, int pivot, struct trouble *why)
{
    return trouble_set(why, TROUBLE_SINGULAR, pivot, 0, c->t0);
}

/* A, D and B = 1 + A: what the minor step does not resolve is damped, by two symmetric operators. */
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

/* W, P and u0 at q. */
static enum status decouple(struct subcycle *c, const double *q, double t, struct trouble *why)
{
    c->centre = (struct instant){.t = t, .q = q, .v = c->v0, .ta = t, .tb = t};
    TRY(decouple_at(&c->dec, &c->centre, why));
    copy(c->u0, c->v0 + c->ns, c->nl);
    decouple_recoil(&c->dec, c->u0, 1, c->v0);
    return OK;
}

/* The slow rows' matrix; where the structure does not allow it, with M^ formed from now on. */
static enum status slow_matrix(struct subcycle *c, struct trouble *why)
{
    enum status status = response_slow(&c->resp, &c->dec, c->centre.q, c->centre.t, why);
    if (status == OK || !c->dec.structured) return status;
    decouple_dense(&c->dec);
    TRY(decouple(c, c->centre.q, c->centre.t, why));
    response_masses(&c->resp, &c->dec);
    return response_slow(&c->resp, &c->dec, c->centre.q, c->centre.t, why);
}

/* F = K_s/2 + C_s/H of the slow class, slow rows and columns; K and C are scratch. */
static void slow_force(struct subcycle *c, const double *K, const double *C)
{
    int n = c->n, ns = c->ns, nl = c->nl;
    for (int j = 0; j < nl; j++)
        for (int i = 0; i < nl; i++) {
            long at = (ns + i) + (long)(ns + j) * n;
            c->resp.F[i + j * nl] = K[at] / 2 + C[at] / c->H;
        }
}

/* All matrices at the start of the step. */
static enum status refresh(struct subcycle *c, struct trouble *why)
{
    struct response *p = &c->resp;
    struct minor *m = &p->one;
    const struct ode2_ops *ops = c->ode->ops;
    struct instant x = {.t = c->t0, .q = c->q0, .v = c->v0, .a = c->a0, .ta = c->t0, .tb = c->t0};
    c->effort->factors++;
    m->h = p->h = c->here.h = c->h;
    p->H = c->H;
    p->ratio = c->ratio;
    TRY(ops->slopes(c->ode, m->K, m->C, &x, SLOW, why));
    slow_force(c, m->K, m->C);
    TRY(ops->slopes(c->ode, m->K, m->C, &x, FAST, why));
    decouple_slopes(&c->dec, m->K, c->dec.ml);
    decouple_slopes(&c->dec, m->C, c->dec.ml);
    response_masses(p, &c->dec);
    if (c->alpha > 0) TRY(damping(c, why));
    int pivot = minor_factor(m);
    if (pivot >= 0) return singular(c, pivot, why);
    response_freeze(p, &c->dec);
    TRY(slow_matrix(c, why));
    c->local = 0;
    newton_refreshed(&c->newton);
    c->newton.fresh = 1 << 20; /* no better matrix to be had in this step */
    return OK;
}

/* The same for the masses as they are now, with slopes and their answers as they were frozen. */
static enum status renew(struct subcycle *c, struct trouble *why)
{
    if (response_masses(&c->resp, &c->dec)) {
        c->effort->factors++;
        int pivot = minor_mass(&c->resp.one);
        if (pivot >= 0) return singular(c, pivot, why);
        TRY(slow_matrix(c, why));
    }
    return c->alpha > 0 ? damping(c, why) : OK;
}

/* J for a minor step whose slopes are no longer the frozen ones. */
static enum status refresh_here(struct subcycle *c, const struct instant *x, struct trouble *why)
{
    struct minor *m = &c->here;
    c->effort->factors++;
    TRY(c->ode->ops->slopes(c->ode, m->K, m->C, x, FAST, why));
    decouple_slopes(&c->dec, m->K, c->dec.ml);
    decouple_slopes(&c->dec, m->C, c->dec.ml);
    int pivot = minor_factor(m);
    if (pivot >= 0) return singular(c, pivot, why);
    c->local = 1;
    return OK;
}

/* ---- the step for du and d_k as they are -------------------------------------------------------- */

/* v_k,S = dx_k/h of d_k from v_S. */
static void fast_velocity(struct subcycle *c, const double *d)
{
    for (int i = 0; i < c->ns; i++) c->v[i] = c->vs[i] + d[i] / 2;
    if (c->alpha > 0) dense_gemv(c->v, .5, c->resp.A, d, c->ns, c->ns, c->ns);
}

/* v_k = P (w, dx_k/h), as far as the minor steps move. */
static void whole_velocity(struct subcycle *c, const double *d)
{
    fast_velocity(c, d);
    decouple_out(&c->dec, c->v, c->w, c->v, c->near);
}

/* x1 = x0 (+) s h v_k, at time t, as far as the minor steps move. */
static void point(struct subcycle *c, double *x1, const double *x0, double s, double t)
{
    int m = c->ns + c->near;
    if (c->ode->move) {
        for (int i = 0; i < m; i++) c->dq[i] = c->h * c->v[i];
        c->ode->move->point(c->ode, x1, x0, c->dq, s, t);
    } else {
        for (int i = 0; i < m; i++) x1[i] = x0[i] + s * c->h * c->v[i];
    }
}

/* x_n, v_S after d_k at v_k. */
static void advance(struct subcycle *c, const double *d)
{
    for (int i = 0; i < c->ns; i++) {
        c->xn[i] += c->h * c->v[i];
        c->vs[i] += d[i];
    }
}

/* When minor step k ends. */
static double minor_end(const struct subcycle *c, int k)
{
    return k + 1 < c->ratio ? c->t0 + (k + 1) * c->h : c->t1;
}

/* w, x_n, v_S at the end, q_n, and the sum of the d_k. */
static void compose(struct subcycle *c)
{
    for (int i = 0; i < c->nl; i++) c->w[i] = c->u0[i] + c->du[i] / 2;
    copy(c->vs, c->v0, c->ns);
    zero(c->xn, c->ns);
    zero(c->dsum, c->ns);
    if (c->ode->move) copy(c->qn, c->q0, c->ode->nq);
    for (int k = 0; k < c->ratio; k++) {
        const double *d = c->d + k * c->ns;
        fast_velocity(c, d);
        advance(c, d);
        for (int i = 0; i < c->ns; i++) c->dsum[i] += d[i];
        if (!c->ode->move) continue;
        decouple_out(&c->dec, c->v, c->w, c->v, c->near);
        point(c, c->qn, c->qn, 1, minor_end(c, k));
    }
    if (c->ode->move) return;
    for (int i = 0; i < c->ns; i++) c->qn[i] = c->q0[i] + c->xn[i];
    for (int i = 0; i < c->nl; i++) c->qn[c->ns + i] = c->H * c->w[i];
    decouple_recoil(&c->dec, c->qn + c->ns, -1, c->xn);
    for (int i = c->ns; i < c->n; i++) c->qn[i] += c->q0[i];
}

/* ---- residuals --------------------------------------------------------------------------------- */

static void book(struct subcycle *c, double time, const double *w)
{
    for (int i = 0; i < POWER_CHANNELS; i++) {
        c->work[i] += time * w[i];
        c->newton.powered |= w[i] != 0;
    }
}

/* r_s, and what is the same for the fast rows of all minor steps. */
static enum status slow_bodies(struct subcycle *c, struct trouble *why)
{
    const struct ode2 *o = c->ode;
    int ns = c->ns, nl = c->nl;
    double power[POWER_CHANNELS], dk = 0, per = 1 / c->H;
    const double mid = c->t0 + (c->t1 - c->t0) / 2;
    motion_diff(o, c->dq, c->qn, c->q0);
    motion_point(o, c->qbar, c->q0, c->dq, .5, mid);
    decouple_out(&c->dec, c->abar, c->du, c->dsum, nl);
    for (int i = 0; i < c->n; i++) {
        c->vbar[i] = per * c->dq[i];
        c->abar[i] *= per;
    }
    struct instant x = {
        .t = mid, .q = c->qbar, .v = c->vbar, .a = c->abar, .qa = c->q0, .qb = c->qn, .ta = c->t0, .tb = c->t1};
    TRY(o->ops->resid(o, c->r, power, &dk, &x, SLOW, why));
    c->effort->slow++;
    if (dk > STALE_SLOPE) c->newton.stale = 1;
    book(c, c->H, power);
    for (int i = 0; i < nl; i++) c->slow[i] = c->H * c->r[ns + i];
    for (int i = 0; i < c->near; i++) c->pull[i] = per * c->du[i];
    for (int i = 0; i < ns; i++) c->dmean[i] = c->dsum[i] / c->ratio;
    zero(c->cs, ns);
    if (c->dec.reach) dense_gemtv(c->cs, -1. / c->ratio, c->dec.W, c->slow, c->dec.reach, ns, nl);
    return OK;
}

/* es: the fast rows of minor step k at its trial point; c->r its fast bodies' share. */
static enum status minor_rows(struct subcycle *c, const double *d, double *power, double *dk, struct instant *x,
                              struct trouble *why)
{
    int ns = c->ns;
    double per = 1 / c->h;
    whole_velocity(c, d);
    point(c, c->qmid, c->q, .5, x->t);
    point(c, c->qend, c->q, 1, x->tb);
    for (int i = 0; i < ns; i++) c->a[i] = per * d[i];
    decouple_out(&c->dec, c->a, c->pull, c->a, c->near);
    TRY(c->ode->ops->resid(c->ode, c->r, power, dk, x, FAST, why));
    c->effort->fast++;
    decouple_fast(&c->dec, c->es, c->r, c->dec.ml);
    for (int i = 0; i < ns; i++) c->es[i] = c->h * c->es[i] + c->cs[i];
    if (c->dec.reach)
        for (int j = 0; j < ns; j++)
            for (int i = 0; i < ns; i++) c->es[i] += c->dec.WMW[i + j * ns] * (d[j] - c->dmean[j]);
    if (c->alpha > 0) dense_gemv(c->es, c->h * c->h / 2, c->resp.D, c->v, ns, ns, ns);
    return OK;
}

/* Largest correction of a minor step, as the newton iteration will see it over the major step. */
static double minor_error(const struct subcycle *c)
{
    double err = 0;
    for (int i = 0; i < c->ns; i++) err = fmax(err, fabs(c->es[i]) * c->newton.per[i] * c->ratio);
    return err;
}

/* d_k corrected: once, or where its slopes have changed until it stands by itself (or has had its turn:
 * the next sweep comes back to it). */
static enum status minor(struct subcycle *c, double *d, double *power, struct instant *x, struct trouble *why)
{
    double enough = fmax(.1 * c->newton.tol, 1e-13), before = INFINITY;
    for (int inner = 0, alone = 0, slow = 0; inner < INNER; inner++) {
        double dk = 0;
        TRY(minor_rows(c, d, power, &dk, x, why));
        if (dk > STALE_SLOPE || slow) {
            TRY(refresh_here(c, x, why));
            alone = 1;
        }
        copy(c->s_, c->es, c->ns);
        minor_solve(c->local ? &c->here : &c->resp.one, c->es);
        c->square += dot(c->s_, c->es, c->ns);
        for (int i = 0; i < c->ns; i++) d[i] -= c->es[i];
        double err = alone ? minor_error(c) : 0;
        if (err <= enough || (err > .5 * before && err < 1e-7)) break;
        slow = err > .1 * before;
        before = err;
    }
    return OK;
}

static void minor_sums(struct subcycle *c, const double *d)
{
    for (int i = 0; i < c->dec.ml; i++) c->R[i] += c->h * c->r[c->ns + i];
    for (int i = 0; i < c->ns; i++) {
        c->dsum[i] -= d[i] + c->es[i]; /* as it was when the rows were taken */
        c->esum[i] += c->es[i];
        c->push += c->s_[i] * c->v[i];
    }
}

/* All minor steps once; R: slow rows of the fast bodies. */
static enum status minor_steps(struct subcycle *c, struct trouble *why)
{
    struct instant x = {.q = c->qmid, .v = c->v, .a = c->a, .qa = c->q, .qb = c->qend};
    int first = c->guessed;
    copy(c->q, c->q0, c->ode->nq);
    copy(c->vs, c->v0, c->ns);
    copy(c->xbefore, c->xn, c->ns);
    zero(c->R, c->dec.ml);
    zero(c->xn, c->ns);
    zero(c->esum, c->ns);
    for (int k = 0; k < c->ratio; k++) {
        double *d = c->d + k * c->ns, power[POWER_CHANNELS];
        x.ta = c->t0 + k * c->h;
        x.tb = minor_end(c, k);
        x.t = x.ta + (x.tb - x.ta) / 2;
        if (first) {
            forecast_minor(&c->forecast, &c->resp, d, c->xn, c->vs, c->w, k);
            copy(c->dbefore + k * c->ns, d, c->ns);
        }
        TRY(minor(c, d, power, &x, why));
        if (first) forecast_force(&c->forecast, &c->resp, d, c->xn, c->vs, c->w, c->local ? NULL : c->s_, k);
        book(c, c->h, power);
        minor_sums(c, d);
        whole_velocity(c, d);
        point(c, c->q, c->q, 1, x.tb);
        advance(c, d);
    }
    c->guessed = 0;
    return OK;
}

/* R complete: slow bodies over the whole step; their inertia where d_k has moved on since they were asked
 * (dsum holds the difference); the last corrections of the minor steps. */
static void slow_rows(struct subcycle *c)
{
    int ns = c->ns, nl = c->nl, ml = c->dec.ml;
    for (int i = ml; i < nl; i++) c->R[i] = 0;
    if (c->dec.reach) dense_gemv(c->R, 1, c->dec.MsW, c->dsum, ml, ns, ml);
    for (int i = 0; i < nl; i++) {
        c->R[i] += c->slow[i];
        c->push += c->R[i] * c->w[i];
    }
    if (c->resp.drives) dense_gemv(c->R, -1, c->resp.Q, c->esum, ml, ns, ml);
}

/* ---- the iteration ----------------------------------------------------------------------------- */

/* du corrected, and all d_k with it. */
static void slow_correction(struct subcycle *c)
{
    int ns = c->ns, nl = c->nl;
    for (int i = 0; i < ns; i++) c->x[i] = c->xn[i] - c->xbefore[i];
    response_correct(&c->resp, &c->dec, c->Du, c->c, c->g, c->R, c->x);
    c->square += fabs(dot(c->R, c->Du, nl));
    for (int i = 0; i < nl; i++) c->du[i] += c->Du[i];
    if (!c->resp.drives) return;
    zero(c->x, ns);
    zero(c->v_, ns);
    response_run(&c->resp, c->d, c->c, c->g, c->x, c->v_, c->s_, 1);
}

static enum verdict judge(struct subcycle *c)
{
    double err = 0, small = 0, sum = 0;
    zero(c->sum, c->ns);
    for (int i = 0; i < c->nl; i++) c->sum[c->ns + i] = fabs(c->Du[i]);
    for (int k = 0; k < c->ratio; k++)
        for (int i = 0; i < c->ns; i++) c->sum[i] += fabs(c->d[i + k * c->ns] - c->dbefore[i + k * c->ns]);
    for (int i = 0; i < c->n; i++) {
        double e = c->sum[i] * c->newton.per[i];
        sum += c->sum[i];
        if (c->sum[i] > small) small = c->sum[i];
        if (e > err) {
            err = e;
            c->newton.worst = i;
        }
    }
    struct instant start = {.t = c->t0, .q = c->q0, .v = c->v0, .ta = c->t0, .tb = c->t0};
    return newton_judge(&c->newton, isfinite(sum) ? err : NAN, small, c->square, &start);
}

static enum status sweep(struct subcycle *c, enum verdict *verdict, struct trouble *why)
{
    zero(c->work, POWER_CHANNELS);
    c->push = c->square = 0;
    copy(c->dbefore, c->d, c->ns * c->ratio);
    compose(c);
    TRY(slow_bodies(c, why));
    TRY(minor_steps(c, why));
    slow_rows(c);
    slow_correction(c);
    *verdict = judge(c);
    return OK;
}

/* Sweeps from du, d_k as they are until they stand. */
static enum status solve(struct subcycle *c, struct trouble *why)
{
    for (;;) {
        enum verdict verdict;
        TRY(sweep(c, &verdict, why));
        if (verdict == CONVERGED) return OK;
        if (verdict == REFRESH) TRY(refresh(c, why));
        if (verdict == FAILED)
            return trouble_set(why, TROUBLE_DIVERGED, c->newton.worst, c->newton.last / c->newton.tol, c->t0);
    }
}

/* The step once more with W at the average of the ends it has found. */
static enum status symmetric_pass(struct subcycle *c, struct trouble *why)
{
    compose(c);
    motion_diff(c->ode, c->dq, c->qn, c->q0);
    const double mid = c->t0 + (c->t1 - c->t0) / 2;
    motion_point(c->ode, c->qbar, c->q0, c->dq, .5, mid);
    decouple_recoil(&c->dec, c->du, -1, c->dsum);
    TRY(decouple(c, c->qbar, mid, why));
    decouple_recoil(&c->dec, c->du, 1, c->dsum);
    TRY(renew(c, why));
    c->newton.count = 0;
    return solve(c, why);
}

/* The energy scale of the iteration, twice the kinetic energy: by M^ where it is there. */
static void energy_scale(struct subcycle *c)
{
    struct newton *nt = &c->newton;
    if (c->dec.structured) {
        newton_energy(nt, &c->centre);
        return;
    }
    zero(c->r, c->n);
    dense_gemv(c->r, 1, c->dec.M, c->v0, c->n, c->n, c->n);
    nt->energy = fmax(nt->energy, dot(c->r, c->v0, c->n));
    nt->age = 0;
}

static enum status attempt(struct subcycle *c, int passes, struct trouble *why)
{
    newton_begin(&c->newton, c->last_local);
    energy_scale(c);
    int changed = c->resp.h != c->h || c->resp.H != c->H || c->resp.ratio != c->ratio;
    if (c->newton.stale || c->local || changed)
        TRY(refresh(c, why));
    else
        TRY(renew(c, why));
    forecast_make(&c->forecast, &c->resp, c->du, c->d, c->u0, c->v0);
    c->guessed = 1;
    TRY(solve(c, why));
    for (int pass = 1; pass < passes; pass++) TRY(symmetric_pass(c, why));
    return OK;
}

/* ---- the step ---------------------------------------------------------------------------------- */

static void forget(struct subcycle *c)
{
    newton_forget(&c->newton);
    newton_scale(&c->newton, c->v0, c->a0, c->H);
    forecast_forget(&c->forecast, &c->dec, c->a0, c->v0, c->u0, c->H);
    c->last_local = -1;
}

/* Energy taken by the damping: sum of (d' M~_SS A d + dx' D dx)/2. */
static double damped(struct subcycle *c)
{
    int ns = c->ns;
    double sum = 0;
    if (c->alpha <= 0) return 0;
    copy(c->vs, c->v0, ns);
    for (int k = 0; k < c->ratio; k++) {
        const double *d = c->d + k * ns;
        fast_velocity(c, d);
        for (int i = 0; i < ns; i++) c->dx[i] = c->h * c->v[i];
        zero(c->x, ns);
        zero(c->g, ns);
        zero(c->s_, ns);
        dense_gemv(c->x, 1, c->resp.A, d, ns, ns, ns);
        dense_gemv(c->g, 1, c->dec.Mss, d, ns, ns, ns);
        dense_gemv(c->s_, 1, c->resp.D, c->dx, ns, ns, ns);
        sum += dot(c->x, c->g, ns) + dot(c->s_, c->dx, ns);
        for (int i = 0; i < ns; i++) c->vs[i] += d[i];
    }
    return sum / 2;
}

/* After compose: c->v stands at the last minor step. */
static void remember(struct subcycle *c)
{
    for (int i = 0; i < c->ns; i++) c->dx[i] = c->h * c->v[i];
    const struct found x = {c->h, c->H, c->ratio, c->d, c->du, c->w, c->dx, c->xn};
    c->last_local = forecast_error(&c->forecast, &x, c->newton.per);
    forecast_keep(&c->forecast, &c->resp, &x);
}

static void accept(struct subcycle *c, struct stepper *s, struct state *x)
{
    int n = c->n;
    double per = 1 / c->H;
    s->lost = damped(c);
    s->left = fabs(c->push) * fmin(1, c->newton.remain);
    copy(s->work, c->work, POWER_CHANNELS);
    compose(c);
    remember(c);
    for (int i = 0; i < c->nl; i++) c->u0[i] += c->du[i];
    decouple_out(&c->dec, c->v, c->u0, c->vs, c->nl);
    for (int i = 0; i < n; i++) x->a[i] = per * (c->v[i] - x->v[i]);
    copy(x->v, c->v, n);
    copy(x->q, c->qn, c->ode->nq);
    x->t = c->t1;
    newton_scale(&c->newton, x->v, x->a, c->H);
    s->effort.minors += c->ratio;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct subcycle *c = s->self;
    double H = h * ratio;
    long before = s->effort.sweeps;
    if (c->ns == 0) {
        TRY(midpoint_advance(c->plain, s, x, H, to, why));
        s->effort.minors++;
        return OK;
    }
    room_for(c, ratio, s->life);
    c->h = h;
    c->H = H;
    c->ratio = ratio;
    c->t0 = x->t;
    c->t1 = to;
    c->q0 = x->q;
    c->v0 = x->v;
    c->a0 = x->a;
    TRY(decouple(c, x->q, x->t, why));
    if (s->fresh) forget(c);
    int passes = s->options.symmetric ? PASSES : 1;
    enum status status = attempt(c, passes, why);
    if (status != OK && c->newton.refreshed == 0) { /* with old factors: once more with fresh ones */
        c->newton.stale = 1;
        status = decouple(c, x->q, x->t, why);
        if (status == OK) status = attempt(c, passes, why);
    }
    s->last_sweeps = (int)(s->effort.sweeps - before);
    if (status != OK) {
        c->newton.stale = 1;
        return status;
    }
    accept(c, s, x);
    s->fresh = 0;
    return OK;
}

const struct stepper_kind step_subcycle = {
    .name = "subcycle",
    .brief = "energy-consistent sub-cycling, inertially decoupled: slow parts in steps of ratio * step",
    .reads = " step ratio rho_infinity symmetric newton_tolerance ",
    .rates = 2,
    .order = 2,
    .quadrature = 1,
    .open = open,
    .step = step,
};
