/* tangent.c -- see tangent.h */
#include "engine/tangent.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/accel.h"
#include "engine/adaptive.h"
#include "engine/missed.h"
#include "engine/motion.h"

/* Displacement from look to look in usual sizes, or time in 1/omega: with fixed steps, where looks are expensive
 * beside a step; with steps that the scheme chooses. */
static const double FAR = .8, NEAR = .4;
static const double COARSE = 3;      /* times as far where looks run short */
static const double QUICK = .2;      /* from which two jumps do not stand for how time changes forces, */
static const double FADES = .3;      /* and what counts of it at the next look */
enum { AT_ONCE = 20 };               /* looks that are allowed from the start, */
enum { STEPS = 200, OWN_STEPS = 4 }; /* and one more with so many fixed steps, with so many chosen ones */

void tangent_open(struct stepper *s, bool timed, struct arena *life)
{
    struct tangent *o = s->tangent = TAKE(life, struct tangent, 1);
    o->q = TAKE(life, double, s->ode->nq);
    o->u = TAKE(life, double, 1);
    o->b = TAKE(life, double, 1);
    o->timed = timed;
    o->apart = s->kind->adaptive ? NEAR : FAR;
    o->usual = ode2_usual(s->ode, 0);
}

/* omega of the motion about the last look, or its rate of growth [1/s]. */
static double frequency(const struct tangent *o)
{
    return sqrt(fabs(o->A));
}

/* ---- from step to step ----------------------------------------------------------------------------------------- */

/* tau, the part along f = (v, a), of the difference (x, y), by the frequency w. */
static double along(double x, double y, double v, double a, double w)
{
    const double norm = a * a + w * w * v * v;
    return norm > 0 ? (w * w * v * x + a * y) / norm : 0;
}

/* Are local errors known by their sizes only? */
static bool sizes_only(const struct stepper *s)
{
    return s->kind->two_rates || (s->kind->adaptive && adaptive_of(s)->scheme->sizes_only);
}

/* Of what is known by its size only all counts as delay. */
void tangent_told(struct stepper *s, double h, double v)
{
    struct tangent *o = s->tangent;
    const struct missed *m = s->missed;
    const double dq = m->signed_position - o->seen_position, dv = m->signed_velocity - o->seen_velocity;
    const double mean = (v + o->v_step) / 2, a = (v - o->v_step) / h, w = o->A != 0 ? frequency(o) : 1 / h;
    o->q_told += dq;
    o->v_told += dv;
    if (o->known && h > 0 && sizes_only(s))
        o->late += along(fabs(dq), fabs(dv), fabs(mean), fabs(a), w);
    else if (o->known && h > 0)
        o->late += along(dq, dv, mean, a, w);
    o->seen_position = m->signed_position;
    o->seen_velocity = m->signed_velocity;
    o->told = m->told;
}

/* Displacement or time since the last look, relative to that at which the next one is due. */
static double gone(const struct tangent *o, double t)
{
    return larger(o->way / o->usual, frequency(o) * (t - o->t)) / o->apart;
}

/* The fewer looks are left, the farther apart they are. */
bool tangent_affords(const struct stepper *s, const struct state *x)
{
    const struct tangent *o = s->tangent;
    const long steps = s->missed->steps / (s->kind->adaptive ? OWN_STEPS : STEPS), left = AT_ONCE + steps - o->looks;
    const double spare = smaller(1, (double)left / AT_ONCE);
    return !o->known || (left > 0 && gone(o, x->t) >= COARSE - (COARSE - 1) * spare);
}

/* ---- looks ----------------------------------------------------------------------------------------------------- */

struct look {
    double t, v, a, M, A, D, excess; /* as in struct tangent */
    double push[2]; /* what time alone has changed of a since the last look, in the first half and in the second */
};

/* *a := the acceleration at x displaced by dq, dv, as forces are at t. */
static enum status accelerate(struct stepper *s, double *a, const struct state *x, double dq, double dv, double t)
{
    struct tangent *o = s->tangent;
    struct trouble why;
    o->u[0] = dq;
    motion_point(s->ode, o->q, x->q, o->u, 1, t);
    o->u[0] = x->v[0] + dv;
    TRY(accel_solve(s->accel, o->b, NULL, o->q, o->u, t, &why));
    *a = o->b[0];
    return OK;
}

static enum status mass(struct stepper *s, double *M, const double *q, double t)
{
    struct trouble why;
    TRY(s->ode->ops->mass(s->ode, s->tangent->b, q, t, ALL, &why));
    *M = s->tangent->b[0];
    return OK;
}

/* l->D by differences; o->q is still displaced by dq, as it was for A. */
static enum status damping(struct stepper *s, struct look *l, const struct state *x, double dq)
{
    const double dv = dq * fmax(1, fabs(x->v[0]) / ode2_usual(s->ode, 0));
    double M, a;
    TRY(mass(s, &M, s->tangent->q, x->t));
    TRY(accelerate(s, &a, x, 0, dv, x->t));
    l->D = (a - l->a) / dv + (M - l->M) / dq * l->v / l->M;
    return OK;
}

/* l->push, by accelerations here as forces were at the last look and half way since. */
static enum status push(struct stepper *s, struct look *l, const struct state *x)
{
    const struct tangent *o = s->tangent;
    double before, half;
    TRY(accelerate(s, &before, x, 0, 0, o->t));
    TRY(accelerate(s, &half, x, 0, 0, (o->t + x->t) / 2));
    l->push[0] = half - before;
    l->push[1] = l->a - half;
    return OK;
}

static enum status look(struct stepper *s, struct look *l, const struct state *x, double excess, bool works)
{
    static const double SMALL = 1e-7;
    const double dq = SMALL * ode2_usual(s->ode, 0);
    double a;
    *l = (struct look){.t = x->t, .v = x->v[0], .excess = excess};
    TRY(mass(s, &l->M, x->q, x->t));
    TRY(accelerate(s, &l->a, x, 0, 0, x->t));
    TRY(accelerate(s, &a, x, dq, 0, x->t));
    l->A = (a - l->a) / dq;
    if (works) TRY(damping(s, l, x, dq));
    return s->tangent->timed && s->tangent->known ? push(s, l, x) : OK;
}

/* (x, y) := exp(h [0 1; A B]) (x, y) */
static void flow(double *x, double *y, double A, double B, double h)
{
    const double half = B / 2, square = half * half + A, w = sqrt(fabs(square));
    const double c = square > 0 ? cosh(w * h) : cos(w * h);
    const double s = w == 0 ? h : (square > 0 ? sinh(w * h) : sin(w * h)) / w;
    const double e = exp(half * h), x0 = *x, y0 = *y;
    *x = e * (c * x0 + s * (y0 - half * x0));
    *y = e * (c * y0 + s * (A * x0 + half * y0));
}

/* What is left at its end of 1 that has come in evenly over a time h. */
static double remains(double D, double h)
{
    return D * h != 0 ? expm1(D * h) / (D * h) : 1;
}

/* Mean coefficients between the last look and another one in the same chart. */
struct way {
    double h, A, D, undamped; /* undamped: da/dv, where D is 0 */
};

/* tau and P. */
static void shift_on(struct tangent *o, const struct look *l, const struct way *c)
{
    const double excess = l->excess - o->excess, w = o->A != 0 ? frequency(o) : 1 / c->h;
    const double a0 = o->a + l->push[0] * l->M / o->M, a = l->a - l->push[1]; /* after one jump, before the other */
    const double norm = a0 * a0 + w * w * o->v * o->v, norm1 = a * a + w * w * l->v * l->v;
    if (!(norm > 0) || !(norm1 > 0)) return;
    double P = o->M * (o->v * o->v_off - a0 * o->q_off), tau = along(o->q_off, o->v_off, o->v, a0, w);
    double x = -a0 / norm, y = w * w * o->v / norm;
    flow(&x, &y, c->A, c->undamped + c->D, c->h);
    tau += (P + excess / 2) / o->M * along(x, y, l->v, a, w) + o->late;
    P = P * exp(c->h * c->D) + excess * remains(c->D, c->h);
    o->q_off = tau * l->v - P / l->M * a / norm1;
    o->v_off = tau * a + P / l->M * w * w * l->v / norm1;
}

/* dq and dv as they are, of local errors one half before, the other behind. */
static void flow_on(struct tangent *o, const struct way *c)
{
    double x = o->q_off + o->q_told / 2, y = o->v_off + o->v_told / 2;
    flow(&x, &y, c->A, c->undamped + c->D, c->h);
    o->q_off = x + o->q_told / 2;
    o->v_off = y + o->v_told / 2;
}

/* How quickly time changes forces: what the jumps of both halves differ by, of accelerations at either look, w v and a; a look by
 * chance between two pushes does not end it. */
static double quickness(const struct tangent *o, const struct look *l)
{
    const double w = frequency(o), moves = fmax(hypot(w * o->v, o->a), hypot(w * l->v, l->a));
    const double apart = fabs(l->push[1] - l->push[0]), now = apart < moves ? apart / moves : apart > 0;
    return larger(now, FADES * o->quick);
}

/* Propagates the error to the look l, which is in the same chart. */
static void go_on(struct tangent *o, const struct look *l)
{
    const double h = l->t - o->t;
    const struct way c = {h, (o->A + l->A) / 2, (o->D + l->D) / 2, -log(l->M / o->M) / h};
    o->quick = quickness(o, l);
    if (o->quick > QUICK)
        flow_on(o, &c);
    else
        shift_on(o, l, &c);
    o->position = larger(o->position, fabs(o->q_off));
    o->velocity = larger(o->velocity, fabs(o->v_off));
}

static void begin(struct tangent *o, const struct look *l)
{
    o->known = true;
    o->t = l->t;
    o->v = l->v;
    o->a = l->a;
    o->M = l->M;
    o->A = l->A;
    o->D = l->D;
    o->excess = l->excess;
    o->way = o->late = o->q_told = o->v_told = 0;
    o->far = o->apart * o->usual;
    o->next = frequency(o) > 0 ? l->t + o->apart / frequency(o) : INFINITY;
}

void tangent_look(struct stepper *s, const struct state *x, double excess, bool works)
{
    struct tangent *o = s->tangent;
    const struct effort effort = s->effort;
    struct look l;
    const bool known = look(s, &l, x, excess, works) == OK;
    s->effort = effort;
    if (!known) return;
    o->looks++;
    if (o->known && x->t > o->t) go_on(o, &l);
    begin(o, &l);
}

/* The new coordinate is f(q_old), v = f' v_old: dq = f' dq_old, dv = f' dv_old + f'' v_old dq_old. */
void tangent_rechart(struct stepper *s, const struct state *x, double v, double a)
{
    struct tangent *o = s->tangent;
    const struct effort effort = s->effort;
    struct look l;
    const bool known = o->known && v != 0 && look(s, &l, x, o->excess, true) == OK;
    s->effort = effort;
    o->known = known;
    if (!known) return;
    const double by = x->v[0] / v, bend = (l.a - by * a) / v;
    const struct look old = {x->t, v, a, l.M * by * by, o->A, o->D, o->excess, {l.push[0] / by, l.push[1] / by}};
    if (x->t > o->t) go_on(o, &old);
    begin(o, &l);
    o->v_off = by * o->v_off + bend * o->q_off;
    o->q_off *= by;
    o->position *= fabs(by);
    o->velocity *= fabs(by);
    o->v_step = l.v;
}

void tangent_recall(struct tangent *o, struct recall *r)
{
    recall_within(r, "tangent");
    recall_one(r, "known", o->known);
    recall_one(r, "t", o->t);
    recall_one(r, "v", o->v);
    recall_one(r, "a", o->a);
    recall_one(r, "M", o->M);
    recall_one(r, "A", o->A);
    recall_one(r, "D", o->D);
    recall_one(r, "excess", o->excess);
    recall_one(r, "q_off", o->q_off);
    recall_one(r, "v_off", o->v_off);
    recall_one(r, "position", o->position);
    recall_one(r, "velocity", o->velocity);
    recall_one(r, "way", o->way);
    recall_one(r, "quick", o->quick);
    recall_one(r, "late", o->late);
    recall_one(r, "q_told", o->q_told);
    recall_one(r, "v_told", o->v_told);
    recall_one(r, "t_step", o->t_step);
    recall_one(r, "v_step", o->v_step);
    recall_one(r, "far", o->far);
    recall_one(r, "next", o->next);
    recall_one(r, "told", o->told);
    recall_one(r, "seen_position", o->seen_position);
    recall_one(r, "seen_velocity", o->seen_velocity);
    recall_one(r, "looks", o->looks);
    recall_without(r);
}
