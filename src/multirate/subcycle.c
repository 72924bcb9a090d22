/* subcycle.c -- energy-consistent, inertially decoupled sub-cycling
 *
 * Slow coordinates L take major steps H = n h, fast ones S minor steps h.  With W and P of decouple.h
 * from M^ at the start of the step, q = q0 (+) P (y, x), the unknowns are du and d_k = dv_S,k, k = 0..n-1:
 *
 *     base      W = M_LL^-1 M_LS,   v = P (u, v_S),   u0 = v_L + W v_S                                      (S1)
 *     slow      w = u0 + du/2,   y moves by h w in each minor step                                          (S2)
 *     fast      dx_k = h (v_S,k + B d_k/2),   v_S,k+1 = v_S,k + d_k                                         (S3)
 *     point     q_k+1/2 = q_k (+) P (h w, dx_k) / 2,   v_k = P (w, dx_k / h),   a_k = P (du/n, d_k) / h     (S4)
 *     slow bodies, once per sweep, at the average of the two ends and the mean acceleration:
 *               r_s = H r_slow(qbar, vbar, P (du, sum d) / H),  qbar = q_0 (+) (q_n (-) q_0)/2,
 *               vbar = (q_n (-) q_0)/H                                                                      (S5)
 *     minor     r_k = P' { h r_fast(q_k+1/2, v_k, a_k) + r_s / n },
 *               r_k,S += W' M_s W (d_k - sum d / n) + h D dx_k / 2                                          (S6)
 *     damping   A = alpha (M~_SS + X)^-1 X,  X = (h^2/4) K~_SS,  D = K~_SS A,  B = 1 + A,
 *               alpha = (1 - rho)/(1 + rho)                                                                 (S7)
 *     equations r_k,S = 0 for all k,   R = sum r_k,L = 0                                                    (S8)
 *     end       q1 = q_n,   v1 = P (u0 + du, v_S,n)                                                         (S9)
 *
 * For constant symmetric M^ > 0, K >= 0, C >= 0: multiply R by w and r_k,S by dx_k/h and add.  Forces
 * are constant over segments and taken at their midpoints, so potentials give V1 - V0 (slow ones over
 * the whole step); w is the mean of u and, without common inertia, the inertia of S gives the change
 * of its energy; dampers take h v'C v.  Hence
 *
 *     E1 - E0 = - sum (d' M~_SS A d + dx' D dx)/2 - h v'C v <= 0                                            (S10)
 *
 * for any partition, any n, any h.  The slow bodies' inertia M_s is in r_s by its mean over the step; how
 * the minor steps differ from the mean adds up to nothing in the slow rows, and in the fast ones is W' M_s W
 * (d_k - sum d / n), with M_s of the start.  For constant M_s this is the same as M_s P (du/n, d_k) in every
 * minor step; else the difference is of third order.  Velocities other than P (w, dx/h) in dampers or gyroscopic
 * forces, or slow bodies at the mean of the minor midpoints, break the identity and the stability with it.
 *
 * Where M^ depends on q the identity is no longer exact.  W at the average of both ends
 * (`symmetric`) makes the step symmetric in time, and the energy error does not drift.
 *
 * One Newton iteration for the whole major step: each sweep corrects every d_k once, with J (S11), and the slow
 * unknown through the linearized answer of the minor steps (S12), both of response.h.  As a rule two sweeps are
 * enough: one through all minor steps from a prediction (forecast.h, subcycle_jump.c), and a coarse one through a
 * few of them (subcycle_coarse.c). */
#include "engine/stepper.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/scalar.h"

#include "engine/composed.h"
#include "engine/midpoint.h"
#include "engine/stepped.h"
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

static const double AT_REST =
    1e-3; /* of the largest velocity scale: what is slower counts as at rest in the energy norm */
static const double LEAVES = .2; /* a coarse sweep that comes third leaves this part of the error, at least */

enum { LEAST_CAPACITY = 64, SWEEPS = 16 };

static void reserve(struct subcycle *c, int ratio, struct arena *life)
{
    if (ratio <= c->capacity) return;
    c->capacity = ratio < LEAST_CAPACITY ? LEAST_CAPACITY : ratio;
    c->d = TAKE_MATRIX(life, double, c->ns, c->capacity);
    c->dbefore = TAKE_MATRIX(life, double, c->ns, c->capacity);
    c->coarse.rows = TAKE_MATRIX(life, double, c->dec.ml, c->capacity);
}

static void take_vectors(struct subcycle *c, struct arena *life)
{
    double **slow[] = {&c->du, &c->u0, &c->w, &c->pull, &c->R, &c->slow, &c->Du};
    double **fast[] = {&c->vs, &c->dx, &c->xn,   &c->xbefore, &c->dsum, &c->dmean, &c->esum,
                       &c->es, &c->cs, &c->rest, &c->s1,      &c->s2,   &c->s3,    &c->xmid};
    double **place[] = {&c->q, &c->qmid, &c->qend, &c->qnext, &c->qn, &c->qbar, &c->qcentre};
    double **whole[] = {&c->dq, &c->v, &c->a, &c->r, &c->vbar, &c->abar, &c->sum, &c->none};
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
    c->plain = implicit_new(s, &midpoint_rule, life);
    newton_open(&c->newton, o, &s->effort, &s->options, life);
    c->newton.limit = SWEEPS;
    c->newton.pairs = 1;
    decouple_open(&c->dec, o, &s->effort, life);
    response_open(&c->resp, &c->dec, life);
    c->resp.damps = c->alpha > 0;
    minor_open(&c->here, &c->resp, life);
    forecast_open(&c->forecast, &c->dec, life);
    c->near = o->move ? c->nl : c->dec.ml;
    c->direct = o->straight && o->pointwise && o->move && o->move->onward;
    c->outright = c->direct || !o->move;
    c->passes = !c->outright || !o->pointwise;
    take_vectors(c, life);
    subcycle_last_open(c, life);
    subcycle_coarse_open(c, life);
    subcycle_resolve_open(c, life);
    reserve(c, LEAST_CAPACITY, life);
    subcycle_error_open(c, life);
}

/* ---- the iteration ----------------------------------------------------------------------------- */

/* Sum over the minor steps of what a sweep has changed d_k by. */
INTO static inline void changes(int ns, double *restrict sum, const double *restrict d, const double *restrict before,
                                int ratio)
{
    for (int i = 0; i < ns; i++) sum[i] = 0;
    for (int k = 0; k < ratio; k++, d += ns, before += ns)
        for (int i = 0; i < ns; i++) sum[i] += fabs(d[i] - before[i]);
}

/* Has the sweep converged?  By its corrections: of du, and of d_k summed over the minor steps. */
static enum verdict judge(struct subcycle *c)
{
    double err = 0, small = 0, sum = 0, light = 0;
    const double most = 1 / larger(AT_REST * c->newton.top, DBL_MIN);
    for (int i = 0; i < c->nl; i++) c->sum[c->ns + i] = fabs(c->Du[i]);
    BY_FEW(changes, c->ns, c->sum, c->d, c->dbefore, c->ratio);
    for (int i = 0; i < c->n; i++) {
        double e = c->sum[i] * c->newton.per[i];
        sum += c->sum[i];
        if (c->sum[i] > small) small = c->sum[i];
        light = larger(light, smaller(e, c->sum[i] * most));
        if (e > err) {
            err = e;
            c->newton.worst = i;
        }
    }
    c->newton.light = light;
    struct instant start = {.t = c->t0, .q = c->q0, .v = c->v0, .ta = c->t0, .tb = c->t0};
    return newton_judge(&c->newton, isfinite(sum) ? err : NAN, small, c->square, &start);
}

/* Slow bodies, then all or a few minor steps. */
static enum status rows(struct subcycle *c, struct trouble *why)
{
    struct effort *e = c->effort;
    const enum spent_on whole = c->newton.count == 0   ? SPENT_ON_FIRST
                                : c->newton.count == 1 ? SPENT_ON_SECOND
                                                       : SPENT_ON_MORE;
    const long slow = e->slow, fast = e->fast, again = e->spent[SPENT_ON_REPEATED].fast;
    TRY(subcycle_slow_bodies(c, why));
    TRY(c->coarse.on ? subcycle_coarse_rows(c, why) : subcycle_fast_rows(c, why));
    subcycle_spent(c, c->coarse.on ? whole + 1 : whole, slow, fast + e->spent[SPENT_ON_REPEATED].fast - again);
    return OK;
}

static enum status sweep(struct subcycle *c, enum verdict *verdict, struct trouble *why)
{
    bool moved = false;
    zero(c->work, POWER_CHANNELS);
    c->push = c->square = c->newton.flow = 0;
    memcpy(c->dbefore, c->d, (size_t)c->ns * (size_t)c->ratio * sizeof *c->d);
    subcycle_compose(c);
    TRY(subcycle_follow(c, &moved, why));
    c->coarse.on &= !moved;
    TRY(rows(c, why));
    subcycle_slow_rows(c);
    c->newton.leaves = c->coarse.on && c->newton.count > 1 ? LEAVES : 0;
    *verdict = judge(c);
    return OK;
}

/* Sweeps, from the present du and d_k, until these have converged. */
static enum status solve(struct subcycle *c, struct trouble *why)
{
    for (;;) {
        enum verdict verdict;
        TRY(sweep(c, &verdict, why));
        c->coarse.on = verdict == CONTINUE && !c->coarse.powered && !c->coarse.varied && subcycle_coarse_next(c);
        if (verdict == CONVERGED) return OK;
        if (verdict == REFRESH) TRY(subcycle_refresh(c, why));
        if (verdict == FAILED)
            return trouble_set(why, TROUBLE_DIVERGED, c->newton.worst, c->newton.last / c->newton.tol, c->t0);
    }
}

/* The energy scale of the iteration, twice the kinetic energy: from M^ where it has been formed. */
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

static enum status attempt(struct subcycle *c, struct trouble *why)
{
    c->newton.steps = c->newton.stage ? sqrt(c->ratio) : c->ratio;
    subcycle_coarse_plan(c);
    newton_begin(&c->newton, c->last_local);
    energy_scale(c);
    if (subcycle_refresh_due(c))
        TRY(subcycle_refresh(c, why));
    else
        TRY(subcycle_renew(c, why));
    forecast_begin(&c->forecast);
    forecast_make(&c->forecast, &c->resp, c->du, c->d, c->u0, c->v0);
    c->guessed = 1;
    TRY(solve(c, why));
    if (!c->again) return OK;
    TRY(subcycle_centre_again(c, why));
    c->newton.count = 0;
    return solve(c, why);
}

/* ---- the step ---------------------------------------------------------------------------------- */

static void forget(struct subcycle *c)
{
    newton_forget(&c->newton);
    newton_scale(&c->newton, c->v0, c->a0, c->H);
    forecast_forget(&c->forecast, &c->dec, c->a0, c->v0, c->u0, c->H);
    c->last.h = 0;
    c->coarse.rest = 0;
    c->coarse.missed = c->coarse.whole = 0;
    c->last_local = -1;
}

static void begin(struct subcycle *c, const struct state *x, double h, int ratio, double to)
{
    c->h = h;
    c->H = h * ratio;
    c->ratio = ratio;
    c->ended = c->halved = false;
    c->t0 = x->t;
    c->t1 = to;
    c->q0 = x->q;
    c->v0 = x->v;
    c->a0 = x->a;
}

/* Without fast coordinates. */
static enum status single_rate(struct subcycle *c, struct stepper *s, struct state *x, struct trouble *why)
{
    copy(c->v, x->v, c->n);
    copy(c->a, x->a, c->n);
    TRY(implicit_once(c->plain, s, x, c->H, c->t1, why));
    s->effort.minors++;
    for (int i = 0; i < c->n; i++) c->dq[i] = x->v[i] - c->v[i];
    if (c->looked) subcycle_error_single(c, c->dq, c->a);
    return OK;
}

static enum status two_rates(struct subcycle *c, struct stepper *s, struct state *x, int ratio, struct trouble *why)
{
    long before = s->effort.sweeps;
    reserve(c, ratio, s->life);
    TRY(subcycle_centre(c, &s->options, s->fresh, why));
    if (s->fresh) forget(c);
    enum status status = attempt(c, why);
    if (status != OK && c->newton.refreshed == 0) { /* with old factors: once more with fresh ones */
        c->newton.stale = 1;
        decouple_failed(&c->dec);
        status = subcycle_centre(c, &s->options, true, why);
        if (status == OK) status = attempt(c, why);
    }
    s->last_sweeps = (int)(s->effort.sweeps - before);
    if (status == OK) {
        status = subcycle_accept(c, s, x, why);
        s->fresh = status != OK; /* what predicts has gone ahead */
    }
    if (status != OK) {
        c->newton.stale = 1;
        c->last.h = 0;
    }
    return status;
}

/* A major step that has been halved down to one minor step and still does not converge is taken by the midpoint
 * rule, whose matrix has all of the coupling: with a light body between heavy ones (S11) and (S12) converge at
 * uselessly small steps only. Only with fixed steps; with a tolerance the scheme takes smaller ones itself. */
static enum status one_rate_instead(struct subcycle *c, struct stepper *s, struct state *x, struct trouble *why)
{
    const bool looked = c->looked;
    zero(s->work, POWER_CHANNELS);
    s->lost = s->left = 0;
    s->fresh = 1;
    c->plain->hfactor = 0;
    c->plain->newton.stale = 1;
    c->looked = false;
    const enum status status = single_rate(c, s, x, why);
    c->looked = looked;
    s->fresh = 1;
    return status;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct subcycle *c = s->self;
    begin(c, x, h, ratio, to);
    c->looked = subcycle_error_looks(s);
    enum status status = c->ns == 0 ? single_rate(c, s, x, why) : two_rates(c, s, x, ratio, why);
    if (c->looked) subcycle_error_note(s, status == OK);
    if (status == E_NUMERIC && ratio == 1 && c->ns > 0 && s->missed) return one_rate_instead(c, s, x, why);
    return status;
}

static enum status recall(struct stepper *s, struct recall *r)
{
    struct subcycle *c = s->self;
    subcycle_error_recall(c, r);
    if (c->ns == 0) return implicit_remember(c->plain, r);
    newton_recall(&c->newton, r);
    forecast_recall(&c->forecast, r);
    subcycle_last_recall(c, r);
    copy(c->dec.W, c->last.W, c->nl * c->ns);
    recall_one(r, "reach", c->dec.reach);
    subcycle_coarse_recall(c, r);
    subcycle_resolve_recall(c, r);
    recall_one(r, "last_local", c->last_local);
    recall_one(r, "local", c->local);
    recall_one(r, "structured", c->dec.structured);
    if (!c->dec.structured) TRY(response_need(&c->resp, c->t0, NULL));
    decouple_recall(&c->dec, r);
    response_recall(&c->resp, &c->dec, r);
    return OK;
}

static const struct key keys[] = {
    KEY_RHO_INFINITY,
    PARAM_BOOL(struct step_options, symmetric, "symmetric", KEY_NEUTRAL, "false",
               "decoupling at the average of both ends, a second pass"),
    KEY_ORDER,
    KEY_NEWTON_TOLERANCE,
    KEY_TOLERANCE,
    KEYS_END,
};

#define SUBCYCLE                                                                                                       \
    .name = "subcycle",                                                                                                \
    .brief = "energy-consistent sub-cycling, inertially decoupled: slow parts in steps of ratio * step", .keys = keys, \
    .single = &step_midpoint, .two_rates = true, .fits = composed_fits, .order = 2, .keeps = true,                     \
    .late = stepped_late, .error = subcycle_error, .error_end = subcycle_error_end, .keep = subcycle_error_keep
extern const struct stepper_kind step_subcycle;
static const struct stepped_scheme by_error = STEPPED(&step_subcycle, NULL);
static const struct stepper_kind tolerant = {SUBCYCLE, TOLERANT(&by_error)};
static const struct stepper_kind fourth = {SUBCYCLE, COMPOSED(&step_subcycle)};
const struct stepper_kind step_subcycle = {SUBCYCLE,     .tolerant = &tolerant, .fourth = &fourth,
                                           .open = open, .step = step,          .recall = recall};
