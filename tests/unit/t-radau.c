/* t-radau.c -- what Radau IIA says that a step is off by, of an oscillator against the same formula in complex numbers, and
 * how it chooses its next one */
#include <complex.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/collocation.h"
#include "engine/missed.h"
#include "unit/oscillators.h"

#include <cmocka.h>

/* A x = b by elimination; x in b. */
static void solve(double complex A[COLLOCATION_STAGES][COLLOCATION_STAGES], double complex *b, int n)
{
    for (int k = 0; k < n; k++)
        for (int i = 0; i < n; i++) {
            if (i == k) continue;
            const double complex by = A[i][k] / A[k][k];
            for (int j = k; j < n; j++) A[i][j] -= by * A[k][j];
            b[i] -= by * b[k];
        }
    for (int k = 0; k < n; k++) b[k] /= A[k][k];
}

/* Of z' = mu z, z = v + i w q and mu = i w, which is q'' = -w^2 q: the stages solve (I - h mu A) Z = z0, and the error
 * is (1 - h mu lambda) e = h mu (lambda z0 + sum d_i Z_i) (Hairer & Wanner II, IV.8, (8.19)). */
static double complex error_of(int stages, double w, double h, double complex z0)
{
    struct collocation o;
    double complex A[COLLOCATION_STAGES][COLLOCATION_STAGES], Z[COLLOCATION_STAGES];
    const double complex hm = h * w * I;
    collocation_radau(&o, stages);
    for (int i = 0; i < stages; i++) {
        for (int j = 0; j < stages; j++) A[i][j] = (i == j) - hm * o.A[i][j];
        Z[i] = z0;
    }
    solve(A, Z, stages);
    double complex sum = o.mode[0].re * z0;
    for (int i = 0; i < stages; i++) sum += o.d[i] * Z[i];
    return hm * sum / (1 - hm * o.mode[0].re);
}

/* Three masses on springs of their own, one step: the errors of their places stand to those of their velocities as they
 * must, and all of them as those of the first. */
static void test_error(void **state)
{
    enum { N = 3 };
    static const double w[N] = {6, 4, 3}, q[N] = {.2, -.1, .3}, v[N] = {.4, .5, .1}, h = .1;
    static const char *const scheme[] = {"radau5", "radau9"};
    static const double part[] = {1, .04}; /* of what drifts, see missed_drift() */
    (void)state;
    for (int k = 0; k < 2; k++) {
        struct linear s;
        struct run r;
        struct missed missed;
        struct step_options options = step_defaults;
        options.tolerance = 1e-1;
        linear_open(&s, N, 0);
        for (int i = 0; i < N; i++) {
            s.M[0][i + i * N] = 2;
            s.K[0][i + i * N] = 2 * w[i] * w[i];
        }
        assert_int_equal(run_open(&r, scheme[k], &s.ode, &options, q, v), OK);
        missed_open(&missed, N, r.life);
        r.stepper.missed = &missed;
        r.stepper.guess.h = h;
        r.stepper.guess.ratio = 1;
        assert_int_equal(run_steps(&r, h, 1, 1), OK);
        assert_int_equal(missed.steps, 1);
        const double by = missed.velocity[0] / fabs(creal(error_of(3 + 2 * k, w[0], h, v[0] + I * w[0] * q[0])));
        assert_true(by > 0 && by <= 1); /* what is gone on from is better than what was estimated */
        for (int i = 0; i < N; i++) {
            const double complex e = error_of(3 + 2 * k, w[i], h, v[i] + I * w[i] * q[i]);
            assert_true(fabs(missed.velocity[i] / fabs(creal(e)) / by - 1) < 1e-6);
            const double own = fabs(cimag(e) / w[i]) * by, drift = part[k] * h * missed.velocity[i]; /* at most */
            assert_true(missed.position[i] >= own * (1 - 1e-6) && missed.position[i] <= own * (1 + 1e-6) + drift);
        }
        run_close(&r);
    }
}

/* Steps from rest at 1 to the end of q'' = -q, the first of h, which may have to end a little behind that once. */
static long steps_to(const char *scheme, double h, double behind, double end)
{
    struct linear s;
    struct run r;
    struct step_options options = step_defaults;
    options.tolerance = 1e-5;
    linear_open(&s, 1, 0);
    s.M[0][0] = s.K[0][0] = 1;
    assert_int_equal(run_open(&r, scheme, &s.ode, &options, (double[]){1}, (double[]){0}), OK);
    r.stepper.guess.h = h;
    r.stepper.guess.ratio = 1;
    assert_int_equal(run_steps(&r, 0, 1, 0), OK);
    if (behind > 0) assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, h + behind, &r.why), OK);
    assert_int_equal(stepper_step(&r.stepper, &r.x, 0, 1, end, &r.why), OK);
    const long steps = r.stepper.effort.minors;
    assert_true(fabs(r.q[0] - cos(end)) < 1e-4);
    run_close(&r);
    return steps;
}

/* A step that ends where it has to, short, says nothing of how long the next one may be. */
static void test_cut(void **state)
{
    static const char *const scheme[] = {"radau5", "radau9"};
    static const double h = .1, end = 10;
    (void)state;
    for (int k = 0; k < 2; k++) {
        const long most = steps_to(scheme[k], h, 0, end) + 2;
        assert_in_range(steps_to(scheme[k], h, 1e-4, end), 4, most);
        assert_in_range(steps_to(scheme[k], h, 1e-8, end), 4, most);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error),
        cmocka_unit_test(test_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
