/* newmark.c -- Newmark's method (2-5)...(2-10)
 *
 *     q1 = q0 (+) h v0 + h^2/2 ((1 - 2 beta) a0 + 2 beta a1)                (2-5)
 *     v1 = v0 + h ((1 - gamma) a0 + gamma a1)                               (2-6)
 *     M^(q1) a1 = Q^(q1, v1, t1)                                            (2-7)
 *
 * The unknown is a1: (2-8), the same solved for q1, has the large factor 1/(beta h^2).
 *
 * Newton for a1 with J = M^ + gamma h C + beta h^2 K.  The paper's own iteration (2-9) is kept as an
 * option: a1 := M^^-1 Q^ at the last iterate, from (2-10*) a1 = a0.  It converges only for
 * beta (omega h)^2 < 1, the limit of an explicit method. */
#include "engine/newmark.h"

#include <math.h>
#include <stdio.h>

#include "engine/accel.h"
#include "engine/matrix.h"
#include "engine/motion.h"
#include "engine/newton.h"
#include "engine/predict.h"
#include "engine/single.h"

struct newmark {
    struct newton newton;
    struct matrix J;
    struct predict predict;
    struct single keep;
    const struct ode2 *ode;
    struct effort *effort;
    struct accel *accel;
    double beta, gamma;
    int fixed_point;
    struct instant x; /* the end under trial */
    double *q, *v, *dx, *a, *hs;
    const double *q0, *v0, *a0;
    double h, hfactor;
    int placed;                                   /* q, v are those of m->a: the matrix was made there */
    double w0[POWER_CHANNELS], w[POWER_CHANNELS]; /* power at the start and at the end */
};

static void open(struct stepper *s, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct newmark *m = TAKE(life, struct newmark, 1);
    m->ode = o;
    m->effort = &s->effort;
    m->accel = s->accel;
    m->beta = s->options.beta;
    m->gamma = s->options.gamma;
    m->fixed_point = s->options.iteration == ITERATION_FIXED_POINT;
    newton_open(&m->newton, o, &s->effort, &s->options, life);
    if (m->fixed_point) m->newton.limit = 50;
    matrix_open(&m->J, o, &s->effort, life);
    predict_open(&m->predict, o->n, life);
    single_open(&m->keep, o, life);
    m->q = TAKE(life, double, o->nq);
    m->v = TAKE(life, double, o->n);
    m->dx = TAKE(life, double, o->n);
    m->a = TAKE(life, double, o->n);
    m->hs = TAKE(life, double, o->n);
    s->self = m;
}

/* The end that belongs to a1: (2-5), (2-6). */
static void place(struct newmark *m, const double *a1)
{
    double h = m->h, b0 = h * h / 2 * (1 - 2 * m->beta), b1 = h * h * m->beta;
    double g0 = h * (1 - m->gamma), g1 = h * m->gamma;
    for (int i = 0; i < m->ode->n; i++) {
        m->dx[i] = h * m->v0[i] + b0 * m->a0[i] + b1 * a1[i];
        m->v[i] = m->v0[i] + g0 * m->a0[i] + g1 * a1[i];
    }
    if (m->newton.count > 0) /* m->q is that of the last iterate */
        motion_again(m->ode, m->q, m->q0, m->dx, 1, m->x.t);
    else
        motion_point(m->ode, m->q, m->q0, m->dx, 1, m->x.t);
    m->x.a = a1;
}

/* The residual of (2-7). */
static enum status resid(void *self, double *r, double *dk, const double *a, struct trouble *why)
{
    struct newmark *m = self;
    if (!m->placed) place(m, a);
    m->placed = 0;
    m->effort->slow++;
    m->effort->fast++;
    return m->ode->ops->resid(m->ode, r, m->w, dk, &m->x, ALL, why);
}

static enum status refresh(void *self, const double *a, struct trouble *why)
{
    struct newmark *m = self;
    place(m, a);
    m->hfactor = m->h;
    return matrix_factor(&m->J, m->gamma * m->h, m->beta * m->h * m->h, &m->x, why);
}

static void solve(void *self, double *dz)
{
    matrix_solve(&((struct newmark *)self)->J, dz);
}

/* (2-9): a - M^^-1 Q^ at the last iterate, as a residual whose matrix is 1. */
static enum status defect(void *self, double *r, double *dk, const double *a, struct trouble *why)
{
    struct newmark *m = self;
    place(m, a);
    *dk = 0;
    TRY(accel_solve(m->accel, r, m->w, m->q, m->v, m->x.t, why));
    for (int i = 0; i < m->ode->n; i++) r[i] = a[i] - r[i];
    return OK;
}

static enum status no_refresh(void *self, const double *a, struct trouble *why)
{
    (void)self, (void)a, (void)why;
    return OK;
}

static void no_solve(void *self, double *dz)
{
    (void)self, (void)dz;
}

/* a1 from the steps before; (2-10*) for the fixed point.  Returns the step's local error, in scales; negative:
 * unknown. */
static double predict(struct newmark *m, const struct state *x, int fresh)
{
    for (int i = 0; i < m->ode->n; i++) m->hs[i] = m->h;
    if (fresh) predict_forget(&m->predict);
    predict_make(&m->predict, m->a, m->h == m->hfactor ? &m->J : NULL, m->h, x->v, x->a, m->h / 2);
    if (m->fixed_point) copy(m->a, x->a, m->ode->n);
    return fresh ? -1 : predict_error(&m->predict, m->h, m->newton.per);
}

static void accept(struct newmark *m, struct stepper *s, struct state *x, double t1)
{
    int n = m->ode->n;
    double push = dot(m->newton.r, m->v, n);
    s->left += fabs(m->h * push) * fmin(1, m->newton.remain);
    s->last_sweeps += m->newton.count;
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += m->h / 2 * (m->w0[c] + m->w[c]);
    copy(m->w0, m->w, POWER_CHANNELS);
    place(m, m->a);
    predict_keep(&m->predict, m->a, x->a, m->h, m->newton.per);
    copy(x->a, m->a, n);
    copy(x->q, m->q, m->ode->nq);
    copy(x->v, m->v, n);
    x->t = t1;
    newton_scale(&m->newton, x->v, x->a, m->h);
}

/* Scales and the power at the start of a run. */
static enum status begin(struct newmark *m, const struct state *x, double h, struct trouble *why)
{
    struct instant start = {.t = x->t, .q = x->q, .v = x->v, .a = x->a, .ta = x->t, .tb = x->t};
    newton_forget(&m->newton);
    newton_scale(&m->newton, x->v, x->a, h);
    m->effort->slow++;
    m->effort->fast++;
    return m->ode->ops->resid(m->ode, m->newton.r, m->w0, NULL, &start, ALL, why);
}

static enum status iterate(struct newmark *m, struct trouble *why)
{
    static const struct equations by_newton = {NULL, NULL, resid, refresh, solve};
    static const struct equations by_fixed_point = {NULL, NULL, defect, no_refresh, no_solve};
    struct equations eq = m->fixed_point ? by_fixed_point : by_newton;
    eq.self = m;
    eq.x = &m->x;
    m->placed = 0;
    if (m->fixed_point) {
        m->newton.refreshed = 1 << 20; /* there is no matrix to blame */
    } else if (m->newton.stale || m->h != m->hfactor) {
        TRY(refresh(m, m->a, why));
        newton_refreshed(&m->newton);
        m->placed = 1;
    }
    return newton_solve(&m->newton, m->a, &eq, m->hs, m->ode->n, why);
}

static enum status one(struct stepper *s, struct state *x, double h, double t1, struct trouble *why)
{
    struct newmark *m = s->self;
    int fresh = s->fresh;
    if (fresh) TRY(begin(m, x, h, why));
    m->h = h;
    m->q0 = x->q;
    m->v0 = x->v;
    m->a0 = x->a;
    m->x = (struct instant){.t = t1, .q = m->q, .v = m->v, .ta = t1, .tb = t1};
    newton_begin(&m->newton, predict(m, x, fresh));
    enum status status = iterate(m, why);
    if (status != OK) {
        m->newton.stale = 1;
        return status;
    }
    accept(m, s, x, t1);
    s->fresh = 0;
    return OK;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct newmark *m = s->self;
    return single_steps(&m->keep, s, x, h, ratio, to, one, why);
}

bool newmark_fits(const struct step_options *o, struct misfit *why)
{
    if (2 * o->beta >= o->gamma) return true;
    *why = (struct misfit){.code = "E-newmark", .key = "beta"};
    snprintf(why->text, sizeof why->text, "beta %g and gamma %g: not stable for every step", o->beta, o->gamma);
    why->hint = "the rule is 2 beta >= gamma >= 1/2; beta 1/4, gamma 1/2 keep energy";
    return false;
}

static const struct key keys[] = {
    KEYS_NEWMARK,
    PARAM_WORD(struct step_options, iteration, "iteration", "newton|fixed-point", 0, "newton",
               "fixed-point is (2-9), which needs small steps"),
    KEY_NEWTON_TOLERANCE,
    KEYS_END,
};

const struct stepper_kind step_newmark = {
    .name = "newmark",
    .brief = "Newmark's method (2-5)...(2-10), one rate",
    .keys = keys,
    .fits = newmark_fits,
    .rates = 1,
    .points = 1,
    .order = 2,
    .open = open,
    .step = step,
};
