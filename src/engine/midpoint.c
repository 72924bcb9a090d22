/* midpoint.c -- the implicit midpoint rule
 *
 *     q1 = q0 (+) h v,  v = v0 + h a / 2,  v1 = v0 + h a,  r(q0 (+) h v / 2, v, a, t0 + h/2) = 0
 *
 * Second order, symmetric.  It keeps quadratic invariants (Cooper 1987), so the energy of a linear
 * system is exact, with work h v . Q.  For a body R1 = R0 cay(h omega) gives both R1 J omega1 =
 * R0 J omega0 and omega . J (omega1 - omega0) = 0: momentum and energy of a free body are exact too
 * (Austin, Krishnaprasad & Wang, J. Comput. Phys. 107, 1993).  Mechanisms that fly freely get the same by va, vb and
 * settle() of ode2.h.
 *
 * Newton for a with J = M^ + (h/2) C + (h^2/4) K. */
#include "engine/midpoint.h"

#include <math.h>

#include "engine/matrix.h"
#include "engine/motion.h"
#include "engine/newton.h"
#include "engine/predict.h"
#include "engine/single.h"

struct midpoint {
    struct newton newton;
    struct matrix J;
    struct predict predict;
    struct single keep;
    const struct ode2 *ode;
    struct effort *effort;
    struct instant x; /* the midpoint under trial */
    double *q, *v, *q1, *v1, *dx, *a, *hs;
    const double *q0, *v0;
    double h, hfactor;
    int placed; /* q, v are those of m->a: the matrix was made there */
    double w[POWER_CHANNELS];
};

struct midpoint *midpoint_new(struct stepper *s, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct midpoint *m = TAKE(life, struct midpoint, 1);
    m->ode = o;
    m->effort = &s->effort;
    newton_open(&m->newton, o, &s->effort, &s->options, life);
    matrix_open(&m->J, o, &s->effort, life);
    predict_open(&m->predict, o->n, life);
    single_open(&m->keep, o, life);
    m->q = TAKE(life, double, o->nq);
    m->q1 = TAKE(life, double, o->nq);
    m->v = TAKE(life, double, o->n);
    m->v1 = TAKE(life, double, o->n);
    m->dx = TAKE(life, double, o->n);
    m->a = TAKE(life, double, o->n);
    m->hs = TAKE(life, double, o->n);
    return m;
}

/* Velocities that belong to the mean acceleration a, and the way of the step. */
static void go(struct midpoint *m, const double *a)
{
    for (int i = 0; i < m->ode->n; i++) {
        m->v[i] = m->v0[i] + m->h / 2 * a[i];
        m->v1[i] = m->v0[i] + m->h * a[i];
        m->dx[i] = m->h * m->v[i];
    }
}

/* The midpoint that belongs to a, and the end where it is looked at. */
static void place(struct midpoint *m, const double *a)
{
    go(m, a);
    motion_point(m->ode, m->q, m->q0, m->dx, .5, m->x.t);
    if (m->x.qb) motion_point(m->ode, m->q1, m->q0, m->dx, 1, m->x.tb);
    m->x.a = a;
}

static enum status resid(void *self, double *r, double *dk, const double *a, struct trouble *why)
{
    struct midpoint *m = self;
    if (!m->placed) place(m, a);
    m->placed = 0;
    m->effort->slow++;
    m->effort->fast++;
    enum status status = m->ode->ops->resid(m->ode, r, m->w, dk, &m->x, ALL, why);
    for (int c = 0; c < POWER_CHANNELS; c++) m->newton.powered |= m->w[c] != 0;
    return status;
}

static enum status refresh(void *self, const double *a, struct trouble *why)
{
    struct midpoint *m = self;
    place(m, a);
    m->hfactor = m->h;
    return matrix_factor(&m->J, m->h / 2, m->h * m->h / 4, &m->x, why);
}

static void solve(void *self, double *dz)
{
    matrix_solve(&((struct midpoint *)self)->J, dz);
}

/* Returns the step's local error, in scales; negative: unknown. */
static double predict(struct midpoint *m, const struct state *x, int fresh)
{
    for (int i = 0; i < m->ode->n; i++) m->hs[i] = m->h;
    if (fresh) predict_forget(&m->predict);
    predict_make(&m->predict, m->a, m->h == m->hfactor ? &m->J : NULL, m->h, x->v, x->a, 0);
    return fresh ? -1 : predict_error(&m->predict, m->h, m->newton.per);
}

static void accept(struct midpoint *m, struct stepper *s, struct state *x, double t1)
{
    int n = m->ode->n;
    double push = 0;
    for (int i = 0; i < n; i++) push += m->newton.r[i] * m->v[i];
    s->left += fabs(m->h * push) * fmin(1, m->newton.remain);
    s->last_sweeps += m->newton.count;
    for (int c = 0; c < POWER_CHANNELS; c++) s->work[c] += m->h * m->w[c];
    go(m, m->a);
    motion_point(m->ode, m->q1, m->q0, m->dx, 1, m->x.tb);
    if (m->ode->settle) m->ode->settle(m->ode, m->q1, m->v1, &m->x);
    predict_keep(&m->predict, m->a, x->a, m->h, m->newton.per);
    copy(x->a, m->a, n);
    copy(x->q, m->q1, m->ode->nq);
    copy(x->v, m->v1, n);
    x->t = t1;
    newton_scale(&m->newton, x->v, x->a, m->h);
}

enum status midpoint_advance(struct midpoint *m, struct stepper *s, struct state *x, double h, double t1,
                             struct trouble *why)
{
    int fresh = s->fresh;
    if (fresh) {
        newton_forget(&m->newton);
        newton_scale(&m->newton, x->v, x->a, h);
    }
    m->h = h;
    m->q0 = x->q;
    m->v0 = x->v;
    m->x = (struct instant){.t = x->t + (t1 - x->t) / 2,
                            .q = m->q,
                            .v = m->v,
                            .qa = x->q,
                            .qb = m->ode->pointwise ? NULL : m->q1,
                            .ta = x->t,
                            .tb = t1};
    if (m->ode->settle) m->x.va = x->v, m->x.vb = m->v1;
    newton_begin(&m->newton, predict(m, x, fresh));
    struct equations eq = {m, &m->x, resid, refresh, solve};
    m->placed = 0;
    if (m->newton.stale || h != m->hfactor) {
        TRY(refresh(m, m->a, why));
        newton_refreshed(&m->newton);
        m->placed = 1;
    }
    enum status status = newton_solve(&m->newton, m->a, &eq, m->hs, m->ode->n, why);
    if (status != OK) {
        m->newton.stale = 1;
        return status;
    }
    accept(m, s, x, t1);
    s->fresh = 0;
    return OK;
}

static void open(struct stepper *s, struct arena *life)
{
    s->self = midpoint_new(s, life);
}

static enum status one(struct stepper *s, struct state *x, double h, double t1, struct trouble *why)
{
    return midpoint_advance(s->self, s, x, h, t1, why);
}

static enum status step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct midpoint *m = s->self;
    return single_steps(&m->keep, s, x, h, ratio, to, one, why);
}

static const struct key keys[] = {KEY_NEWTON_TOLERANCE, KEYS_END};

const struct stepper_kind step_midpoint = {
    .name = "midpoint",
    .brief = "implicit midpoint rule, one rate, keeps the energy of linear systems",
    .keys = keys,
    .rates = 1,
    .order = 2,
    .open = open,
    .step = step,
};
