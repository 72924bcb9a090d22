/* subcycle_point.c -- where du and d_k lead: the points of the minor steps (S2)-(S4), and the end of the major one
 * (S9).
 *
 * Where displacements add up (ode2's `straight`) the middle of a minor step is found from q0, by its whole displacement; if
 * nothing looks at the ends of minor steps, q_k then need not be known at all.  Where loops are closed, dependents go on from the
 * middle before it, and q_n is closed only of the step that has been found.
 *
 * The minor steps move only what fast bodies and elements know of the slow coordinates, the first `near`; the
 * others follow at the end (all of them where positions have a move of their own). */
#include <math.h>

#include "la/dense.h"
#include "multirate/subcycle_parts.h"

/* v_k of d_k in the fast rows, as if nothing were damped. */
INTO static inline void midway(int ns, double *restrict v, const double *restrict vs, const double *restrict d)
{
    for (int i = 0; i < ns; i++) v[i] = vs[i] + d[i] / 2;
}

void subcycle_fast_velocity(struct subcycle *c, const double *d)
{
    BY_FEW(midway, c->ns, c->v, c->vs, d);
    if (c->alpha > 0) dense_gemv(c->v, .5, c->resp.A, d, c->ns, c->ns, c->ns);
}

void subcycle_velocity(struct subcycle *c, const double *d)
{
    subcycle_fast_velocity(c, d);
    decouple_out(&c->dec, c->v, c->w, c->v, c->near);
}

void subcycle_point(struct subcycle *c, double *x1, const double *x0, double s, double t)
{
    int m = c->ns + c->near;
    if (c->ode->move) {
        for (int i = 0; i < m; i++) c->dq[i] = c->h * c->v[i];
        c->ode->move->point(c->ode, x1, x0, c->dq, s, t);
    } else {
        const double *restrict v = c->v, step = s * c->h;
        for (int i = 0; i < m; i++) x1[i] = x0[i] + step * v[i];
    }
}

void subcycle_onward(struct subcycle *c, double *x1, const double *x0, double s, double t, int open)
{
    if (!c->ode->move || !c->ode->move->onward) {
        subcycle_point(c, x1, x0, s, t);
        return;
    }
    for (int i = 0; i < c->n; i++) c->dq[i] = c->h * c->v[i];
    c->ode->move->onward(c->ode, x1, x0, c->dq, s, t, open);
}

/* The same, a_k, and x half-way. */
INTO static inline void motion(int ns, double *restrict v, double *restrict a, double *restrict x,
                               const double *restrict vs, const double *restrict xn, const double *restrict d, double h)
{
    for (int i = 0; i < ns; i++) {
        const double vi = vs[i] + d[i] / 2;
        v[i] = vi;
        a[i] = d[i] / h;
        x[i] = xn[i] + h / 2 * vi;
    }
}

void subcycle_half_way(struct subcycle *c, const double *d, int k, double t)
{
    BY_FEW(motion, c->ns, c->v, c->a, c->xmid, c->vs, c->xn, d, c->h);
    if (c->alpha > 0) {
        dense_gemv(c->v, .5, c->resp.A, d, c->ns, c->ns, c->ns);
        vector_move(c->xmid, c->xn, c->h / 2, c->v, c->ns);
    }
    if (c->outright) {
        const struct decouple_there there = {.v = c->v,
                                             .a = c->a,
                                             .q1 = c->direct ? c->dq : c->qmid,
                                             .q0 = c->direct ? c->none : c->q0,
                                             .x = c->xmid,
                                             .y = c->w,
                                             .b = c->pull,
                                             .s = (k + .5) * c->h};
        decouple_there(&c->dec, &there, c->near);
        if (c->direct) motion_onward(c->ode, c->qmid, c->q0, c->dq, 1, t, OPEN_BEFORE | OPEN_AFTER);
        return;
    }
    decouple_both(&c->dec, c->v, c->a, c->w, c->pull, c->near);
    copy(c->qmid, c->q, c->ode->nq);
    subcycle_onward(c, c->qmid, c->q, .5, t, OPEN_AFTER);
}

INTO static inline void advance(int ns, double *restrict v, double *restrict x, double *restrict vs,
                                const double *restrict d, double h)
{
    for (int i = 0; i < ns; i++) {
        const double vi = vs[i] + d[i] / 2;
        v[i] = vi;
        x[i] += h * vi;
        vs[i] += d[i];
    }
}

/* The same where A is not zero. */
APART void advance_damped(struct subcycle *c, const double *d)
{
    const int ns = c->ns;
    subcycle_fast_velocity(c, d);
    vector_move(c->xn, c->xn, c->h, c->v, ns);
    vector_move(c->vs, c->vs, 1, d, ns);
}

void subcycle_advance(struct subcycle *c, const double *d)
{
    if (c->alpha > 0)
        advance_damped(c, d);
    else
        BY_FEW(advance, c->ns, c->v, c->xn, c->vs, d, c->h);
}

/* dq := P (k h w, x_k). */
static void displacement(struct subcycle *c, int k)
{
    const double time = k < c->ratio ? k * c->h : c->H;
    copy(c->dq, c->xn, c->ns);
    vector_times(c->dq + c->ns, time, c->w, c->nl);
    decouple_recoil(&c->dec, c->dq + c->ns, -1, c->xn);
}

void subcycle_place(struct subcycle *c, int k)
{
    displacement(c, k);
    motion_point(c->ode, c->q, c->q0, c->dq, 1, k < c->ratio ? c->t0 + k * c->h : c->t1);
}

/* q_n, v_S,n and x_n by all minor steps, one after the other. */
static void by_steps(struct subcycle *c)
{
    copy(c->vs, c->v0, c->ns);
    zero(c->xn, c->ns);
    copy(c->qn, c->q0, c->ode->nq);
    for (int k = 0; k < c->ratio; k++) {
        const double *d = c->d + (long)k * c->ns;
        subcycle_velocity(c, d);
        subcycle_advance(c, d);
        subcycle_point(c, c->qn, c->qn, 1, subcycle_minor_end(c, k));
    }
}

/* q_n = q_0 (+) P (H w, x_n), where that is the same. */
static void in_one_go(struct subcycle *c)
{
    displacement(c, c->ratio);
    if (c->direct) {
        copy(c->qn, c->qmid, c->ode->nq);
        motion_onward(c->ode, c->qn, c->q0, c->dq, 1, c->t1, OPEN_BEFORE);
        return;
    }
    if (c->ended)
        motion_again(c->ode, c->qn, c->q0, c->dq, 1, c->t1, 0);
    else
        motion_point(c->ode, c->qn, c->q0, c->dq, 1, c->t1);
    c->ended = true;
}

/* All minor steps of the fast coordinates; v stands in the last one. */
static void fast_steps(struct subcycle *c)
{
    copy(c->vs, c->v0, c->ns);
    zero(c->xn, c->ns);
    zero(c->dsum, c->ns);
    for (int k = 0; k < c->ratio; k++) {
        const double *d = c->d + (long)k * c->ns;
        subcycle_advance(c, d);
        for (int i = 0; i < c->ns; i++) c->dsum[i] += d[i];
    }
}

/* The same where nothing is damped. */
INTO static inline void plain_steps(int ns, double *restrict v, double *restrict x, double *restrict vs,
                                    double *restrict sum, const double *restrict v0, const double *restrict d, double h,
                                    int n)
{
    for (int i = 0; i < ns; i++) vs[i] = v0[i], x[i] = sum[i] = 0;
    for (int k = 0; k < n; k++, d += ns)
        for (int i = 0; i < ns; i++) {
            const double vi = vs[i] + d[i] / 2;
            v[i] = vi;
            x[i] += h * vi;
            vs[i] += d[i];
            sum[i] += d[i];
        }
}

void subcycle_compose(struct subcycle *c)
{
    vector_move(c->w, c->u0, .5, c->du, c->nl);
    if (c->alpha > 0)
        fast_steps(c);
    else
        BY_FEW(plain_steps, c->ns, c->v, c->xn, c->vs, c->dsum, c->v0, c->d, c->h, c->ratio);
    if (!c->direct) subcycle_end(c);
}

void subcycle_end(struct subcycle *c)
{
    const bool straight = !c->ode->move || c->ode->straight;
    if (straight) in_one_go(c);
    if (!straight || isnan(c->qn[0])) by_steps(c);
}

double subcycle_middle(struct subcycle *c)
{
    const double mid = c->t0 + (c->t1 - c->t0) / 2;
    if (!c->direct) {
        motion_diff(c->ode, c->dq, c->qn, c->q0);
        motion_point(c->ode, c->qbar, c->q0, c->dq, .5, mid);
        return mid;
    }
    displacement(c, c->ratio);
    if (c->halved)
        c->ajar = motion_again(c->ode, c->qbar, c->q0, c->dq, .5, mid, OPEN_AFTER | (c->ajar ? OPEN_BEFORE : 0));
    else
        c->ajar = motion_first(c->ode, c->qbar, c->q0, c->dq, .5, mid);
    c->halved = true;
    return mid;
}
