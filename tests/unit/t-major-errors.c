/* t-major-errors.c -- what a major step of sub-cycling says that it is off by, against what it is off by: from exact states
 * of two masses, the exact step of the exponential of their matrix */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "unit/oscillators.h"

#include <cmocka.h>

enum { S = 4 }; /* q0, q1, v0, v1; coordinate 0 is fast */

static void times(double *C, const double *A, const double *B)
{
    double out[S * S];
    for (int j = 0; j < S; j++)
        for (int i = 0; i < S; i++) {
            double sum = 0;
            for (int k = 0; k < S; k++) sum += A[i + k * S] * B[k + j * S];
            out[i + j * S] = sum;
        }
    memcpy(C, out, sizeof out);
}

/* exp(A t): Taylor of A t / 2^10, squared. */
static void exponential(double *E, const double *A, double t)
{
    double part[S * S], X[S * S];
    for (int i = 0; i < S * S; i++) X[i] = A[i] * t / 1024, E[i] = part[i] = i % (S + 1) == 0;
    for (int k = 1; k < 14; k++) {
        times(part, part, X);
        for (int i = 0; i < S * S; i++) E[i] += part[i] /= k;
    }
    for (int k = 0; k < 10; k++) times(E, E, E);
}

/* d/dt (q, v) of M a + C v + K q = 0. */
static void motion_matrix(double *A, const struct linear *s)
{
    double M[4], K[4], C[4];
    for (int i = 0; i < 4; i++) {
        M[i] = s->M[0][i] + s->M[1][i];
        K[i] = s->K[0][i] + s->K[1][i];
        C[i] = s->C[0][i] + s->C[1][i];
    }
    const double det = M[0] * M[3] - M[1] * M[2], Z[4] = {M[3] / det, -M[1] / det, -M[2] / det, M[0] / det};
    memset(A, 0, S * S * sizeof *A);
    A[0 + 2 * S] = A[1 + 3 * S] = 1;
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++)
            for (int k = 0; k < 2; k++) {
                A[2 + i + j * S] -= Z[i + 2 * k] * K[k + 2 * j];
                A[2 + i + (2 + j) * S] -= Z[i + 2 * k] * C[k + 2 * j];
            }
}

static void advance(double *x, const double *E)
{
    double y[S] = {0};
    for (int j = 0; j < S; j++)
        for (int i = 0; i < S; i++) y[i] += E[i + j * S] * x[j];
    memcpy(x, y, sizeof y);
}

struct errors {
    double found[S], said[S]; /* of x, y, v_S, u: sums of squares over the steps */
};

static void compare(struct errors *e, const struct linear *s, double h, int ratio, int steps)
{
    double A[S * S], E[S * S], x[S] = {.1, 1, 0, .3};
    const double W = (s->M[0][1] + s->M[1][1]) / (s->M[0][3] + s->M[1][3]), H = h * ratio;
    struct step_options o = step_defaults;
    struct linear copy = *s;
    struct run r;
    copy.ode.self = &copy;
    o.newton_tolerance = 1e-13;
    motion_matrix(A, s);
    exponential(E, A, H);
    assert_int_equal(run_open(&r, "subcycle", &copy.ode, &o, x, x + 2), OK);
    r.stepper.missed = NULL; /* as under a tolerance: every step is looked at */
    *e = (struct errors){{0}, {0}};
    for (int k = 0; k < steps; k++) {
        memcpy(r.q, x, 2 * sizeof *x);
        memcpy(r.v, x + 2, 2 * sizeof *x);
        assert_int_equal(stepper_step(&r.stepper, &r.x, h, ratio, r.x.t + H, &r.why), OK);
        const struct step_error said = r.stepper.kind->error(&r.stepper);
        advance(x, E);
        const double off[S] = {r.q[0] - x[0], r.q[1] - x[1] + W * (r.q[0] - x[0]), r.v[0] - x[2],
                               r.v[1] - x[3] + W * (r.v[0] - x[2])};
        for (int i = 0; i < S && k >= 3; i++) {
            const double y = i < 2 ? said.position[i] : said.velocity[i - 2];
            e->found[i] += off[i] * off[i];
            e->said[i] += y * y;
        }
        r.stepper.kind->keep(&r.stepper, true);
    }
    run_close(&r);
}

/* Of what the fast one brings to the velocity of the slow one more is said: by its change from one major step to the next,
 * where the minor steps see to it. */
enum { SLOW_RATE = 3 };

static void test_all(void **state)
{
    static const struct {
        const char *name;
        double M[4], K[4], C[4], slow;
    } list[] = {
        {"inertia", {1, .6, .6, 2}, {400, 0, 0, 9}, {0}, 0},
        {"damping", {1, 0, 0, 2}, {400, 0, 0, 9}, {0, -3, 3, 0}, 0},
        {"springs", {1, 0, 0, 2}, {400, -40, -40, 20}, {0}, 0},
        {"all", {1, .6, .6, 2}, {400, -40, -40, 20}, {0, -3, 3, 0}, 0},
        {"slow body", {1, .6, .6, 2}, {400, 0, 0, 0}, {0}, 9},
    };
    static const double step[] = {1e-3, 5e-3, 2e-2};
    static const int ratio[] = {1, 2, 3, 5, 10, 30};
    (void)state;
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 6; k++) {
                struct linear s;
                struct errors e;
                linear_pair(&s, list[i].M, list[i].K, list[i].C);
                s.K[1][3] = list[i].slow;
                compare(&e, &s, step[j], ratio[k], 200);
                for (int m = 0; m < S; m++) {
                    const double quotient = sqrt(e.said[m] / e.found[m]);
                    const bool held = quotient > .3 && quotient < (m == SLOW_RATE ? 30 : 3);
                    if (!held)
                        print_error("%s, h %g, ratio %d, %d: %g\n", list[i].name, step[j], ratio[k], m, quotient);
                    assert_true(held);
                }
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
