/* alpha.c -- the generalized-alpha method of Chung and Hulbert (J. Appl. Mech. 60 (1993) 371), in the form of Arnold and
 * Bruels (Multibody Syst. Dyn. 18 (2007) 185), and with m = 0 that of Hilber, Hughes and Taylor (Earthq. Eng. Struct.
 * Dyn. 5 (1977) 283):
 *
 *     q1 = q0 (+) h v0 + h^2 ((1/2 - beta) a0 + beta a1),      v1 = v0 + h ((1 - gamma) a0 + gamma a1)
 *     (1 - m) a1 + m a0 = (1 - f) z1 + f z0,                   M^(q1) z1 = Q^(q1, v1, t1)
 *
 * z are the accelerations of (2-4), and a begins as z.  gamma = 1/2 + f - m gives order 2, beta = (gamma + 1/2)^2/4 the
 * least damping of what the step resolves.  Of what it does not, a step leaves rho, with hht (1 + alpha)/(1 - alpha).
 * a is z at another time, (m - f) h off: where h changes, a - z goes with it.
 *
 * Where M^ is constant the energy is short of the work by (e = 1/2 - f; v, z, D: means of both ends, dD the difference)
 *
 *     lost = h e v.dD - h^2/4 (gamma - 1/2) z.(D + e dD),      D = M^ (a - z) = r(q, v, a, t) */
#include <stdio.h>

#include "engine/implicit.h"
#include "engine/stepped.h"

enum { CHUNG, HILBER };
struct alpha {
    double m, f, beta, gamma, *a0, *a1, *D; /* [n] */
    double h;                               /* that a0 lags behind z by; 0: it does not */
    double *a_before, *D_before, h_before;  /* what they were when the last step began */
    bool again;                             /* it begins once more */
};

static struct alpha weights(const struct step_options *options, int variant)
{
    const double rho = options->rho_infinity;
    const double alpha = rho < 1 ? (rho - 1) / (rho + 1) : options->alpha;
    const double am = variant == HILBER ? 0 : (2 * rho - 1) / (rho + 1);
    const double af = variant == HILBER ? -alpha : rho / (rho + 1);
    const double gamma = .5 + af - am, beta = (gamma + .5) * (gamma + .5) / 4;
    return (struct alpha){.m = am, .f = af, .beta = beta, .gamma = gamma};
}

/* From the eigenvalue of a vibration, 1 - |..| being of fourth order: the part of (omega h)^3 that it is late by. */
static double late(struct alpha o)
{
    return (o.beta - 1. / 12 - o.f * (o.f - o.m)) / 2;
}

static void open(struct implicit *m, struct arena *life)
{
    struct alpha *o = m->own = TAKE(life, struct alpha, 1);
    *o = weights(m->options, m->scheme->variant);
    m->damps = true;
    double **vector[] = {&o->a0, &o->a1, &o->D, &o->a_before, &o->D_before};
    for (size_t i = 0; i < sizeof vector / sizeof *vector; i++) *vector[i] = TAKE(life, double, m->ode->n);
}

static void start(struct implicit *m)
{
    struct alpha *o = m->own;
    if (o->again) {
        copy(o->a0, o->a_before, m->ode->n);
        copy(o->D, o->D_before, m->ode->n);
    } else {
        copy(o->a0, m->a0, m->ode->n);
        zero(o->D, m->ode->n);
    }
    o->h = o->again ? o->h_before : 0;
    o->again = false;
}

/* The last step is taken back. */
static void back(struct stepper *s)
{
    struct alpha *o = ((struct implicit *)s->self)->own;
    o->again = true;
}

static double *carried(struct stepper *s, double h, bool next)
{
    struct alpha *o = ((struct implicit *)s->self)->own;
    if (!next) return o->a0;
    o->again = true;
    o->h_before = h;
    return o->a_before;
}

static void begin(struct implicit *m)
{
    struct alpha *o = m->own;
    for (int i = 0; i < m->ode->n && o->h > 0 && o->h != m->h; i++)
        o->a0[i] = m->a0[i] + (o->a0[i] - m->a0[i]) * (m->h / o->h);
    o->h = m->h;
    m->cc = (1 - o->f) / (1 - o->m) * o->gamma * m->h;
    m->ck = (1 - o->f) / (1 - o->m) * o->beta * m->h * m->h;
}

static void rates(struct implicit *m, const double *z1)
{
    const struct alpha *o = m->own;
    const double h = m->h, *z0 = m->a0, *a0 = o->a0;
    for (int i = 0; i < m->ode->n; i++) {
        const double a1 = o->a1[i] = ((1 - o->f) * z1[i] + o->f * z0[i] - o->m * a0[i]) / (1 - o->m);
        m->dx[i] = h * m->v0[i] + h * h * ((.5 - o->beta) * a0[i] + o->beta * a1);
        m->v[i] = m->v0[i] + h * ((1 - o->gamma) * a0[i] + o->gamma * a1);
    }
}

static enum status accept(struct implicit *m, struct stepper *s, struct trouble *why)
{
    struct alpha *o = m->own;
    copy(o->a_before, o->a0, m->ode->n);
    copy(o->D_before, o->D, m->ode->n);
    o->h_before = o->h;
    const double h = m->h, e = .5 - o->f, c = h * h / 4 * (o->gamma - .5), *r = m->newton.r;
    if (o->gamma > .5) TRY(implicit_resid(m, m->newton.r, o->a1, why)); /* else a = z */
    for (int i = 0; i < m->ode->n && o->gamma > .5; i++) {
        const double dD = r[i] - o->D[i], D = (r[i] + o->D[i]) / 2;
        s->lost += h * e * (m->v0[i] + m->v[i]) / 2 * dD - c * (m->a0[i] + m->z[i]) / 2 * (D + e * dD);
        o->D[i] = r[i];
    }
    copy(o->a0, o->a1, m->ode->n);
    return OK;
}

static void recall(struct implicit *m, struct recall *r)
{
    struct alpha *o = m->own;
    recall_list(r, "a0", o->a0, m->ode->n);
    recall_list(r, "D", o->D, m->ode->n);
    recall_one(r, "h", o->h);
}

#define SCHEME(word)                                                                                                   \
    {                                                                                                                  \
        .variant = word, .open = open, .start = start, .begin = begin, .rates = rates, .accept = accept,               \
        .recall = recall                                                                                               \
    }
static const struct implicit_scheme scheme[] = {SCHEME(CHUNG), SCHEME(HILBER)};
static const struct key keys_chung[] = {KEY_RHO_INFINITY, KEY_NEWTON_TOLERANCE, KEY_TOLERANCE, KEYS_END};
static const struct key keys_hilber[] = {KEY_RHO_INFINITY,
                                         PARAM_REAL(struct step_options, alpha, "alpha", NULL, -1. / 3, 0, KEY_META,
                                                    "-0.05", "0 keeps all energy, -1/3 damps most"),
                                         KEY_NEWTON_TOLERANCE, KEY_TOLERANCE, KEYS_END};

/* From alpha = -1/3 on it damps less again, and it is for alpha. */
static bool fits_hilber(const struct step_options *o, struct misfit *why)
{
    if (o->rho_infinity == 1) return true;
    if (o->rho_infinity >= .5 && o->alpha == -.05) return true;
    *why = (struct misfit){.code = "E-damping", .key = "rho_infinity", .other = "alpha"};
    if (o->alpha != -.05) {
        snprintf(why->text, sizeof why->text, "'rho_infinity' gives alpha: both were given");
        why->hint = "leave out one of them";
    } else {
        snprintf(why->text, sizeof why->text,
                 "rho_infinity %g: hht leaves at least 0.5 of what the step does not resolve", o->rho_infinity);
        why->hint = "0.5 or more; scheme generalized-alpha goes down to 0";
    }
    return false;
}

static double late_chung(const struct step_options *o)
{
    return late(weights(o, CHUNG));
}

static double late_hilber(const struct step_options *o)
{
    return late(weights(o, HILBER));
}

#define CHUNG_KIND                                                                                                     \
    .name = "generalized-alpha", .keys = keys_chung, .order = 2, .late = late_chung, .back = back, .carried = carried, \
    .brief = "Chung and Hulbert's method, one rate, damps what 'step' cannot resolve"
#define HILBER_KIND                                                                                                    \
    .name = "hht", .keys = keys_hilber, .fits = fits_hilber, .order = 2, .late = late_hilber, .back = back,            \
    .carried = carried, .brief = "Hilber, Hughes and Taylor's method, one rate, damps what 'step' cannot resolve"
extern const struct stepper_kind step_generalized_alpha, step_hht;
static const struct stepped_scheme by_error[] = {STEPPED(&step_generalized_alpha, stepped_between),
                                                 STEPPED(&step_hht, stepped_between)};
static const struct stepper_kind tolerant_chung = {CHUNG_KIND, TOLERANT(&by_error[CHUNG])},
                                 tolerant_hilber = {HILBER_KIND, TOLERANT(&by_error[HILBER])};
const struct stepper_kind step_generalized_alpha = {CHUNG_KIND, .tolerant = &tolerant_chung, .formulas = &scheme[CHUNG],
                                                    IMPLICIT_AT_END},
                          step_hht = {HILBER_KIND, .tolerant = &tolerant_hilber, .formulas = &scheme[HILBER],
                                      IMPLICIT_AT_END};
