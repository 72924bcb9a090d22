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

#include <stdio.h>

#include "engine/accel.h"
#include "engine/implicit.h"
#include "engine/motion.h"
#include "engine/stepped.h"
#include "la/wide.h"

struct newmark {
    struct newmark_weights w;
    double *Q0, *Q1; /* [n] generalized forces at both ends */
    int known;       /* is Q0 there? */
};

struct newmark_weights newmark_weights(const struct step_options *o)
{
    const double rho = o->rho_infinity;
    if (rho == 1) return (struct newmark_weights){o->beta, o->gamma};
    return (struct newmark_weights){1 / ((1 + rho) * (1 + rho)), (3 - rho) / (2 + 2 * rho)};
}

static void begin(struct implicit *m)
{
    const struct newmark *o = m->own;
    m->cc = o->w.gamma * m->h;
    m->ck = o->w.beta * m->h * m->h;
}

/* (2-5), (2-6). */
INTO static inline void rates_from(double *restrict dx, double *restrict v, const double *restrict v0,
                                   const double *restrict a0, const double *restrict a1, double h, double beta,
                                   double gamma, int n)
{
    const double b0 = h * h / 2 * (1 - 2 * beta), b1 = h * h * beta, g0 = h * (1 - gamma), g1 = h * gamma;
    for (int i = 0; i < n; i++) {
        dx[i] = h * v0[i] + b0 * a0[i] + b1 * a1[i];
        v[i] = v0[i] + g0 * a0[i] + g1 * a1[i];
    }
}

WIDE static void rates_wide(double *dx, double *v, const double *v0, const double *a0, const double *a1, double h,
                            double beta, double gamma, int n)
{
    rates_from(dx, v, v0, a0, a1, h, beta, gamma, n);
}

static void rates(struct implicit *m, const double *a1)
{
    enum { FEW = 8 }; /* up to so many, the call costs more than it gives */
    const struct newmark *o = m->own;
    const int n = m->ode->n;
    if (n <= FEW)
        rates_from(m->dx, m->v, m->v0, m->a0, a1, m->h, o->w.beta, o->w.gamma, n);
    else
        rates_wide(m->dx, m->v, m->v0, m->a0, a1, m->h, o->w.beta, o->w.gamma, n);
}

/* (2-9): a - M^^-1 Q^ at the last iterate, as a residual whose matrix is 1. */
static enum status defect(void *self, double *r, double *dk, const double *a, struct trouble *why)
{
    struct implicit *m = self;
    implicit_place(m, a);
    *dk = 0;
    TRY(accel_solve(m->accel, r, m->w, m->q, m->v, m->x.t, why));
    for (int i = 0; i < m->ode->n; i++) r[i] = a[i] - r[i];
    return OK;
}

/* ---- what gamma above 1/2 takes -------------------------------------------------------------------------------- */

/* Q := what all forces are at q, v, t: the residual of no acceleration, turned round. */
static enum status forces(struct implicit *m, double *Q, const double *q, const double *v, double t,
                          struct trouble *why)
{
    const struct instant there = {.t = t, .q = q, .v = v, .ta = t, .tb = t};
    m->effort->slow++;
    m->effort->fast++;
    TRY(m->ode->ops->resid(m->ode, Q, NULL, NULL, &there, ALL, why));
    for (int i = 0; i < m->ode->n; i++) Q[i] = -Q[i];
    return OK;
}

/* With M a = Q at both ends, (2-5) and (2-6): half of (v0 + v1)'M(v1 - v0) is what Q0 and Q1 do on the average along the
 * displacement, but for
 *
 *     h/2 (gamma - 1/2) (v0 + v1)'(Q1 - Q0) - h^2/2 (beta - gamma/2) (Q0 + Q1)'(a1 - a0)
 *
 * (Krenk, Int. J. Numer. Methods Eng. 67 (2006) 1, of linear systems): that is the scheme's own. */
static enum status accept(struct implicit *m, struct stepper *s, struct trouble *why)
{
    struct newmark *o = m->own;
    const struct newmark_weights *w = &o->w;
    const int n = m->ode->n;
    const double g = m->h / 2 * (w->gamma - .5), b = m->h * m->h / 2 * (w->beta - w->gamma / 2);
    if (w->gamma == .5) return OK;
    if (!o->known) TRY(forces(m, o->Q0, m->q0, m->v0, m->x.t - m->h, why));
    TRY(forces(m, o->Q1, m->q, m->v, m->x.t, why));
    for (int i = 0; i < n; i++) {
        s->lost -= g * (m->v0[i] + m->v[i]) * (o->Q1[i] - o->Q0[i]) - b * (o->Q0[i] + o->Q1[i]) * (m->z[i] - m->a0[i]);
        o->Q0[i] = o->Q1[i];
    }
    o->known = true;
    return OK;
}

static void start(struct implicit *m)
{
    ((struct newmark *)m->own)->known = false;
}

static void recall(struct implicit *m, struct recall *r)
{
    struct newmark *o = m->own;
    recall_one(r, "known", o->known);
    recall_list(r, "forces", o->Q0, m->ode->n);
}

static void open(struct implicit *m, struct arena *life)
{
    enum { MOST_ITERATIONS = 50 };
    struct newmark *o = m->own = TAKE(life, struct newmark, 1);
    o->w = newmark_weights(m->options);
    m->damps = o->w.gamma > .5;
    o->Q0 = TAKE(life, double, m->ode->n);
    o->Q1 = TAKE(life, double, m->ode->n);
    if (m->options->iteration != ITERATION_FIXED_POINT) return;
    implicit_without_matrix(m, defect);
    m->newton.limit = MOST_ITERATIONS;
}

static const struct implicit_scheme newmark = {
    .begin = begin, .rates = rates, .open = open, .start = start, .accept = accept, .recall = recall};

bool newmark_fits(const struct step_options *o, struct misfit *why)
{
    if (2 * o->beta >= o->gamma) return true;
    *why = (struct misfit){.code = "E-newmark", .key = "beta", .other = "gamma"};
    snprintf(why->text, sizeof why->text, "beta %g and gamma %g: not stable for every step", o->beta, o->gamma);
    why->hint = "the rule is 2 beta >= gamma >= 1/2; beta 1/4, gamma 1/2 keep energy";
    return false;
}

static const struct key keys[] = {
    KEY_RHO_INFINITY,
    KEYS_NEWMARK,
    PARAM_WORD(struct step_options, iteration, "iteration", "newton|fixed-point", 0, "newton",
               "fixed-point is (2-9), which needs small steps"),
    KEY_NEWTON_TOLERANCE,
    KEY_TOLERANCE,
    KEYS_END,
};

static double late(const struct step_options *o)
{
    const struct newmark_weights w = newmark_weights(o);
    const double e = w.gamma - .5; /* from the angle of the eigenvalue of a vibration */
    return (w.beta + e * e / 4 - e / 2 - 1. / 12) / 2;
}

static double fades(const struct step_options *o)
{
    return (newmark_weights(o).gamma - .5) / 2;
}

/* With gamma above 1/2 the order is 1, and the error another. */
static bool fits(const struct step_options *o, struct misfit *why)
{
    const bool damps = o->rho_infinity < 1;
    if (damps && (o->beta != .25 || o->gamma != .5)) {
        *why = (struct misfit){.code = "E-newmark", .key = "rho_infinity", .other = o->gamma != .5 ? "gamma" : "beta"};
        snprintf(why->text, sizeof why->text, "'rho_infinity' gives beta and gamma: both were given");
        why->hint = "leave out one of them";
        return false;
    }
    if (!newmark_fits(o, why)) return false;
    if (!(o->tolerance > 0) || newmark_weights(o).gamma == .5) return true;
    *why = (struct misfit){.code = "E-newmark", .key = damps ? "rho_infinity" : "gamma", .other = "tolerance"};
    snprintf(why->text, sizeof why->text, "%s %g is of order 1: no steps by 'tolerance'", why->key,
             damps ? o->rho_infinity : o->gamma);
    why->hint = "gamma 1/2 with 'tolerance'; to damp what the step cannot resolve, scheme generalized-alpha";
    return false;
}

#define NEWMARK                                                                                                        \
    .name = "newmark", .brief = "Newmark's method (2-5)...(2-10), one rate", .keys = keys, .fits = fits, .order = 2,   \
    .late = late, .fades = fades
extern const struct stepper_kind step_newmark;
static const struct stepped_scheme by_error = STEPPED(&step_newmark, stepped_between);
static const struct stepper_kind tolerant = {NEWMARK, TOLERANT(&by_error)};
const struct stepper_kind step_newmark = {NEWMARK, .tolerant = &tolerant, .formulas = &newmark, IMPLICIT_AT_END};
