/* alpha.c -- the generalized-alpha method of Chung and Hulbert (J. Appl. Mech. 60 (1993) 371), in the form of Arnold and
 * Bruels (Multibody Syst. Dyn. 18 (2007) 185), and with m = 0 that of Hilber, Hughes and Taylor (Earthq. Eng. Struct.
 * Dyn. 5 (1977) 283):
 *
 *     q1 = q0 (+) h v0 + h^2 ((1/2 - beta) a0 + beta a1),      v1 = v0 + h ((1 - gamma) a0 + gamma a1)
 *     (1 - m) a1 + m a0 = (1 - f) z1 + f z0,                   M^(q1) z1 = Q^(q1, v1, t1)
 *
 * z are the accelerations of (2-4), and a begins as z.  gamma = 1/2 + f - m gives order 2, beta = (gamma + 1/2)^2/4 the
 * least damping of what the step resolves.  Of what it does not, a step leaves rho, with hht (1 + alpha)/(1 - alpha).
 * Where M^ is constant the energy is short of the work by (e = 1/2 - f; v, z, D: means of both ends, dD the difference)
 *
 *     lost = h e v.dD - h^2/4 (gamma - 1/2) z.(D + e dD),      D = M^ (a - z) = r(q, v, a, t) */
#include "engine/implicit.h"

enum { CHUNG, HILBER };
struct alpha {
    double m, f, beta, gamma, *a0, *a1, *D; /* [n] */
};

static void open(struct implicit *m, struct arena *life)
{
    const double rho = m->options->rho_infinity, alpha = m->options->alpha;
    const double am = m->scheme->variant == HILBER ? 0 : (2 * rho - 1) / (rho + 1);
    const double af = m->scheme->variant == HILBER ? -alpha : rho / (rho + 1);
    const double gamma = .5 + af - am, beta = (gamma + .5) * (gamma + .5) / 4;
    struct alpha *o = m->own = TAKE(life, struct alpha, 1);
    double *x = TAKE(life, double, 3 * m->ode->n);
    *o = (struct alpha){am, af, beta, gamma, x, x + m->ode->n, x + 2 * m->ode->n};
}

static void start(struct implicit *m)
{
    const struct alpha *o = m->own;
    copy(o->a0, m->a0, m->ode->n);
    zero(o->D, m->ode->n);
}

static void begin(struct implicit *m)
{
    const struct alpha *o = m->own;
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
    const struct alpha *o = m->own;
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
    const struct alpha *o = m->own;
    recall_list(r, "a0", o->a0, m->ode->n);
    recall_list(r, "D", o->D, m->ode->n);
}

#define SCHEME(word)                                                                                                   \
    {                                                                                                                  \
        .variant = word, .open = open, .start = start, .begin = begin, .rates = rates, .accept = accept,               \
        .recall = recall                                                                                               \
    }
static const struct implicit_scheme scheme[] = {SCHEME(CHUNG), SCHEME(HILBER)};
static const struct key keys_chung[] = {KEY_RHO_INFINITY, KEY_NEWTON_TOLERANCE, KEYS_END};
static const struct key keys_hilber[] = {PARAM_REAL(struct step_options, alpha, "alpha", NULL, -1. / 3, 0, KEY_META,
                                                    "-0.05", "0 keeps all energy, -1/3 damps most"),
                                         KEY_NEWTON_TOLERANCE, KEYS_END};

#define KIND(name_, brief_, keys_, variant_)                                                                           \
    {                                                                                                                  \
        .name = name_, .brief = brief_, .keys = keys_, .order = 2, .formulas = &scheme[variant_], IMPLICIT_AT_END      \
    }
const struct stepper_kind step_generalized_alpha = KIND(
    "generalized-alpha", "Chung and Hulbert's method, one rate, damps what 'step' cannot resolve", keys_chung, CHUNG);
const struct stepper_kind step_hht =
    KIND("hht", "Hilber, Hughes and Taylor's method, one rate, damps what 'step' cannot resolve", keys_hilber, HILBER);
