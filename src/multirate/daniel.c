/* daniel.c -- explicit sub-cycling by a partition of the coordinates, to compare with: daniel and neal-belytschko
 *
 * Central differences in velocity form, of H = n h for the slow coordinates L and of h for the fast ones S.  L goes
 * first, and where it is at the minor steps s = h, 2h, ..., H behind t is known before S follows:
 *
 *     daniel            q_L(s) = q_L0 + s q'_L0 + s^2/2 q''_L0          constant acceleration over the major step
 *     neal-belytschko   q_L(s) = q_L0 + s (q'_L0 + H/2 q''_L0)          constant velocity
 *
 *     q_S(i+1)   = q_S,i + h q'_S,i + h^2/2 q''_S,i
 *     M_SS q''_S(i+1) = Q_S(q_S(i+1), q_L(s)) - M_SL q''_L0             before the end; at it (2-4) for all
 *     q'_S(i+1)  = q'_S,i + h/2 (q''_S,i + q''_S(i+1)),  q'_Ln = q'_L0 + H/2 (q''_L0 + q''_Ln)
 *
 * W. J. T. Daniel, Analysis and implementation of a new constant acceleration subcycling algorithm, IJNME 40 (1997) 2841;
 * M. O. Neal and T. Belytschko, Computers and Structures 31 (1989) 871, here with whole ratios only.  Their texts were not
 * at hand: this is derived from what their titles, and those who quote them, say of them.  Both are for lumped masses, M_SL =
 * 0, where both are of order 2; the term of M_SL is ours, and with it they are of order 1 and grow at every step.  Rates in
 * Q are foretold, q' + h q''.
 *
 * Stability without M_SL, without damping (found by the eigenvalues of the map over a major step): w_S h < 2 and w_L H < 2
 * are necessary; below, constant velocity grows in narrow bands near w_S H = k pi, constant acceleration weakly almost
 * anywhere (1.02 a major step at most where both are below 0.5). */
#include <math.h>

#include "base/stop.h"
#include "engine/accel.h"
#include "engine/motion.h"
#include "la/dense.h"
#include "multirate/schemes.h"

/* Where L is s behind the start of a major step of H, against q_L0, and how fast. */
struct path {
    double (*moved)(double v, double a, double s, double H);
    double (*rate)(double v, double a, double s, double H);
};

static double accelerated(double v, double a, double s, double H)
{
    (void)H;
    return s * v + s * s / 2 * a;
}

static double accelerated_rate(double v, double a, double s, double H)
{
    (void)H;
    return v + s * a;
}

static double straight(double v, double a, double s, double H)
{
    return s * (v + H / 2 * a);
}

static double straight_rate(double v, double a, double s, double H)
{
    return s < H ? v + H / 2 * a : v + H * a; /* at the end the forces of all are wanted */
}

struct partition {
    const struct path *path;
    int n, ns;
    double *M;                                     /* [n x n] */
    double *q, *v, *a;                             /* S at the minor step, L at the start */
    double *at, *vt;                               /* trial place, its rates */
    double *slow, *dx, *part;                      /* what L has moved from q0 (that of S is 0), all from q */
    double *next;                                  /* accelerations there */
    double wf[POWER_CHANNELS], ws[POWER_CHANNELS]; /* power of the fast and slow parts, where the last step ended */
};

static void open(struct stepper *s, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct partition *m = TAKE(life, struct partition, 1);
    s->self = m;
    m->path = s->kind->formulas;
    m->n = o->n;
    m->ns = o->ns;
    m->M = TAKE_MATRIX(life, double, o->n, o->n);
    double **whole[] = {&m->v, &m->a, &m->vt, &m->slow, &m->dx, &m->part, &m->next};
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) *whole[i] = TAKE(life, double, o->n);
    m->q = TAKE(life, double, o->nq);
    m->at = TAKE(life, double, o->nq);
}

/* m->at, m->vt: S a minor step on, L at its place s behind the start x. */
static void foretell(struct partition *m, const struct ode2 *o, const struct state *x, double h, double s, double H,
                     double t)
{
    for (int i = m->ns; i < m->n; i++) {
        m->slow[i] = m->path->moved(x->v[i], x->a[i], s, H);
        m->vt[i] = m->path->rate(x->v[i], x->a[i], s, H);
    }
    motion_point(o, m->at, x->q, m->slow, 1, t);
    motion_diff(o, m->dx, m->at, m->q);
    for (int i = 0; i < m->ns; i++) {
        m->dx[i] = h * m->v[i] + h * h / 2 * m->a[i];
        m->vt[i] = m->v[i] + h * m->a[i];
    }
    motion_point(o, m->at, m->q, m->dx, 1, t);
}

/* Fast accelerations there, with those of L as at the start: r is linear in them. */
static enum status fast_accelerations(struct partition *m, struct stepper *s, double *w, double t, struct trouble *why)
{
    const struct ode2 *o = s->ode;
    const struct instant x = {.t = t, .q = m->at, .v = m->vt, .a = m->a, .ta = t, .tb = t};
    s->effort.fast++;
    TRY(o->ops->resid(o, m->part, w, NULL, &x, FAST, why));
    TRY(o->ops->mass(o, m->M, m->at, t, FAST, why));
    const int pivot = dense_cholesky(m->M, m->ns, m->n);
    if (pivot >= 0) return trouble_set(why, TROUBLE_MASS, pivot, 0, t);
    dense_cholesky_solve(m->M, m->part, m->ns, m->n);
    copy(m->next, m->a, m->n);
    for (int i = 0; i < m->ns; i++) {
        m->next[i] -= m->part[i];
        if (!isfinite(m->next[i])) return trouble_set(why, TROUBLE_NOT_FINITE, i, m->next[i], t);
    }
    return OK;
}

/* Power of both parts where a, v, q are known. */
static enum status powers(struct partition *m, struct stepper *s, double *wf, double *ws, const double *q,
                          const double *v, const double *a, double t, struct trouble *why)
{
    const struct ode2 *o = s->ode;
    const struct instant x = {.t = t, .q = q, .v = v, .a = a, .ta = t, .tb = t};
    s->effort.fast++;
    s->effort.slow++;
    TRY(o->ops->resid(o, m->part, wf, NULL, &x, FAST, why));
    return o->ops->resid(o, m->part, ws, NULL, &x, SLOW, why);
}

static void book(struct stepper *s, double *before, const double *now, double h)
{
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += h / 2 * (before[c] + now[c]);
    copy(before, now, POWER_CHANNELS);
}

/* S to the next place: (2-6) with gamma = 1/2. */
static void follow(struct partition *m, const struct ode2 *o, double h)
{
    copy(m->q, m->at, o->nq);
    for (int i = 0; i < m->ns; i++) {
        m->v[i] += h / 2 * (m->a[i] + m->next[i]);
        m->a[i] = m->next[i];
    }
}

static enum status minor_steps(struct partition *m, struct stepper *s, const struct state *x, double h, int ratio,
                               struct trouble *why)
{
    for (int i = 1; i < ratio && m->ns > 0; i++) {
        double w[POWER_CHANNELS];
        if (stop) return stop_status();
        foretell(m, s->ode, x, h, i * h, ratio * h, x->t + i * h);
        TRY(fast_accelerations(m, s, w, x->t + i * h, why));
        follow(m, s->ode, h);
        book(s, m->wf, w, h);
    }
    return OK;
}

static enum status common_step(struct partition *m, struct stepper *s, const struct state *x, double h, int ratio,
                               double to, struct trouble *why)
{
    const double H = ratio * h, part = m->ns > 0 ? h : H;
    double wf[POWER_CHANNELS], ws[POWER_CHANNELS];
    foretell(m, s->ode, x, h, H, H, to);
    TRY(accel_solve(s->accel, m->next, NULL, m->at, m->vt, to, why));
    for (int i = m->ns; i < m->n; i++) m->v[i] = x->v[i] + H / 2 * (x->a[i] + m->next[i]);
    follow(m, s->ode, h);
    copy(m->a, m->next, m->n);
    TRY(powers(m, s, wf, ws, m->q, m->v, m->a, to, why));
    book(s, m->wf, wf, part);
    book(s, m->ws, ws, H);
    return OK;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct partition *m = s->self;
    if (s->fresh) TRY(powers(m, s, m->wf, m->ws, x->q, x->v, x->a, x->t, why));
    copy(m->q, x->q, s->ode->nq);
    copy(m->v, x->v, m->n);
    copy(m->a, x->a, m->n);
    s->fresh = 1; /* the fast power goes ahead */
    TRY(minor_steps(m, s, x, h, ratio, why));
    TRY(common_step(m, s, x, h, ratio, to, why));
    copy(x->q, m->q, s->ode->nq);
    copy(x->v, m->v, m->n);
    copy(x->a, m->a, m->n);
    x->t = to;
    s->effort.minors += ratio;
    s->fresh = 0;
    return OK;
}

static enum status recall(struct stepper *s, struct recall *r)
{
    struct partition *m = s->self;
    recall_list(r, "fast_power", m->wf, POWER_CHANNELS);
    recall_list(r, "slow_power", m->ws, POWER_CHANNELS);
    return OK;
}

static const struct key keys[] = {KEYS_END};
static const struct path constant_acceleration = {accelerated, accelerated_rate};
static const struct path constant_velocity = {straight, straight_rate};

#define KIND(name_, brief_, path_)                                                                                     \
    {                                                                                                                  \
        .name = name_, .brief = brief_, .keys = keys, .two_rates = true, .yardstick = true, .points = 1, .order = 2,   \
        .formulas = path_, .open = open, .step = step, .recall = recall                                                \
    }
const struct stepper_kind step_daniel =
    KIND("daniel", "explicit sub-cycling with constant acceleration of the slow part, to compare with",
         &constant_acceleration);
const struct stepper_kind step_neal_belytschko =
    KIND("neal-belytschko", "explicit sub-cycling with constant velocity of the slow part, to compare with",
         &constant_velocity);
