/* t-newton.c -- few iterations: where a step begins, what contraction is expected, when another matrix is due */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/contraction.h"
#include "engine/fit.h"
#include "engine/newton.h"
#include "engine/renewal.h"
#include "unit/oscillators.h"

#include <cmocka.h>

/* ---- fit: what a recursion of two terms goes through -------------------------------------------- */

static double missed(double (*term)(int n), int from, int to)
{
    struct fit fit = {0};
    double worst = 0;
    for (int n = 0; n < to; n++) {
        double said = fit_next(&fit), is = term(n + 1) - term(n);
        if (n >= from) worst = fmax(worst, fabs(said - is));
        fit_learn(&fit, is);
    }
    return worst;
}

static double undersampled(int n)
{
    return cos(41.3 * n + 1);
}

static double parabola(int n)
{
    return 3 - .2 * n + .01 * n * n;
}

static void test_fit(void **state)
{
    (void)state;
    assert_true(missed(undersampled, 8, 100) < 1e-4);
    assert_true(missed(parabola, 8, 100) < .1 * .02); /* of what its differences change by */
    struct fit none = {0};
    assert_true(fit_next(&none) == 0);
    fit_learn(&none, 2);
    assert_true(fit_next(&none) == 2);
}

/* ---- contraction -------------------------------------------------------------------------------- */

/* One step whose quotients are given; what was expected after each of its iterations. */
static void iterate(double *said, struct contraction *c, const double *theta, int n, int fresh)
{
    contraction_begin(c);
    if (fresh) contraction_renewed(c);
    for (int k = 0; k < n; k++) said[k] = contraction_after(c, k ? theta[k] : 1, 3e-4);
}

/* Errors go to and fro between two blocks: small quotients are followed by large ones. */
static void test_to_and_fro(void **state)
{
    (void)state;
    static const double theta[] = {0, 1e-4, .2, 1e-4, .2, 1e-4};
    struct contraction c;
    double said[6];
    contraction_forget(&c);
    iterate(said, &c, theta, 6, 1);
    assert_true(said[0] == .5); /* nothing is known */
    for (int step = 0; step < 20; step++) {
        iterate(said, &c, theta, 6, 0);
        for (int k = 0; k < 5; k++) assert_true(said[k] >= theta[k + 1]);
        assert_true(said[0] < 3.1e-4 && said[1] < .21);
    }
}

/* A step that goes worse than foreseen; a matrix that is not looked at for long; a new one. */
static void test_doubt(void **state)
{
    (void)state;
    static const double good[] = {0, 1e-3, 1e-3, 1e-3}, bad[] = {0, 1e-2, 1e-2, 1e-2};
    struct contraction c;
    double said[4], before;
    contraction_forget(&c);
    for (int step = 0; step < 5; step++) iterate(said, &c, good, 4, step == 0);
    assert_true(said[0] < 1.01e-3 && said[1] < 1.01e-3);
    iterate(said, &c, bad, 4, 0);
    assert_true(said[1] >= 1e-2);
    for (int step = 0; step < 20; step++) iterate(said, &c, good, 4, 0);
    before = said[0];
    for (int step = 0; step < 12; step++) {
        iterate(said, &c, good, 1, 0);
        assert_true(step == 0 || said[0] >= before);
        before = said[0];
    }
    assert_true(before > .3);
    iterate(said, &c, good, 1, 1); /* what it was in the first step of the matrix before */
    assert_true(said[0] < 1.01e-3);
}

/* What was so good once need not be so now: a first iteration is not taken for the last on its word, nor is a second
 * one where nobody has seen a third; and a quotient that is far too good has left the slow part for the next. */
static void test_hearsay(void **state)
{
    (void)state;
    static const double at_rest[] = {0, 1e-9, 1e-9}, shifted[] = {0, 1e-4}, usual[] = {0, .02, 2e-5, .2};
    struct contraction c;
    double said[4];
    contraction_forget(&c);
    iterate(said, &c, at_rest, 2, 1);
    assert_true(said[1] >= 1e-3);
    iterate(said, &c, at_rest, 3, 0);
    iterate(said, &c, at_rest, 3, 1);
    assert_true(said[0] >= 3e-4);
    contraction_forget(&c);
    for (int step = 0; step < 5; step++) iterate(said, &c, usual, 4, step == 0);
    assert_true(said[1] < .021);
    iterate(said, &c, shifted, 2, 0);
    assert_true(said[1] >= .02);
}

/* ---- renewal ------------------------------------------------------------------------------------ */

static double growing(int age, int step)
{
    (void)step;
    return 2 + .02 * age;
}

/* Fewer and more by turns whatever the matrix is. */
static double restless(int age, int step)
{
    (void)age;
    return 2.5 + .8 * sin(2.4 * step);
}

/* Renewals in so many steps, and their cost a step. */
static double renewals(double *cost, double (*need)(int age, int step), double price, int steps)
{
    struct renewal r;
    int age = 0, due = 1, count = 0;
    renewal_forget(&r, price);
    *cost = 0;
    for (int i = 0; i < steps; i++) {
        age = due ? 0 : age + 1;
        count += due;
        *cost += need(age, i) + (due ? price : 0);
        due = renewal_due(&r, need(age, i), age == 0);
    }
    *cost /= steps;
    return (double)steps / count;
}

/* (R + e T^2/2)/T is least at T = sqrt(2 R/e), where it is sqrt(2 R e).  Where no matrix is better than another they
 * cost less than a tenth. */
static void test_renewal(void **state)
{
    (void)state;
    static const double prices[] = {1, 2, 8};
    double cost;
    for (int i = 0; i < 3; i++) {
        double R = prices[i], T = sqrt(2 * R / .02), every = renewals(&cost, growing, R, 4000);
        if (!(every > .7 * T && every < 1.3 * T)) print_error("price %g: every %g of %g steps\n", R, every, T);
        assert_true(every > .7 * T && every < 1.3 * T);
        assert_true(cost < 2 + 1.1 * sqrt(2 * R * .02));
    }
    assert_true(renewals(&cost, restless, 2, 4000) > 8 && cost < 1.1 * 2.5);
}

static void test_need(void **state)
{
    (void)state;
    assert_true(renewal_need(1e-9, 1e-8, 1, 1) == 1);
    for (double theta = 1e-4; theta < .5; theta *= 3) {
        double want = 1 + log(1e-2 / 1e-8) / log(1 / theta), found = renewal_need(1e-2, 1e-8, 1 / theta, 2);
        assert_true(fabs(found - want) < .1 * want);
        assert_true(fabs(renewal_need(1e-2, 1e-8, pow(theta, -3), 4) - want) < .1 * want);
    }
}

/* ---- steps -------------------------------------------------------------------------------------- */

static const char *const scheme[] = {"midpoint", "newmark"};

/* Vibration under a constant load is foreseen whatever w h is: one iteration a step finds nothing to do. */
static void test_vibration(void **state)
{
    (void)state;
    struct dice dice = {5};
    for (int k = 0; k < 40; k++) {
        struct linear s;
        struct run r;
        double q[5], v[5], a[5];
        int n = 5;
        linear_open(&s, n, 0);
        random_positive(s.M[0], n, n, &dice, .1, 10);
        random_positive(s.K[0], n, n, &dice, 1, 1e6);
        random_positive(s.C[0], n, n, &dice, .01, 1);
        for (int i = 0; i < n; i++) {
            q[i] = dice_range(&dice, -.1, .1), v[i] = dice_range(&dice, -1, 1);
            s.f[i] = dice_range(&dice, -100, 100);
        }
        assert_int_equal(run_open(&r, scheme[k % 2], &s.ode, &step_defaults, q, v), OK);
        assert_int_equal(run_steps(&r, .1, 1, 12), OK);
        long before = r.stepper.effort.sweeps, factors = r.stepper.effort.factors;
        assert_int_equal(run_steps(&r, .1, 1, 50), OK);
        assert_true(r.stepper.effort.sweeps - before <= 51);
        assert_int_equal(r.stepper.effort.factors, factors);
        /* and it is the scheme's: one step more by itself, to 1e-13 */
        struct run one;
        struct step_options sharp = step_defaults;
        sharp.newton_tolerance = 1e-13;
        memcpy(q, r.q, sizeof q), memcpy(v, r.v, sizeof v), memcpy(a, r.a, sizeof a);
        assert_int_equal(run_open(&one, scheme[k % 2], &s.ode, &sharp, q, v), OK);
        if (k % 2) memcpy(one.a, a, sizeof a);
        assert_int_equal(run_steps(&one, .1, 1, 1), OK);
        assert_int_equal(run_steps(&r, .1, 1, 1), OK);
        for (int i = 0; i < n; i++) assert_true(fabs(one.v[i] - r.v[i]) < 1e-7 * r.stepper.effort.majors);
        run_close(&one);
        run_close(&r);
    }
}

/* ---- when it may stop --------------------------------------------------------------------------- */

static void open_one(struct newton *nt, struct linear *s, struct effort *effort, const struct step_options *options,
                     struct arena *life)
{
    linear_open(s, 1, 0);
    s->M[0][0] = 2;
    s->K[0][0] = 5;
    newton_open(nt, &s->ode, effort, options, life);
}

/* The energy of the motion is looked at between a residual and its use. */
static void test_energy_keeps_the_residual(void **state)
{
    (void)state;
    struct linear s;
    struct effort effort = {0};
    struct newton nt;
    struct arena *life = arena_open();
    const double q = .3, v = 4, a = 0;
    const struct instant x = {.q = &q, .v = &v, .a = &a};
    open_one(&nt, &s, &effort, &step_defaults, life);
    nt.r[0] = 1e-9;
    newton_energy(&nt, &x);
    assert_float_equal(nt.energy, 32, 1e-12); /* v M v */
    assert_float_equal(nt.r[0], 1e-9, 0);
    arena_close(life);
}

/* Corrections of 1e-4 and 1e-6, so that 1e-8 are left: some tolerances.  With little of the energy that is enough, not where
 * the deck names the tolerance, nor for more of them. */
static enum verdict second(double tolerance, double tolerances_left, double share_of_energy)
{
    struct linear s;
    struct effort effort = {0};
    struct newton nt;
    struct arena *life = arena_open();
    struct step_options options = step_defaults;
    const double one = 1;
    const struct instant x = {.q = &one, .v = &one, .a = &one};
    options.newton_tolerance = tolerance;
    open_one(&nt, &s, &effort, &options, life);
    newton_scale(&nt, &one, &one, 1);
    newton_energy(&nt, &x);
    newton_begin(&nt, -1);
    nt.tol = 1e-8 / tolerances_left;
    const double left = share_of_energy * nt.tol, energy = left * left * nt.energy;
    assert_int_equal(newton_judge(&nt, 1e-4, 1, 1e8 * energy, &x), CONTINUE);
    enum verdict said = newton_judge(&nt, 1e-6, 1, 1e4 * energy, &x);
    arena_close(life);
    return said;
}

static void test_little_energy_is_left(void **state)
{
    (void)state;
    assert_int_equal(second(0, .02, 10), CONVERGED);
    assert_int_equal(second(0, .5, 10), CONTINUE);
    assert_int_equal(second(0, .5, .05), CONVERGED);
    assert_int_equal(second(1e-8, .5, .05), CONTINUE);
    assert_int_equal(second(0, 3, .05), CONTINUE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fit),
        cmocka_unit_test(test_to_and_fro),
        cmocka_unit_test(test_doubt),
        cmocka_unit_test(test_hearsay),
        cmocka_unit_test(test_renewal),
        cmocka_unit_test(test_need),
        cmocka_unit_test(test_vibration),
        cmocka_unit_test(test_energy_keeps_the_residual),
        cmocka_unit_test(test_little_energy_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
