/* subcycle.c -- energy-consistent, inertially decoupled sub-cycling
 *
 * Slow coordinates L take major steps H = n h, fast ones S minor steps h.  With W and P of decouple.h
 * from M^ at the start of the step, q = q0 (+) P (y, x), u0 = v_L + W v_S, the unknowns are du and
 * d_k = dv_S,k, k = 0..n-1:
 *
 *     slow      w = u0 + du/2,   y moves by h w in each minor step
 *     fast      dx_k = h (v_S,k + B d_k/2),   v_S,k+1 = v_S,k + d_k
 *     point     q_k+1/2 = q_k (+) P (h w, dx_k) / 2,   v_k = P (w, dx_k / h),   a_k = P (du/n, d_k) / h
 *     minor     r_k = P' { h r_fast(q_k+1/2, v_k, a_k) + M_s P (du/n, d_k) + h r_slow(qbar, vbar, 0) }
 *     slow bodies, once per sweep, at the average of the two ends: qbar = q_0 (+) (q_n (-) q_0)/2,
 *               vbar = (q_n (-) q_0)/H, M_s = M_slow(qbar)
 *     damping   r_k,S += h D dx_k / 2,   A = alpha (M~_SS + X)^-1 X,  X = (h^2/4) K~_SS,  D = K~_SS A,  B = 1 + A,
 *               alpha = (1 - rho)/(1 + rho)
 *     equations r_k,S = 0 for all k,   R = sum r_k,L = 0
 *     end       q1 = q_n,   v1 = P (u0 + du, v_S,n)
 *
 * For constant symmetric M^ > 0, K >= 0, C >= 0: multiply R by w and r_k,S by dx_k/h and add.  Forces
 * are constant over segments and taken at their midpoints, so potentials give V1 - V0 (slow ones over
 * the whole step); w is the mean of u and, without common inertia, the inertia of S gives the change
 * of its energy; dampers take h v'C v.  Hence E1 - E0 = - sum (d' M~_SS A d + dx' D dx)/2 - h v'C v <= 0
 * for any partition, any n, any h.  Velocities other than P (w, dx/h) in dampers or gyroscopic forces,
 * or slow bodies at the mean of the minor midpoints, break the identity and the stability with it.
 *
 * Where M^ depends on q the identity is no longer exact.  W at the average of both ends
 * (`symmetric`) makes the step symmetric in time, and the energy error does not drift.
 *
 * One Newton iteration for the whole major step: each sweep corrects every d_k once, with J, and the
 * slow unknown through the linearized answer of the minor steps (response.h).  A minor step whose
 * slopes have changed gets its own J and iterates by itself. */
#include <math.h>

#include "engine/decouple.h"
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
    struct response near; /* J of a minor step whose slopes have changed */
    int local;            /* near is in use */
    int n, ns, nl, ratio, room;
    double alpha, h, H, t0, t1;
    const double *q0, *v0, *a0;

    double *d, *dbefore;                   /* [ns x ratio] */
    double *du, *u0, *w;                   /* [nl] */
    double *R, *rs, *e, *rho, *Du, *De;    /* [nl]: slow rows; slow bodies' share; displacement of L; corrections */
    double *vs, *dx, *xn, *dsum, *esum;    /* [ns] */
    double *es, *cs, *c, *g, *x, *v_, *s_; /* [ns] */
    double *q, *qmid, *qend, *qn, *qbar;   /* [nq] */
    double *dq, *v, *a, *r, *vbar;         /* [n] */
    double *Ms, *MsW, *WMW;                /* [n x n], [nl x ns], [ns x ns] */
    double *sum;                           /* [n] size of the correction */
    double work[POWER_CHANNELS];
    double push, square; /* power of what is left, energy of the correction */

    struct {                   /* the last minor and major steps, for prediction */
        double *as, *dx, *vs;  /* [ns] */
        double *y, *w;         /* [nl] half of its slow displacement, its slow velocity */
        double *trend;         /* [ns] rate of the force that the linear model does not know */
        double *ay, *aybefore; /* [nl] */
        double H, Hbefore, local;
    } last;
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
    double **slow[] = {&c->du, &c->u0,     &c->w,      &c->R,       &c->rs,           &c->e, &c->rho, &c->Du,
                       &c->De, &c->last.y, &c->last.w, &c->last.ay, &c->last.aybefore};
    double **fast[] = {&c->vs, &c->dx, &c->xn, &c->dsum, &c->esum,    &c->es,      &c->cs,      &c->c,
                       &c->g,  &c->x,  &c->v_, &c->s_,   &c->last.as, &c->last.dx, &c->last.vs, &c->last.trend};
    double **place[] = {&c->q, &c->qmid, &c->qend, &c->qn, &c->qbar};
    double **whole[] = {&c->dq, &c->v, &c->a, &c->r, &c->vbar, &c->sum};
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
    decouple_open(&c->dec, c->n, c->ns, life);
    response_open(&c->resp, c->n, c->ns, life);
    response_open(&c->near, c->n, c->ns, life);
    c->near.M = c->resp.M;
    c->near.A = c->resp.A;
    c->near.D = c->resp.D;
    take_vectors(c, life);
    c->Ms = TAKE(life, double, c->n * c->n);
    c->MsW = TAKE(life, double, c->nl * c->ns);
    c->WMW = TAKE(life, double, c->ns * c->ns);
    room_for(c, ROOM, life);
}

static enum status singular(const struct subcycle *c, int pivot, struct trouble *why)
{
    return trouble_set(why, TROUBLE_SINGULAR, pivot, 0, c->t0);
}

/* A, D and B = 1 + A: what the minor step does not resolve is damped, by two symmetric operators. */
static enum status damping(struct subcycle *c, struct trouble *why)
{
    struct response *p = &c->resp;
    int n = c->n, ns = c->ns;
    double s = c->h * c->h / 8; /* X = (h^2/4) K~, symmetrized */
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++) {
            p->A[i + j * ns] = s * (p->K[i + j * n] + p->K[j + i * n]);
            p->J[i + j * ns] = c->dec.Mss[i + j * ns] + p->A[i + j * ns];
        }
    int pivot = dense_cholesky(p->J, ns, ns);
    if (pivot >= 0) return singular(c, pivot, why);
    dense_cholesky_solves(p->J, p->A, ns, ns, ns, ns);
    for (int i = 0; i < ns * ns; i++) p->A[i] *= c->alpha;
    zero(p->D, ns * ns);
    dense_gemm(p->D, .5, p->K, p->A, ns, ns, ns, ns, n, ns);
    dense_gemtm(p->D, .5, p->K, p->A, ns, ns, ns, ns, n, ns);
    return OK;
}

/* M^ at q, W, P. */
static enum status decouple_at(struct subcycle *c, const double *q, double t, struct trouble *why)
{
    TRY(c->ode->ops->mass(c->ode, c->dec.M, q, t, ALL, why));
    c->effort->slow++;
    c->effort->fast++;
    int pivot = decouple_factor(&c->dec);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, t);
    for (int i = 0; i < c->nl; i++) c->u0[i] = c->v0[c->ns + i];
    if (c->dec.coupled) dense_gemv(c->u0, 1, c->dec.W, c->v0, c->nl, c->ns, c->nl);
    return OK;
}

/* P' M^ P: block diagonal. */
static void transformed_mass(struct subcycle *c)
{
    int n = c->n, ns = c->ns;
    zero(c->resp.M, n * n);
    dense_copy(c->resp.M, c->dec.Mss, ns, ns, n, ns);
    dense_copy(c->resp.M + ns + ns * n, c->dec.M + ns + ns * n, c->nl, c->nl, n, n);
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

/* J, G and the rest at the start of the step. */
static enum status refresh(struct subcycle *c, struct trouble *why)
{
    struct response *p = &c->resp;
    const struct ode2_ops *ops = c->ode->ops;
    struct instant x = {.t = c->t0, .q = c->q0, .v = c->v0, .a = c->a0, .ta = c->t0, .tb = c->t0};
    c->effort->factors++;
    p->h = c->near.h = c->h;
    p->H = c->near.H = c->H;
    p->ratio = c->ratio;
    TRY(ops->slopes(c->ode, p->K, p->C, &x, SLOW, why));
    slow_force(c, p->K, p->C);
    TRY(ops->slopes(c->ode, p->K, p->C, &x, FAST, why));
    decouple_slopes(&c->dec, p->K);
    decouple_slopes(&c->dec, p->C);
    transformed_mass(c);
    if (c->alpha > 0) TRY(damping(c, why));
    int pivot = response_factor(p);
    if (pivot < 0) pivot = response_slow(p, c->dec.W);
    if (pivot >= 0) return singular(c, pivot, why);
    c->local = 0;
    newton_refreshed(&c->newton);
    c->newton.fresh = 1 << 20; /* no better matrix to be had in this step */
    return OK;
}

/* J for a minor step whose slopes are no longer the frozen ones. */
static enum status refresh_near(struct subcycle *c, const struct instant *x, struct trouble *why)
{
    struct response *p = &c->near;
    c->effort->factors++;
    TRY(c->ode->ops->slopes(c->ode, p->K, p->C, x, FAST, why));
    decouple_slopes(&c->dec, p->K);
    decouple_slopes(&c->dec, p->C);
    int pivot = response_factor(p);
    if (pivot >= 0) return singular(c, pivot, why);
    c->local = 1;
    return OK;
}

/* dx_k of d_k from v_S. */
static void fast_move(struct subcycle *c, const double *d)
{
    for (int i = 0; i < c->ns; i++) c->dx[i] = c->h * (c->vs[i] + d[i] / 2);
    if (c->alpha > 0) dense_gemv(c->dx, c->h / 2, c->resp.A, d, c->ns, c->ns, c->ns);
}

/* dq = P (h w, dx). */
static void whole_move(struct subcycle *c)
{
    for (int i = 0; i < c->nl; i++) c->De[i] = c->h * c->w[i];
    decouple_out(&c->dec, c->dq, c->De, c->dx);
}

/* e = H w - W x_n. */
static void slow_move(const struct subcycle *c, double *e)
{
    for (int i = 0; i < c->nl; i++) e[i] = c->H * c->w[i];
    if (c->dec.coupled) dense_gemv(e, -1, c->dec.W, c->xn, c->nl, c->ns, c->nl);
}

/* The end of the step for du and all d_k as they are: w, x_n, v_S, q_n, e. */
static void compose(struct subcycle *c)
{
    for (int i = 0; i < c->nl; i++) c->w[i] = c->u0[i] + c->du[i] / 2;
    copy(c->vs, c->v0, c->ns);
    zero(c->xn, c->ns);
    if (c->ode->move) copy(c->qn, c->q0, c->ode->nq);
    for (int k = 0; k < c->ratio; k++) {
        const double *d = c->d + k * c->ns;
        fast_move(c, d);
        for (int i = 0; i < c->ns; i++) {
            c->xn[i] += c->dx[i];
            c->vs[i] += d[i];
        }
        if (!c->ode->move) continue;
        whole_move(c);
        motion_point(c->ode, c->qn, c->qn, c->dq, 1);
    }
    slow_move(c, c->e);
    if (c->ode->move) return;
    for (int i = 0; i < c->ns; i++) c->qn[i] = c->q0[i] + c->xn[i];
    for (int i = 0; i < c->nl; i++) c->qn[c->ns + i] = c->q0[c->ns + i] + c->e[i];
}

static void book(struct subcycle *c, double time, const double *w)
{
    for (int i = 0; i < POWER_CHANNELS; i++) {
        c->work[i] += time * w[i];
        c->newton.powered |= w[i] != 0;
    }
}

/* M_s P_S = (-M_s W), W' M_s W, and the constant part of the fast rows. */
static void slow_inertia(struct subcycle *c)
{
    int n = c->n, ns = c->ns, nl = c->nl;
    const double *M = c->Ms + ns + ns * n;
    zero(c->cs, ns);
    if (!c->dec.coupled) return;
    zero(c->MsW, nl * ns);
    zero(c->WMW, ns * ns);
    dense_gemm(c->MsW, 1, M, c->dec.W, nl, nl, ns, nl, n, nl);
    dense_gemtm(c->WMW, 1, c->dec.W, c->MsW, ns, nl, ns, ns, nl, nl);
    for (int i = 0; i < nl; i++) c->R[i] = c->h * c->rs[i];
    dense_gemv(c->R, 1. / c->ratio, M, c->du, nl, nl, n);
    dense_gemtv(c->cs, -1, c->dec.W, c->R, nl, ns, nl);
}

/* Slow bodies at the average of the ends. */
static enum status slow_bodies(struct subcycle *c, struct trouble *why)
{
    const struct ode2 *o = c->ode;
    double power[POWER_CHANNELS], dk = 0;
    motion_diff(o, c->dq, c->qn, c->q0);
    motion_point(o, c->qbar, c->q0, c->dq, .5);
    for (int i = 0; i < c->n; i++) c->vbar[i] = c->dq[i] / c->H;
    struct instant x = {.t = c->t0 + (c->t1 - c->t0) / 2,
                        .q = c->qbar,
                        .v = c->vbar,
                        .qa = c->q0,
                        .qb = c->qn,
                        .ta = c->t0,
                        .tb = c->t1};
    TRY(o->ops->resid(o, c->r, power, &dk, &x, SLOW, why));
    TRY(o->ops->mass(o, c->Ms, c->qbar, x.t, SLOW, why));
    c->effort->slow++;
    if (dk > STALE_SLOPE) c->newton.stale = 1;
    copy(c->rs, c->r + c->ns, c->nl);
    book(c, c->H, power);
    slow_inertia(c);
    return OK;
}

/* es = J^-1 of the fast rows of minor step k at its trial point; c->r its fast bodies' share. */
static enum status minor_rows(struct subcycle *c, const double *d, double *power, double *dk, struct instant *x,
                              struct trouble *why)
{
    int ns = c->ns, nl = c->nl;
    fast_move(c, d);
    whole_move(c);
    motion_point(c->ode, c->qmid, c->q, c->dq, .5);
    motion_point(c->ode, c->qend, c->q, c->dq, 1);
    for (int i = 0; i < nl; i++) c->De[i] = c->du[i] / c->ratio;
    decouple_out(&c->dec, c->a, c->De, d);
    for (int i = 0; i < c->n; i++) {
        c->v[i] = c->dq[i] / c->h;
        c->a[i] /= c->h;
    }
    TRY(c->ode->ops->resid(c->ode, c->r, power, dk, x, FAST, why));
    c->effort->fast++;
    decouple_fast(&c->dec, c->es, c->r);
    for (int i = 0; i < ns; i++) c->es[i] = c->h * c->es[i] + c->cs[i];
    if (c->dec.coupled) dense_gemv(c->es, 1, c->WMW, d, ns, ns, ns);
    if (c->alpha > 0) dense_gemv(c->es, c->h / 2, c->resp.D, c->dx, ns, ns, ns);
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
            TRY(refresh_near(c, x, why));
            alone = 1;
        }
        copy(c->s_, c->es, c->ns);
        response_solve(c->local ? &c->near : &c->resp, c->es);
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
    for (int i = 0; i < c->nl; i++) c->R[i] += c->h * c->r[c->ns + i];
    for (int i = 0; i < c->ns; i++) {
        c->dsum[i] += d[i] + c->es[i]; /* as it was when the rows were taken */
        c->esum[i] += c->es[i];
        c->push += c->s_[i] * c->dx[i] / c->h;
    }
}

/* All minor steps once; R: slow rows of the fast bodies. */
static enum status minor_steps(struct subcycle *c, struct trouble *why)
{
    struct instant x = {.q = c->qmid, .v = c->v, .a = c->a, .qa = c->q, .qb = c->qend};
    copy(c->q, c->q0, c->ode->nq);
    copy(c->vs, c->v0, c->ns);
    zero(c->R, c->nl);
    zero(c->xn, c->ns);
    zero(c->dsum, c->ns);
    zero(c->esum, c->ns);
    for (int k = 0; k < c->ratio; k++) {
        double *d = c->d + k * c->ns, power[POWER_CHANNELS];
        x.ta = c->t0 + k * c->h;
        x.tb = k + 1 < c->ratio ? c->t0 + (k + 1) * c->h : c->t1;
        x.t = x.ta + (x.tb - x.ta) / 2;
        TRY(minor(c, d, power, &x, why));
        book(c, c->h, power);
        minor_sums(c, d);
        fast_move(c, d);
        whole_move(c);
        motion_point(c->ode, c->q, c->q, c->dq, 1);
        for (int i = 0; i < c->ns; i++) {
            c->xn[i] += c->dx[i];
            c->vs[i] += d[i];
        }
    }
    return OK;
}

/* R complete: slow bodies over the whole step, and the last corrections of the minor steps. */
static void slow_rows(struct subcycle *c)
{
    int n = c->n, ns = c->ns, nl = c->nl;
    dense_gemv(c->R, 1, c->Ms + ns + ns * n, c->du, nl, nl, n);
    if (c->dec.coupled) dense_gemv(c->R, -1, c->MsW, c->dsum, nl, ns, nl);
    for (int i = 0; i < nl; i++) {
        c->R[i] += c->H * c->rs[i];
        c->push += c->R[i] * c->w[i];
    }
    dense_gemv(c->R, -1, c->resp.Q, c->esum, nl, ns, nl);
}

/* du corrected, and all d_k with it. */
static void slow_correction(struct subcycle *c)
{
    const struct response *p = &c->resp;
    int n = c->n, ns = c->ns, nl = c->nl;
    slow_move(c, c->rho);
    for (int i = 0; i < nl; i++) c->rho[i] -= c->e[i];
    response_slow_solve(p, c->Du, c->De, c->R, c->rho);
    c->square += fabs(dot(c->R, c->Du, nl));
    for (int i = 0; i < nl; i++) c->du[i] += c->Du[i];
    zero(c->c, ns);
    zero(c->g, ns);
    zero(c->x, ns);
    zero(c->v_, ns);
    dense_gemv(c->c, c->h / 2, p->C + ns * n, c->Du, ns, nl, n);
    dense_gemv(c->g, c->h * c->H / 2, p->K + ns * n, c->Du, ns, nl, n);
    if (p->slow_slopes) dense_gemv(c->c, -c->h, p->WF, c->De, ns, nl, ns);
    response_run(p, c->d, c->c, c->g, c->x, c->v_, c->s_, 1);
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
        small = fmax(small, c->sum[i]);
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

/* What the predictor needs, from consistent accelerations. */
static void forget(struct subcycle *c)
{
    int ns = c->ns, nl = c->nl;
    newton_forget(&c->newton);
    newton_scale(&c->newton, c->v0, c->a0, c->H);
    copy(c->last.as, c->a0, ns);
    copy(c->last.vs, c->v0, ns);
    zero(c->last.dx, ns);
    copy(c->last.ay, c->a0 + ns, nl);
    if (c->dec.coupled) dense_gemv(c->last.ay, 1, c->dec.W, c->a0, nl, ns, nl);
    copy(c->last.aybefore, c->last.ay, nl);
    zero(c->last.y, nl);
    zero(c->last.trend, ns);
    copy(c->last.w, c->u0, nl);
    c->last.H = c->last.Hbefore = c->H;
    c->last.local = -1;
}

/* du by its last two values; d_k as linear minor steps under the force of the last one:
 *
 *     M dd_k = h { M as - K_SS (x_k+1/2 - x_last) - K_SL (y_k+1/2 - y_last) - C (v - v_last) + trend (t - t_last) }
 *
 * which is exact for a linear system under constant loads. */
static void predict(struct subcycle *c)
{
    const struct response *p = &c->resp;
    int n = c->n, ns = c->ns, nl = c->nl;
    double h = c->h, s = (c->H + c->last.H) / (c->last.H + c->last.Hbefore);
    for (int i = 0; i < nl; i++) {
        double ay = c->last.ay[i];
        c->du[i] = c->H * (ay + s * (ay - c->last.aybefore[i]));
        c->w[i] = c->u0[i] + c->du[i] / 2;
        c->Du[i] = c->w[i] - c->last.w[i];
    }
    zero(c->c, ns);
    zero(c->g, ns);
    dense_gemv(c->c, -h, p->M, c->last.as, ns, ns, n);
    dense_gemv(c->c, -h, p->C, c->last.vs, ns, ns, n);
    if (c->alpha > 0) dense_gemv(c->c, -h / 2, p->D, c->last.dx, ns, ns, ns);
    dense_gemv(c->c, h, p->K + ns * n, c->last.y, ns, nl, n);
    dense_gemv(c->c, h, p->C + ns * n, c->Du, ns, nl, n);
    dense_gemv(c->g, h * c->H, p->K + ns * n, c->w, ns, nl, n);
    for (int i = 0; i < ns; i++) {
        c->x[i] = c->last.dx[i] / 2;
        c->c[i] -= h * c->last.trend[i] * c->h / 2;
        c->g[i] -= h * c->last.trend[i] * c->H;
    }
    copy(c->v_, c->v0, ns);
    response_run(p, c->d, c->c, c->g, c->x, c->v_, c->s_, 0);
}

/* J, G, A and D for the mass as it is now, the slopes as they were frozen. */
static enum status renew(struct subcycle *c, struct trouble *why)
{
    int factored, pivot = response_masses(&c->resp, &factored, c->dec.Mss, c->dec.M);
    c->effort->factors += factored;
    if (pivot >= 0) return singular(c, pivot, why);
    if (c->alpha <= 0) return OK;
    copy(c->near.J, c->resp.J, c->ns * c->ns);
    enum status status = damping(c, why);
    copy(c->resp.J, c->near.J, c->ns * c->ns);
    return status;
}

/* The step once more with W at the average of the ends it has found. */
static enum status symmetric_pass(struct subcycle *c, struct trouble *why)
{
    int ns = c->ns, nl = c->nl;
    compose(c);
    motion_diff(c->ode, c->dq, c->qn, c->q0);
    motion_point(c->ode, c->qbar, c->q0, c->dq, .5);
    zero(c->dsum, ns);
    for (int k = 0; k < c->ratio; k++)
        for (int i = 0; i < ns; i++) c->dsum[i] += c->d[i + k * ns];
    if (c->dec.coupled) dense_gemv(c->du, -1, c->dec.W, c->dsum, nl, ns, nl);
    TRY(decouple_at(c, c->qbar, c->t0 + (c->t1 - c->t0) / 2, why));
    if (c->dec.coupled) dense_gemv(c->du, 1, c->dec.W, c->dsum, nl, ns, nl);
    TRY(renew(c, why));
    c->newton.count = 0;
    return solve(c, why);
}

/* The energy scale of the iteration. */
static void twice_kinetic(struct subcycle *c)
{
    zero(c->r, c->n);
    dense_gemv(c->r, 1, c->dec.M, c->v0, c->n, c->n, c->n);
    c->newton.energy = fmax(c->newton.energy, dot(c->r, c->v0, c->n));
    c->newton.age = 0;
}

static enum status attempt(struct subcycle *c, int passes, struct trouble *why)
{
    newton_begin(&c->newton, c->last.local);
    twice_kinetic(c);
    int changed = c->resp.h != c->h || c->resp.H != c->H || c->resp.ratio != c->ratio;
    if (c->newton.stale || c->local || changed)
        TRY(refresh(c, why));
    else
        TRY(renew(c, why));
    predict(c);
    TRY(solve(c, why));
    for (int pass = 1; pass < passes; pass++) TRY(symmetric_pass(c, why));
    return OK;
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
        fast_move(c, d);
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

/* The step's local errors, h/12 |a_k - a_k-1| summed and H/12 |a_y - a_y,last|, in scales. */
static double local_error(const struct subcycle *c)
{
    double worst = 0;
    for (int i = 0; i < c->ns; i++) {
        double sum = 0, before = c->h * c->last.as[i];
        for (int k = 0; k < c->ratio; k++) {
            double d = c->d[i + k * c->ns];
            sum += fabs(d - before);
            before = d;
        }
        worst = fmax(worst, sum / 12 * c->newton.per[i]);
    }
    for (int i = 0; i < c->nl; i++)
        worst = fmax(worst, fabs(c->du[i] - c->H * c->last.ay[i]) / 12 * c->newton.per[c->ns + i]);
    return worst;
}

/* M as + K_SS x + K_SL y + C v has changed over the major step, between its last minor step and the one
 * before it; what was before is still in c->last. */
static void find_trend(struct subcycle *c, const double *d)
{
    const struct response *p = &c->resp;
    int n = c->n, ns = c->ns, nl = c->nl;
    for (int i = 0; i < ns; i++) {
        c->c[i] = d[i] / c->h - c->last.as[i];
        c->x[i] = c->xn[i] - c->dx[i] / 2 + c->last.dx[i] / 2;
        c->v_[i] = c->dx[i] / c->h - c->last.vs[i];
    }
    for (int i = 0; i < nl; i++) {
        c->Du[i] = (c->H - c->h / 2) * c->w[i] + c->last.y[i];
        c->De[i] = c->w[i] - c->last.w[i];
    }
    zero(c->g, ns);
    dense_gemv(c->g, 1, p->M, c->c, ns, ns, n);
    dense_gemv(c->g, 1, p->K, c->x, ns, ns, n);
    dense_gemv(c->g, 1, p->C, c->v_, ns, ns, n);
    dense_gemv(c->g, 1, p->K + ns * n, c->Du, ns, nl, n);
    dense_gemv(c->g, 1, p->C + ns * n, c->De, ns, nl, n);
    for (int i = 0; i < ns; i++) c->last.trend[i] = c->g[i] / c->H;
}

/* After compose: c->dx, c->vs stand at the last minor step. */
static void remember(struct subcycle *c)
{
    const double *d = c->d + (c->ratio - 1) * c->ns;
    c->last.local = local_error(c);
    find_trend(c, d);
    for (int i = 0; i < c->ns; i++) {
        c->last.as[i] = d[i] / c->h;
        c->last.dx[i] = c->dx[i];
        c->last.vs[i] = c->dx[i] / c->h;
    }
    copy(c->last.aybefore, c->last.ay, c->nl);
    for (int i = 0; i < c->nl; i++) {
        c->last.ay[i] = c->du[i] / c->H;
        c->last.w[i] = c->w[i];
        c->last.y[i] = c->h / 2 * c->w[i];
    }
    c->last.Hbefore = c->last.H;
    c->last.H = c->H;
}

static void accept(struct subcycle *c, struct stepper *s, struct state *x)
{
    int n = c->n;
    s->lost = damped(c);
    s->left = fabs(c->push) * fmin(1, c->newton.remain);
    copy(s->work, c->work, POWER_CHANNELS);
    compose(c);
    remember(c);
    for (int i = 0; i < c->nl; i++) c->u0[i] += c->du[i];
    decouple_out(&c->dec, c->v, c->u0, c->vs);
    for (int i = 0; i < n; i++) x->a[i] = (c->v[i] - x->v[i]) / c->H;
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
    TRY(decouple_at(c, x->q, x->t, why));
    if (s->fresh) forget(c);
    int passes = s->options.symmetric ? PASSES : 1;
    enum status status = attempt(c, passes, why);
    if (status != OK && c->newton.refreshed == 0) { /* with old factors: once more with fresh ones */
        c->newton.stale = 1;
        status = decouple_at(c, x->q, x->t, why);
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
    .rates = 2,
    .order = 2,
    .quadrature = 1,
    .open = open,
    .step = step,
};
