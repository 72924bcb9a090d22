/* t-moving.c -- the whole matrix of a rigid tree, factored: against differences of the residual */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "model/build.h"
#include "system/system.h"
#include "unit/trees.h"

#include <cmocka.h>

enum { MOST = 96 };

/* Only forces along coordinates: those that the structure allows. */
static void keep_plain(struct model *m, struct arena *arena)
{
    struct model_force *kept = TAKE(arena, struct model_force, m->nforce);
    int n = 0;
    for (int i = 0; i < m->nforce; i++)
        if (m->force[i].type == FORCE_LAW && m->measure[m->force[i].measure].type == MEASURE_COORDINATE)
            kept[n++] = m->force[i];
    m->force = kept;
    m->nforce = n;
}

/* r at q + s ck x, v + s cc x, a + s x. */
static void resid_off(double *r, const struct ode2 *o, const struct instant *at, const double *x, double s, double cc,
                      double ck)
{
    double q[MOST], v[MOST], a[MOST];
    for (int i = 0; i < o->n; i++) {
        q[i] = at->q[i] + s * ck * x[i];
        v[i] = at->v[i] + s * cc * x[i];
        a[i] = at->a[i] + s * x[i];
    }
    const struct instant there = {.t = at->t, .q = q, .v = v, .a = a};
    assert_int_equal(o->ops->resid(o, r, NULL, NULL, &there, ALL, NULL), OK);
}

/* J^-1 (dr/dx x) is x again. */
static double worst_of(const struct ode2 *o, const struct instant *at, struct tree_dice *dice, double cc, double ck,
                       struct arena *arena)
{
    double x[MOST], up[MOST], down[MOST], worst = 0, step = 1e-4;
    void *F = arena_take(arena, 1, o->direct->factor_size);
    assert_int_equal(o->ops->resid(o, up, NULL, NULL, at, ALL, NULL), OK);
    assert_int_equal(o->direct->factor(o, F, 1, cc, ck, at, NULL), OK);
    for (int i = 0; i < o->n; i++) x[i] = tree_roll(dice, -1, 1);
    resid_off(up, o, at, x, step, cc, ck);
    resid_off(down, o, at, x, -step, cc, ck);
    for (int i = 0; i < o->n; i++) up[i] = (up[i] - down[i]) / (2 * step);
    o->direct->solve(o, F, up);
    for (int i = 0; i < o->n; i++) worst = fmax(worst, fabs(up[i] - x[i]));
    return worst;
}

static void test_plane(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 60; seed++) {
        struct arena *arena = arena_open();
        struct tree_dice dice = {(uint64_t)seed};
        struct model *m = random_tree(2, 9, (unsigned)seed, seed % 2 ? TREE_FORCES : 0, arena);
        keep_plain(m, arena);
        const struct ode2 *o = system_ode2(system_build(m, arena));
        double v[MOST], a[MOST];
        assert_true(o->n <= MOST && o->n == o->nq);
        for (int i = 0; i < o->n; i++) v[i] = tree_roll(&dice, -3, 3), a[i] = tree_roll(&dice, -9, 9);
        const struct instant at = {.q = m->q0, .v = v, .a = a};
        const double worst = worst_of(o, &at, &dice, .05, .002, arena);
        if (!(worst < 1e-6)) print_error("seed %d: %g\n", seed, worst);
        assert_true(worst < 1e-6);
        arena_close(arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_plane)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
