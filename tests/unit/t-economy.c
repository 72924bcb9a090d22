/* t-economy.c -- sub-cycling stops its iteration early, and what that costs: nothing that shows
 *
 * A major step leaves in the norm of energy what its minor steps would leave together.  Against the same scheme iterated
 * to round-off the energy of a swinging chain drifts no more over 2e4 major steps, and where it is after a swing differs
 * by far less than the scheme is off by. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "unit/oscillators.h"

#include <cmocka.h>

struct drifting {
    double h;
    int ratio;
    double most; /* of the drift, against that of the converged iteration */
};

struct outcome {
    double drift, sweeps;
};

/* Largest change of the mean energy over tenths of 2e4 major steps of the chain with a stiff outer hinge. */
static struct outcome drift_of(const struct drifting *d, double newton_tolerance)
{
    enum { MAJORS = 20000, TENTHS = 10 };
    struct chain chain;
    struct run r;
    struct step_options o = step_defaults;
    struct outcome out = {0, 0};
    double first = 0;
    o.newton_tolerance = newton_tolerance;
    chain_open(&chain, 2000, 0, 9.81);
    assert_int_equal(run_open(&r, "subcycle", &chain.ode, &o, (double[]){.02, 1.2}, (double[]){0, 0}), OK);
    const double E0 = chain_energy(&chain, r.q, r.v),
                 swing = chain_energy(&chain, (double[]){0, M_PI}, r.v) - chain_energy(&chain, (double[]){0, 0}, r.v);
    for (int k = 0; k < TENTHS; k++) {
        double mean = 0;
        for (int i = 0; i < MAJORS / TENTHS; i++) {
            assert_int_equal(run_steps(&r, d->h, d->ratio, 1), OK);
            mean += (chain_energy(&chain, r.q, r.v) - E0) / swing / (MAJORS / TENTHS);
        }
        if (k == 0) first = mean;
        out.drift = fmax(out.drift, fabs(mean - first));
    }
    out.sweeps = (double)r.stepper.effort.sweeps / MAJORS;
    run_close(&r);
    return out;
}

static void test_drift(void **state)
{
    (void)state;
    static const struct drifting cases[] = {
        {.01, 10, 1.1}, {.005, 10, 1.1}, {.002, 10, 1.1}, {.002, 20, 1.1}, {.001, 5, 1.1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct outcome own = drift_of(&cases[i], 0), exact = drift_of(&cases[i], 1e-12);
        print_message("h %g, ratio %d: drift %g in %.2f sweeps, converged %g in %.2f\n", cases[i].h, cases[i].ratio,
                      own.drift, own.sweeps, exact.drift, exact.sweeps);
        assert_true(own.drift <= cases[i].most * exact.drift);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_drift),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
