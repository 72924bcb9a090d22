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

enum status subcycle_minor_rows(struct subcycle *c, const double *d, double *power, double *dk, struct instant *x,
                                struct trouble *why)
{
    int ns = c->ns;
    subcycle_half_way(c, d, x->t);
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

/* d_k corrected: once, or where its slopes have changed until it stands by itself (or has had its turn:
 * the next sweep comes back to it). */
static enum status minor(struct subcycle *c, double *d, double *power, struct instant *x, struct trouble *why)
{
    double enough = larger(.1 * c->newton.tol, 1e-13), before = INFINITY;
    for (int inner = 0, alone = 0, slow = 0; inner < INNER; inner++) {
        double dk = 0;
        const long fast = c->effort->fast;
        TRY(subcycle_minor_rows(c, d, power, &dk, x, why));
        if (inner > 0) subcycle_spent(c, SPENT_ON_REPEATED, c->effort->slow, fast);
        c->coarse.varied |= sharpened(&dk);
        c->coarse.varied |= dk > STALE_SLOPE;
        if (dk > STALE_SLOPE || slow) {
            TRY(subcycle_refresh_here(c, x, why));
            alone = 1;
        }
        BY_FEW(correct, c->ns, c, d);
        double err = alone ? minor_error(c) : 0;
        if (err <= enough || (err > .5 * before && err < 1e-7)) break;
        slow = err > .1 * before;
        before = err;
    }
    return OK;
}

/* d of the minor step leaves dsum as it was when the rows were taken. */
INTO static inline void corrected(int ns, double *restrict dsum, double *restrict esum, const double *restrict d,
                                  const double *restrict e)
{
    for (int i = 0; i < ns; i++) {
        dsum[i] -= d[i] + e[i];
        esum[i] += e[i];
    }
}

INTO static inline double with_power(int ns, double push, const double *rest, const double *v)
{
    for (int i = 0; i < ns; i++) push += rest[i] * v[i];
    return push;
}

static void minor_sums(struct subcycle *c, const double *d)
{
    const int ns = c->ns;
    vector_move(c->R, c->R, c->h, c->r + ns, c->dec.ml);
    BY_FEW(corrected, ns, c->dsum, c->esum, d, c->es);
    c->push = BY_FEW(with_power, ns, c->push, c->rest, c->v);
}

void subcycle_rewind(struct subcycle *c)
{
    copy(c->q, c->q0, c->ode->nq);
    if (c->direct) copy(c->qmid, c->q0, c->ode->nq);
    if (c->direct) zero(c->way, c->n);
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
    if (c->direct || !c->ode->move) {
        subcycle_fast_velocity(c, d);
        decouple_on(&c->dec, c->direct ? c->way : c->q, c->h, c->w, c->v, c->near);
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

enum status subcycle_fast_rows(struct subcycle *c, struct trouble *why)
{
    struct instant x = {.q = c->qmid, .v = c->v, .a = c->a, .qa = c->q, .qb = c->ode->pointwise ? NULL : c->qend};
    struct forecast *f = &c->forecast;
    subcycle_rewind(c);
    const double *jump = c->guessed ? subcycle_jump(c) : NULL;
    for (int k = 0; k < c->ratio; k++) {
        double *d = c->d + (long)k * c->ns, power[POWER_CHANNELS];
        if (stop) return stop_status();
        subcycle_minor_time(c, &x, k);
        if (c->guessed) {
            forecast_minor(f, &c->resp, d, c->xn, c->vs, c->w, jump, k);
            copy(c->dbefore + (long)k * c->ns, d, c->ns);
        }
        TRY(minor(c, d, power, &x, why));
        if (c->guessed) forecast_force(f, &c->resp, d, c->xn, c->vs, c->w, c->local ? NULL : c->rest, k);
        c->coarse.powered |= subcycle_book(c, c->h, power);
        minor_sums(c, d);
        subcycle_coarse_keep(c, k);
        if (k + 1 < c->ratio) {
            next_point(c, d, x.tb);
            x.qa = c->q;
        } else { /* nobody asks where the last one ends: that is composed when all unknowns are corrected */
            subcycle_fast_velocity(c, d);
        }
        subcycle_advance(c, d);
    }
    c->guessed = 0;
    return OK;
}
