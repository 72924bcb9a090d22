/* subcycle_coupling.c -- the error of the fast coordinates that comes from the slow ones, which move along a
 * straight line in a major step.
 *
 * The slow displacement y should be u0 t + a t^2/2, and is (u0 + a H/2) t: too large by a t (H - t)/2 on the way,
 * too fast by a (H/2 - t).  And the part of the slow bodies in the fast rows is constant, the mean of what should
 * vary over the step.  So the accelerations of the fast coordinates are off by a sawtooth and a parabola,
 *
 *     s (1 - 2 t/H) + p t (H - t),                                                                          (S13)
 *
 * which begin anew with each major step; s is proportional to H, p does not depend on it.  At the start of a step
 * the accelerations jump by s + s_last, their rates by p (H + H_last).  Both jumps are found from the d_k on either
 * side, extrapolated to the start by a parabola through three of them, or a line through two.  At the end of the
 * step coordinates without springs are off by
 *
 *     x: s H^2/6 + p H^4/12,      v: p H^3/6,                                                               (S14)
 *
 * with springs by M^-1 K s H^3/12 less in v.  Stiff coordinates are off by less than that, by 2 s/omega^2 and 2 p
 * H/omega^2. With A = (M + (H^2/12) K)^-1 M both limits are met by
 *
 *     v = A p H^3/6 - (6/H) (1 - A) x,   x = A s H^2/6,   and (H/2) A A p H^3/6 more in x.                    (S15) */
#include <math.h>

#include "base/scalar.h"
#include "la/dense.h"
#include "multirate/subcycle_parts.h"

enum { LINE = 2, PARABOLA = 3 };

void subcycle_coupling_open(struct subcycle *c, struct arena *life)
{
    struct subcycle_coupling *o = &c->error->coupling;
    double **fast[] = {&o->tail, &o->rate, &o->s,  &o->new_tail, &o->new_rate, &o->new_s,
                       &o->x,    &o->p,    &o->dx, &o->dv,       &o->position, &o->velocity};
    for (size_t i = 0; i < sizeof fast / sizeof *fast; i++) *fast[i] = TAKE(life, double, c->ns);
    o->stiff = TAKE_MATRIX(life, double, c->ns, c->ns);
}

/* Extrapolates the accelerations d/h of coordinate i, from minor step `one` and those behind it (way: 1) or before
 * it (-1), to the end of `one` that they come from: the acceleration there, and its rate. */
static double led(const struct subcycle *c, double *rate, int i, int one, int way)
{
    const double *d = c->d + i, per = 1 / c->h;
    const long ns = c->ns;
    const double a = per * d[one * ns], b = per * d[(one + way) * ns];
    if (c->ratio < PARABOLA) {
        *rate = way * (b - a) / c->h;
        return (3 * a - b) / 2;
    }
    const double z = per * d[(one + 2 * way) * ns];
    *rate = way * (3 * b - 2 * a - z) / c->h;
    return (15 * a - 10 * b + 3 * z) / 8;
}

/* s and p of this step, and its accelerations extrapolated to its end. */
static void jumps(struct subcycle *c)
{
    struct subcycle_coupling *o = &c->error->coupling;
    const double last = c->error->slow.h, whole = c->H + last;
    const bool rates = c->ratio >= PARABOLA && o->terms >= PARABOLA && last > 0;
    for (int i = 0; i < c->ns; i++) {
        double rate;
        const double begin = led(c, &rate, i, 0, 1), before = o->terms > 0 ? o->tail[i] : c->a0[i];
        o->new_s[i] = (begin - before) * c->H / whole;
        o->p[i] = rates ? (rate - o->rate[i]) / whole : 0;
        o->new_tail[i] = led(c, &o->new_rate[i], i, c->ratio - 1, -1);
    }
}

/* o->stiff := M + (H^2/12) K, factored; false: it is not positive definite. */
static bool stiffen(struct subcycle *c)
{
    struct subcycle_coupling *o = &c->error->coupling;
    const double s = c->H * c->H / 24, *K = c->resp.one.K;
    const int n = c->n, ns = c->ns;
    for (int j = 0; j < ns; j++)
        for (int i = 0; i < ns; i++) o->stiff[i + j * ns] = c->dec.Mss[i + j * ns] + s * (K[i + j * n] + K[j + i * n]);
    return dense_cholesky(o->stiff, ns, ns) < 0;
}

/* x := A x. */
static void give_way(struct subcycle *c, double *x)
{
    zero(c->s1, c->ns);
    dense_gemv(c->s1, 1, c->dec.Mss, x, c->ns, c->ns, c->ns);
    copy(x, c->s1, c->ns);
    dense_cholesky_solve(c->error->coupling.stiff, x, c->ns, c->ns);
}

void subcycle_coupling_measure(struct subcycle *c)
{
    struct subcycle_error *e = c->error;
    struct subcycle_coupling *o = &e->coupling;
    const int ns = c->ns;
    const double H = c->H;
    o->new_terms = c->ratio < LINE ? 0 : c->ratio;
    zero(o->position, ns);
    zero(o->velocity, ns);
    if (c->ratio < LINE) return;
    jumps(c);
    const bool sprung = stiffen(c);
    for (int i = 0; i < ns; i++) {
        o->x[i] = o->new_s[i] * H * H / 6;
        o->p[i] *= H * H * H / 6;
    }
    if (sprung) give_way(c, o->x);
    if (sprung) give_way(c, o->p);
    copy(o->dx, o->p, ns);
    copy(o->dv, o->x, ns);
    if (sprung) give_way(c, o->dx);
    if (sprung) give_way(c, o->dv);
    for (int i = 0; i < ns; i++) {
        o->position[i] = fabs(o->x[i] + H / 2 * o->dx[i]);
        o->velocity[i] = fabs(o->p[i] - 6 / H * (o->x[i] - o->dv[i]));
        e->position[i] += o->position[i];
        e->velocity[i] += o->velocity[i];
    }
}

/* The last accelerations of the step before were too small by s: corrected by it they count as those of a step of
 * length 0 that ends where this one begins. */
void subcycle_coupling_before(struct subcycle *c)
{
    struct subcycle_error *e = c->error;
    const struct subcycle_coupling *o = &e->coupling;
    if (o->terms < LINE) return;
    for (int i = 0; i < c->ns; i++) e->minor.mean[i] = o->tail[i] + o->s[i];
    e->minor.h = 0;
    e->minor.known = 1;
}

/* Extrapolated by the rate in the step before, less that of its sawtooth: a line through the corrected acceleration
 * at the start would carry the error of that into any step. */
void subcycle_coupling_end(struct subcycle *c, const double *a)
{
    struct subcycle_error *e = c->error;
    const struct subcycle_coupling *o = &e->coupling;
    if (o->terms < LINE) return;
    for (int i = 0; i < c->ns; i++)
        e->more[i] = a[i] - e->minor.mean[i] - c->h / 2 * (o->rate[i] + 2 * o->s[i] / e->slow.h);
}

void subcycle_coupling_keep(struct subcycle *c)
{
    struct subcycle_coupling *o = &c->error->coupling;
    copy(o->tail, o->new_tail, c->ns);
    copy(o->rate, o->new_rate, c->ns);
    copy(o->s, o->new_s, c->ns);
    o->terms = o->new_terms;
}

void subcycle_coupling_recall(struct subcycle *c, struct recall *r)
{
    struct subcycle_coupling *o = &c->error->coupling;
    recall_within(r, "coupling");
    recall_list(r, "tail", o->tail, (size_t)c->ns);
    recall_list(r, "rate", o->rate, (size_t)c->ns);
    recall_list(r, "s", o->s, (size_t)c->ns);
    recall_one(r, "terms", o->terms);
    recall_without(r);
}
