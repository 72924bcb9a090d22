/* implicit.c -- see implicit.h */
#include "engine/implicit.h"

#include <math.h>

#include "base/scalar.h"
#include "engine/motion.h"

/* ---- the equations --------------------------------------------------------------------------------------------- */

/* From the last iterate, where q stands. */
static void correct(struct implicit *m, double share, int may)
{
    m->open = motion_again(m->ode, m->q, m->q0, m->dx, share, m->x.t, may | (m->open ? OPEN_BEFORE : 0));
}

void implicit_place(struct implicit *m, const double *z)
{
    const struct instant *x = &m->x;
    const double share = m->scheme->middle ? .5 : 1;
    m->scheme->rates(m, z);
    if (m->newton.count > 0)
        correct(m, share, OPEN_AFTER);
    else
        m->open = motion_first(m->ode, m->q, m->q0, m->dx, share, x->t);
    if (m->scheme->middle && x->qb) motion_point(m->ode, m->q1, m->q0, m->dx, 1, x->tb);
    m->x.a = z;
}

enum status implicit_resid(struct implicit *m, double *r, const double *a, struct trouble *why)
{
    struct instant there = m->x;
    there.a = a;
    m->effort->slow++;
    m->effort->fast++;
    return m->ode->ops->resid(m->ode, r, NULL, NULL, &there, ALL, why);
}

static bool any_power(const double *w)
{
    for (int c = 0; c < POWER_CHANNELS; c++)
        if (w[c] != 0) return true;
    return false;
}

static enum status resid(void *self, double *r, double *dk, const double *z, struct trouble *why)
{
    struct implicit *m = self;
    implicit_place(m, z);
    m->effort->slow++;
    m->effort->fast++;
    if (m->ode->workless) return m->ode->ops->resid(m->ode, r, NULL, dk, &m->x, ALL, why);
    enum status status = m->ode->ops->resid(m->ode, r, m->w, dk, &m->x, ALL, why);
    if (m->scheme->middle && !m->newton.powered) m->newton.powered = any_power(m->w);
    return status;
}

static enum status refresh(void *self, const double *z, struct trouble *why)
{
    struct implicit *m = self;
    (void)z;
    m->hfactor = m->h;
    return broyden_form(&m->J, m->h, m->cc, m->ck, &m->x, why);
}

static void solve(void *self, double *dz, const double *r)
{
    broyden_solve(&((struct implicit *)self)->J, dz, r);
}

static bool learn(void *self, double *dz, const double *step, const double *before, const double *r)
{
    return broyden_learn(&((struct implicit *)self)->J, dz, step, before, r);
}

static enum status no_refresh(void *self, const double *z, struct trouble *why)
{
    (void)self, (void)z, (void)why;
    return OK;
}

static void no_solve(void *self, double *dz, const double *r)
{
    const struct implicit *m = self;
    copy(dz, r, m->ode->n);
}

void implicit_without_matrix(struct implicit *m, enum status (*defect)(void *self, double *r, double *dk,
                                                                       const double *z, struct trouble *why))
{
    m->equations = (struct equations){m, &m->x, defect, no_refresh, no_solve, NULL};
    m->newton.matrix_free = true;
}

/* ---- one step -------------------------------------------------------------------------------------------------- */

static struct instant instant_of(const struct implicit *m, const struct state *x, double t1)
{
    if (!m->scheme->middle) return (struct instant){.t = t1, .q = m->q, .v = m->v, .ta = t1, .tb = t1};
    const int settles = m->ode->settle != NULL;
    return (struct instant){.t = x->t + (t1 - x->t) / 2,
                            .q = m->q,
                            .v = m->v,
                            .qa = x->q,
                            .qb = m->ode->pointwise ? NULL : m->q1,
                            .va = settles ? x->v : NULL,
                            .vb = settles ? m->v1 : NULL,
                            .ta = x->t,
                            .tb = t1};
}

/* Scales, and the power at the start of a run. */
static enum status start(struct implicit *m, const struct state *x, struct trouble *why)
{
    struct instant there = {.t = x->t, .q = x->q, .v = x->v, .a = x->a, .ta = x->t, .tb = x->t};
    newton_forget(&m->newton);
    newton_scale(&m->newton, x->v, x->a, m->h);
    predict_forget(&m->predict);
    broyden_forget(&m->J);
    if (m->scheme->start) m->scheme->start(m);
    if (m->scheme->middle) return OK;
    m->effort->slow++;
    m->effort->fast++;
    return m->ode->ops->resid(m->ode, m->newton.r, m->w0, NULL, &there, ALL, why);
}

/* z from the steps before; a start for iterations without a matrix is (2-10*).  Returns the step's local error, in
 * scales; negative: unknown. */
static double predict(struct implicit *m, int fresh)
{
    const double ahead = m->scheme->middle ? 0 : m->h / 2;
    for (int i = 0; i < m->ode->n; i++) m->hs[i] = m->h;
    predict_make(&m->predict, m->z, m->h == m->hfactor ? &m->J : NULL, m->h, m->v0, m->a0, ahead);
    if (m->newton.matrix_free) copy(m->z, m->a0, m->ode->n);
    return fresh ? -1 : predict_error(&m->predict, m->h, m->newton.per);
}

static enum status iterate(struct implicit *m, struct trouble *why)
{
    m->newton.due = !m->newton.matrix_free && (m->newton.stale || m->h != m->hfactor);
    return newton_solve(&m->newton, m->z, &m->equations, m->hs, m->ode->n, why);
}

/* Do dampers take energy while a velocity and its acceleration turn round in the step?  Then one is too stiff for it: they
 * alternate from step to step, and the powers at both ends are large where the mean velocity is small.  Schemes that damp
 * on their own do away with it in few steps, and not all of these turn it round. */
static bool overdamped(const struct implicit *m)
{
    const double most = m->damps ? .25 : 1;
    if (m->scheme->middle || m->w[POWER_DAMPER] == 0) return false;
    for (int i = 0; i < m->ode->n; i++)
        if (fabs(m->v[i] - m->v0[i]) > most * fabs(m->v[i] + m->v0[i]) && m->a0[i] * m->z[i] < 0) return true;
    return false;
}

/* What dampers take at the velocities m->hs, at the end of the step [W]. */
static enum status damping_at(struct implicit *m, double *power, struct trouble *why)
{
    struct instant there = m->x;
    double w[POWER_CHANNELS];
    there.v = m->hs;
    m->effort->slow++;
    m->effort->fast++;
    TRY(m->ode->ops->resid(m->ode, m->newton.dz, w, NULL, &there, ALL, why));
    *power = w[POWER_DAMPER];
    return OK;
}

/* What dampers take of their mean forces -C v, v = (v0 + v1)/2, along the step's displacement h u: with it the balance of
 * linear dampers is exact at any step [W].  v' C u = ((v + u)' C (v + u) - (v - u)' C (v - u))/4, and u may be v. */
static enum status mean_damping(struct implicit *m, double *power, struct trouble *why)
{
    const int n = m->ode->n;
    double against = 0;
    bool apart = false;
    for (int i = 0; i < n; i++) {
        const double v = (m->v0[i] + m->v[i]) / 2, u = m->dx[i] / m->h;
        if (fabs(u - v) > 1e-12 * (fabs(m->v0[i]) + fabs(m->v[i]))) apart = true;
    }
    if (apart) {
        for (int i = 0; i < n; i++) m->hs[i] = ((m->v0[i] + m->v[i]) / 2 - m->dx[i] / m->h) / 2;
        TRY(damping_at(m, &against, why));
    }
    for (int i = 0; i < n; i++) {
        const double v = (m->v0[i] + m->v[i]) / 2;
        m->hs[i] = apart ? (v + m->dx[i] / m->h) / 2 : v;
    }
    TRY(damping_at(m, power, why));
    *power -= against;
    return OK;
}

/* Works, and what Newton has left over: at the last residual. */
static enum status book(struct implicit *m, struct stepper *s, struct trouble *why)
{
    double damping;
    s->left += fabs(m->h * dot(m->newton.r, m->v, m->ode->n)) * smaller(1, m->newton.remain);
    s->last_sweeps += m->newton.count;
    for (int c = 0; c < POWER_CHANNELS; c++)
        s->work[c] += m->scheme->middle ? m->h * m->w[c] : m->h / 2 * (m->w0[c] + m->w[c]);
    if (overdamped(m)) {
        TRY(mean_damping(m, &damping, why));
        s->work[POWER_DAMPER] += m->h * damping - m->h / 2 * (m->w0[POWER_DAMPER] + m->w[POWER_DAMPER]);
    }
    if (!m->scheme->middle) copy(m->w0, m->w, POWER_CHANNELS);
    return OK;
}

static enum status move_to_end(struct implicit *m, struct trouble *why)
{
    m->scheme->rates(m, m->z);
    if (!m->scheme->middle) {
        correct(m, 1, 0);
        m->x.a = m->z;
        return OK;
    }
    motion_point(m->ode, m->q1, m->q0, m->dx, 1, m->x.tb);
    return m->ode->settle ? m->ode->settle(m->ode, m->q1, m->v1, &m->x, why) : OK;
}

static enum status accept(struct implicit *m, struct stepper *s, struct state *x, double t1, struct trouble *why)
{
    TRY(book(m, s, why));
    TRY(move_to_end(m, why));
    if (m->scheme->accept) TRY(m->scheme->accept(m, s, why));
    predict_keep(&m->predict, m->z, x->a, m->h, m->newton.per);
    copy(x->a, m->z, m->ode->n);
    copy(x->q, m->q1, m->ode->nq);
    copy(x->v, m->v1, m->ode->n);
    x->t = t1;
    newton_scale(&m->newton, x->v, x->a, m->h);
    return OK;
}

enum status implicit_once(struct implicit *m, struct stepper *s, struct state *x, double h, double t1,
                          struct trouble *why)
{
    const int fresh = s->fresh;
    m->h = h;
    m->q0 = x->q;
    m->v0 = x->v;
    m->a0 = x->a;
    if (fresh) TRY(start(m, x, why));
    m->x = instant_of(m, x, t1);
    m->scheme->begin(m);
    m->newton.one_way = broyden_go(&m->J, m->x.t);
    newton_begin(&m->newton, predict(m, fresh));
    enum status status = iterate(m, why);
    if (status == OK) status = accept(m, s, x, t1, why);
    m->newton.stale |= status != OK;
    if (status == OK) s->fresh = 0;
    return status;
}

/* ---- as a kind ------------------------------------------------------------------------------------------------- */

struct implicit *implicit_new(struct stepper *s, const struct implicit_scheme *scheme, struct arena *life)
{
    const struct ode2 *o = s->ode;
    struct implicit *m = TAKE(life, struct implicit, 1);
    double **vector[] = {&m->z, &m->v, &m->dx, &m->hs};
    *m = (struct implicit){.scheme = scheme, .options = &s->options, .ode = o, .effort = &s->effort, .accel = s->accel};
    for (int i = 0; i < 4; i++) *vector[i] = TAKE(life, double, o->n);
    m->v1 = scheme->middle ? TAKE(life, double, o->n) : m->v;
    m->q = TAKE(life, double, o->nq);
    m->q1 = scheme->middle ? TAKE(life, double, o->nq) : m->q;
    m->equations = (struct equations){m, &m->x, resid, refresh, solve, learn};
    newton_open(&m->newton, o, &s->effort, &s->options, life);
    broyden_open(&m->J, o, &s->effort, life);
    if (m->J.J.structured && o->direct->price > 0) m->newton.price = o->direct->price;
    predict_open(&m->predict, o->n, life);
    single_open(&m->keep, o, life);
    if (scheme->open) scheme->open(m, life);
    return m;
}

void implicit_open(struct stepper *s, struct arena *life)
{
    s->self = implicit_new(s, s->kind->formulas, life);
}

static enum status one(struct stepper *s, struct state *x, double h, double t1, struct trouble *why)
{
    return implicit_once(s->self, s, x, h, t1, why);
}

enum status implicit_step(struct stepper *s, struct state *x, double h, int ratio, double to, struct trouble *why)
{
    struct implicit *m = s->self;
    return single_steps(&m->keep, s, x, h, ratio, to, one, why);
}

enum status implicit_remember(struct implicit *m, struct recall *r)
{
    recall_one(r, "hfactor", m->hfactor);
    recall_list(r, "power", m->w0, POWER_CHANNELS);
    newton_recall(&m->newton, r);
    predict_recall(&m->predict, r);
    if (m->scheme->recall) m->scheme->recall(m, r);
    return broyden_recall(&m->J, r);
}

enum status implicit_recall(struct stepper *s, struct recall *r)
{
    return implicit_remember(s->self, r);
}
