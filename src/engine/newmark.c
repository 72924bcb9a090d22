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
#include "engine/stepped.h"

static void begin(struct implicit *m)
{
    m->cc = m->options->gamma * m->h;
    m->ck = m->options->beta * m->h * m->h;
}

/* (2-5), (2-6). */
static void rates_from(double *restrict dx, double *restrict v, const double *restrict v0, const double *restrict a0,
                       const double *restrict a1, double h, double beta, double gamma, int n)
{
    const double b0 = h * h / 2 * (1 - 2 * beta), b1 = h * h * beta, g0 = h * (1 - gamma), g1 = h * gamma;
    for (int i = 0; i < n; i++) {
        dx[i] = h * v0[i] + b0 * a0[i] + b1 * a1[i];
        v[i] = v0[i] + g0 * a0[i] + g1 * a1[i];
    }
}

static void rates(struct implicit *m, const double *a1)
{
    rates_from(m->dx, m->v, m->v0, m->a0, a1, m->h, m->options->beta, m->options->gamma, m->ode->n);
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

static void open(struct implicit *m, struct arena *life)
{
    enum { MOST_ITERATIONS = 50 };
    (void)life;
    if (m->options->iteration != ITERATION_FIXED_POINT) return;
    implicit_without_matrix(m, defect);
    m->newton.limit = MOST_ITERATIONS;
}

static const struct implicit_scheme newmark = {.begin = begin, .rates = rates, .open = open};

bool newmark_fits(const struct step_options *o, struct misfit *why)
{
    if (2 * o->beta >= o->gamma) return true;
    *why = (struct misfit){.code = "E-newmark", .key = "beta", .other = "gamma"};
    snprintf(why->text, sizeof why->text, "beta %g and gamma %g: not stable for every step", o->beta, o->gamma);
    why->hint = "the rule is 2 beta >= gamma >= 1/2; beta 1/4, gamma 1/2 keep energy";
    return false;
}

static const struct key keys[] = {
    KEYS_NEWMARK,
    PARAM_WORD(struct step_options, iteration, "iteration", "newton|fixed-point", 0, "newton",
               "fixed-point is (2-9), which needs small steps"),
    KEY_NEWTON_TOLERANCE,
    KEY_TOLERANCE,
    KEYS_END,
};

static double late(const struct step_options *o)
{
    return (o->beta - 1. / 12) / 2;
}

static double fades(const struct step_options *o)
{
    return (o->gamma - .5) / 2;
}

/* With gamma above 1/2 the order is 1, and the error another. */
static bool fits(const struct step_options *o, struct misfit *why)
{
    if (!newmark_fits(o, why)) return false;
    if (!(o->tolerance > 0) || o->gamma == .5) return true;
    *why = (struct misfit){.code = "E-newmark", .key = "gamma", .other = "tolerance"};
    snprintf(why->text, sizeof why->text, "gamma %g is of order 1: no steps by 'tolerance'", o->gamma);
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
