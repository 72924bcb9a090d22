/* t-growth.c -- the growth of schemes by their own steps (probe/growth.h): closed forms of one coordinate, the table of
 * two coupled ones by a prototype outside of this program, and runs step after step. */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "probe/growth.h"
#include "unit/oscillators.h"

#include <cmocka.h>

static struct growth find(struct linear *s, const char *scheme, const struct step_options *options, double h, int ratio)
{
    struct growth o;
    struct trouble why = {0};
    if (growth_find(&o, &s->ode, stepper_find(scheme), options, h, ratio, &why) != OK)
        fail_msg("%s: h %g ratio %d: trouble %d, %g", scheme, h, ratio, (int)why.code, why.value);
    return o;
}

static const struct step_options plain = {.rho_infinity = 1, .beta = .25, .gamma = .5};

/* One coordinate of frequency 1. */
static void oscillator(struct linear *s, double damping)
{
    linear_open(s, 1, 1);
    s->M[0][0] = s->K[0][0] = 1;
    s->C[0][0] = 2 * damping;
}

static void test_closed_forms(void **state)
{
    struct linear s;
    (void)state;
    oscillator(&s, 0);
    for (double h = .01; h < 1e3; h *= 3) {
        assert_true(fabs(find(&s, "newmark", &plain, h, 1).radius - 1) < 1e-11);
        assert_true(fabs(find(&s, "midpoint", &plain, h, 1).radius - 1) < 1e-11);
        assert_true(fabs(find(&s, "midpoint", &plain, h, 1).angle - 2 * atan(h / 2)) < 1e-10);
        assert_true(fabs(find(&s, "subcycle", &plain, h, 7).radius - 1) < 1e-11);
    }
    /* R(ih) of the classical Runge-Kutta method: |R|^2 = 1 - h^6/72 + h^8/576 */
    for (double h = .1; h < 4; h += .3) {
        const double is = pow(1 - pow(h, 6) / 72 + pow(h, 8) / 576, .5);
        assert_true(fabs(find(&s, "rk4", &plain, h, 1).radius / is - 1) < 1e-11);
    }
    /* Central differences: on the unit circle below omega h = 2, beyond x + sqrt(x^2 - 1), x = h^2/2 - 1. */
    assert_true(fabs(find(&s, "daniel", &plain, 1.99, 1).radius - 1) < 1e-9);
    const double x = 2.5 * 2.5 / 2 - 1;
    assert_true(fabs(find(&s, "daniel", &plain, 2.5, 1).radius - (x + sqrt(x * x - 1))) < 1e-9);
}

/* What a step leaves of what it does not resolve is what the option says. */
static void test_damping_at_infinity(void **state)
{
    struct linear s;
    (void)state;
    oscillator(&s, 0);
    for (double rho = .2; rho < 1; rho += .2) {
        struct step_options o = plain;
        o.rho_infinity = rho;
        assert_true(fabs(find(&s, "generalized-alpha", &o, 1e6, 1).radius - rho) < 1e-3);
        assert_true(find(&s, "generalized-alpha", &o, 1e-2, 1).radius < 1);
        assert_true(fabs(find(&s, "newmark", &o, 1e6, 1).radius - rho) < 1e-3);
        assert_true(find(&s, "newmark", &o, 1e-2, 1).radius < 1);
        assert_true(fabs(find(&s, "subcycle", &o, 1e6, 1).radius - rho) < 1e-3);
        assert_true(fabs(find(&s, "midpoint", &o, 1e6, 1).radius - rho) < 1e-3);
        assert_true(fabs(1 - find(&s, "midpoint", &o, 1e-1, 1).radius - (1 - rho) / (1 + rho) * 1e-4 / 8) < 1e-7);
        if (rho > .5) assert_true(fabs(find(&s, "hht", &o, 1e6, 1).radius - rho) < 1e-3);
        o.rho_infinity = 1;
        o.alpha = -rho / 3;
        assert_true(fabs(find(&s, "hht", &o, 1e6, 1).radius - (1 + o.alpha) / (1 - o.alpha)) < 1e-3);
    }
}

/* M = [1 mu; mu 1], K = [wL^2 k wL wS; . wS^2], the fast one first. */
static void pair(struct linear *s, double wl, double ws, double mu, double k)
{
    linear_open(s, 2, 1);
    double *M = s->M[0], *K = s->K[0];
    M[0] = M[3] = 1;
    M[1] = M[2] = mu;
    K[0] = ws * ws;
    K[3] = wl * wl;
    K[1] = K[2] = k * wl * ws;
}

struct scan {
    double share, worst, practical, practical_worst;
};

/* Cells wL H, wS h in [1e-2, 1e2]; of these the practical ones, wL H <= 0.5 and wS >= 3 wL. */
static struct scan scan(const char *scheme, double mu, double k, int n, int grid)
{
    struct linear s;
    struct scan o = {0};
    int unstable = 0, used = 0, bad = 0;
    for (int i = 0; i < grid; i++)
        for (int j = 0; j < grid; j++) {
            const double H = n, wl = pow(10, -2 + 4. * i / (grid - 1)) / H, ws = pow(10, -2 + 4. * j / (grid - 1));
            pair(&s, wl, ws, mu, k);
            const double radius = find(&s, scheme, &plain, 1, n).radius;
            const bool practical = wl * H <= .5 * (1 + 1e-9) && ws >= 3 * wl * (1 - 1e-9);
            unstable += radius > 1 + 1e-4;
            bad += practical && radius > 1 + 1e-4;
            used += practical;
            o.worst = fmax(o.worst, radius);
            if (practical) o.practical_worst = fmax(o.practical_worst, radius);
        }
    o.share = unstable / (double)(grid * grid);
    o.practical = bad / (double)used;
    return o;
}

/* Shares of unstable cells of the paper's scheme and largest radii, by a prototype in another language on 61 x 61 cells. */
static void test_table_of_pairs(void **state)
{
    static const struct {
        double mu, k;
        int n;
        double share, worst, practical, practical_worst;
    } row[] = {
        {.3, 0, 5, .55, 1.30, .46, 1.30},  {.3, 0, 20, .74, 1.37, .71, 1.37}, {.7, 0, 20, .86, 4.1, .84, 4.1},
        {0, .3, 10, .54, 1.11, .16, 1.01}, {0, .9, 20, .72, 1.58, .35, 1.05},
    };
    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        const struct scan miao = scan("miao", row[i].mu, row[i].k, row[i].n, 61);
        print_message("miao mu %g k %g n %d: %.3f (%.4f), practical %.3f (%.4f)\n", row[i].mu, row[i].k, row[i].n,
                      miao.share, miao.worst, miao.practical, miao.practical_worst);
        assert_true(fabs(miao.share - row[i].share) < .0151);
        assert_true(fabs(miao.worst / row[i].worst - 1) < .02);
        assert_true(fabs(miao.practical - row[i].practical) < .0151);
        assert_true(fabs(miao.practical_worst / row[i].practical_worst - 1) < .02);
        const struct scan ours = scan("subcycle", row[i].mu, row[i].k, row[i].n, 21);
        assert_true(ours.worst < 1 + 1e-9);
    }
}

/* Without inertial coupling both explicit schemes are stable or not as their head says. */
static void test_explicit_pairs(void **state)
{
    struct linear s;
    double daniel = 0, neal = 0, off = 0;
    (void)state;
    for (double ws = .05; ws < 1.5; ws += .0005) {
        pair(&s, .01, ws, 0, .2);
        daniel = fmax(daniel, find(&s, "daniel", &plain, 1, 10).radius);
        const double radius = find(&s, "neal-belytschko", &plain, 1, 10).radius;
        const double phase = fmod(20 * asin(ws / 2) + .5 * acos(-1), acos(-1)) - .5 * acos(-1); /* from k pi */
        if (fabs(phase) < .5)
            neal = fmax(neal, radius);
        else
            off = fmax(off, radius);
    }
    print_message("daniel %.6f, neal-belytschko near k pi %.6f, elsewhere %.9f\n", daniel, neal, off);
    assert_true(daniel > 1 + 1e-5 && daniel < 1.02);
    assert_true(neal > 1 + 1e-5);
    assert_true(off < 1 + 1e-9);
}

/* A run's growth from states step after step: x_(k+1) = a x_k + b x_(k-1) of a pair of eigenvalues, b = -radius^2; of one
 * real eigenvalue the quotient. */
static double of_run(struct linear *s, const char *scheme, const struct step_options *options, double h, int ratio,
                     struct growth g)
{
    const int steps = (int)fmin(40000, 120 / log10(fmax(g.radius, 1 + 1e-9))), many = steps > 20 ? steps : 20;
    struct arena *life = arena_open();
    struct stepper stepper;
    struct trouble why = {0};
    double q[2] = {.3, -.2}, v[2] = {.1, .4}, a[2], x[3] = {0}, sum = 1;
    struct state state = {0, q, v, a};
    struct step_options exact = *options;
    exact.newton_tolerance = 1e-13;
    stepper_open(&stepper, stepper_find(scheme), &s->ode, &exact, life);
    assert_int_equal(OK, stepper_start(&stepper, &state, &why));
    for (int k = 0; k < many; k++) {
        assert_int_equal(OK, stepper_step(&stepper, &state, h, ratio, (k + 1) * h * ratio, &why));
        x[0] = x[1], x[1] = x[2], x[2] = q[0];
        if (k == many - 2) sum = x[0] * x[2] - x[1] * x[1]; /* goes with radius^2 */
    }
    const double last = x[0] * x[2] - x[1] * x[1];
    arena_close(life);
    const bool turns = g.angle > 1e-6 && g.angle < acos(-1) - 1e-6;
    return turns ? sqrt(last / sum) : fabs(x[2] / x[1]);
}

static void test_runs(void **state)
{
    static const struct {
        const char *scheme;
        double mu, k, wl, ws, h;
        int n;
    } row[] = {
        {"miao", .3, 0, .02, .3, 1, 5},  {"miao", .7, 0, .01, .2, 1, 20},  {"miao", 0, .9, .03, 1.2, 1, 20},
        {"miao", .3, .3, .05, 2, 1, 10}, {"daniel", .3, 0, .02, .3, 1, 5}, {"neal-belytschko", .3, .2, .02, .3, 1, 5},
    };
    struct linear s;
    (void)state;
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        pair(&s, row[i].wl, row[i].ws, row[i].mu, row[i].k);
        const struct growth g = find(&s, row[i].scheme, &plain, row[i].h, row[i].n);
        const double run = of_run(&s, row[i].scheme, &plain, row[i].h, row[i].n, g);
        print_message("%s: %.12f, run %.12f\n", row[i].scheme, g.radius, run);
        assert_true(fabs(run - g.radius) < 1e-6);
    }
}

static void test_own(void **state)
{
    struct linear s;
    (void)state;
    oscillator(&s, 0);
    assert_true(growth_own(&s.ode) == 0);
    oscillator(&s, -.1); /* s = .1 +- i sqrt(.99) */
    assert_true(fabs(growth_own(&s.ode) - .1) < 1e-12);
    oscillator(&s, 0);
    s.K[0][0] = -4;
    assert_true(fabs(growth_own(&s.ode) - 2) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closed_forms),   cmocka_unit_test(test_damping_at_infinity),
        cmocka_unit_test(test_table_of_pairs), cmocka_unit_test(test_explicit_pairs),
        cmocka_unit_test(test_runs),           cmocka_unit_test(test_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
