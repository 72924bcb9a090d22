/* t-structure.c -- subcycle by the structure of a mechanism: the factor with a diagonal and held coordinates against
 * dense algebra, whole runs with and without the owner's solver, and with and without knowing which slow
 * coordinates are near the fast ones; what is written of these bodies' mass matrix */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/stepper.h"
#include "la/dense.h"
#include "model/build.h"
#include "multirate/schemes.h"
#include "sim/load.h"
#include "system/system.h"
#include "unit/oscillators.h"
#include "unit/trees.h"

#include <cmocka.h>

enum { MOST = 96 };

/* (M^ + diag(d)) x = b in the free coordinates, x = 0 in the held ones. */
static void test_factor(void **state)
{
    (void)state;
    for (int seed = 1; seed <= 40; seed++) {
        static double M[MOST * MOST];
        struct arena *arena = arena_open();
        struct tree_dice dice = {(uint64_t)seed};
        struct model *m = random_tree(2 + seed % 2, 9, (unsigned)seed, 0, arena);
        const struct ode2 *o = system_ode2(system_build(m, arena));
        int n = o->n;
        double d[MOST], b[MOST], x[MOST];
        assert_true(n <= MOST);
        for (int i = 0; i < n; i++) {
            d[i] = tree_pick(&dice, 3) == 0 ? INFINITY : tree_roll(&dice, 0, 2);
            b[i] = x[i] = tree_roll(&dice, -1, 1);
        }
        void *F = arena_take(arena, 1, o->direct->factor_size);
        assert_int_equal(o->direct->stiffen(o, F, d, m->q0, 0, ALL, NULL), OK);
        o->direct->solve(o, F, x);
        assert_int_equal(o->ops->mass(o, M, m->q0, 0, ALL, NULL), OK);
        for (int i = 0; i < n; i++) {
            if (isinf(d[i])) {
                assert_true(x[i] == 0);
                continue;
            }
            double sum = d[i] * x[i] - b[i], size = 1;
            for (int j = 0; j < n; j++) {
                sum += M[i + j * n] * x[j];
                size += fabs(M[i + j * n] * x[j]);
            }
            assert_true(fabs(sum) < 1e-11 * size);
        }
        arena_close(arena);
    }
}

struct walk {
    struct stepper stepper;
    struct state x;
    double q[MOST], v[MOST], a[MOST], work[POWER_CHANNELS];
};

static void walk(struct walk *w, struct ode2 *ode, const double *q, const double *v, const struct step_options *o,
                 double h, int ratio, int majors, struct arena *arena)
{
    struct trouble why = {0};
    *w = (struct walk){.x = {0}};
    w->x = (struct state){0, w->q, w->v, w->a};
    memcpy(w->q, q, (size_t)ode->nq * sizeof *q);
    memcpy(w->v, v, (size_t)ode->n * sizeof *v);
    stepper_open(&w->stepper, stepper_find("subcycle"), ode, o, arena);
    assert_int_equal(stepper_start(&w->stepper, &w->x, &why), OK);
    for (int k = 1; k <= majors; k++) {
        assert_int_equal(stepper_step(&w->stepper, &w->x, h, ratio, k * ratio * h, &why), OK);
        for (int c = 0; c < POWER_CHANNELS; c++) w->work[c] += w->stepper.work[c];
    }
}

static double apart(const double *x, const double *y, int n)
{
    double worst = 0, size = 1;
    for (int i = 0; i < n; i++) size = fmax(size, fabs(y[i]));
    for (int i = 0; i < n; i++) worst = fmax(worst, fabs(x[i] - y[i]));
    return worst / size;
}

static void same(const struct walk *a, const struct walk *b, double tolerance)
{
    const struct ode2 *o = a->stepper.ode;
    double q = apart(a->q, b->q, o->nq), v = apart(a->v, b->v, o->n), w = apart(a->work, b->work, POWER_CHANNELS);
    if (!(q < tolerance && v < tolerance && w < tolerance)) print_error("apart: q %g, v %g, work %g\n", q, v, w);
    assert_true(q < tolerance && v < tolerance && w < tolerance);
}

/* Only forces along coordinates. */
static void keep_plain(struct model *m, struct arena *arena)
{
    struct model_force *kept = TAKE(arena, struct model_force, m->nforce);
    int n = 0;
    for (int i = 0; i < m->nforce; i++) {
        const struct model_force *f = &m->force[i];
        if (f->type == FORCE_LOAD || (f->type == FORCE_LAW && m->measure[f->measure].type == MEASURE_COORDINATE))
            kept[n++] = *f;
    }
    m->force = kept;
    m->nforce = n;
}

/* The owner's factor, or M^ formed: the same steps, with stiffness and dampers along slow and fast coordinates, with
 * positions that have a move of their own and without, symmetric and damped. */
static void test_dense(void **state)
{
    (void)state;
    int tried = 0, stiff = 0;
    for (int seed = 1; seed <= 60; seed++) {
        struct arena *arena = arena_open();
        unsigned flags = TREE_FAST_LEAVES | (seed % 3 ? TREE_FORCES : 0) | (seed % 4 < 2 ? TREE_LIGHT : 0);
        struct model *m = random_tree(2 + seed % 2, 10, (unsigned)seed, flags, arena);
        keep_plain(m, arena);
        struct ode2 *o = system_ode2(system_build(m, arena));
        struct ode2 dense = *o;
        dense.direct = NULL;
        if (o->n > 12 && o->n <= MOST && o->ns > 0 && o->ns < o->n) {
            struct step_options options = step_defaults;
            static struct walk a, b;
            options.newton_tolerance = 1e-13;
            options.symmetric = seed % 5 == 0;
            options.rho_infinity = seed % 7 == 0 ? .7 : 1;
            walk(&a, o, m->q0, m->v0, &options, 2e-4, 5, 20, arena);
            walk(&b, &dense, m->q0, m->v0, &options, 2e-4, 5, 20, arena);
            same(&a, &b, 1e-10);
            tried++;
            stiff += m->nforce > 3;
        }
        arena_close(arena);
    }
    assert_true(tried >= 20 && stiff >= 10);
}

/* Far coordinates left out of the minor steps, or taken along. */
static void test_near(void **state)
{
    (void)state;
    struct arena *arena = arena_open();
    struct diags *diags = diags_open(arena);
    struct report report = {0};
    struct scene *scene;
    struct model *m;
    static struct walk a, b;
    assert_int_equal(sim_load(&scene, "tests/bench/arms.yaml", NULL, diags, arena, &report), OK);
    assert_int_equal(model_build(&m, scene, NULL, diags, arena), OK);
    struct ode2 *o = system_ode2(system_build(m, arena));
    struct step_options options = step_defaults;
    options.newton_tolerance = 1e-13;
    struct ode2 all = *o, formed = *o;
    all.near = 0;
    formed.direct = NULL;
    assert_true(o->near == 4 && o->n == 44 && !o->move);
    walk(&a, o, m->q0, m->v0, &options, 2e-4, 10, 40, arena);
    walk(&b, &all, m->q0, m->v0, &options, 2e-4, 10, 40, arena);
    same(&a, &b, 1e-11);
    walk(&b, &formed, m->q0, m->v0, &options, 2e-4, 10, 40, arena);
    same(&a, &b, 1e-9);
    arena_close(arena);
}

/* The mass matrix of the fast class is written where coordinates are near it, and nowhere else. */
static void test_near_mass(void **state)
{
    (void)state;
    static double M[4][MOST * MOST];
    struct arena *arena = arena_open();
    struct diags *diags = diags_open(arena);
    struct report report = {0};
    struct scene *scene;
    struct model *m;
    assert_int_equal(sim_load(&scene, "tests/bench/arms.yaml", NULL, diags, arena, &report), OK);
    assert_int_equal(model_build(&m, scene, NULL, diags, arena), OK);
    struct ode2 *o = system_ode2(system_build(m, arena));
    for (int i = 0; i < o->n * o->n; i++) M[FAST][i] = NAN;
    for (unsigned cls = FAST; cls <= ALL; cls++) assert_int_equal(o->ops->mass(o, M[cls], m->q0, 0, cls, NULL), OK);
    for (int i = 0; i < o->n * o->n; i++) {
        const bool near = i % o->n < o->near && i / o->n < o->near;
        assert_true(near ? fabs(M[FAST][i] + M[SLOW][i] - M[ALL][i]) < 1e-12 : isnan(M[FAST][i]));
        assert_true(near || M[SLOW][i] == M[ALL][i]);
    }
    arena_close(arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_factor),
        cmocka_unit_test(test_dense),
        cmocka_unit_test(test_near),
        cmocka_unit_test(test_near_mass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
