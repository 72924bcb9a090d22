/* subcycle_point.c -- where du and d_k lead: the points of the minor steps (S2)-(S4), and the end of the major one
 * (S9).
 *
 * Where loops are closed and displacements add up (ode2's `straight`) the middle of a minor step is found from q0, by its whole
 * displacement; dependents go on from the middle before it.  q_k then need not be closed at all, and q_n only of the step that
 * has been found.
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

/* The same, and a_k. */
INTO static inline void motion(int ns, double *restrict v, double *restrict a, const double *restrict vs,
                               const double *restrict d, double per)
{
    for (int i = 0; i < ns; i++) {
        v[i] = vs[i] + d[i] / 2;
        a[i] = per * d[i];
    }
}

void subcycle_half_way(struct subcycle *c, const double *d, double t)
{
    const double *from = c->direct ? c->way : c->q;
    BY_FEW(motion, c->ns, c->v, c->a, c->vs, d, 1 / c->h);
    if (c->alpha > 0) dense_gemv(c->v, .5, c->resp.A, d, c->ns, c->ns, c->ns);
    if (c->direct || !c->ode->move) {
        double *to = c->direct ? c->dq : c->qmid;
        decouple_there(&c->dec, c->v, c->a, to, from, c->h / 2, c->w, c->pull, c->near);
        if (c->direct) motion_onward(c->ode, c->qmid, c->q0, c->dq, 1, t, OPEN_BEFORE | OPEN_AFTER);
        return;
    }
    decouple_both(&c->dec, c->v, c->a, c->w, c->pull, c->near);
    copy(c->qmid, c->q, c->ode->nq);
    subcycle_onward(c, c->qmid, c->q, .5, t, OPEN_AFTER);
}

INTO static inline void advance(int ns, double *restrict x, double *restrict vs, const double *restrict v,
                                const double *restrict d, double h)
{
    for (int i = 0; i < ns; i++) {
        x[i] += h * v[i];
        vs[i] += d[i];
    }
}

void subcycle_advance(struct subcycle *c, const double *d)
{
    BY_FEW(advance, c->ns, c->xn, c->vs, c->v, d, c->h);
}

double subcycle_minor_end(const struct subcycle *c, int k)
{
    return k + 1 < c->ratio ? c->t0 + (k + 1) * c->h : c->t1;
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
    if (c->direct)
        copy(c->way, c->dq, c->n);
    else
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
        subcycle_fast_velocity(c, d);
        subcycle_advance(c, d);
        for (int i = 0; i < c->ns; i++) c->dsum[i] += d[i];
    }
}

/* The same where nothing is damped: each coordinate goes by itself. */
static void plain_steps(struct subcycle *c)
{
    const int ns = c->ns, n = c->ratio;
    const double h = c->h;
    for (int i = 0; i < ns; i++) {
        const double *d = c->d + i;
        double vs = c->v0[i], x = 0, sum = 0, v = 0;
        for (int k = 0; k < n; k++, d += ns) {
            v = vs + *d / 2;
            x += h * v;
            vs += *d;
            sum += *d;
        }
        c->v[i] = v, c->vs[i] = vs, c->xn[i] = x, c->dsum[i] = sum;
    }
}

void subcycle_compose(struct subcycle *c)
{
    vector_move(c->w, c->u0, .5, c->du, c->nl);
    if (c->alpha > 0)
        fast_steps(c);
    else
        plain_steps(c);
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
