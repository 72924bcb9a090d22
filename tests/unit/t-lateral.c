/* t-lateral.c -- a strip on edge, clamped, under a force at its end tips over sideways by bending and twisting
 * together, at
 *
 *     F = 4.0126 sqrt(E I G J)/L^2                                                             (Prandtl 1899)
 *
 * or little above, by half of I/I' + G J/(E I') where I' is that of the stiff bending (Reissner, Z. angew. Math. Mech.
 * 20 (1940)).  The square of the lowest frequency goes to zero there, however many segments the strip is cut into. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "flex/section.h"
#include "opened.h"
#include "probe/modes.h"

static double square(int segments, double F)
{
    char text[1000];
    struct opened o;
    struct modes modes;
    snprintf(text, sizeof text,
             "bodies:\n"
             "  a:\n"
             "    beam: {from: [0, 0, 0], to: [1, 0, 0], elements: 16}\n"
             "    section: {rectangle: [0.002, 0.04]}\n"
             "    material: {E: 2.1e+11, nu: 0.3, density: 7850}\n"
             "    modes: %d\n"
             "    segments: %d\n"
             "    points: {tip: {station: 1, static: true}}\n"
             "constraints: {clamp: {fixed: [ground, %s], at: [0, 0, 0]}}\n"
             "forces: {f: {force: a.tip, value: [0, 0, -%.17g]}}\n"
             "initial: {static: true}\n"
             "integrate: {scheme: midpoint, step: 1.0e-4, until: 1.0e-4}\n",
             segments == 1 ? 12 : 4, segments, segments == 1 ? "a" : "a1", F);
    open_deck(&o, text);
    assert_int_equal(modes_find(&modes, &o.sim, o.life, &o.report), OK);
    const double w = modes.mode[0].omega;
    arena_close(o.life);
    return w * w;
}

static void test_prandtl(void **state)
{
    static const int segments[] = {1, 2, 4};
    struct flex_section c = {0};
    (void)state;
    section_rectangle(&c, 0.002, 0.04, 0.3);
    const double E = 2.1e11, GJ = E / 2.6 * c.J, prandtl = 4.0126 * sqrt(E * c.Iz * GJ);
    const double most = (1 + (c.Iz / c.Iy + GJ / (E * c.Iy)) / 2) * prandtl;
    for (int k = 0; k < 3; k++) {
        const double F[2] = {0.97 * prandtl, 0.99 * prandtl};
        const double w2[2] = {square(segments[k], F[0]), square(segments[k], F[1])};
        const double zero = F[1] + (F[1] - F[0]) * w2[1] / (w2[0] - w2[1]);
        if (!(zero > 0.998 * prandtl && zero < 1.006 * most))
            fail_msg("%d segments: %g of Prandtl's force", segments[k], zero / prandtl);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_prandtl)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
