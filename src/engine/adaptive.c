/* adaptive.c -- see adaptive.h */
#include "engine/adaptive.h"

#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "base/stop.h"
#include "engine/creep.h"
#include "engine/edge.h"
#include "engine/missed.h"
#include "engine/motion.h"
#include "engine/relay.h"
#include "engine/strikes.h"
#include "engine/tangent.h"
#include "engine/touch.h"
#include "engine/works.h"

static const struct rk_table euler = {.stages = 2, .c = {0, 1}, .a = {{0}, {1}}};

static void note_pace(struct stepper *s, double t)
{
    struct adaptive *m = s->self;
    if (s->ode->driven) m->pace = larger(m->pace, s->ode->driven(s->ode, t));
    for (int i = 0; i < s->ode->n; i++) {
        m->top[i] = larger(m->top[i], fabs(m->v[i]));
        m->pace = fmax(m->pace, fabs(m->v[i]) / ode2_usual(s->ode, i));
    }
}

static void forget(struct adaptive *m)
{
    if (m->scheme->forget) m->scheme->forget(m);
}

/* A first step: 1 % of the time in which the state moves by its own size, and an Euler step to see
 * the second derivative (Hairer, Norsett & Wanner, II.4, starting step). */
static enum status first_step(struct stepper *s, double t, double most, struct trouble *why)
{
    struct adaptive *m = s->self;
    struct rk *k = &m->rk;
    int n = s->ode->n;
    double d0 = 0, d1 = 0, d2 = 0;
    copy(m->q1, m->q, s->ode->nq);
    copy(m->v1, m->v, n);
    TRY(rk_stage(k, &euler, 0, m->q, m->v, t, 0, why));
    for (int i = 0; i < n; i++) {
        double sq = adaptive_scale_q(s, i), sv = adaptive_scale_v(s, i);
        d0 += pow(adaptive_size(s, m->q, i) / sq, 2) + pow(m->v[i] / sv, 2);
        d1 += pow(m->v[i] / sq, 2) + pow(k->dv[0][i] / sv, 2);
    }
    d0 = sqrt(d0 / (2 * n));
    d1 = sqrt(d1 / (2 * n));
    double h0 = fmin(most, d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : .01 * d0 / d1);
    TRY(rk_stage(k, &euler, 1, m->q, m->v, t, h0, why));
    for (int i = 0; i < n; i++)
        d2 += pow((k->du[1][i] - k->du[0][i]) / adaptive_scale_q(s, i), 2) +
              pow((k->dv[1][i] - k->dv[0][i]) / adaptive_scale_v(s, i), 2);
    d2 = sqrt(d2 / (2 * n)) / h0;
    double top = fmax(d1, d2), h1 = top <= 1e-15 ? fmax(1e-6, 1e-3 * h0) : pow(.01 / top, 1. / m->scheme->order);
    m->h = fmin(fmin(100 * h0, h1), most);
    m->old = 1e-4;
    return OK;
}

/* What the trial, of error err in scales of the tolerance, is off by. */
static void note_missed(const struct stepper *s, const struct adaptive *m, double err, double h)
{
    struct missed *o = s->missed;
    const struct adaptive_scheme *scheme = m->scheme;
    if (!o) return;
    double *position = o->v[0], *velocity = o->v[1];
    const double less = scheme->sharper > 0 ? pow(smaller(1, err * m->tolerance), scheme->sharper) : 1;
    scheme->off(s, m, position, velocity, h);
    for (int i = 0; i < o->n; i++) {
        position[i] *= m->leaps ? 0 : less;
        velocity[i] *= m->leaps ? 0 : less;
    }
    if (scheme->left && !m->leaps) scheme->left(s, m, position, velocity, h);
    edge_add(m, position, velocity, o->n);
    o->steps++;
    missed_add(o, s->ode, position, velocity, m->v, m->a);
    if (scheme->drifts > 0) missed_drift(o, s->ode, m->v, h, scheme->drifts);
}

static double sum_of(const double *work)
{
    double sum = 0;
    for (int c = 0; c < POWER_CHANNELS; c++) sum += fabs(work[c]);
    return sum;
}

static void take(struct stepper *s, struct adaptive *m, double t, double h)
{
    double before[POWER_CHANNELS];
    copy(before, m->work, POWER_CHANNELS);
    copy(m->q0, m->q, s->ode->nq);
    copy(m->v0, m->v, s->ode->n);
    copy(m->a0, m->a, s->ode->n);
    m->t0 = t;
    m->t1 = t + h;
    m->scheme->take(s, m, h);
    works_taken(&m->works, before, m->work);
    s->swing = larger(s->swing, sum_of(m->work));
    copy(m->q, m->q1, s->ode->nq);
    copy(m->v, m->v1, s->ode->n);
    note_pace(s, m->t1);
    m->cause.code = TROUBLE_NONE;
    m->elapsed += fabs(h);
    s->effort.minors++;
}

/* The slopes are known at the state: its accelerations, of which closed contacts have a part. */
static enum status accelerate(struct stepper *s, double t, struct trouble *why)
{
    struct adaptive *m = s->self;
    struct state x = {t, m->q, m->v, m->a};
    copy(m->a, m->rk.dv[0], s->ode->n);
    return s->touch ? touch_accelerations(s->touch, &x, why) : OK;
}

/* The slopes at the state, at t. */
static enum status slopes_here(struct stepper *s, double t, struct trouble *why)
{
    struct adaptive *m = s->self;
    TRY(rk_stage(&m->rk, &euler, 0, m->q, m->v, t, 0, why));
    return accelerate(s, t, why);
}

/* Better coordinates at t, where there are any: what is known in the old ones is made anew.  The state x goes along, as
 * it cannot go back behind t. */
static enum status recoordinate(struct stepper *s, struct state *x, double t, struct trouble *why)
{
    struct adaptive *m = s->self;
    struct ode2 *o = s->ode;
    const double v = s->tangent ? m->v[0] : 0, a = s->tangent ? m->a[0] : 0;
    if (!o->chart || !o->chart->rechart || !o->chart->rechart(o, m->q, m->v, t)) return OK;
    if (s->tangent) tangent_rechart(s, &(struct state){t, m->q, m->v, m->a}, v, a);
    if (s->missed) missed_rechart(s->missed);
    if (s->strikes) strikes_rechart(s->strikes);
    zero(m->span, o->n);
    forget(m);
    copy(x->q, m->q, o->nq);
    copy(x->v, m->v, o->n);
    x->t = t;
    TRY(slopes_here(s, t, why));
    copy(x->a, m->a, o->n);
    return OK;
}

/* Where the right-hand side jumps for ever, as dry friction written as sign(rate) does at rest, there is no end. */
static enum status give_up(enum trouble_code code, double value, double t, struct trouble *why)
{
    (void)trouble_set(why, code, -1, value, t);
    return E_LIMIT;
}

/* Steps that shrink to nothing may do so before what cannot be passed, as a dead point: a longer one then tells, and for
 * all that begin again with this step. */
static enum status too_small(struct stepper *s, double t, double h, double left, struct trouble *why)
{
    struct adaptive *m = s->self;
    struct trouble cause = {0};
    double err;
    if (m->cause.code == TROUBLE_NONE && m->scheme->attempt(s, m, &err, t, left / 100, &cause) == E_NUMERIC)
        m->cause = cause;
    if (m->cause.code == TROUBLE_NONE || !why) return trouble_set(why, TROUBLE_TOO_SMALL, -1, h, t);
    *why = m->cause;
    return E_NUMERIC;
}

/* Behind a jump steps are what they were before it. */
static void go_on(struct adaptive *m)
{
    m->h = m->held;
    m->held = 0;
    forget(m);
}

/* A step under way. */
struct aim {
    double end, left; /* where steps end at the latest, [s] up to there */
    double h, came;   /* [s] that are asked for, that it came */
    double least;     /* [s] that t can tell, with some of its round-off to spare */
    bool last, cut;   /* it ends there; it is shorter than its error asks for */
    int shy;          /* times that records have asked for a shorter one */
};

static void aim_next(struct aim *o, const struct adaptive *m)
{
    static const double NEAR = .9;
    o->h = m->h;
    o->last = o->h >= o->left * (1 - 1e-10);
    const bool near = m->scheme->plain && !o->last && o->h > NEAR * o->left;
    o->cut = near || (o->last && o->h > o->left);
    if (o->last) o->h = o->left;
    if (near) o->h = o->left / 2;
}

/* Records within the step ask for a shorter step, or for one to the first of them. */
static void shorten_for_records(struct stepper *s, struct aim *o, double t, double records)
{
    struct adaptive *m = s->self;
    m->h = o->came * m->scheme->shrink(m, records);
    if (o->shy++ || m->h < s->due - t) m->h = o->left = (o->end = s->due) - t;
    s->effort.rejected++;
}

/* The step up to `at` is done; err: its error, whole: before its share of the tolerance was taken. */
static enum status accept(struct stepper *s, const struct aim *o, double *t, double at, double err, double whole,
                          struct trouble *why)
{
    struct adaptive *m = s->self;
    const double end = s->natural && s->due > *t ? smaller(o->end, s->due) : o->end;
    note_missed(s, m, whole, m->came);
    if (s->strikes && m->beyond > 0) strikes_note(s->strikes, m->v, *t);
    take(s, m, *t, m->came);
    const bool stuck = creep_found(m, *t + m->came, end);
    if (m->leaps) {
        go_on(m);
    } else {
        if (!m->jumps) m->held = 0; /* it is not in the way */
        if (m->beyond > 0) forget(m);
        const double grow = m->scheme->grow(m, err);
        if ((!o->cut && o->came == o->h) || grow < 1) m->h = larger(o->came * grow, o->least);
        m->old = fmax(err, 1e-4);
    }
    *t = at;
    if (m->relay) relay_took(s, m, o->cut || o->came != o->h);
    return stuck ? give_up(TROUBLE_CREEP, fabs(m->came), *t, why) : OK;
}

/* One step of the scheme's own on the way from *t to end, tried until its error will do, or the run is to end.  Where
 * accelerations jump no step is short enough; a few of the round-off of t pass it, for what they miss is of that order.  None is
 * left over that is far shorter than the others, where changes of velocities over it, round-off, would be read. */
static enum status own_step(struct stepper *s, double *t, double end, int *passed, struct trouble *why)
{
    enum { MOST_PASSED = 4, MOST_REJECTED = 100000 };
    struct adaptive *m = s->self;
    const double round_off = DBL_EPSILON * fmax(fabs(*t), fabs(end)), least = 16 * round_off, way = end > *t ? 1 : -1;
    struct aim o = {.end = end, .left = fabs(end - *t), .least = 2 * round_off};
    m->jumps = 0;
    if (m->relay && relay_next(s, m, *t)) TRY(slopes_here(s, *t, why));
    for (;;) {
        double err = 0;
        aim_next(&o, m);
        if (*t + way * o.h == *t) return too_small(s, *t, o.h, way * o.left, why);
        m->came = way * o.h;
        const enum status status = m->scheme->attempt(s, m, &err, *t, way * o.h, why);
        if (status != OK && status != E_NUMERIC) return status; /* no step is short enough for that */
        o.came = status == OK ? fabs(m->came) : o.h;
        const double whole = err, share = adaptive_share(m, o.came);
        err /= share;
        if (o.h > least && err <= 1) *passed = 0;
        const bool jump = status == OK && err > 1 && o.h <= least && (*passed)++ < MOST_PASSED;
        m->leaps = false;
        m->beyond = 0;
        const double cut_to = status == OK && o.h > least ? edge_cut(s, m, *t, err, share) : 1;
        if (cut_to < 1) {
            (void)m->scheme->shrink(m, larger(err, 1)); /* it is given up */
            m->h = larger(cut_to * o.came, o.least);
            s->effort.rejected++;
            continue;
        }
        if (status == OK && (err <= 1 || jump || m->leaps)) {
            const double at = o.last && o.came == o.h ? o.end : *t + m->came;
            const double records = adaptive_records(s, *t, m->came, at);
            if (!(records > 1)) return accept(s, &o, t, at, larger(err, records), whole, why);
            shorten_for_records(s, &o, *t, records);
            continue;
        }
        m->h = o.came * (status == OK ? m->scheme->shrink(m, err) : .2);
        s->effort.rejected++;
        if (m->relay) relay_failed(s, m);
        if (++m->rejected > MOST_REJECTED) return give_up(TROUBLE_REJECTED, (double)m->rejected, *t, why);
        if (stop) return OK;
    }
}

/* From *t to end, landing there, or by one step; short of it where the run is asked to end.  Either may be the later one. */
static enum status advance(struct stepper *s, struct state *x, double *t, double end, struct trouble *why)
{
    int passed = 0;
    while (*t != end) {
        TRY(own_step(s, t, end, &passed, why));
        if (s->natural || stop) return OK;
        if (*t != end) TRY(recoordinate(s, x, *t, why));
    }
    return OK;
}

/* The slopes at the start of H: kept from the last step, new after anything has changed. */
static enum status begin(struct stepper *s, const struct state *x, double to, struct trouble *why)
{
    struct adaptive *m = s->self;
    copy(m->q, x->q, s->ode->nq);
    copy(m->v, x->v, s->ode->n);
    zero(m->work, POWER_CHANNELS);
    m->rejected = 0;
    if (!(s->natural && m->known && m->works.until == s->due)) m->works.asked = false;
    m->works.until = s->due;
    if (s->fresh) {
        zero(m->span, s->ode->n);
        note_pace(s, x->t);
        TRY(first_step(s, x->t, fabs(to - x->t), why));
        TRY(accelerate(s, x->t, why));
        if (s->guess.h > 0) m->h = fmin(s->guess.h * s->guess.ratio, fabs(to - x->t));
    } else if (!(s->natural && m->known)) {
        TRY(slopes_here(s, x->t, why));
    }
    s->fresh = 0;
    return OK;
}

/* The impulse of a corner in [*t, behind), and the slopes behind it: also where there is no impulse, but another side. */
static enum status take_impulse(struct stepper *s, double *t, double behind, struct trouble *why)
{
    struct adaptive *m = s->self;
    const struct ode2 *o = s->ode;
    int met = 0;
    if (o->breaks->jump) TRY(o->breaks->jump(o, &met, m->v, &m->work[POWER_DRIVE], m->q, *t, behind, why));
    if (!met && !motion_sides(o, *t)) return OK;
    *t = behind;
    return slopes_here(s, *t, why);
}

/* Where drives have corners in [t, end): the impulse of one at t, and the other side of anything that has two there;
 * *end then is where the next one is.  Round-off before the end it is what jumps up to the end itself: the next interval
 * begins with the rates there. */
static enum status turn_corner(struct stepper *s, double *t, double *end, struct trouble *why)
{
    const struct ode2 *o = s->ode;
    if (!o->breaks) return OK;
    const double behind = motion_behind(*t, *end);
    if (behind >= *end) return take_impulse(s, t, *end, why);
    double first = o->breaks->corner ? o->breaks->corner(o, *t, *end) : INFINITY;
    if (first <= behind || motion_sides(o, *t)) TRY(take_impulse(s, t, behind, why));
    if (first <= behind) first = o->breaks->corner(o, behind, *end);
    *end = fmin(*end, first);
    return OK;
}

enum status adaptive_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct adaptive *m = s->self;
    const struct ode2 *o = s->ode;
    (void)h, (void)ratio;
    TRY(begin(s, x, to, why));
    const int forth = to > x->t, breaks = forth && o->breaks && o->breaks->next;
    if (s->natural && m->known) TRY(recoordinate(s, x, x->t, why)); /* records looked back from the old ones */
    m->known = false;
    double t = x->t;
    do {
        double end = breaks ? fmin(to, o->breaks->next(o, t)) : to;
        if (forth) TRY(turn_corner(s, &t, &end, why));
        TRY(advance(s, x, &t, end, why));
        if (t == end && end != to) TRY(slopes_here(s, t, why)); /* those beyond the kink */
    } while (t != to && !s->natural && !stop);
    m->known = t != to;
    copy(x->q, m->q, o->nq);
    copy(x->v, m->v, o->n);
    copy(x->a, m->a, o->n);
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += m->work[c];
    x->t = t;
    return OK;
}
