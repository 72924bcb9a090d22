/* stepped.c -- see stepped.h */
#include "engine/stepped.h"

#include <math.h>
#include <string.h>

#include "base/scalar.h"
#include "engine/accel.h"
#include "engine/local_error.h"
#include "engine/motion.h"
#include "engine/touch.h"

enum { MOST_RATIO = 1000 };

/* One class of coordinates: what its trial is off by, and what the filter remembers. */
struct class
{
    double error;  /* of the trial, in scales of the tolerance */
    double before; /* of the step before, against its share; 0: there was none */
    double factor; /* the last step over the one before that */
};

struct stepped {
    struct stepper fixed;
    struct local_error local; /* of schemes of one rate */
    double *a1, *dv, *a2;     /* [n] the fixed scheme's accelerations, change of velocities, accelerations at the end */
    double *bend;             /* [n] scratch */
    double share;             /* of the tolerance that the trial may take */
    struct class slow, fast;  /* of one rate: all are slow */
    double h;                 /* minor step; 0: not chosen yet */
    double alone;             /* last step at one rate, where there can be two; 0: there was none */
    int rest, pause;          /* steps at one rate until two are tried again; and how many these will be next time */
    int ratio;                /* of the trial */
    double H;                 /* and its length */
    bool met;                 /* something has touched at its end, opened, or begun to slide or stick */
};

double stepped_late(const struct step_options *o)
{
    (void)o;
    return 1. / 12;
}

static const struct stepper_kind *fixed_kind(const struct adaptive *m)
{
    return ((const struct stepped_scheme *)m->scheme)->fixed;
}

void stepped_open(struct stepper *s, struct adaptive *m, struct arena *life)
{
    static const double PART =
        .7; /* of those that look at the ends of steps: ten orbits are off by 127 tolerances else */
    struct stepped *o = m->own = TAKE(life, struct stepped, 1);
    if (fixed_kind(m)->points) m->tolerance *= PART;
    stepper_open(&o->fixed, fixed_kind(m), s->ode, &s->options, life);
    o->fixed.missed = NULL;
    s->touch = o->fixed.touch;
    o->a1 = TAKE(life, double, s->ode->n);
    o->dv = TAKE(life, double, s->ode->n);
    m->ahead = o->a1;
    o->a2 = TAKE(life, double, s->ode->n);
    o->bend = TAKE(life, double, s->ode->n);
    local_error_open(&o->local, s->ode->n, life);
}

void stepped_forget(struct adaptive *m)
{
    struct stepped *o = m->own;
    o->fixed.fresh = 1;
    o->slow = o->fast = (struct class){0};
    o->alone = 0;
    o->rest = 0;
    o->pause = 1;
    local_error_forget(&o->local);
    if (fixed_kind(m)->keep) fixed_kind(m)->keep(&o->fixed, false);
}

/* ---- a trial --------------------------------------------------------------------------------------------------- */

/* However long it goes on, a vibration that is off in phase is off by no more than twice its size: what is too small to be
 * seen need not be resolved.  Nor is round-off of contacts an error that a shorter step would lessen: it grows there. */
static double against(const struct stepper *s, double position, double velocity, int i)
{
    const struct adaptive *m = s->self;
    const struct stepped *o = m->own;
    const double top = larger(m->top[i], fabs(m->v1[i])), eq = fabs(position) / adaptive_scale_q(s, i);
    const double off = s->touch ? larger(0, fabs(velocity) - touch_noise(s->touch, m->came)) : fabs(velocity);
    const double ev = smaller(off, 2 * o->share * top) / adaptive_scale_v(s, i);
    return worse(eq, ev);
}

/* The largest of each class against the scales; what the fast coordinates have from the slow ones is theirs. */
static void largest(const struct stepper *s, const struct step_error *e, int ns, int n)
{
    const struct adaptive *m = s->self;
    struct stepped *o = m->own;
    o->fast.error = o->slow.error = 0;
    for (int i = 0; i < ns; i++) {
        const double position = e->shared_position[i], velocity = e->shared_velocity[i];
        o->slow.error = worse(o->slow.error, against(s, position, velocity, i));
        o->fast.error = worse(o->fast.error, against(s, e->position[i] - position, e->velocity[i] - velocity, i));
    }
    for (int i = ns; i < n; i++) o->slow.error = worse(o->slow.error, against(s, e->position[i], e->velocity[i], i));
}

/* What accelerations at the end tell of the error, of schemes that have not looked there: of steep forces, and of the first
 * steps behind an impact, where means tell nothing of velocities. */
static enum status look_at_end(struct stepper *s, struct adaptive *m, double t, double h, struct trouble *why)
{
    struct stepped *o = m->own;
    struct state x = {t + h, m->q1, m->v1, o->a2};
    if (fixed_kind(m)->points || !(s->ode->steep || (s->touch && o->local.known < 2))) return OK;
    if (s->touch)
        TRY(touch_accelerations(s->touch, &x, why));
    else
        TRY(accel_solve(s->accel, o->a2, NULL, m->q1, m->v1, t + h, why));
    if (fixed_kind(m)->error_end) {
        fixed_kind(m)->error_end(&o->fixed, o->a2);
    } else {
        local_error_end(&o->local, o->a2, false, o->a2, h);
        local_error_apart(o->local.position, o->local.velocity, o->a2, h, s->ode->n);
    }
    return OK;
}

/* What the straight way of the trial misses of rotations is off, too. */
static void bend(const struct stepper *s, const struct adaptive *m, double h)
{
    struct stepped *o = m->own;
    for (int i = 0; i < s->ode->n; i++) o->a2[i] = o->dv[i] / h;
    if (!motion_bend(s->ode, o->bend, m->v, o->a2, 2)) return;
    for (int i = 0; i < s->ode->n; i++) o->local.position[i] -= h * h * h / 12 * o->bend[i];
}

static enum status measure(struct stepper *s, struct adaptive *m, double t, double h, struct trouble *why)
{
    struct stepped *o = m->own;
    o->share = adaptive_share(m, fabs(h));
    const int n = s->ode->n, ns = fixed_kind(m)->two_rates ? s->ode->ns : 0;
    struct step_error e = {.position = o->local.position, .velocity = o->local.velocity};
    if (!fixed_kind(m)->error) {
        for (int i = 0; i < n; i++) o->dv[i] = m->v1[i] - m->v[i];
        local_error_try(&o->local, o->dv, m->a, h, fixed_kind(m)->late(&s->options));
        bend(s, m, h);
    }
    TRY(look_at_end(s, m, t, h, why));
    if (fixed_kind(m)->error) e = fixed_kind(m)->error(&o->fixed);
    largest(s, &e, ns, n);
    return OK;
}

static int ratio_of(const struct stepped *o, double H)
{
    return o->h > 0 && o->h < H ? (int)smaller(ceil(H / o->h * (1 - 1e-9)), MOST_RATIO) : 1;
}

/* At the start of the trial, x: its works so far count whether it is taken or not, and it begins behind what happens there. */
static enum status begin_behind(struct stepper *s, struct adaptive *m, const struct state *x, struct trouble *why)
{
    struct stepped *o = m->own;
    struct state there = {x->t, m->q, m->v, m->a};
    copy(m->v, x->v, s->ode->n);
    for (int c = 0; c < POWER_CHANNELS; c++) m->work[c] += o->fixed.work[c];
    s->struck += o->fixed.struck;
    zero(o->fixed.work, POWER_CHANNELS);
    o->fixed.struck = 0;
    stepped_forget(m);
    return touch_accelerations(s->touch, &there, why);
}

/* Between what touches: from x, by h or as far as the motion is smooth. */
static enum status smooth_part(struct stepper *s, struct adaptive *m, struct state *x, double h, struct trouble *why)
{
    enum { MOST = 40 };
    const double t = x->t;
    bool happened, turned;
    TRY(touch_first(s->touch, &happened, x, why));
    if (happened) TRY(begin_behind(s, m, x, why));
    for (int k = 0, cuts = 0; k < MOST; k++) {
        TRY(touch_part(s->touch, &turned, x, &cuts, h, t + h, why));
        m->came = x->t != t + h ? x->t - t : h;
        if (m->came > 0) return OK;
        if (!turned) TRY(touch_meet(s->touch, &happened, x, why));
        TRY(begin_behind(s, m, x, why));
    }
    return trouble_set(why, TROUBLE_CONTACT, 0, INFINITY, t);
}

static enum status step(struct stepper *s, struct adaptive *m, struct state *x, double h, struct trouble *why)
{
    struct stepped *o = m->own;
    struct stepper *fixed = &o->fixed;
    if (!s->touch) return fixed->kind->step(fixed, x, h / o->ratio, o->ratio, x->t + h, why);
    TRY(smooth_part(s, m, x, h, why));
    o->H = m->came;
    return OK;
}

enum status stepped_attempt(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why)
{
    struct stepped *o = m->own;
    struct stepper *fixed = &o->fixed;
    struct state x = {t, m->q1, m->v1, o->a1};
    o->H = fabs(h);
    if (!(o->h > 0) && fixed_kind(m)->two_rates && s->ode->ns > 0) o->h = s->guess.h;
    o->ratio = ratio_of(o, o->H);
    copy(m->q1, m->q, s->ode->nq);
    copy(m->v1, m->v, s->ode->n);
    copy(o->a1, m->a, s->ode->n);
    zero(fixed->work, POWER_CHANNELS);
    fixed->lost = fixed->left = fixed->struck = 0;
    enum status status = step(s, m, &x, h, why);
    s->last_sweeps = fixed->last_sweeps;
    effort_hand_on(&s->effort, &fixed->effort);
    TRY(status);
    status = measure(s, m, t, m->came, why);
    *err = larger(o->slow.error, o->fast.error);
    if (status == OK && !isfinite(*err)) status = trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
    o->met = false;
    if (status == OK && s->touch) status = touch_meet(s->touch, &o->met, &x, why);
    if (status == OK) return OK;
    fixed->fresh = 1;
    if (s->touch) touch_back(s->touch, &x);
    return status;
}

void stepped_off(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h)
{
    struct stepped *o = m->own;
    const bool own = fixed_kind(m)->error;
    const struct step_error e = own ? fixed_kind(m)->error(&o->fixed)
                                    : (struct step_error){.position = o->local.position, .velocity = o->local.velocity};
    (void)h;
    copy(position, e.position, s->ode->n);
    copy(velocity, e.velocity, s->ode->n);
}

void stepped_take(struct stepper *s, struct adaptive *m, double h)
{
    struct stepped *o = m->own;
    for (int c = 0; c < POWER_CHANNELS; c++) m->work[c] += o->fixed.work[c];
    s->effort.minors += o->ratio - 1;
    s->lost += o->fixed.lost;
    s->left += o->fixed.left;
    s->struck += o->fixed.struck;
    adaptive_travel(s, m, o->dv);
    copy(m->a, o->a1, s->ode->n);
    if (o->met)
        stepped_forget(m);
    else if (fixed_kind(m)->keep)
        fixed_kind(m)->keep(&o->fixed, true);
    else
        local_error_keep(&o->local, h);
}

/* ---- the next step --------------------------------------------------------------------------------------------- */

/* An error against its share of the tolerance goes with h^2; what is aimed at leaves room for what is not foreseen. */
static const double AIM = .7, KEPT_FROM = .85, KEPT_TO = 1.2, LEAST = .2, MOST = 3;

/* H211b: times the step of a class whose error was taken, `share` what it may be. */
static double filter(struct class *c, double share)
{
    const double now = larger(c->error / share / AIM, 1e-8);
    double factor = c->before > 0 ? pow(now * c->before, -1. / 8) * pow(c->factor, -1. / 4) : 1 / sqrt(now);
    if (now * AIM > 1) factor = smaller(factor, 1 / sqrt(now));
    factor = smaller(MOST, larger(LEAST, factor));
    if (factor > KEPT_FROM && factor < KEPT_TO) factor = 1;
    c->before = now;
    c->factor = factor;
    return factor;
}

/* Minor steps are whole parts of a major one, and a small change may be none: one less where that is expected to do. */
static double one_less(const struct stepped *o, double share)
{
    const double part = (o->ratio - 1.) / o->ratio;
    return o->ratio > 1 && o->fast.error / share < .75 * AIM * part * part ? 1 / part : 1;
}

/* Of a trial that failed: what it can still be. */
static double retry(const struct class *c, double share)
{
    const double now = c->error / share;
    return now > 1 ? larger(LEAST, .8 / sqrt(now)) : 1;
}

/* Slow coordinates that move in a straight line in a major step are in the way of stiff fast ones: two rates whose major step can
 * be but a few steps of one rate lose by them, and are tried again only after a while.  Times H to the next step of either. */
static double one_or_two(struct stepped *o, double factor)
{
    enum { SOON = 8, LATE = 512 };
    static const double APART = 1.5;
    const double H = factor * o->H, one = larger(o->alone, o->h);
    const bool two = o->ratio > 1, apart = H >= APART * one;
    if (two && apart) o->pause = SOON;
    if (two && !apart) {
        o->rest = o->pause;
        o->pause = o->pause < LATE ? 2 * o->pause : LATE;
    }
    if (apart && o->rest == 0) return factor;
    o->h = smaller(two ? o->H : H, one);
    return o->h / o->H;
}

double stepped_shrink(const struct adaptive *m, double err)
{
    struct stepped *o = m->own;
    const double share = larger(o->slow.error, o->fast.error) / err, minor = o->H / o->ratio;
    struct state x = {m->t1, m->q1, m->v1, o->a1};
    o->fixed.fresh = 1; /* its predictors have gone ahead */
    if (o->fixed.touch) touch_back(o->fixed.touch, &x);
    if (o->fixed.kind->back) o->fixed.kind->back(&o->fixed);
    if (o->ratio > 1 || o->fast.error > 0) o->h = minor * retry(&o->fast, share);
    const double factor = retry(&o->slow, share);
    if (!(o->h > 0)) return factor;
    return o->ratio > 1 ? smaller(one_or_two(o, factor), MOST_RATIO * o->h / o->H) : smaller(factor, o->h / minor);
}

double stepped_grow(const struct adaptive *m, double err)
{
    struct stepped *o = m->own;
    const double most = larger(o->slow.error, o->fast.error), share = err > 0 ? most / err : 1;
    const bool cut = o->H < m->h * (1 - 1e-10);
    const bool two = o->fixed.ode->ns > 0 && fixed_kind(m)->two_rates;
    const bool all = o->fixed.ode->ns == o->fixed.ode->n;
    if ((cut && err <= 1) || o->met) return 1; /* what has just happened tells nothing of the next step */
    double factor = filter(&o->slow, share);
    if (!two) return factor;
    const double minor = o->H / o->ratio;
    o->h = minor * larger(filter(&o->fast, share), one_less(o, share));
    if (o->ratio == 1) {
        o->alone = o->h;
        if (o->rest > 0) o->rest--;
    }
    factor = all ? o->h / o->H : one_or_two(o, factor);
    o->h = smaller(o->h, factor * o->H);
    return smaller(factor, MOST_RATIO * o->h / o->H);
}

/* ---- records, memory ------------------------------------------------------------------------------------------- */

/* Positions by Hermite's cubic; velocities by a parabola of the third derivative that local_error.h has seen. */
void stepped_between(const struct stepper *s, const struct adaptive *m, double *u, double *v, double x)
{
    const struct stepped *o = m->own;
    const double h = m->t1 - m->t0, y = 1 - x;
    adaptive_cubic(s, m, u, o->dv, o->a1, x);
    for (int i = 0; i < s->ode->n; i++) v[i] = y * m->v0[i] + x * m->v[i] - h * h / 2 * x * y * o->local.jerk[i];
}

enum status stepped_recall(struct stepper *s, struct adaptive *m, struct recall *r)
{
    struct stepped *o = m->own;
    (void)s;
    recall_within(r, "stepped");
    recall_one(r, "minor", o->h);
    recall_one(r, "alone", o->alone);
    recall_one(r, "rest", o->rest);
    recall_one(r, "pause", o->pause);
    recall_one(r, "slow", o->slow.before);
    recall_one(r, "slow_factor", o->slow.factor);
    recall_one(r, "fast", o->fast.before);
    recall_one(r, "fast_factor", o->fast.factor);
    local_error_recall(&o->local, r);
    const enum status status = stepper_recall(&o->fixed, r);
    recall_without(r);
    return status;
}
