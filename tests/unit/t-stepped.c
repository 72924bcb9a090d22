/* t-stepped.c -- the steps of a scheme of fixed steps under a tolerance: the error of a trial by hand, what the filter makes
 * of it, and what is left of a step that failed. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/adaptive.h"
#include "unit/oscillators.h"

#include <cmocka.h>

struct trial {
    struct linear s;
    struct run r;
    struct adaptive *m;
    double err;
};

/* Two oscillators that know nothing of each other: coordinate 0, fast where there are two rates, at w0, the other at w1. */
static void open_trial(struct trial *o, const char *name, int ns, double w0, double w1, double tolerance)
{
    static const double q[2] = {.3, 1}, v[2] = {.5, -2};
    struct step_options options = step_defaults;
    options.tolerance = tolerance;
    options.newton_tolerance = 1e-11;
    linear_pair(&o->s, (double[]){1, 0, 0, 0}, (double[]){w0 * w0, 0, 0, 0}, NULL);
    o->s.ode.ns = ns;
    memcpy(o->s.M[1], (double[]){0, 0, 0, 1}, 4 * sizeof(double));
    memcpy(o->s.K[1], (double[]){0, 0, 0, w1 * w1}, 4 * sizeof(double));
    assert_int_equal(run_open(&o->r, name, &o->s.ode, &options, q, v), OK);
    const struct stepper_kind *kind = stepper_find(name)->tolerant;
    assert_non_null(kind);
    stepper_open(&o->r.stepper, kind, &o->s.ode, &options, o->r.life);
    o->m = adaptive_of(&o->r.stepper);
    memcpy(o->m->q, q, sizeof q);
    memcpy(o->m->v, v, sizeof v);
    memcpy(o->m->a, o->r.a, sizeof q);
    o->m->pace = o->m->top[1] = 2;
    o->m->top[0] = .5;
    o->m->elapsed = 1;
}

static void attempt(struct trial *o, double h)
{
    struct stepper *s = &o->r.stepper;
    o->m->came = h;
    assert_int_equal(o->m->scheme->attempt(s, o->m, &o->err, o->r.x.t, h, &o->r.why), OK);
}

/* Returns its minor steps. */
static int take(struct trial *o, double h)
{
    const long before = o->r.stepper.effort.minors;
    o->m->scheme->take(&o->r.stepper, o->m, h);
    memcpy(o->m->q, o->m->q1, 2 * sizeof(double));
    memcpy(o->m->v, o->m->v1, 2 * sizeof(double));
    o->r.x.t += h;
    o->m->elapsed += h;
    return (int)(o->r.stepper.effort.minors - before) + 1;
}

static void close_to(double x, double y)
{
    if (!(fabs(x - y) <= 1e-9 * fabs(y) + 1e-300)) fail_msg("%.15g is not %.15g", x, y);
}

/* In scales of the tolerance; a velocity's counts up to 2 of the share of what it was at most. */
static double in_scales(const struct trial *o, int i, double position, double velocity, double share)
{
    const struct adaptive *m = o->m;
    const double tol = m->tolerance, sq = tol * (1 + fmax(fabs(m->q[i]), fabs(m->q1[i])));
    const double sv = tol * (fmax(.1 * m->pace, 1e-3) + m->top[i]);
    return fmax(fabs(position) / sq, fmin(fabs(velocity), 2 * share * fmax(m->top[i], fabs(m->v1[i]))) / sv);
}

/* The midpoint rule on x'' = -w^2 x. */
static void midpoint_by_hand(double *x1, double *v1, double x, double v, double w, double h)
{
    const double z = w * h / 2, d = 1 + z * z;
    *x1 = ((1 - z * z) * x + h * v) / d;
    *v1 = ((1 - z * z) * v - w * w * h * x) / d;
}

/* c h^3 j and c h^3 s from three mean accelerations; the first step has that at its start instead, and
 * j/h for s. */
static void errors_by_hand(void **state)
{
    static const double w[2] = {7, 3}, h[3] = {.02, .03, .011};
    struct trial o;
    double A[3][2], j[3][2];
    (void)state;
    open_trial(&o, "midpoint", 1, w[0], w[1], 1e-3);
    for (int k = 0; k < 3; k++) {
        double most = 0;
        attempt(&o, h[k]);
        const double share = fmin(1, h[k] / (o.m->elapsed + 10 * h[k]));
        for (int i = 0; i < 2; i++) {
            double x1, v1, position[2], velocity[2];
            midpoint_by_hand(&x1, &v1, o.m->q[i], o.m->v[i], w[i], h[k]);
            close_to(o.m->q1[i], x1);
            close_to(o.m->v1[i], v1);
            A[k][i] = (v1 - o.m->v[i]) / h[k];
            j[k][i] =
                k ? 2 * (A[k][i] - A[k - 1][i]) / (h[k] + h[k - 1]) : 2 * (A[0][i] + w[i] * w[i] * o.m->q[i]) / h[0];
            const double c = pow(h[k], 3) / 12, eq = c * j[k][i],
                         ev = c * (k ? (j[k][i] - j[k - 1][i]) / h[k - 1] : j[k][i] / h[k]);
            o.m->scheme->off(&o.r.stepper, o.m, position, velocity, h[k]);
            close_to(position[i], eq);
            if (fabs(velocity[i] - ev) > 1e-9 * fabs(ev)) fail_msg("%g is not %g", velocity[i], ev);
            most = fmax(most, in_scales(&o, i, eq, ev, share));
        }
        close_to(o.err, most);
        assert_int_equal(take(&o, h[k]), 1);
    }
    /* A vibration too small to be seen: its velocity is off by twice its size at most. */
    double position[2], velocity[2];
    o.m->elapsed = 1e6;
    attempt(&o, .05);
    const double share = .05 / (o.m->elapsed + .5);
    o.m->scheme->off(&o.r.stepper, o.m, position, velocity, .05);
    assert_true(fabs(velocity[0]) > 2 * share * fmax(o.m->top[0], fabs(o.m->v1[0])));
    close_to(o.err, fmax(in_scales(&o, 0, position[0], velocity[0], share),
                         in_scales(&o, 1, position[1], velocity[1], share)));
    for (int i = 0; i < 2; i++) { /* and no less than it is now */
        o.m->top[i] = 0;
        o.m->pace = 2;
    }
    attempt(&o, .05);
    close_to(o.err, fmax(in_scales(&o, 0, position[0], velocity[0], share),
                         in_scales(&o, 1, position[1], velocity[1], share)));
    run_close(&o.r);
}

/* H211b (Soderlind 2003, b = 4, of an error that goes with h^2), aiming at .7: the step times
 * (now before)^(-1/8) (last factor)^(-1/4); nothing is changed between .85 and 1.2. */
static double filtered(double *before, double *last, double err)
{
    const double now = fmax(err / .7, 1e-8);
    double f = *before > 0 ? pow(now * *before, -.125) * pow(*last, -.25) : pow(now, -.5);
    if (err > 1) f = fmin(f, pow(now, -.5));
    f = f > 3 ? 3 : f < .2 ? .2 : f;
    if (f > .85 && f < 1.2) f = 1;
    *before = now;
    *last = f;
    return f;
}

static void grows_by_the_filter(void **state)
{
    /* first steps of a sequence, on both sides of what is kept and of the limits */
    static const double first[] = {.7,    .5,   .48,  .487,  .96, .968, .97,  1,  1.01,
                                   .0777, .078, 1e-3, 1e-12, 0,   17.4, 17.6, 40, 2};
    static const double chain[] = {.7, .3, .3, .05, .6, .9, 1.3, 5, .2, .69, .01, 1e-9, 0, .7, 30, .5};
    struct trial o;
    double before, last;
    (void)state;
    open_trial(&o, "midpoint", 1, 7, 3, 1e-3);
    for (size_t i = 0; i < sizeof first / sizeof *first; i++) {
        o.m->scheme->forget(o.m);
        attempt(&o, .02);
        before = last = 0;
        o.m->h = .02;
        close_to(o.m->scheme->grow(o.m, first[i] > 0 ? first[i] : 1e-300), filtered(&before, &last, first[i]));
    }
    o.m->scheme->forget(o.m);
    before = last = 0;
    for (size_t i = 0; i < sizeof chain / sizeof *chain; i++) {
        attempt(&o, .02);
        const double err = chain[i] > 0 ? chain[i] : 1e-300;
        /* a step that was cut tells nothing, unless it was too long */
        o.m->h = .021;
        assert_true(o.m->scheme->grow(o.m, 1) == 1);
        o.m->h = .02 * (1 + 1e-11);
        close_to(o.m->scheme->grow(o.m, err), filtered(&before, &last, err));
    }
    o.m->h = .021;
    close_to(o.m->scheme->grow(o.m, 1.5), filtered(&before, &last, 1.5));
    run_close(&o.r);
}

static void shrinks_by_the_root(void **state)
{
    struct trial o;
    (void)state;
    open_trial(&o, "midpoint", 1, 7, 3, 1e-3);
    attempt(&o, .02);
    close_to(o.m->scheme->shrink(o.m, 1), 1);
    close_to(o.m->scheme->shrink(o.m, 1.0001), .8 / sqrt(1.0001));
    close_to(o.m->scheme->shrink(o.m, 4), .4);
    close_to(o.m->scheme->shrink(o.m, 15.9), .8 / sqrt(15.9));
    close_to(o.m->scheme->shrink(o.m, 16.1), .2);
    close_to(o.m->scheme->shrink(o.m, 1e6), .2);
    run_close(&o.r);
}

/* Of two rates: whole minor steps, no longer than the one that was chosen. */
static void whole_minor_steps(void **state)
{
    static const struct {
        double H;
        int ratio;
    } cases[] = {{.05, 5}, {.0501, 6}, {.0499, 5}, {.05 * (1 + 1e-10), 5}, {.011, 2}, {.01, 1}, {.009, 1}, {.2, 20}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct trial o;
        open_trial(&o, "subcycle", 1, 40, 3, 1e-3);
        o.r.stepper.guess = (struct guess){.01, 5};
        attempt(&o, cases[i].H);
        assert_int_equal(take(&o, cases[i].H), cases[i].ratio);
        run_close(&o.r);
    }
}

/* Both oscillators fast: H is one minor step, and goes with the error of the fast ones alone. */
static void all_are_fast(void **state)
{
    struct trial o;
    double before = 0, last = 0;
    (void)state;
    open_trial(&o, "subcycle", 2, 40, 3, 1e-3);
    o.r.stepper.guess = (struct guess){.01, 1};
    attempt(&o, .01);
    assert_int_equal(take(&o, .01), 1);
    o.m->h = .01;
    close_to(o.m->scheme->grow(o.m, .3), filtered(&before, &last, .3));
    run_close(&o.r);
}

/* What is left to the end is a little more than the step: two of half its length, and the step is kept. */
static void no_splinters(void **state)
{
    const double h = 1e-4, end = 1.001 * h;
    struct trial o;
    (void)state;
    open_trial(&o, "midpoint", 0, 1, 2, 1e-2);
    o.r.stepper.guess = (struct guess){h, 1};
    assert_int_equal(stepper_step(&o.r.stepper, &o.r.x, end, 1, end, &o.r.why), OK);
    assert_true(o.r.x.t == end);
    assert_int_equal(o.r.stepper.effort.minors, 2);
    close_to(o.m->t1 - o.m->t0, end / 2);
    close_to(o.m->h, h);
    run_close(&o.r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_by_hand),      cmocka_unit_test(grows_by_the_filter),
        cmocka_unit_test(shrinks_by_the_root), cmocka_unit_test(whole_minor_steps),
        cmocka_unit_test(all_are_fast),        cmocka_unit_test(no_splinters),
    };
    return cmocka_run_group_tests_name("stepped", tests, NULL, NULL);
}
