/* dopri5.c -- Dormand & Prince 5(4), steps of its own by the error of the embedded method
 *
 * Coefficients: Dormand & Prince, J. Comput. Appl. Math. 6 (1980).  PI step control, starting step and
 * scales: Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, II.4 and IV.2:
 *
 *     h := h clip(0.9 err^-0.17 err_old^0.04, 0.2, 5),    err = rms of e_i / (tol (Y_i + |y_i|))
 *
 * Y_i is what makes the tolerance a share in any units: of a position its usual size L_i (a radian, the mechanism's length), of
 * a velocity L_i times a hundredth of the fastest |v_j|/L_j so far.
 *
 * Steps end exactly at `to` and at known kinks in time; the step used before such a cut is kept. */
#include <float.h>
#include <math.h>
#include <stdbool.h>

#include "engine/motion.h"
#include "engine/rk.h"

static const struct rk_table table = {
    .stages = 7,
    .c = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1},
    .a = {{0},
          {1. / 5},
          {3. / 40, 9. / 40},
          {44. / 45, -56. / 15, 32. / 9},
          {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
          {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
          {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}},
    .b = {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84, 0},
};

/* Weights of order 5 less those of order 4. */
static const double e[RK_STAGES] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};

struct dopri5 {
    struct rk rk;
    double *q, *v, *a, *q1, *v1; /* the state inside H, and the end under trial */
    double pace;                 /* largest |v|/L so far [1/s] */
    double *span;                /* [n] displacement since the start, where positions have a move of their own */
    double h, old;               /* next step; error of the last one */
    double work[POWER_CHANNELS];
};

static void open(struct stepper *s, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct dopri5 *m = TAKE(life, struct dopri5, 1);
    rk_open(&m->rk, o, s->accel, life);
    m->q = TAKE(life, double, o->nq);
    m->q1 = TAKE(life, double, o->nq);
    m->v = TAKE(life, double, o->n);
    m->v1 = TAKE(life, double, o->n);
    m->a = TAKE(life, double, o->n);
    m->span = TAKE(life, double, o->n);
    s->self = m;
}

static double usual(const struct stepper *s, int i)
{
    return s->ode->size ? s->ode->size(s->ode, i) : 1;
}

/* Size of position i.  A position that is moved by quasi-displacements has none of its own: what it
 * has travelled, at most its usual size. */
static double size(const struct stepper *s, const double *q, int i)
{
    struct dopri5 *m = s->self;
    return s->ode->move ? fmin(usual(s, i), fabs(m->span[i])) : fabs(q[i]);
}

static double scale_q(const struct stepper *s, int i)
{
    struct dopri5 *m = s->self;
    return s->options.tolerance * usual(s, i) + s->options.tolerance * fmax(size(s, m->q, i), size(s, m->q1, i));
}

/* What all but stands is not judged by its round-off. */
static double scale_v(const struct stepper *s, int i)
{
    static const double PART = .01, SLOWEST = 1e-3; /* [1/s] */
    struct dopri5 *m = s->self;
    return s->options.tolerance * usual(s, i) * fmax(PART * m->pace, SLOWEST) +
           s->options.tolerance * fmax(fabs(m->v[i]), fabs(m->v1[i]));
}

static void note_pace(struct stepper *s)
{
    struct dopri5 *m = s->self;
    for (int i = 0; i < s->ode->n; i++) m->pace = fmax(m->pace, fabs(m->v[i]) / usual(s, i));
}

static double error(const struct stepper *s, double h)
{
    struct dopri5 *m = s->self;
    int n = s->ode->n;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double eq = 0, ev = 0;
        for (int j = 0; j < table.stages; j++) {
            eq += e[j] * m->rk.du[j][i];
            ev += e[j] * m->rk.dv[j][i];
        }
        eq *= h / scale_q(s, i);
        ev *= h / scale_v(s, i);
        sum += eq * eq + ev * ev;
    }
    return sqrt(sum / (2 * n));
}

/* A first step: 1 % of the time in which the state moves by its own size, and an Euler step to see
 * the second derivative (Hairer, Norsett & Wanner, II.4, starting step). */
static enum status first_step(struct stepper *s, double t, double most, struct trouble *why)
{
    struct dopri5 *m = s->self;
    struct rk *k = &m->rk;
    int n = s->ode->n;
    double d0 = 0, d1 = 0, d2 = 0;
    copy(m->q1, m->q, s->ode->nq);
    copy(m->v1, m->v, n);
    TRY(rk_stage(k, &table, 0, m->q, m->v, t, 0, why));
    for (int i = 0; i < n; i++) {
        double sq = scale_q(s, i), sv = scale_v(s, i);
        d0 += pow(size(s, m->q, i) / sq, 2) + pow(m->v[i] / sv, 2);
        d1 += pow(m->v[i] / sq, 2) + pow(k->dv[0][i] / sv, 2);
    }
    d0 = sqrt(d0 / (2 * n));
    d1 = sqrt(d1 / (2 * n));
    double h0 = fmin(most, d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : .01 * d0 / d1);
    static const struct rk_table euler = {.stages = 2, .c = {0, 1}, .a = {{0}, {1}}};
    TRY(rk_stage(k, &euler, 1, m->q, m->v, t, h0, why));
    for (int i = 0; i < n; i++)
        d2 += pow((k->du[1][i] - k->du[0][i]) / scale_q(s, i), 2) + pow((k->dv[1][i] - k->dv[0][i]) / scale_v(s, i), 2);
    d2 = sqrt(d2 / (2 * n)) / h0;
    double top = fmax(d1, d2), h1 = top <= 1e-15 ? fmax(1e-6, 1e-3 * h0) : pow(.01 / top, 1. / 5);
    m->h = fmin(fmin(100 * h0, h1), most);
    m->old = 1e-4;
    return OK;
}

/* One trial from t to t + h: its error, and q1, v1. */
static enum status attempt(struct stepper *s, double *err, double t, double h, struct trouble *why)
{
    struct dopri5 *m = s->self;
    copy(m->rk.dv[0], m->a, s->ode->n); /* first same as last; w[0] is kept likewise */
    zero(m->rk.u, s->ode->n);
    motion_rate(s->ode, m->rk.du[0], m->q, m->q, m->rk.u, m->v, t);
    for (int i = 1; i < table.stages; i++) TRY(rk_stage(&m->rk, &table, i, m->q, m->v, t, h, why));
    copy(m->q1, m->q, s->ode->nq);
    copy(m->v1, m->v, s->ode->n);
    rk_end(&m->rk, &table, m->q1, m->v1, NULL, t, h);
    *err = error(s, h);
    return isfinite(*err) ? OK : trouble_set(why, TROUBLE_NOT_FINITE, -1, *err, t + h);
}

static void take(struct stepper *s, double h)
{
    struct dopri5 *m = s->self;
    int n = s->ode->n;
    for (int j = 0; j < table.stages; j++)
        for (int c = 0; c < POWER_CHANNELS; c++) m->work[c] += h * table.b[j] * m->rk.w[j][c];
    for (int i = 0; i < n; i++) m->span[i] += m->rk.u[i];
    copy(m->q, m->q1, s->ode->nq);
    copy(m->v, m->v1, n);
    copy(m->a, m->rk.dv[6], n);
    note_pace(s);
    copy(m->rk.w[0], m->rk.w[6], POWER_CHANNELS);
    s->effort.minors++;
}

/* Better coordinates at t, where there are any: what is known in the old ones is made anew.  The state x goes along, as
 * it cannot go back behind t. */
static enum status recoordinate(struct stepper *s, struct state *x, double t, struct trouble *why)
{
    struct dopri5 *m = s->self;
    struct ode2 *o = s->ode;
    if (!o->chart || !o->chart->rechart || !o->chart->rechart(o, m->q, m->v, t)) return OK;
    zero(m->span, o->n);
    copy(x->q, m->q, o->nq);
    copy(x->v, m->v, o->n);
    x->t = t;
    TRY(rk_stage(&m->rk, &table, 0, m->q, m->v, t, 0, why));
    copy(m->a, m->rk.dv[0], o->n);
    copy(x->a, m->a, o->n);
    return OK;
}

/* From t to end, landing there; either may be the later one.  Where accelerations jump no step is short enough; a few
 * of the round-off of t pass it, for what they miss is of that order. */
static enum status advance(struct stepper *s, struct state *x, double t, double end, struct trouble *why)
{
    enum { MOST_PASSED = 4 };
    struct dopri5 *m = s->self;
    const double least = 16 * DBL_EPSILON * fmax(fabs(t), fabs(end));
    int passed = 0;
    while (t != end) {
        double left = fabs(end - t), h = m->h, err = 0, way = end > t ? 1 : -1;
        int last = h >= left * (1 - 1e-10), cut = last && h > left;
        if (last) h = left;
        if (t + way * h == t) return trouble_set(why, TROUBLE_TOO_SMALL, -1, h, t);
        enum status status = attempt(s, &err, t, way * h, why);
        if (h > least && err <= 1) passed = 0;
        const bool jump = status == OK && err > 1 && h <= least && passed++ < MOST_PASSED;
        if (status != OK || (err > 1 && !jump)) {
            m->h = h * (status == OK ? fmax(.2, .9 * pow(err, -.2)) : .2);
            s->effort.rejected++;
            continue;
        }
        take(s, way * h);
        double grow = fmin(5, fmax(.2, .9 * pow(fmax(err, 1e-10), -.17) * pow(m->old, .04)));
        if (!cut || grow < 1) m->h = h * grow;
        m->old = fmax(err, 1e-4);
        t = last ? end : t + way * h;
        if (!last) TRY(recoordinate(s, x, t, why));
    }
    return OK;
}

/* The slopes at the start of H: kept from the last step, new after anything has changed. */
static enum status begin(struct stepper *s, const struct state *x, double to, struct trouble *why)
{
    struct dopri5 *m = s->self;
    copy(m->q, x->q, s->ode->nq);
    copy(m->v, x->v, s->ode->n);
    zero(m->work, POWER_CHANNELS);
    if (s->fresh) {
        zero(m->span, s->ode->n);
        note_pace(s);
        TRY(first_step(s, x->t, fabs(to - x->t), why));
    } else {
        TRY(rk_stage(&m->rk, &table, 0, m->q, m->v, x->t, 0, why));
    }
    copy(m->a, m->rk.dv[0], s->ode->n);
    s->fresh = 0;
    return OK;
}

/* The impulse of a corner in [*t, behind), and the slopes behind it. */
static enum status take_impulse(struct stepper *s, double *t, double behind, struct trouble *why)
{
    struct dopri5 *m = s->self;
    const struct ode2 *o = s->ode;
    int met;
    TRY(o->breaks->jump(o, &met, m->v, &m->work[POWER_DRIVE], m->q, *t, behind, why));
    if (!met) return OK;
    *t = behind;
    TRY(rk_stage(&m->rk, &table, 0, m->q, m->v, *t, 0, why));
    copy(m->a, m->rk.dv[0], o->n);
    return OK;
}

/* Where drives have corners in [t, end): the impulse of one at t; *end then is where the next one is.  Round-off before
 * the end it is what jumps up to the end itself: the next interval begins with the rates there. */
static enum status turn_corner(struct stepper *s, double *t, double *end, struct trouble *why)
{
    const struct ode2 *o = s->ode;
    if (!o->breaks || !o->breaks->jump) return OK;
    const double behind = motion_behind(*t, *end);
    if (behind >= *end) return take_impulse(s, t, *end, why);
    double first = o->breaks->corner(o, *t, *end);
    if (first <= behind) TRY(take_impulse(s, t, behind, why));
    if (first <= behind) first = o->breaks->corner(o, behind, *end);
    *end = fmin(*end, first);
    return OK;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct dopri5 *m = s->self;
    const struct ode2 *o = s->ode;
    (void)h, (void)ratio;
    TRY(begin(s, x, to, why));
    const int forth = to > x->t, breaks = forth && o->breaks && o->breaks->next;
    for (double t = x->t, end; t != to; t = end) {
        end = breaks ? fmin(to, o->breaks->next(o, t)) : to;
        if (forth) TRY(turn_corner(s, &t, &end, why));
        TRY(advance(s, x, t, end, why));
        if (end != to) { /* one-sided slopes beyond the kink */
            TRY(rk_stage(&m->rk, &table, 0, m->q, m->v, end, 0, why));
            copy(m->a, m->rk.dv[0], o->n);
        }
    }
    copy(x->q, m->q, o->nq);
    copy(x->v, m->v, o->n);
    copy(x->a, m->a, o->n);
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += m->work[c];
    x->t = to;
    return OK;
}

static const struct key keys[] = {
    PARAM_REAL(struct step_options, tolerance, "tolerance", NULL, 0, 0.1, KEY_ABOVE | KEY_META, NULL,
               "relative error of every step"),
    KEYS_END,
};

const struct stepper_kind step_dopri5 = {
    .name = "dopri5",
    .brief = "Dormand-Prince 5(4), explicit, steps of its own inside H",
    .keys = keys,
    .order = 5,
    .adaptive = 1,
    .open = open,
    .step = step,
};
