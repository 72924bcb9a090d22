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
 * Newton for a with J = M^ + (h/2) C + (h^2/4) K.  state.a is the mean acceleration of the step. */
#include "engine/midpoint.h"

#include "engine/composed.h"
#include "engine/stepped.h"

static void begin(struct implicit *m)
{
    m->cc = m->h / 2;
    m->ck = m->h * m->h / 4;
}

/* None of these overlap: a third of the instructions. */
static void rates_from(double *restrict v, double *restrict v1, double *restrict dx, const double *restrict v0,
                       const double *restrict a, double h, int n)
{
    for (int i = 0; i < n; i++) {
        v[i] = v0[i] + h / 2 * a[i];
        v1[i] = v0[i] + h * a[i];
        dx[i] = h * v[i];
    }
}

static void rates(struct implicit *m, const double *a)
{
    rates_from(m->v, m->v1, m->dx, m->v0, a, m->h, m->ode->n);
}

const struct implicit_scheme midpoint_rule = {.middle = true, .begin = begin, .rates = rates};

static void open(struct stepper *s, struct arena *life)
{
    s->self = implicit_new(s, s->options.rho_infinity < 1 ? &midpoint_damped : &midpoint_rule, life);
}

static const struct key keys[] = {KEY_RHO_INFINITY, KEY_ORDER, KEY_NEWTON_TOLERANCE, KEY_TOLERANCE, KEYS_END};

#define MIDPOINT                                                                                                       \
    .name = "midpoint", .brief = "implicit midpoint rule, one rate, keeps the energy of linear systems", .keys = keys, \
    .fits = composed_fits, .order = 2, .keeps = true, .late = stepped_late, .cut = true
static const struct stepped_scheme by_error = STEPPED(&step_midpoint, stepped_between);
static const struct stepper_kind tolerant = {MIDPOINT, TOLERANT(&by_error)};
static const struct stepper_kind fourth = {MIDPOINT, COMPOSED(&step_midpoint)};
const struct stepper_kind step_midpoint = {
    MIDPOINT,     .tolerant = &tolerant, .fourth = &fourth,         .formulas = &midpoint_rule,
    .open = open, .step = implicit_step, .recall = implicit_recall,
};
