/* sliding.c -- friction of a compliant contact, smooth: against the velocity u across the normal, of at most mu times the
 * push F,
 *
 *     f = -mu F u / sqrt(|u|^2 + v_s^2)
 *
 * so that what should stick creeps: at a share c of the bound with the speed v_s c/sqrt(1 - c^2).  The slope along u and
 * that at right angles, by which Newton's iteration goes on, are mu F v_s^2/(|u|^2 + v_s^2)^(3/2) and
 * mu F/sqrt(|u|^2 + v_s^2); how F changes is left out of them.
 *
 * The contact point is on the surface of the ball, of two balls half-way.  Smooth friction by a square root: Mostaghel & Davis,
 * Earthq. Eng. Struct. Dyn. 26 (1997) 285. */
#include "kind/sliding.h"

#include <math.h>

#include "la/vec3.h"

/* Where the surfaces meet. */
struct meeting {
    double n[3];  /* unit: away from the second surface */
    double at[3]; /* world */
    double s;     /* the measure of the push */
};

static void meet(struct meeting *o, const struct sliding *p, const struct between *x)
{
    double d[3], size, out = p->radius;
    v3_diff(d, x->b.x, x->a.x);
    if (p->pair == PAIR_OUTLINE) {
        double ex[3];
        m3_mul(ex, x->a.E, p->normal);
        o->s = outline_meet(p->outline, o->n, ex, d) - p->radius;
    } else if (p->pair == PAIR_PLANE) {
        m3_mul(o->n, x->a.E, p->normal);
        o->s = v3_dot(o->n, d);
    } else {
        o->s = size = v3_norm(d);
        v3_scale(o->n, size > 0 ? (p->pair == PAIR_HOLE ? -1 : 1) / size : 0, d);
        if (p->pair == PAIR_SPHERES) out = (size + p->radius - p->other) / 2;
    }
    v3_copy(o->at, x->b.x);
    v3_axpy(o->at, -out, o->n);
}

/* Velocity of the place `at` on a marker's body. */
static void velocity_at(double *v, const struct frame *f, const double *at)
{
    double arm[3], turned[3];
    v3_diff(arm, at, f->x);
    v3_cross(turned, f->w, arm);
    v3_sum(v, f->v, turned);
}

/* A unit vector at right angles to n. */
static void across(double *t, const double *n)
{
    const int k = fabs(n[0]) < .6 ? 0 : 1;
    double e[3];
    v3_set(e, k == 0, k == 1, 0);
    v3_axpy(e, -n[k], n);
    v3_scale(t, 1 / v3_norm(e), e);
}

static void add(struct strains *o, const double *dir, double rate, double lost, double slope)
{
    struct strain *s = &o->of[o->n++];
    *s = (struct strain){.rate = rate, .slides = true, .lost = lost, .kv = slope};
    v3_copy(s->dir, dir);
}

/* Along the normal of a curve. */
static void add_push(struct strains *o, const struct sliding *p, const struct meeting *m, double rate)
{
    const double spring = unilateral_push(&p->push, m->s, 0), all = unilateral_push(&p->push, m->s, rate);
    add(o, m->n, rate, all - spring, all > 0 ? unilateral_resistance(&p->push, m->s) : 0);
    struct strain *s = &o->of[o->n - 1];
    s->s = m->s;
    s->V = unilateral_energy(&p->push, m->s);
    s->f = spring;
    s->ks = unilateral_slope(&p->push, m->s);
}

static void strains(struct strains *o, const void *par, const struct between *x)
{
    const struct sliding *p = par;
    struct meeting m;
    double u[3], first[3], t[3], side[3];
    meet(&m, p, x);
    v3_copy(o->at_a, m.at);
    v3_copy(o->at_b, m.at);
    velocity_at(u, &x->b, m.at);
    velocity_at(first, &x->a, m.at);
    v3_take(u, first);
    const double closing = v3_dot(m.n, u);
    if (p->pair == PAIR_OUTLINE) add_push(o, p, &m, closing);
    v3_axpy(u, -closing, m.n);
    const double speed = v3_norm(u), root = sqrt(speed * speed + p->slip * p->slip);
    const double F = p->mu * unilateral_push(&p->push, m.s, p->pair == PAIR_HOLE ? -closing : closing);
    if (x->space == 2)
        v3_set(t, m.n[1], -m.n[0], 0);
    else if (speed > 0)
        v3_scale(t, 1 / speed, u);
    else
        across(t, m.n);
    const double rate = v3_dot(t, u);
    add(o, t, rate, -F * rate / root, F * p->slip / root * p->slip / root / root);
    if (x->space == 2) return;
    v3_cross(side, m.n, t);
    add(o, side, 0, 0, F / root);
}

static void means(struct strains *o, const void *par, const double *s0, const double *s1)
{
    const struct sliding *p = par;
    struct strain *push = &o->of[0];
    if (p->pair == PAIR_OUTLINE) push->f = unilateral_mean_push(&push->ks, &p->push, s0[0], s1[0]);
}

/* Beside a push of its own it has nothing to tell. */
static double clear(const void *par, double s)
{
    return ((const struct sliding *)par)->pair == PAIR_OUTLINE ? s : INFINITY;
}

static double whole(double *at_once, const void *par, double s, double v)
{
    return unilateral_whole(at_once, &((const struct sliding *)par)->push, s, v);
}

const struct force_kind force_sliding = {.name = "sliding",
                                         .brief = "smooth friction of a compliant contact",
                                         .size = sizeof(struct sliding),
                                         .strains = strains,
                                         .means = means,
                                         .clear = clear,
                                         .whole = whole,
                                         .sharp = true};
