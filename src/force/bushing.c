/* bushing.c -- what a bushing does between two markers.
 *
 * In axes of the marker on a: d = E'(x_b - x_a), its rate d' = E'(v_b - v_a - w_a x (x_b - x_a)), the rotation
 * vector phi of b's marker against a's, phi' = T' W.  With V = (d.k d + phi.kr phi)/2 the power is -V' less
 * damping for
 *
 *     F = -(k d + c d')  on b at x_b, -F on a at the same point;     n = -(T kr phi + cr W) on b, -n on a:
 *
 * one line, so both momenta are kept. */
#include "force/parts.h"
#include "la/rot.h"
#include "la/vec3.h"

void bushing_at(struct bush *o, const struct elements *e, const struct sweep *s, const struct model_force *f)
{
    const struct bushing *par = f->par;
    struct pose a, b;
    double xa[3], va[3], vb[3], d[3], rate[3], turned[3], w[3];
    e->ops->pose(s, &a, f->a.body);
    e->ops->pose(s, &b, f->b.body);
    e->ops->point(s, xa, va, f->a.body, f->a.p);
    e->ops->point(s, o->at, vb, f->b.body, f->b.p);
    v3_diff(d, o->at, xa);
    v3_diff(rate, vb, va);
    v3_cross(turned, a.w, d);
    v3_take(rate, turned);
    v3_diff(w, b.w, a.w);
    m3_mulm(o->E, a.R, par->Ea);
    m3_tmul(o->d, o->E, d);
    m3_tmul(o->rate, o->E, rate);
    m3_tmul(o->W, o->E, w);
    if (e->model->space == 2) {
        v3_set(o->phi, 0, 0, o->E[8] * (b.angle - a.angle));
        m3_unit(o->T);
    } else {
        double Eb[9], R[9];
        m3_mulm(Eb, b.R, par->Eb);
        m3_tmulm(R, o->E, Eb);
        vector_of_matrix(o->phi, R);
        vector_rate(o->T, o->phi);
    }
}

double bushing_stored(const struct bush *o, const struct bushing *par)
{
    double V = 0;
    for (int i = 0; i < 3; i++) V += par->k[i] * o->d[i] * o->d[i] + par->kr[i] * o->phi[i] * o->phi[i];
    return .5 * V;
}

void bushing_load(struct elements *e, struct sweep *s, const struct part_of *p, double *r, double *w,
                  struct effect *effect, const struct instant *x)
{
    const struct model_force *f = &e->model->force[p->force];
    const struct bushing *par = f->par;
    struct bush b;
    double F[3], n[3], turn[3], kept = 0, lost = 0, force[3], back[3];
    bushing_at(&b, e, s, f);
    for (int i = 0; i < 3; i++) turn[i] = -par->kr[i] * b.phi[i];
    m3_mul(n, b.T, turn);
    for (int i = 0; i < 3; i++) {
        F[i] = -par->k[i] * b.d[i] - par->c[i] * b.rate[i];
        kept += -par->k[i] * b.d[i] * b.rate[i] + n[i] * b.W[i];
        lost -= par->c[i] * b.rate[i] * b.rate[i] + par->cr[i] * b.W[i] * b.W[i];
        n[i] -= par->cr[i] * b.W[i];
    }
    m3_mul(force, b.E, F);
    v3_scale(back, -1, force);
    e->ops->push(s, f->b.body, b.at, force);
    e->ops->push(s, f->a.body, b.at, back);
    m3_mul(force, b.E, n);
    v3_scale(back, -1, force);
    e->ops->twist(s, f->b.body, force);
    e->ops->twist(s, f->a.body, back);
    if (x->qa && x->qb)
        give_to_rotations(r, p, p->end[0] - p->end[1] - kept * (x->tb - x->ta), p->end[0] + p->end[1], x);
    if (w) w[POWER_DAMPER] += lost;
    if (effect) *effect = (struct effect){v3_norm(F), v3_norm(b.d), kept + lost};
}
