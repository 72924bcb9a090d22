/* rest.c -- static equilibrium: r(q, 0, 0, t) = 0 at a posture that is stable.
 *
 * Damped Newton (pseudo-transient continuation; Kelley & Keyes, SIAM J. Numer. Anal. 35, 1998): steps
 *
 *     (mu M^ + K) dx = -r,     K = dr/dq by central differences, made symmetric,
 *
 * with mu so large that the matrix is positive definite, lowered after every step that goes downhill: then each
 * step follows the forces, and what is reached is a minimum of the potential, never a saddle.  At mu = 0 it is
 * Newton's method.  Along motions that nothing holds and nothing pushes no step goes: rest_neutral.c. */
#include <math.h>
#include <string.h>

#include "base/stop.h"
#include "engine/motion.h"
#include "la/dense.h"
#include "sim/rest_parts.h"

enum { MOST_STEPS = 500, FEW_STEPS = 60, MOST_EVALUATIONS = 50000, MOST_TRIES = 60 };

/* Is there still hope?  Equilibria take 5 steps, far ones 50; many coordinates are dear, two evaluations each a step. */
static bool may_go_on(const struct rest *s)
{
    return s->steps < FEW_STEPS || (s->steps < MOST_STEPS && 2 * s->n * s->steps < MOST_EVALUATIONS);
}

static struct rest open_rest(const struct sim *sim, struct arena *scratch)
{
    const struct ode2 *o = sim->stepper.ode;
    struct rest s = {.ode = o, .t = sim->x.t, .n = o->n};
    double **vectors[] = {&s.r, &s.r1, &s.dx, &s.zero, &s.up, &s.down, &s.gone};
    double **matrices[] = {&s.M, &s.K, &s.J};
    s.q = TAKE(scratch, double, o->nq);
    s.q1 = TAKE(scratch, double, o->nq);
    for (int i = 0; i < 7; i++) *vectors[i] = TAKE(scratch, double, o->n);
    for (int i = 0; i < 3; i++) *matrices[i] = TAKE_MATRIX(scratch, double, o->n, o->n);
    rest_neutral_open(&s, scratch);
    memcpy(s.q, sim->x.q, sizeof *s.q * (size_t)o->nq);
    return s;
}

void rest_displaced(const struct rest *s, double *q1, const double *dx)
{
    if (s->ode->move)
        s->ode->move->point(s->ode, q1, s->q, dx, 1, s->t);
    else
        for (int i = 0; i < s->n; i++) q1[i] = s->q[i] + dx[i];
}

enum status rest_resid(const struct rest *s, double *r, const double *q, struct trouble *why)
{
    const struct instant x = {.t = s->t, .q = q, .v = s->zero, .ta = s->t, .tb = s->t};
    return s->ode->ops->resid(s->ode, r, NULL, NULL, &x, ALL, why);
}

static enum status stiffness(struct rest *s, struct trouble *why)
{
    static const double step = 1e-6; /* [m], [rad] */
    int n = s->n;
    memset(s->dx, 0, sizeof *s->dx * (size_t)n);
    for (int j = 0; j < n; j++) {
        s->dx[j] = step;
        rest_displaced(s, s->q1, s->dx);
        TRY(rest_resid(s, s->up, s->q1, why));
        s->dx[j] = -step;
        rest_displaced(s, s->q1, s->dx);
        TRY(rest_resid(s, s->down, s->q1, why));
        s->dx[j] = 0;
        for (int i = 0; i < n; i++) s->K[i + j * n] = (s->up[i] - s->down[i]) / (2 * step);
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < j; i++) s->K[i + j * n] = s->K[j + i * n] = (s->K[i + j * n] + s->K[j + i * n]) / 2;
    return OK;
}

static double largest(const double *K, int n)
{
    double most = 0;
    for (int i = 0; i < n * n; i++) most = fmax(most, fabs(K[i]));
    return most > 0 ? most : 1;
}

/* mu M + K factored: a mu that makes it positive. */
static bool factor(struct rest *s)
{
    int nn = s->n * s->n;
    for (int i = 0; i < MOST_TRIES; i++) {
        for (int k = 0; k < nn; k++) s->J[k] = s->mu * s->M[k] + s->K[k];
        rest_hold_neutral(s, s->J);
        if (dense_cholesky(s->J, s->n, s->n) < 0) return true;
        s->mu = 4 * s->mu + 1e-6;
    }
    return false;
}

/* Is it stable here, and Newton's step, to q1, next to nothing?  Asked before a step is taken: at round-off no step
 * goes downhill any more, and mu would only grow. */
static bool settled(struct rest *s)
{
    double size = 0;
    memcpy(s->J, s->K, sizeof *s->J * (size_t)(s->n * s->n));
    const bool held = dense_cholesky(s->J, s->n, s->n) < 0;
    s->neutral = 0;
    if (rest_suspects(s, held)) return rest_settles_neutral(s);
    if (!held) return false;
    for (int k = 0; k < s->n; k++) s->dx[k] = -s->r[k];
    dense_cholesky_solve(s->J, s->dx, s->n, s->n);
    for (int k = 0; k < s->n; k++) size = fmax(size, fabs(s->dx[k]));
    rest_displaced(s, s->q1, s->dx);
    return size <= REST_TINY;
}

/* One step downhill, M and K as they are here. */
static enum status descend(struct rest *s, double *size, struct trouble *why)
{
    static const double longest = 0.5; /* [m], [rad] a step */
    for (int i = 0; i < MOST_TRIES; i++) {
        if (!factor(s)) return trouble_set(why, TROUBLE_SINGULAR, s->steps, s->mu, s->t);
        for (int k = 0; k < s->n; k++) s->dx[k] = -s->r[k];
        dense_cholesky_solve(s->J, s->dx, s->n, s->n);
        rest_leave_neutral(s, s->dx);
        *size = 0;
        for (int k = 0; k < s->n; k++) *size = fmax(*size, fabs(s->dx[k]));
        rest_displaced(s, s->q1, s->dx);
        double before = dot(s->r, s->dx, s->n);
        bool fine = *size <= longest && rest_resid(s, s->r1, s->q1, why) == OK;
        if (fine && dot(s->r1, s->dx, s->n) <= -0.5 * before) { /* at most as far uphill at its end */
            memcpy(s->q, s->q1, sizeof *s->q * (size_t)s->ode->nq);
            memcpy(s->r, s->r1, sizeof *s->r * (size_t)s->n);
            for (int k = 0; k < s->n; k++) s->gone[k] += s->dx[k];
            s->mu = s->mu < 1e-9 ? 0 : s->mu / 4;
            return OK;
        }
        s->mu = 4 * s->mu + 1e-3;
    }
    return trouble_set(why, TROUBLE_DIVERGED, s->steps, *size, s->t);
}

/* What bends so far is pulled apart, and goes on for ever. */
static enum status still_whole(const struct sim *sim, const struct rest *s, struct trouble *why)
{
    static const double LENGTHS = 2; /* a run stops at 1 */
    const int body = deflections_beyond(sim, s->q, LENGTHS);
    return body ? trouble_set(why, TROUBLE_DEFLECTION, body, LENGTHS, s->t) : OK;
}

/* From s->q, with its residual, to s->q1. */
static enum status search(struct rest *s, struct sim *sim, struct trouble *why)
{
    double size = INFINITY;
    for (; may_go_on(s); s->steps++) {
        if (stop) return stop_status();
        TRY(s->ode->ops->mass(s->ode, s->M, s->q, s->t, ALL, why));
        TRY(stiffness(s, why));
        idle_clear(&sim->idle, sim->system, s->K, largest(s->K, s->n), s->q, s->t); /* any posture of them will do */
        if (settled(s)) return OK;
        TRY(descend(s, &size, why));
        system_count_turns(sim->system, s->q, s->t);
        TRY(still_whole(sim, s, why));
    }
    return trouble_set(why, TROUBLE_DIVERGED, s->steps, size, s->t);
}

static void take(struct sim *sim, struct rest *s)
{
    memcpy(sim->x.q, s->q1, sizeof *s->q1 * (size_t)s->ode->nq);
    rest_name_neutral(&sim->neutral, s);
}

/* Why the search has failed, by a coordinate. */
static void blame(struct rest *s, struct trouble *why)
{
    const int falls = rest_falls(s);
    int far = 0;
    for (int i = 1; i < s->n; i++)
        if (fabs(s->gone[i]) * ode2_usual(s->ode, far) > fabs(s->gone[far]) * ode2_usual(s->ode, i)) far = i;
    *why = falls >= 0 ? (struct trouble){TROUBLE_DIVERGED, REST_FALLS, falls, 0, s->t}
                      : (struct trouble){TROUBLE_DIVERGED, REST_GOES_ON, far, s->gone[far], s->t};
}

enum status rest_find(struct sim *sim, struct arena *scratch, struct trouble *why)
{
    struct rest s = open_rest(sim, scratch);
    struct trouble not_so;
    s.mu = 1;
    system_count_turns(sim->system, s.q, s.t);
    TRY(rest_resid(&s, s.r, s.q, why));
    const enum status status = search(&s, sim, why);
    if (status != OK && !stop && why->code == TROUBLE_DIVERGED) blame(&s, why);
    if (status != OK) return status;
    memset(sim->x.v, 0, sizeof *sim->x.v * (size_t)s.n);
    take(sim, &s);
    if (rest_goes_back(&s) && search(&s, sim, &not_so) == OK && s.neutral > 0) take(sim, &s);
    return OK;
}
