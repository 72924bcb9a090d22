/* t-limbs -- factors of the limbs that hold fast bodies, made anew while those of the other limbs stay. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include "tree/moves.h"
#include "tree/sweep.h"
#include "trees.h"

#include <cmocka.h>

enum { BODIES = 9, MOST = 6 * BODIES, SEEDS = 40 };

static int root(const struct model *m, int body)
{
    while (m->body[body].parent) body = m->body[body].parent;
    return body;
}

/* x := M^-1 b by F. */
static void answer(double *x, const struct sweep_ops *ops, const struct sweep *s, const void *F, const double *b, int n)
{
    memcpy(x, b, sizeof *x * (size_t)n);
    ops->solve(s, F, x);
}

/* Limbs share no inertia: of the mixed factor each coordinate has the answer of the posture that its limb was factored at. */
static int check(const struct sweep_ops *ops, const struct model *m, unsigned seed, struct arena *arena)
{
    struct tree_dice dice = {seed};
    struct moves moves;
    bool fast[BODIES + 1] = {false};
    double d[MOST], b[MOST], dx[MOST], then[MOST], now[MOST], mixed[MOST];
    double *q = TAKE(arena, double, m->nq);
    int kept = 0;
    fast[m->nbody - 1] = true;
    struct sweep *s = ops->build(m, FOR_STEPS, fast, arena);
    void *F = arena_take(arena, 1, ops->factor_size(s));
    for (int k = 0; k < m->n; k++) {
        d[k] = tree_roll(&dice, 0, 1);
        b[k] = tree_roll(&dice, -1, 1);
        dx[k] = tree_roll(&dice, -1, 1);
    }
    moves_build(&moves, m, arena);
    moves_point(&moves, q, m->q0, dx, 1);
    assert_true(ops->factor(s, F, 1, d, q, ALL));
    answer(now, ops, s, F, b, m->n);
    assert_true(ops->factor(s, F, 1, d, m->q0, ALL));
    answer(then, ops, s, F, b, m->n);
    assert_true(ops->factor(s, F, 1, d, q, LIMBS));
    answer(mixed, ops, s, F, b, m->n);
    for (int i = 1; i < m->nbody; i++) {
        const struct model_joint *j = &m->joint[m->body[i].joint];
        const bool anew = root(m, i) == root(m, m->nbody - 1);
        for (int k = 0; k < j->nv; k++) {
            assert_true(mixed[j->iv[k]] == (anew ? now : then)[j->iv[k]]);
            kept += !anew && now[j->iv[k]] != then[j->iv[k]];
        }
    }
    return kept;
}

static void test_planar(void **state)
{
    (void)state;
    int kept = 0;
    for (unsigned seed = 1; seed <= SEEDS; seed++) {
        struct arena *arena = arena_open();
        kept += check(&sweep_planar, random_tree(2, BODIES, seed, 0, arena), seed, arena);
        arena_close(arena);
    }
    assert_true(kept > SEEDS);
}

static void test_spatial(void **state)
{
    (void)state;
    int kept = 0;
    for (unsigned seed = 1; seed <= SEEDS; seed++) {
        struct arena *arena = arena_open();
        kept += check(&sweep_spatial, random_tree(3, BODIES, seed, 0, arena), seed, arena);
        arena_close(arena);
    }
    assert_true(kept > SEEDS);
}

/* The share of the bodies that such a factor takes. */
static void test_share(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed <= SEEDS; seed++) {
        struct arena *arena = arena_open();
        const struct model *m = random_tree(2, BODIES, seed, TREE_FAST_LEAVES, arena);
        int with = 0;
        for (int i = 1; i < m->nbody; i++) {
            bool fast = false;
            for (int j = 1; j < m->nbody; j++) fast |= m->body[j].fast && root(m, j) == root(m, i);
            with += fast;
        }
        assert_float_equal(rosters_limbs(m, arena), (double)with / BODIES, 1e-15);
        arena_close(arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_planar),
        cmocka_unit_test(test_spatial),
        cmocka_unit_test(test_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
