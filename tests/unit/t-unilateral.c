/* t-unilateral.c -- springs that only push: forces and means against their energies, bounces at any stiffness and step. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "kind/unilateral.h"
#include "unit/trees.h"

#include <cmocka.h>

#include "unit/opened.h"

/* V by Simpson's rule over many pieces of the force itself. */
static double summed(const struct unilateral *p, double s0, double s1)
{
    enum { PIECES = 4000 };
    double sum = 0, h = (s1 - s0) / PIECES;
    struct law f;
    for (int i = 0; i <= 2 * PIECES; i++) {
        force_unilateral.law(&f, p, s0 + i * h / 2, 0, 0);
        sum += f.f * (i == 0 || i == 2 * PIECES ? 1 : i % 2 ? 4 : 2);
    }
    return -sum * h / 6;
}

static void forces_and_means(void **state)
{
    (void)state;
    struct tree_dice d = {3};
    for (int i = 0; i < 400; i++) {
        const struct unilateral p = {.k = 30, .from = .25, .side = i % 2, .root = i / 2 % 2};
        const double s0 = .25 + tree_roll(&d, -1, 1), s1 = .25 + tree_roll(&d, -1, 1), e = 1e-6;
        struct law mean, back, up, down;
        force_unilateral.mean(&mean, &p, s0, s1);
        force_unilateral.mean(&back, &p, s1, s0);
        near(mean.f, back.f, 1e-13);
        near(mean.f * (s1 - s0), force_unilateral.stored(&p, s0) - force_unilateral.stored(&p, s1), 1e-13);
        near(force_unilateral.stored(&p, s1) - force_unilateral.stored(&p, s0), summed(&p, s0, s1), 1e-5);
        force_unilateral.mean(&up, &p, s0, s1 + e), force_unilateral.mean(&down, &p, s0, s1 - e);
        near(mean.ks, (down.f - up.f) / e, 1e-3);
        force_unilateral.mean(&mean, &p, s0, s0), force_unilateral.law(&up, &p, s0, 0, 0);
        near(mean.f, up.f, 1e-13);
        near(mean.ks, up.ks, 1e-12);
    }
}

/* The damper acts while it pushes, and it never pulls. */
static void dampers(void **state)
{
    (void)state;
    const struct unilateral p = {.k = 100, .from = 1, .c = 5, .side = UNILATERAL_ABOVE};
    struct law f;
    force_unilateral.law(&f, &p, .9, 3, 0);
    assert_true(f.f == 0 && f.ks == 0 && f.kv == 0);
    force_unilateral.law(&f, &p, 1.1, 1, 0);
    near(f.f, -15, 1e-13);
    assert_true(f.kv == 5);
    force_unilateral.law(&f, &p, 1.1, -4, 0);
    near(f.f, 0, 1e-13);
    assert_true(f.kv == 0);
}

/* A ball of 1 kg falls 1 m on a floor without loss, a hundred times or so: worst of the balance, of 10 J. */
static double bounced(const char *forces, const char *integrate)
{
    struct opened o;
    char text[900];
    snprintf(text, sizeof text,
             "gravity: [0, -9.81]\nbodies: {b: {mass: 1, inertia: 0.1, at: [0, 0]}}\n"
             "constraints: {y: {prismatic: [ground, b], axis: [0, 1]%s}}\n%s\n"
             "initial: {y.displacement: 1}\nintegrate: {%s, until: 90}\n",
             *forces == ',' ? forces : "", *forces == ',' ? "" : forces, integrate);
    open_deck(&o, text);
    run(&o);
    const double worst = o.sim.ledger.worst;
    assert_true(value(&o, "y.displacement") > -1e-2 && value(&o, "y.displacement") < 1 + 1e-8);
    arena_close(o.life);
    return worst;
}

static void bounces(void **state)
{
    static const char *const floors[] = {
        "forces: {F: {unilateral: y, from: 0, side: below, stiffness: 1.0e+6}}",
        "forces: {F: {unilateral: y, from: 0, side: below, stiffness: 1.0e+8}}",
        "forces: {F: {unilateral: y, from: 0, side: below, stiffness: 1.0e+10}}",
        "forces: {F: {unilateral: y, from: 0, side: below, stiffness: 1.0e+8, exponent: 1.5}}",
        ", range: {lower: 0, hold: {stiffness: 1.0e+8}}"};
    static const char *const steps[] = {"scheme: midpoint, step: 1.0e-2", "scheme: midpoint, step: 1.0e-3"};
    (void)state;
    for (int i = 0; i < 5; i++)
        for (int k = 0; k < 2; k++) near(bounced(floors[i], steps[k]), 0, 1e-9 * 9.81);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(forces_and_means), cmocka_unit_test(dampers),
                                       cmocka_unit_test(bounces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
