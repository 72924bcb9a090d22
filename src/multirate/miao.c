/* miao.c -- the paper's Newmark sub-cycling (2-12)...(2-25), with its misprints corrected
 *
 * There is no equation (2-11) in print: where it would stand, the text parts the coordinates into slow ones L, which
 * take Newmark steps (2-5), (2-6) of H = n h, and fast ones S, of h.  The common step
 * solves for q''_S1 and q''_Ln together:
 *
 *     M_SS q''_S1 + M_SL ((n-1) q''_L0 + q''_Ln)/n              = Q_S(t+h)              (2-14), (2-17*)
 *     M_LL q''_Ln + M_LS (q''_S0 + n (q''_S1 - q''_S0))         = Q_L(t+H)              (2-13), (2-18*)
 *
 * (both together (2-19*), for the accelerations instead of the positions)
 * with L at t+h interpolated, q_L1 = ((n-1) q_L0 + q_Ln)/n (2-15), its rates likewise, and S at t+H
 * extrapolated, q_S0 + n (q_S1 - q_S0) (2-16*), its rates likewise.  The other minor steps i = 1..n-1
 * solve
 *
 *     M_SS q''_S(i+1) + M_SL q''_L(i+1)                         = Q_S(t+(i+1)h)         (2-20*), (2-21*), (2-25*)
 *
 * with L interpolated, (2-22), (2-23).  As printed, (2-17), (2-18) and (2-24) take Newmark's difference
 * of interpolated positions for accelerations, which gives (2n-1) q''_L, and the scheme diverges for
 * h -> 0 once M_SL is not zero.  Corrected it is of order 2, but unstable for many (n, h) when S and L
 * share inertia: it is here to compare with.
 *
 * The residual is linear over bodies, so the slow rows at t+H are taken as r(FAST) + r(SLOW): slow
 * bodies see slow coordinates only, their power is not touched by the extrapolation. */
#include <math.h>

#include "base/stop.h"
#include "engine/matrix.h"
#include "engine/motion.h"
#include "engine/newmark.h"
#include "engine/newton.h"
#include "la/dense.h"

struct block {
    double *J; /* [m x m] */
    int *swap;
    enum matrix_form form;
};

struct miao {
    struct newton newton;
    const struct ode2 *ode;
    struct effort *effort;
    double beta, gamma;
    int n, ns, ratio;
    int i; /* the minor step under way */
    double h, H, hfactor;
    int nfactor;
    double *M, *K, *C, *spare;  /* [n x n] */
    struct block common, minor; /* iteration matrices of the common and of the other minor steps */
    const double *q0, *v0, *a0; /* start of the major step */
    double *z;                  /* [n] q''_S(i+1), q''_Ln */
    double *hs;                 /* [n] h or H */
    double *qi, *vi, *ai;       /* fast state at i, slow parts as interpolated */
    double *dx, *dn;            /* [n] displacements: S over h, L over H; and of one trial point */
    double *vn;                 /* [n] v_S(i+1), v_Ln */
    double *q, *v, *a, *r, *part;
    double *qkeep, *target;
    double *aold;
    struct instant x;
    double wf0[POWER_CHANNELS], wf[POWER_CHANNELS], ws0[POWER_CHANNELS], ws[POWER_CHANNELS];
    double hold, Hold;
};

static void block_open(struct block *b, int m, struct arena *life)
{
    b->J = TAKE_MATRIX(life, double, m, m);
    b->swap = TAKE(life, int, m);
}

static void open(struct stepper *s, struct arena *life)
{
    const struct ode2 *o = s->ode;
    int n = o->n;
    struct miao *m = TAKE(life, struct miao, 1);
    s->self = m;
    m->ode = o;
    m->effort = &s->effort;
    m->beta = s->options.beta;
    m->gamma = s->options.gamma;
    m->n = n;
    m->ns = o->ns;
    newton_open(&m->newton, o, &s->effort, &s->options, life);
    double **square[] = {&m->M, &m->K, &m->C, &m->spare};
    double **whole[] = {&m->z, &m->hs, &m->vi, &m->ai, &m->dx, &m->dn, &m->vn, &m->v, &m->a, &m->r, &m->part, &m->aold};
    double **place[] = {&m->qi, &m->q, &m->qkeep, &m->target};
    for (size_t i = 0; i < sizeof square / sizeof *square; i++) *square[i] = TAKE_MATRIX(life, double, n, n);
    for (size_t i = 0; i < sizeof whole / sizeof *whole; i++) *whole[i] = TAKE(life, double, n);
    for (size_t i = 0; i < sizeof place / sizeof *place; i++) *place[i] = TAKE(life, double, o->nq);
    block_open(&m->common, n, life);
    block_open(&m->minor, o->ns, life);
}

/* (2-5), (2-6) for coordinate range [from, to), step h, from v, a to the acceleration z. */
static void newmark(struct miao *m, const double *v, const double *a, const double *z, double h, int from, int to)
{
    for (int i = from; i < to; i++) {
        m->dx[i] = h * v[i] + h * h / 2 * ((1 - 2 * m->beta) * a[i] + 2 * m->beta * z[i]);
        m->vn[i] = v[i] + h * ((1 - m->gamma) * a[i] + m->gamma * z[i]);
    }
}

/* Rates of L at fraction s of H: (2-23). */
static void slow_rates(struct miao *m, double s)
{
    for (int i = m->ns; i < m->n; i++) {
        m->v[i] = (1 - s) * m->v0[i] + s * m->vn[i];
        m->a[i] = (1 - s) * m->a0[i] + s * m->z[i];
    }
}

/* m->q := the fast state at i moved by dx_S, the slow one on its way at fraction s of H (2-22). */
static void trial_place(struct miao *m, double s)
{
    const struct ode2 *o = m->ode;
    if (o->move) { /* what is missing of the slow way, seen from q_i */
        zero(m->dn, m->ns);
        copy(m->dn + m->ns, m->dx + m->ns, m->n - m->ns);
        motion_point(o, m->target, m->q0, m->dn, s, m->x.t);
        motion_diff(o, m->dn, m->target, m->qi);
        copy(m->dn, m->dx, m->ns);
        motion_point(o, m->q, m->qi, m->dn, 1, m->x.t);
        return;
    }
    for (int i = 0; i < m->ns; i++) m->q[i] = m->qi[i] + m->dx[i];
    for (int i = m->ns; i < m->n; i++) m->q[i] = m->q0[i] + s * m->dx[i];
}

/* Fast rows at minor step i + 1 for the accelerations z. */
static enum status fast_rows(struct miao *m, double *r, double *dk, int i, struct trouble *why)
{
    newmark(m, m->vi, m->ai, m->z, m->h, 0, m->ns);
    trial_place(m, (i + 1.) / m->ratio);
    slow_rates(m, (i + 1.) / m->ratio);
    copy(m->v, m->vn, m->ns);
    copy(m->a, m->z, m->ns);
    m->effort->fast++;
    return m->ode->ops->resid(m->ode, r, m->wf, dk, &m->x, FAST, why);
}

/* Slow rows at t+H with S extrapolated from the first minor step (2-16*). */
static enum status slow_rows(struct miao *m, double *r, double *dk, double T, struct trouble *why)
{
    const struct ode2 *o = m->ode;
    struct instant x = {.t = m->x.t - m->h + T, .q = m->q, .v = m->v, .a = m->a};
    double n = m->ratio, dkf = 0;
    x.ta = x.tb = x.t;
    for (int i = 0; i < m->ns; i++) {
        m->dn[i] = n * m->dx[i];
        m->v[i] = m->v0[i] + n * (m->vn[i] - m->v0[i]);
        m->a[i] = m->a0[i] + n * (m->z[i] - m->a0[i]);
    }
    copy(m->dn + m->ns, m->dx + m->ns, m->n - m->ns);
    slow_rates(m, 1);
    motion_point(o, m->q, m->q0, m->dn, 1, x.t);
    m->effort->slow++;
    m->effort->fast++;
    TRY(o->ops->resid(o, m->part, NULL, &dkf, &x, FAST, why));
    TRY(o->ops->resid(o, m->r, m->ws, dk, &x, SLOW, why));
    *dk = fmax(*dk, dkf);
    for (int i = m->ns; i < m->n; i++) r[i] = m->part[i] + m->r[i];
    return OK;
}

static enum status common_resid(void *self, double *r, double *dk, const double *z, struct trouble *why)
{
    struct miao *m = self;
    double dks = 0;
    (void)z; /* is m->z */
    newmark(m, m->v0, m->a0, m->z, m->H, m->ns, m->n);
    TRY(fast_rows(m, r, dk, 0, why));
    TRY(slow_rows(m, r, &dks, m->H, why));
    *dk = fmax(*dk, dks);
    return OK;
}

static enum status minor_resid(void *self, double *r, double *dk, const double *z, struct trouble *why)
{
    struct miao *m = self;
    (void)z;
    return fast_rows(m, r, dk, m->i, why);
}

/* J of the common step: rows S by h, rows L by the extrapolation,
 *
 *     [ M_SS + gamma h C_SS + beta h^2 K_SS     (M_SL + gamma H C_SL + beta H^2 K_SL)/n ]
 *     [ n (M_LS + gamma h C_LS + beta h^2 K_LS)  M_LL + gamma H C_LL + beta H^2 K_LL    ] */
static int common_factor(struct miao *m)
{
    int n = m->n, ns = m->ns;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double T = j < ns ? m->h : m->H, s = i < ns ? (j < ns ? 1 : 1. / m->ratio) : (j < ns ? m->ratio : 1);
            int at = i + j * n;
            m->common.J[at] = s * (m->M[at] + m->gamma * T * m->C[at] + m->beta * T * T * m->K[at]);
            if (i < ns && j < ns) m->minor.J[i + j * ns] = m->common.J[at];
        }
    int pivot = factor_dense(m->common.J, m->common.swap, m->spare, &m->common.form, n);
    return pivot >= 0 ? pivot : factor_dense(m->minor.J, m->minor.swap, m->spare, &m->minor.form, ns);
}

static enum status refresh(void *self, const double *z, struct trouble *why)
{
    struct miao *m = self;
    const struct ode2 *o = m->ode;
    (void)z;
    m->effort->factors++;
    m->effort->slow++;
    m->effort->fast++;
    TRY(o->ops->slopes(o, m->K, m->C, &m->x, ALL, why));
    TRY(o->ops->mass(o, m->M, m->x.q, m->x.t, ALL, why));
    int pivot = common_factor(m);
    m->hfactor = m->h;
    m->nfactor = m->ratio;
    return pivot < 0 ? OK : trouble_set(why, TROUBLE_SINGULAR, pivot, 0, m->x.t);
}

static void common_solve(void *self, double *dz, const double *r)
{
    struct miao *m = self;
    copy(dz, r, m->n);
    solve_dense(m->common.J, m->common.swap, m->common.form, dz, m->n);
}

static void minor_solve(void *self, double *dz, const double *r)
{
    struct miao *m = self;
    copy(dz, r, m->ns);
    solve_dense(m->minor.J, m->minor.swap, m->minor.form, dz, m->ns);
}

/* z from the last accelerations; the local error h/12 |da| as a velocity, in scales. */
static double predict(struct miao *m, const struct state *x, int fresh)
{
    double local = 0;
    for (int i = 0; i < m->n; i++) {
        double T = i < m->ns ? m->h : m->H, before = i < m->ns ? m->hold : m->Hold;
        double da = fresh ? 0 : T / before * (x->a[i] - m->aold[i]);
        m->z[i] = x->a[i] + da;
        m->hs[i] = T;
        local = fmax(local, fabs(T / 12 * da) * m->newton.per[i]);
    }
    return fresh ? -1 : local;
}

static void book(struct miao *m, struct stepper *s)
{
    s->left += fabs(m->h * dot(m->newton.r, m->vn, m->ns)) * fmin(1, m->newton.remain);
    s->last_sweeps += m->newton.count;
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += m->h / 2 * (m->wf0[c] + m->wf[c]);
    copy(m->wf0, m->wf, POWER_CHANNELS);
}

/* The state at i+1 from z. */
static void minor_end(struct miao *m, int i)
{
    newmark(m, m->vi, m->ai, m->z, m->h, 0, m->ns);
    trial_place(m, (i + 1.) / m->ratio);
    copy(m->qi, m->q, m->ode->nq);
    copy(m->aold, m->ai, m->ns);
    copy(m->vi, m->vn, m->ns);
    copy(m->ai, m->z, m->ns);
}

static enum status minor_steps(struct miao *m, struct stepper *s, double t0, double to, struct trouble *why)
{
    struct equations eq = {m, &m->x, minor_resid, refresh, minor_solve, NULL};
    for (int i = 1; i < m->ratio; i++) {
        double local = 0;
        if (stop) return stop_status();
        m->i = i;
        m->x.t = m->x.ta = m->x.tb = i + 1 < m->ratio ? t0 + (i + 1) * m->h : to;
        for (int j = 0; j < m->ns; j++) {
            double da = m->ai[j] - m->aold[j];
            m->z[j] = m->ai[j] + da;
            local = fmax(local, fabs(m->h / 12 * da) * m->newton.per[j]);
        }
        newton_begin(&m->newton, local);
        TRY(newton_solve(&m->newton, m->z, &eq, m->hs, m->ns, why));
        book(m, s);
        minor_end(m, i);
    }
    return OK;
}

/* Power at the start of a run, scales. */
static enum status begin(struct miao *m, const struct state *x, struct trouble *why)
{
    const struct ode2 *o = m->ode;
    struct instant start = {.t = x->t, .q = x->q, .v = x->v, .a = x->a, .ta = x->t, .tb = x->t};
    newton_forget(&m->newton);
    newton_scale(&m->newton, x->v, x->a, m->H);
    m->effort->slow++;
    m->effort->fast++;
    TRY(o->ops->resid(o, m->r, m->wf0, NULL, &start, FAST, why));
    return o->ops->resid(o, m->r, m->ws0, NULL, &start, SLOW, why);
}

static enum status common_step(struct miao *m, struct stepper *s, const struct state *x, struct trouble *why)
{
    struct equations eq = {m, &m->x, common_resid, refresh, common_solve, NULL};
    copy(m->qi, x->q, m->ode->nq);
    copy(m->vi, x->v, m->n);
    copy(m->ai, x->a, m->n);
    newton_begin(&m->newton, predict(m, x, s->fresh));
    if (m->newton.stale || m->h != m->hfactor || m->ratio != m->nfactor) {
        copy(m->q, x->q, m->ode->nq);
        copy(m->v, x->v, m->n);
        copy(m->a, x->a, m->n);
        TRY(refresh(m, m->z, why));
        newton_refreshed(&m->newton);
    }
    TRY(newton_solve(&m->newton, m->z, &eq, m->hs, m->n, why));
    newmark(m, m->v0, m->a0, m->z, m->H, m->ns, m->n);
    book(m, s);
    minor_end(m, 0);
    return OK;
}

static void accept(struct miao *m, struct stepper *s, struct state *x, double to)
{
    int n = m->n, ns = m->ns;
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += m->H / 2 * (m->ws0[c] + m->ws[c]);
    copy(m->ws0, m->ws, POWER_CHANNELS);
    copy(m->aold + ns, x->a + ns, n - ns);
    copy(x->q, m->qi, m->ode->nq);
    copy(x->v, m->vn, n);
    copy(x->a, m->z, n);
    x->t = to;
    m->hold = m->h;
    m->Hold = m->H;
    newton_scale(&m->newton, x->v, x->a, m->H);
    s->effort.minors += m->ratio;
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct miao *m = s->self;
    m->h = h;
    m->H = ratio * h;
    m->ratio = ratio;
    m->q0 = x->q;
    m->v0 = x->v;
    m->a0 = x->a;
    if (s->fresh) TRY(begin(m, x, why));
    m->x = (struct instant){.t = ratio > 1 ? x->t + h : to, .q = m->q, .v = m->v, .a = m->a};
    m->x.ta = m->x.tb = m->x.t;
    enum status status = common_step(m, s, x, why);
    if (status == OK) status = minor_steps(m, s, x->t, to, why);
    if (status != OK) {
        m->newton.stale = 1;
        s->fresh = 1; /* fast predictors and powers have gone ahead */
        return status;
    }
    accept(m, s, x, to);
    s->fresh = 0;
    return OK;
}

static void block_recall(struct block *b, struct recall *r, const char *name, int m)
{
    recall_within(r, name);
    recall_list(r, "J", b->J, m * m);
    recall_list(r, "swap", b->swap, m);
    form_recall(&b->form, r);
    recall_without(r);
}

static enum status recall(struct stepper *s, struct recall *r)
{
    struct miao *m = s->self;
    newton_recall(&m->newton, r);
    recall_one(r, "hfactor", m->hfactor);
    recall_one(r, "nfactor", m->nfactor);
    block_recall(&m->common, r, "common", m->n);
    block_recall(&m->minor, r, "minor", m->ns);
    recall_list(r, "aold", m->aold, m->n);
    recall_list(r, "fast_power", m->wf0, POWER_CHANNELS);
    recall_list(r, "slow_power", m->ws0, POWER_CHANNELS);
    recall_one(r, "hold", m->hold);
    recall_one(r, "Hold", m->Hold);
    return OK;
}

static const struct key keys[] = {KEYS_NEWMARK, KEY_NEWTON_TOLERANCE, KEYS_END};

const struct stepper_kind step_miao = {
    .name = "miao",
    .brief = "Newmark sub-cycling (2-12)...(2-25) of Miao, Zhu, Shi & Chen, misprints corrected",
    .keys = keys,
    .fits = newmark_fits,
    .single = &step_newmark,
    .two_rates = true,
    .yardstick = true,
    .points = 1,
    .order = 2,
    .open = open,
    .step = step,
    .recall = recall,
};
