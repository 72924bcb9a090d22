/* bdf.c -- backward differentiation formulas of order 1 to 5, the method of Gear that the paper names, by CVODE
 *
 * CVODE (Hindmarsh et al., SUNDIALS, ACM Trans. Math. Software 31, 2005) chooses steps and orders for y' = f(t, y); its
 *
 *     y = (u, v, W),   u' = rate(u, v) as in rk.h,   v' = M^-1 Q^(q0 (+) u, v, t),   W' = powers by channel
 *
 * is the motion from q0, the posture where it has begun, with the works since then, so that these are held by the tolerance as
 * the motion is.  Newton's equations (1 - g f_y) x = b are those of one implicit Euler step g of (2-4),
 *
 *     (M + g C + g^2 K) x_v = M b_v - g K b_u,   x_u = b_u + g rate(u, x_v),   x_W = b_W
 *
 * (W does not act on the motion), solved by our own algebra: CVODE is told when to form M, C, K and when to factor.
 *
 * What CVODE remembers, the past of y, ends where y does: at kinks and corners, where the state or its coordinates are changed from
 * outside, and where rotations have left the part of their chart in which rate() is near v, after about a radian.  There,
 * and behind a state that was kept in a file, it begins again with short steps of order 1.
 *
 * Errors of steps, of the order of what goes on, are to add up to the tolerance: each of N steps may take 1/(N + 10) of it, what
 * h/(t + 10 h) of adaptive.h is of equal steps, but not the less for a step that is short because it is the first.
 *
 * Orders above 2 grow vibrations that steps do not resolve, until their errors shorten the steps: where nothing damps them,
 * most_order 2 keeps steps long.  CVODE's own look-out for that (STALD) makes no fewer of them here.
 *
 * CVODE takes memory of its own when it is opened and gives none back before the end. */
#include "engine/adaptive.h"

#ifdef CVODE
#include <float.h>
#include <math.h>

#include "base/scalar.h"
#include "engine/bdf.h"
#include "engine/motion.h"

static void open(struct stepper *s, struct adaptive *m, struct arena *life)
{
    static const double PART = .5; /* ten orbits of eccentricity .6 are off by 160 tolerances else */
    static const struct collocation euler = {.s = 1, .nmode = 1, .mode = {{.re = 1}}};
    const struct ode2 *o = s->ode;
    struct bdf *x = m->own = TAKE(life, struct bdf, 1);
    *x = (struct bdf){.stepper = s, .motion = m, .n = o->n, .channels = o->workless ? 0 : POWER_CHANNELS};
    double **vector[] = {&x->u, &x->x, &x->v1, &x->a1, &x->start}, **posture[] = {&x->base, &x->q, &x->look, &x->q1};
    for (int i = 0; i < 5; i++) *vector[i] = TAKE(life, double, o->n);
    for (int i = 0; i < 4; i++) *posture[i] = TAKE(life, double, o->nq);
    x->y0 = TAKE(life, double, 2 * o->n + x->channels);
    stage_matrix_open(&x->matrix, &euler, o, &s->effort, life);
    m->tolerance *= PART;
    m->ahead = x->a1;
    if (o->n > 0) bdf_open(x, life);
}

static void forget(struct adaptive *m)
{
    struct bdf *x = m->own;
    x->begun = false;
}

/* ---- a step ---------------------------------------------------------------------------------------------------- */

/* Is the state where the past ends, and does it go on from there as it would have? */
static bool goes_on(const struct bdf *x, const struct adaptive *m, double t)
{
    const struct ode2 *o = x->stepper->ode;
    const size_t n = (size_t)o->n * sizeof(double), nq = (size_t)o->nq * sizeof(double);
    return x->begun && t == x->t1 && memcmp(m->q, x->q1, nq) == 0 && memcmp(m->v, x->v1, n) == 0 &&
           memcmp(m->a, x->a1, n) == 0;
}

static void begin(struct bdf *x, const struct adaptive *m, double t)
{
    const int n = x->n;
    double *y = bdf_values(x->y);
    copy(x->base, m->q, x->stepper->ode->nq);
    copy(x->q, m->q, x->stepper->ode->nq);
    zero(y, n);
    zero(x->start, n);
    copy(y + n, m->v, n);
    zero(y + 2 * n, x->channels);
    copy(x->y0, y, 2 * n + x->channels);
    x->t1 = t;
    (void)CVodeReInit(x->cvode, t, x->y);
    x->iterations = x->tests = x->solves = 0;
    x->begun = true;
}

/* Of so short a time only the start of the motion is to be seen. */
static void too_short(struct bdf *x, const struct adaptive *m, double h)
{
    double *y = bdf_values(x->y);
    for (int i = 0; i < x->n; i++) {
        y[i] = h * m->v[i];
        y[x->n + i] += h * m->a[i];
    }
    for (int c = 0; c < x->channels; c++) y[2 * x->n + c] = h * m->rk.w[0][c];
}

/* Where displacements add up each step has its own q0: from far away loops may be closed in another posture. */
static bool is_straight(const struct ode2 *o)
{
    return o->straight || !o->move;
}

static void begin_step(struct bdf *x, const struct adaptive *m)
{
    copy(x->y0, bdf_values(x->y), 2 * x->n + x->channels);
    if (!is_straight(x->stepper->ode)) return;
    copy(x->base, m->q, x->stepper->ode->nq);
    copy(x->start, x->y0, x->n);
}

/* Else it has to be the posture that is reached from the start of the step. */
static enum status end_step(struct bdf *x, struct adaptive *m, double t, struct trouble *why)
{
    static const double APART = 1e-6;
    const struct ode2 *o = x->stepper->ode;
    copy(m->q1, x->q, o->nq);
    if (is_straight(o)) return OK;
    motion_diff(o, x->x, x->q, m->q);
    motion_point(o, m->q1, m->q, x->x, 1, t);
    for (int i = 0; i < o->nq; i++)
        if (!(fabs(m->q1[i] - x->q[i]) <= APART * (1 + fabs(x->q[i]))))
            return trouble_set(why, TROUBLE_DIVERGED, -1, INFINITY, t);
    return OK;
}

/* Has rate() come away from v? */
static bool bent(struct bdf *x, const double *rate)
{
    static const double MUCH = .5;
    const struct ode2 *o = x->stepper->ode;
    double most = 0, top = 0;
    if (is_straight(o)) return false;
    for (int i = 0; i < x->n; i++) {
        most = larger(most, fabs(rate[i] - x->v1[i]) / ode2_usual(o, i));
        top = larger(top, fabs(x->v1[i]) / ode2_usual(o, i));
    }
    return most > MUCH * top;
}

static enum status attempt(struct stepper *s, struct adaptive *m, double *err, double t, double h, struct trouble *why)
{
    static const double SHORT = 1000 * DBL_EPSILON; /* of the time: CVODE cannot tell its ends apart */
    struct bdf *x = m->own;
    const int n = x->n;
    double end = t + h, *rate = bdf_values(x->scratch);
    copy(m->q1, m->q, s->ode->nq); /* the scales look at the end, which is not known yet */
    copy(m->v1, m->v, n);
    m->h = INFINITY; /* the next step is as long as CVODE will */
    x->plain = fabs(h) > SHORT * larger(fabs(t), fabs(end));
    if (!x->plain || !goes_on(x, m, t)) begin(x, m, t);
    begin_step(x, m);
    if (x->plain)
        TRY(bdf_step(x, &end, t, h, why));
    else
        too_short(x, m, h);
    m->came = end == t + h ? h : end - t;
    enum status status = bdf_evaluate(x, end, bdf_values(x->y), rate);
    if (status != OK) *why = x->why;
    if (status == OK) status = end_step(x, m, end, why);
    copy(m->v1, bdf_values(x->y) + n, n);
    copy(x->q1, m->q1, s->ode->nq);
    copy(x->v1, m->v1, n);
    copy(x->a1, rate + n, n);
    copy(x->w1, rate + 2 * n, x->channels);
    x->t1 = end;
    x->begun = status == OK && x->plain && !bent(x, rate);
    *err = 0; /* CVODE has judged it */
    return status;
}

static void take(struct stepper *s, struct adaptive *m, double h)
{
    struct bdf *x = m->own;
    const double *y = bdf_values(x->y);
    (void)h;
    for (int c = 0; c < x->channels; c++) m->work[c] += y[2 * x->n + c] - x->y0[2 * x->n + c];
    adaptive_travel(s, m, x->x);
    copy(m->a, x->a1, x->n);
    copy(m->rk.w[0], x->w1, POWER_CHANNELS);
    x->steps++;
}

/* Inside the last step, by CVODE's polynomial through the past. */
static void between(const struct stepper *s, const struct adaptive *m, double *u, double *v, double part)
{
    const struct bdf *x = m->own;
    const int n = x->n;
    const double t = m->t0 + part * (m->t1 - m->t0), *y = bdf_values(x->scratch);
    if (!x->plain || CVodeGetDky(x->cvode, t, 0, x->scratch) != 0) {
        for (int i = 0; i < n; i++) {
            u[i] = part * (m->t1 - m->t0) * m->v0[i];
            v[i] = m->v0[i] + part * (m->v[i] - m->v0[i]);
        }
        return;
    }
    copy(v, y + n, n);
    for (int i = 0; i < n; i++) u[i] = y[i] - x->y0[i];
    if (is_straight(s->ode)) return;
    copy(x->look, m->q, s->ode->nq);
    motion_onward(s->ode, x->look, x->base, y, 1, t, 0);
    motion_diff(s->ode, u, x->look, m->q0);
}

static void off(const struct stepper *s, const struct adaptive *m, double *position, double *velocity, double h)
{
    const struct bdf *x = m->own;
    const double *e = bdf_values(x->scratch);
    (void)s, (void)h;
    zero(position, x->n);
    zero(velocity, x->n);
    if (!x->plain || CVodeGetEstLocalErrors(x->cvode, x->scratch) != 0) return;
    copy(position, e, x->n);
    copy(velocity, e + x->n, x->n);
}

/* Steps are CVODE's. */
static double change(const struct adaptive *m, double err)
{
    (void)m, (void)err;
    return 1;
}

static enum status recall(struct stepper *s, struct adaptive *m, struct recall *r)
{
    struct bdf *x = m->own;
    (void)s;
    recall_one(r, "steps", x->steps);
    x->begun = false; /* a run that goes on behind a checkpoint does as one that begins with it */
    return OK;
}

static const struct adaptive_scheme formulas = {.stages = 2,
                                                .order = 2,
                                                .plain = true,
                                                .open = open,
                                                .forget = forget,
                                                .attempt = attempt,
                                                .take = take,
                                                .shrink = change,
                                                .grow = change,
                                                .between = between,
                                                .off = off,
                                                .drifts = 1,
                                                .recall = recall};
#endif

static const struct key keys[] = {
    KEY_TOLERANCE,
    PARAM_INT(struct step_options, most_order, "most_order", 1, 5, 0, "5",
              "not above it; 2 for stiff vibrations without damping, where the others need short steps"),
    KEYS_END};

#define BDF                                                                                                            \
    .name = "bdf",                                                                                                     \
    .brief = "Gear's method by CVODE, order 1 to 5, implicit, for stiff scenes, steps of its own inside H",            \
    .order = 5, .full = true, .needs = "libsundials-dev", .starts_anew = true, .keys = keys, .adaptive = 1
#ifdef CVODE
const struct stepper_kind step_bdf = {BDF, .formulas = &formulas, .open = adaptive_open, .step = adaptive_step,
                                      .recall = adaptive_recall};
#else
const struct stepper_kind step_bdf = {BDF};
#endif
