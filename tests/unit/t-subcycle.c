/* t-subcycle.c -- energy-consistent, inertially decoupled sub-cycling: numbers of an independent
 * implementation, order, special cases, what it costs, long runs, stops */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

/* The digits are those of an independent prototype of the scheme. */
static void test_numbers(void **state)
{
    (void)state;
    static const struct {
        double h;
        int n;
        double rho;
        int damped;
        double one[4], forty[4], energy; /* qL vL qS vS */
    } want[] = {
        {.01,
         5,
         1,
         0,
         {1.024073046925, .572130220893, .126566158431, -2.634714809064},
         {.977197307754, -.259070185096, .1569116357, -2.176256454529},
         1},
        {.1,
         10,
         1,
         0,
         {-.403204941315, -4.04291086453, -.083766425012, 2.554137089639},
         {.83006901257, -2.880533406654, .030046242773, .093602115249},
         1},
        {.01,
         5,
         .5,
         0,
         {1.024081484002, .571704691597, .126536710396, -2.633349355857},
         {.977766242487, -.273217527206, .15510529523, -2.132958224041},
         .991285154742},
        {.01,
         5,
         1,
         1,
         {1.022452676433, .489835133895, .131001746503, -2.399023728402},
         {.807420278472, -.740367254526, .057364837339, -.092519691217},
         .506429277498},
    };
    for (int k = 0; k < 4; k++) {
        struct linear s;
        struct run r;
        struct step_options o = sharp();
        o.rho_infinity = want[k].rho;
        linear_both(&s);
        if (want[k].damped) memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
        assert_int_equal(run_open(&r, "subcycle", &s.ode, &o, both_q, both_v), OK);
        double E0 = linear_energy(&s, r.q, r.v);
        for (int part = 0; part < 2; part++) {
            const double *x = part ? want[k].forty : want[k].one;
            assert_int_equal(run_steps(&r, want[k].h, want[k].n, part ? 39 : 1), OK);
            const double got[4] = {r.q[1], r.v[1], r.q[0], r.v[0]};
            for (int i = 0; i < 4; i++) assert_true(fabs(got[i] - x[i]) < 6e-13);
        }
        assert_true(fabs(linear_energy(&s, r.q, r.v) / E0 - want[k].energy) < (want[k].energy == 1 ? 3e-14 : 6e-13));
        run_close(&r);
    }
}

static void is_second_order(const char *what, struct ode2 *ode, const struct step_options *o, const double *q,
                            const double *v, double T, int majors)
{
    static const int ratios[] = {1, 2, 5, 10, 20};
    for (int k = 0; k < 5; k++) {
        double order = run_order("subcycle", ode, o, q, v, T, ratios[k], majors);
        if (!(order > 1.9 && order < 2.1)) print_error("%s, n = %d: order %g\n", what, ratios[k], order);
        assert_true(order > 1.9 && order < 2.1);
    }
}

static void test_order(void **state)
{
    (void)state;
    struct step_options o = sharp(), damped = sharp(), symmetric = sharp();
    struct linear s;
    struct chain chain;
    struct carrier slide;
    damped.rho_infinity = .5;
    symmetric.symmetric = 1;
    linear_both(&s);
    is_second_order("both", &s.ode, &o, both_q, both_v, 1, 400);
    is_second_order("both, damped", &s.ode, &damped, both_q, both_v, 1, 400);
    linear_pair(&s, (double[]){1, .6, .6, 2}, (double[]){400, 0, 0, 24}, NULL);
    is_second_order("inertia", &s.ode, &o, both_q, both_v, 1, 400);
    linear_pair(&s, (double[]){1, 0, 0, 2}, (double[]){400, -20, -20, 24}, NULL);
    is_second_order("stiffness", &s.ode, &o, both_q, both_v, 1, 400);
    linear_both(&s);
    memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
    s.M[0][3] = 1, s.M[1][3] = 1, s.K[0][3] = 10, s.K[1][3] = 14, s.C[1][3] = 1; /* half of L is a slow body */
    s.f[0] = 5, s.f[1] = -3, s.w = 4;
    is_second_order("slow bodies, dampers, load", &s.ode, &o, both_q, both_v, 1, 400);
    chain_open(&chain, 30, 2, 9.81);
    is_second_order("chain", &chain.ode, &o, (double[]){.3, 1}, (double[]){0, .5}, 1, 400);
    is_second_order("chain, symmetric", &chain.ode, &symmetric, (double[]){.3, 1}, (double[]){0, .5}, 1, 400);
    carrier_open(&slide, 1);
    is_second_order("rotation", &slide.ode, &o, carrier_q, carrier_v, 1, 400);
}

static void same(const struct run *a, const struct run *b, double tol)
{
    for (int i = 0; i < a->stepper.ode->nq; i++) assert_true(fabs(a->q[i] - b->q[i]) < tol);
    for (int i = 0; i < a->stepper.ode->n; i++) assert_true(fabs(a->v[i] - b->v[i]) < 10 * tol);
    for (int c = 0; c < POWER_CHANNELS; c++) assert_true(fabs(a->work[c] - b->work[c]) < 100 * tol);
}

/* With one minor step it is the midpoint rule, W or no W, slow bodies apart or not. */
static void test_one(void **state)
{
    (void)state;
    struct linear s;
    struct chain chain;
    struct carrier slide;
    struct step_options o = sharp();
    linear_both(&s);
    memcpy(s.C[0], (double[]){3, -.2, -.2, .5}, 4 * sizeof(double));
    s.M[1][3] = 1, s.K[1][3] = 14, s.C[1][3] = 1;
    s.f[0] = 5, s.w = 4;
    chain_open(&chain, 300, 2, 9.81);
    chain.c[0] = .1, chain.c[1] = .2;
    carrier_open(&slide, 1);
    struct ode2 *odes[] = {&s.ode, &chain.ode, &slide.ode};
    for (int k = 0; k < 3; k++) {
        struct run a, b;
        const double *q = k == 2 ? carrier_q : both_q, *v = k == 2 ? carrier_v : both_v;
        assert_int_equal(run_open(&a, "subcycle", odes[k], &o, q, v), OK);
        assert_int_equal(run_open(&b, "midpoint", odes[k], &o, q, v), OK);
        for (int i = 0; i < 50; i++) {
            assert_int_equal(run_steps(&a, .01, 1, 1), OK);
            assert_int_equal(run_steps(&b, .01, 1, 1), OK);
            same(&a, &b, 1e-12);
        }
        run_close(&a);
        run_close(&b);
    }
}

/* All slow: the midpoint rule with H.  All fast: the midpoint rule with h. */
static void test_degenerate(void **state)
{
    (void)state;
    for (int fast = 0; fast < 2; fast++) {
        struct linear s;
        struct run a, b;
        struct step_options o = sharp();
        linear_both(&s);
        s.f[0] = 5, s.w = 4;
        s.ode.ns = fast ? 2 : 0;
        assert_int_equal(run_open(&a, "subcycle", &s.ode, &o, both_q, both_v), OK);
        assert_int_equal(run_open(&b, "midpoint", &s.ode, &o, both_q, both_v), OK);
        assert_int_equal(run_steps(&a, .01, 5, 40), OK);
        assert_int_equal(run_steps(&b, fast ? .01 : .05, fast ? 5 : 1, 40), OK);
        same(&a, &b, 1e-11);
        run_close(&a);
        run_close(&b);
    }
}

/* Half of the slow mass and stiffness in slow bodies, strongly coupled: at most two sweeps a step, slow
 * bodies swept once more than that, fast bodies n times a sweep. */
static void test_sweeps(void **state)
{
    (void)state;
    struct dice dice = {23};
    for (int k = 0; k < 40; k++) {
        struct linear s;
        struct run r;
        struct step_options o = step_defaults;
        int n = 6, ns = 1 + k % 4, ratio = 1 + 7 * (k % 5);
        double q[6], v[6], part[36];
        linear_open(&s, n, ns);
        random_positive(s.M[0], n, n, &dice, .3, 3);
        random_positive(s.K[0], n, n, &dice, 1, 1e4);
        random_positive(part, n - ns, n - ns, &dice, .3, 3);
        for (int j = 0; j < n - ns; j++)
            for (int i = 0; i < n - ns; i++) s.M[1][ns + i + (ns + j) * n] = part[i + j * (n - ns)];
        random_positive(part, n - ns, n - ns, &dice, 1, 1e4);
        for (int j = 0; j < n - ns; j++)
            for (int i = 0; i < n - ns; i++) s.K[1][ns + i + (ns + j) * n] = part[i + j * (n - ns)];
        if (k % 2) memcpy(s.C[1], s.M[1], sizeof s.C[1]), memcpy(s.C[0], s.M[0], sizeof s.C[0]);
        for (int i = 0; i < n; i++) q[i] = dice_range(&dice, -1, 1), v[i] = dice_range(&dice, -1, 1);
        o.newton_tolerance = 1e-9;
        assert_int_equal(run_open(&r, "subcycle", &s.ode, &o, q, v), OK);
        memset(s.calls, 0, sizeof s.calls);
        struct effort before = r.stepper.effort;
        for (int i = 0; i < 20; i++) {
            long slow = r.stepper.effort.slow;
            assert_int_equal(run_steps(&r, .01, ratio, 1), OK);
            if (r.stepper.last_sweeps > 2) print_error("k %d step %d: %d sweeps\n", k, i, r.stepper.last_sweeps);
            assert_true(r.stepper.last_sweeps <= 2);
            assert_true(r.stepper.effort.slow - slow <= r.stepper.last_sweeps + 1);
        }
        long sweeps = r.stepper.effort.sweeps - before.sweeps;
        assert_int_equal(s.calls[SLOW], sweeps);
        /* and once more for each row or column, whichever are fewer, of the slow bodies' share of the inertia */
        int few = ns < n - ns ? ns : n - ns;
        assert_int_equal(s.calls[FAST], sweeps * ratio + 20 * (few + 1));
        assert_int_equal(r.stepper.effort.slow - before.slow, sweeps + 20);
        assert_int_equal(r.stepper.effort.fast - before.fast, sweeps * ratio + 20 * (few + 2));
        assert_int_equal(r.stepper.effort.factors, 1);
        run_close(&r);
    }
}

/* A step that failed leaves nothing behind: not the state, not the forecasts. */
static void test_after_failure(void **state)
{
    (void)state;
    struct linear s;
    struct run a, b;
    struct step_options o = sharp();
    linear_both(&s);
    assert_int_equal(run_open(&a, "subcycle", &s.ode, &o, both_q, both_v), OK);
    assert_int_equal(run_open(&b, "subcycle", &s.ode, &o, both_q, both_v), OK);
    assert_int_equal(run_steps(&a, .01, 5, 10), OK);
    assert_int_equal(run_steps(&b, .01, 5, 10), OK);
    s.f[0] = NAN;
    assert_int_equal(run_steps(&b, .01, 5, 1), E_NUMERIC);
    s.f[0] = 0;
    for (int i = 0; i < 2; i++) assert_true(a.q[i] == b.q[i] && a.v[i] == b.v[i]);
    assert_int_equal(run_steps(&a, .01, 5, 10), OK);
    assert_int_equal(run_steps(&b, .01, 5, 10), OK);
    same(&a, &b, 1e-12);
    run_close(&a);
    run_close(&b);
}

/* Nonlinear: swinging chain with a vibrating outer hinge at the program's own tolerance. */
static void test_effort(void **state)
{
    (void)state;
    struct chain chain;
    struct run r;
    chain_open(&chain, 5000, 0, 9.81);
    assert_int_equal(run_open(&r, "subcycle", &chain.ode, &step_defaults, (double[]){.02, 1.2}, (double[]){0, 0}), OK);
    assert_int_equal(run_steps(&r, .001, 10, 500), OK);
    double sweeps = r.stepper.effort.sweeps / 500.;
    if (sweeps > 3.5) print_error("%g sweeps, %ld factors\n", sweeps, r.stepper.effort.factors);
    assert_true(sweeps < 3.5);
    assert_true(r.stepper.effort.slow <= r.stepper.effort.sweeps + 502);
    run_close(&r);
}

/* The ledger with rho_infinity < 1, dampers, a load and slow bodies: to round-off. */
static void test_ledger(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        const int damped = k % 2;
        struct linear s;
        struct run r;
        struct step_options o = sharp();
        o.rho_infinity = damped ? .3 : 1;
        linear_both(&s);
        memcpy(s.C[0], (double[]){.3, -.2, -.2, .5}, 4 * sizeof(double));
        s.M[1][3] = 1, s.K[1][3] = 14, s.C[1][3] = 1;
        s.f[0] = 5, s.f[1] = 2, s.w = 4;
        assert_int_equal(run_open(&r, k < 2 ? "subcycle" : "midpoint", &s.ode, &o, both_q, both_v), OK);
        double E0 = linear_energy(&s, r.q, r.v);
        assert_int_equal(run_steps(&r, .02, 6, 100), OK);
        double gap = linear_energy(&s, r.q, r.v) - E0 - r.work[POWER_DAMPER] - r.work[POWER_EXTERNAL] + r.lost;
        assert_true(fabs(gap) < 1e-11 * E0);
        assert_true(r.work[POWER_DAMPER] < -.1 * E0);
        if (damped)
            assert_true(r.lost > .01 * E0);
        else
            assert_true(r.lost == 0);
        run_close(&r);
    }
}

/* rho_infinity is what is left of the amplitude of a fast mode per minor step as w h goes to infinity;
 * a resolved mode is hardly touched: the energy lost per step falls as (w h)^3. */
static void test_damping(void **state)
{
    (void)state;
    double lost[2];
    for (int k = 0; k < 3; k++) {
        struct linear s;
        struct run r;
        struct step_options o = sharp();
        double q[2] = {1, 0}, v[2] = {0, 0}, h = k == 2 ? 1e5 : k ? .05 : .1;
        o.rho_infinity = .6;
        linear_pair(&s, (double[]){1, 0, 0, 1}, (double[]){1, 0, 0, 1}, NULL);
        assert_int_equal(run_open(&r, "subcycle", &s.ode, &o, q, v), OK);
        assert_int_equal(run_steps(&r, h, 10, 1), OK);
        if (k == 2)
            assert_true(fabs(sqrt(2 * linear_energy(&s, r.q, r.v)) / pow(.6, 10) - 1) < 1e-4);
        else
            lost[k] = r.lost / h; /* per time */
        run_close(&r);
    }
    /* per time and over the same number of steps, so a little of the phase shows */
    assert_true(lost[0] / lost[1] > 3 && lost[0] / lost[1] < 12);
}

/* Means of the energy error over tenths of a run of the chain with a stiff outer hinge, H = .1, and how many evaluations of the
 * slow bodies it takes. */
static long drift(double *tenths, int symmetric, int order, int majors)
{
    struct chain chain;
    struct run r;
    struct step_options o = step_defaults;
    o.symmetric = symmetric;
    o.order = order;
    chain_open(&chain, 2000, 0, 9.81);
    assert_int_equal(run_open(&r, "subcycle", &chain.ode, &o, (double[]){.02, 1.2}, (double[]){0, 0}), OK);
    double E0 = chain_energy(&chain, r.q, r.v),
           scale = chain_energy(&chain, (double[]){0, M_PI}, r.v) - chain_energy(&chain, (double[]){0, 0}, r.v);
    for (int k = 0; k < 10; k++) {
        tenths[k] = 0;
        for (int i = 0; i < majors / 10; i++) {
            assert_int_equal(run_steps(&r, .01, 10, 1), OK);
            tenths[k] += (chain_energy(&chain, r.q, r.v) - E0) / scale / (majors / 10.);
        }
    }
    const long slow = r.stepper.effort.slow;
    run_close(&r);
    return slow;
}

static double change_of(const double *tenths)
{
    double change = 0;
    for (int k = 1; k < 10; k++) change = fmax(change, fabs(tenths[k] - tenths[0]));
    return change;
}

/* M^ depends on the configuration and the energy identity is no longer exact.  W at the average of the
 * ends makes the step symmetric in time: no drift.  W at the start leaves one, linear in time and small:
 * of the order of 1e-8 of the swing's energy per major step, here 2.7e-4 over 20000. */
static void test_drift(void **state)
{
    (void)state;
    double t[10], change[2];
    for (int symmetric = 0; symmetric < 2; symmetric++) {
        drift(t, symmetric, 2, 20000);
        change[symmetric] = change_of(t);
        assert_true(fabs(t[0]) < 2e-4);
    }
    if (!(change[0] < 5e-4 && change[1] < 1e-6)) print_error("drift: plain %g, symmetric %g\n", change[0], change[1]);
    assert_true(change[0] < 5e-4 && change[1] < 1e-6);
}

/* Nor does order 4, whose stages have W where the middle is foreseen: a stage takes W once or twice and two or three sweeps,
 * where one that is solved twice asks the slow bodies 7.4 times. */
static void test_fourth(void **state)
{
    (void)state;
    enum { MAJORS = 4000, STAGES = 5 };
    double t[10];
    const double asks = (double)drift(t, 0, 4, MAJORS) / MAJORS / STAGES, change = change_of(t);
    print_message("order 4: drift %g, %g evaluations of the slow bodies a stage\n", change, asks);
    assert_true(change < 2e-5 && asks < 6);
}

/* The symmetric form undoes itself; the plain one does not. */
static void test_reversal(void **state)
{
    (void)state;
    double back[2];
    for (int symmetric = 0; symmetric < 2; symmetric++) {
        struct chain chain;
        struct run r;
        struct step_options o = sharp();
        o.symmetric = symmetric;
        chain_open(&chain, 300, 2, 9.81);
        assert_int_equal(run_open(&r, "subcycle", &chain.ode, &o, (double[]){.1, 1}, (double[]){0, .5}), OK);
        assert_int_equal(run_steps(&r, .005, 5, 20), OK);
        assert_int_equal(stepper_start(&r.stepper, &r.x, NULL), OK);
        assert_int_equal(run_steps(&r, -.005, 5, 20), OK);
        back[symmetric] = fmax(fabs(r.q[0] - .1), fabs(r.q[1] - 1));
        run_close(&r);
    }
    if (!(back[1] < 1e-8)) print_error("reversal: plain %g, symmetric %g\n", back[0], back[1]);
    assert_true(back[1] < 1e-8 && back[0] > 100 * back[1]);
}

/* ---- a slider on a rod that hits a stop: s = q[0] along the rod (fast), angle q[1] (slow) */

struct slider {
    struct ode2 ode;
    double k, stop, at; /* spring, stop 1000 times stiffer, gap */
    double m, J;
    int gradient; /* discrete gradient; else the force at the point */
    double slope; /* at the last slopes() */
};

static double stored(const struct slider *s, double x)
{
    double in = fmax(0, x - s->at);
    return s->k / 2 * x * x + s->stop / 2 * in * in;
}

static double push(const struct slider *s, double x)
{
    return s->k * x + s->stop * fmax(0, x - s->at);
}

static double slider_force(const struct slider *s, const struct instant *x, double *slope)
{
    double a = x->qa && s->gradient ? x->qa[0] : 0, b = x->qb && s->gradient ? x->qb[0] : 0;
    *slope = s->k + (x->q[0] > s->at ? s->stop : 0);
    if (fabs(b - a) < 1e-9) return push(s, x->q[0]);
    double f = (stored(s, b) - stored(s, a)) / (b - a);
    *slope = fmax(s->k, 2 * (push(s, b) - f) / (b - a)); /* by the midpoint, (a + b)/2 */
    return f;
}

static enum status slider_resid(const struct ode2 *o, double *r, double *w, double *dk, const struct instant *x,
                                unsigned cls, struct trouble *why)
{
    struct slider *s = o->self;
    double l = 1 + x->q[0], slope, f = slider_force(s, x, &slope), as = x->a ? x->a[0] : 0, at = x->a ? x->a[1] : 0;
    (void)why;
    r[0] = r[1] = 0;
    if (w) memset(w, 0, POWER_CHANNELS * sizeof *w);
    if (dk) *dk = cls & FAST ? fabs(slope - s->slope) / s->slope : 0;
    if (cls & FAST) {
        r[0] = s->m * (as - l * x->v[1] * x->v[1]) + f;
        r[1] = s->m * l * (l * at + 2 * x->v[0] * x->v[1]);
    }
    if (cls & SLOW) r[1] += s->J * at;
    return OK;
}

static enum status slider_mass(const struct ode2 *o, double *M, const double *q, double t, unsigned cls,
                               struct trouble *why)
{
    struct slider *s = o->self;
    double l = 1 + q[0];
    (void)t, (void)why;
    memset(M, 0, 4 * sizeof *M);
    if (cls & FAST) M[0] = s->m, M[3] = s->m * l * l;
    if (cls & SLOW) M[3] += s->J;
    return OK;
}

static enum status slider_slopes(const struct ode2 *o, double *K, double *C, const struct instant *x, unsigned cls,
                                 struct trouble *why)
{
    struct slider *s = o->self;
    double slope;
    (void)why;
    memset(K, 0, 4 * sizeof *K);
    memset(C, 0, 4 * sizeof *C);
    if (!(cls & FAST)) return OK;
    slider_force(s, x, &slope);
    s->slope = K[0] = slope;
    return OK;
}

static double slider_energy(const struct slider *s, const double *q, const double *v)
{
    double l = 1 + q[0];
    return s->m / 2 * (v[0] * v[0] + l * l * v[1] * v[1]) + s->J / 2 * v[1] * v[1] + stored(s, q[0]);
}

/* Largest energy over the first, or -1 when a step fails. */
static double stop_run(double h, int n, int gradient, long *factors)
{
    static const struct ode2_ops ops = {.resid = slider_resid, .mass = slider_mass, .slopes = slider_slopes};
    struct slider s = {.k = 1000, .stop = 1e6, .at = .05, .m = 5, .J = 8. / 3, .gradient = gradient, .slope = 1000};
    struct run r;
    double most = 0;
    s.ode = (struct ode2){.n = 2, .ns = 1, .nq = 2, .ops = &ops, .self = &s};
    assert_int_equal(run_open(&r, "subcycle", &s.ode, &step_defaults, (double[]){-.1, 0}, (double[]){0, .5}), OK);
    double E0 = slider_energy(&s, r.q, r.v);
    for (int k = 0; k < 1000 && most >= 0; k++) {
        if (run_steps(&r, h, n, 1) != OK)
            most = -1;
        else
            most = fmax(most, slider_energy(&s, r.q, r.v) / E0);
    }
    *factors = r.stepper.effort.factors;
    run_close(&r);
    return most;
}

/* Fast rotation, Coriolis forces that no slope tells of: the first sweep removes most of the error, the
 * rest goes round between slow and fast rows.  The program's own tolerance must not be taken in by that. */
static void test_tolerance(void **state)
{
    (void)state;
    static const struct ode2_ops ops = {.resid = slider_resid, .mass = slider_mass, .slopes = slider_slopes};
    struct run r[2];
    for (int k = 0; k < 2; k++) {
        struct slider s = {.k = 1000, .stop = 0, .at = 10, .m = 5, .J = 8. / 3, .slope = 1000};
        struct step_options o = k ? sharp() : step_defaults;
        s.ode = (struct ode2){.n = 2, .ns = 1, .nq = 2, .ops = &ops, .self = &s};
        assert_int_equal(run_open(&r[k], "subcycle", &s.ode, &o, (double[]){.1, 0}, (double[]){0, 12}), OK);
        assert_int_equal(run_steps(&r[k], 1e-3, 5, 400), OK);
        run_close(&r[k]);
    }
    double gap = fmax(fabs(r[0].q[0] - r[1].q[0]), fabs(r[0].q[1] - r[1].q[1]));
    if (!(gap < 1e-6)) print_error("positions differ by %g after 400 steps\n", gap);
    assert_true(gap < 1e-6);
}

/* A stop 1000 times stiffer than the spring, w h = .9 ... 4.5 inside: the discrete gradient keeps the
 * energy, minor steps at the kink take matrices of their own; the force at the midpoint does not. */
static void test_stop(void **state)
{
    (void)state;
    static const struct {
        double h;
        int n;
    } runs[] = {{2e-3, 10}, {5e-3, 10}, {1e-2, 5}, {1e-2, 20}};
    for (int k = 0; k < 4; k++) {
        long factors;
        double most = stop_run(runs[k].h, runs[k].n, 1, &factors);
        if (!(most > 0 && most < 1.007)) print_error("h %g n %d: %g\n", runs[k].h, runs[k].n, most);
        assert_true(most > 0 && most < 1.007);
        assert_true(factors > 1100); /* one a step for the masses, and those of the minor steps at the kink */
    }
    long factors;
    double most = stop_run(1e-2, 5, 0, &factors);
    assert_true(most < 0 || most > 1.2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),    cmocka_unit_test(test_order),     cmocka_unit_test(test_one),
        cmocka_unit_test(test_degenerate), cmocka_unit_test(test_sweeps),    cmocka_unit_test(test_after_failure),
        cmocka_unit_test(test_effort),     cmocka_unit_test(test_ledger),    cmocka_unit_test(test_damping),
        cmocka_unit_test(test_drift),      cmocka_unit_test(test_fourth),    cmocka_unit_test(test_reversal),
        cmocka_unit_test(test_stop),       cmocka_unit_test(test_tolerance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
