/* subcycle_fast.c -- the minor steps of a sweep, and the correction of d_k in each: r_k,S = 0 (S6), (S8).
 *
 * A sweep corrects every d_k once, with the frozen J (S11).  A minor step whose slopes have changed gets its own J and
 * iterates by itself. */
#include <math.h>

#include "base/scalar.h"
#include "base/stop.h"
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

enum { INNER = 12 };
static const double LEAVES = 1e-2; /* a correction of the first minor step leaves this part of it, at most */

/* es: from the fast rows of the fast bodies to all of (S6), but for the damping. */
INTO static inline void with_slow_bodies(int ns, struct subcycle *c, const double *restrict d)
{
    const double *restrict cs = c->cs, *restrict mean = c->dmean, h = c->h;
    double *restrict es = c->es, *restrict off = c->s1;
    for (int i = 0; i < ns; i++) {
        es[i] = h * es[i] + cs[i];
        off[i] = d[i] - mean[i];
    }
    if (c->dec.reach) gemv_few(es, 1, c->dec.WMW, off, ns, ns, ns);
}

struct instant subcycle_half(const struct subcycle *c)
{
    return (struct instant){
        .q = c->qmid, .v = c->v, .a = c->a, .qa = c->passes ? c->q : NULL, .qb = c->ode->pointwise ? NULL : c->qend};
}

enum status subcycle_minor_rows(struct subcycle *c, int k, double *power, double *dk, struct instant *x,
                                struct trouble *why)
{
    const int ns = c->ns;
    const double *d = c->d + (long)k * ns;
    subcycle_half_way(c, d, k, x->t);
    if (x->qb) subcycle_point(c, c->qend, c->q, 1, x->tb);
    TRY(c->ode->ops->resid(c->ode, c->r, power, dk, x, FAST, why));
    c->effort->fast++;
    decouple_fast(&c->dec, c->es, c->r, c->dec.ml);
    BY_FEW(with_slow_bodies, ns, c, d);
    if (c->alpha > 0) dense_gemv(c->es, c->h * c->h / 2, c->resp.D, c->v, ns, ns, ns);
    return OK;
}

/* Largest correction of a minor step, as the newton iteration will see it over the major step. */
static double minor_error(const struct subcycle *c)
{
    double err = 0;
    for (int i = 0; i < c->ns; i++) err = larger(err, fabs(c->es[i]) * c->newton.per[i] * c->ratio);
    return err;
}

/* es: from the residual to the correction of d. */
INTO static inline void correct(int ns, struct subcycle *c, double *restrict d)
{
    double *restrict es = c->es, *restrict rest = c->rest, square = 0;
    for (int i = 0; i < ns; i++) rest[i] = es[i];
    minor_solve(c->local ? &c->here : &c->resp.one, es, ns);
    for (int i = 0; i < ns; i++) {
        square += rest[i] * es[i];
        d[i] -= es[i];
    }
    c->square += square;
}

/* d_k corrected until it stands by itself, or has had its turn: the next sweep comes back to it. */
APART enum status minor_alone(struct subcycle *c, int k, double *power, struct instant *x, struct trouble *why)
{
    const double enough = larger(.1 * c->newton.tol, 1e-13);
    double before = INFINITY, dk = 0;
    TRY(subcycle_refresh_here(c, x, why));
    for (int inner = 1;; inner++) {
        BY_FEW(correct, c->ns, c, c->d + (long)k * c->ns);
        const double err = minor_error(c);
        if (inner == INNER || err <= enough || (err > .5 * before && err < 1e-7)) return OK;
        const bool slow = err > .1 * before;
        const long fast = c->effort->fast;
        before = err;
        TRY(subcycle_minor_rows(c, k, power, &dk, x, why));
        subcycle_spent(c, SPENT_ON_REPEATED, c->effort->slow, fast);
        sharpened(&dk);
        if (dk > STALE_SLOPE || slow) TRY(subcycle_refresh_here(c, x, why));
    }
}

/* The forecast misses the first minor step most, and what its correction leaves there stands alone: a coarse sweep, which
 * interpolates between other minor steps, does not see it.  So it is corrected once more where one may follow and as little
 * counts, in a stage of a step of order 4; at order 2 that took 3 to 8 percent more fast evaluations, for nothing. */
static enum status first_again(struct subcycle *c, double *power, struct instant *x, struct trouble *why)
{
    const long fast = c->effort->fast;
    double dk = 0;
    if (!subcycle_coarse_blind(c) || minor_error(c) * LEAVES <= c->newton.tol) return OK;
    TRY(subcycle_minor_rows(c, 0, power, &dk, x, why));
    subcycle_spent(c, SPENT_ON_REPEATED, c->effort->slow, fast);
    c->coarse.varied |= sharpened(&dk);
    BY_FEW(correct, c->ns, c, c->d);
    return OK;
}

/* d_k corrected: once, where its slopes have not changed. */
static enum status minor(struct subcycle *c, int k, double *power, struct instant *x, struct trouble *why)
{
    double dk = 0;
    TRY(subcycle_minor_rows(c, k, power, &dk, x, why));
    const bool sharp = sharpened(&dk), changed = dk > STALE_SLOPE;
    c->coarse.varied |= sharp | changed;
    if (changed) return minor_alone(c, k, power, x, why);
    BY_FEW(correct, c->ns, c, c->d + (long)k * c->ns);
    return k == 0 && c->guessed && c->newton.stage ? first_again(c, power, x, why) : OK;
}

/* d of the minor step leaves dsum as it was when the rows were taken; returns the power of the residual. */
INTO static inline double corrected(int ns, double *restrict dsum, double *restrict esum, const double *restrict d,
                                    const double *restrict e, const double *restrict rest, const double *restrict v)
{
    double push = 0;
    for (int i = 0; i < ns; i++) {
        dsum[i] -= d[i] + e[i];
        esum[i] += e[i];
        push += rest[i] * v[i];
    }
    return push;
}

static void minor_sums(struct subcycle *c, const double *d)
{
    const int ns = c->ns;
    vector_move(c->R, c->R, c->h, c->r + ns, c->dec.ml);
    c->push += BY_FEW(corrected, ns, c->dsum, c->esum, d, c->es, c->rest, c->v);
}

void subcycle_rewind(struct subcycle *c)
{
    if (c->passes) copy(c->q, c->q0, c->ode->nq);
    if (c->direct) copy(c->qmid, c->q0, c->ode->nq);
    copy(c->vs, c->v0, c->ns);
    copy(c->xbefore, c->xn, c->ns);
    zero(c->R, c->dec.ml);
    zero(c->xn, c->ns);
    zero(c->esum, c->ns);
}

/* q_k+1 from q_k; the middle, where the fast bodies have just been, is near. */
static void next_point(struct subcycle *c, const double *d, double t)
{
    double *before = c->q;
    if (c->outright) {
        subcycle_fast_velocity(c, d);
        decouple_on(&c->dec, c->q, c->h, c->w, c->v, c->near);
        return;
    }
    subcycle_velocity(c, d);
    copy(c->qnext, c->qmid, c->ode->nq);
    subcycle_onward(c, c->qnext, c->q, 1, t, OPEN_BEFORE);
    c->q = c->qnext;
    c->qnext = before;
}

void subcycle_minor_time(const struct subcycle *c, struct instant *x, int k)
{
    x->ta = c->t0 + k * c->h;
    x->tb = subcycle_minor_end(c, k);
    x->t = x->ta + (x->tb - x->ta) / 2;
}

INTO static inline void keep(int ns, double *restrict to, const double *restrict d)
{
    for (int i = 0; i < ns; i++) to[i] = d[i];
}

enum status subcycle_fast_rows(struct subcycle *c, struct trouble *why)
{
    struct instant x = subcycle_half(c);
    const struct reached from = {c->xn, c->vs, c->w};
    struct forecast *f = &c->forecast;
    subcycle_rewind(c);
    const double *jump = c->guessed ? subcycle_jump(c) : NULL;
    for (int k = 0; k < c->ratio; k++) {
        double *d = c->d + (long)k * c->ns, power[POWER_CHANNELS];
        if (stop) return stop_status();
        subcycle_minor_time(c, &x, k);
        if (c->guessed) {
            forecast_minor(f, &c->resp, d, &from, jump, k);
            BY_FEW(keep, c->ns, c->dbefore + (long)k * c->ns, d);
        }
        TRY(minor(c, k, power, &x, why));
        if (c->guessed) forecast_force(f, &c->resp, d, &from, c->local ? NULL : c->rest, k);
        c->coarse.powered |= subcycle_book(c, c->h, power);
        minor_sums(c, d);
        subcycle_coarse_keep(c, k);
        if (c->passes && k + 1 < c->ratio) { /* where the last one ends is composed when all unknowns are corrected */
            next_point(c, d, x.tb);
            x.qa = c->q;
        }
        subcycle_advance(c, d);
    }
    subcycle_coarse_kept(c);
    c->guessed = 0;
    return OK;
}
