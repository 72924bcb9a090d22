/* t-moves.c -- positions moved by quasi-displacements over whole models */
#include "tree/moves.h"

#include "la/rot.h"
#include "unit/trees.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 64, SEEDS = 40 };

struct scene {
    struct arena *arena;
    const struct model *m;
    struct moves moves;
    double dx[MOST], v[MOST];
};

static void open_scene(struct scene *s, int space, unsigned seed, unsigned flags)
{
    s->arena = arena_open();
    s->m = random_tree(space, 7, seed, flags, s->arena);
    assert_true(s->m->nq < MOST);
    moves_build(&s->moves, s->m, s->arena);
    struct tree_dice d = {seed};
    for (int i = 0; i < s->m->n; i++) s->dx[i] = tree_roll(&d, -1, 1), s->v[i] = tree_roll(&d, -1, 1);
}

/* Largest difference; infinite when one is not a number. */
static double worst(const double *a, const double *b, int n)
{
    double x = 0;
    for (int i = 0; i < n; i++) x = fmax(x, isnan(a[i] - b[i]) ? INFINITY : fabs(a[i] - b[i]));
    return x;
}

/* There and back; fractions compose; each joint by itself: plain ones add, quaternions follow la/rot.h. */
static void test_point_and_diff(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene s;
        open_scene(&s, seed % 2 ? 3 : 2, seed, seed % 3 ? TREE_FAST_LEAVES : 0);
        double q1[MOST], q2[MOST], back[MOST];
        moves_point(&s.moves, q1, s.m->q0, s.dx, 1);
        moves_diff(&s.moves, back, q1, s.m->q0);
        assert_true(worst(back, s.dx, s.m->n) < 1e-14);
        memcpy(q2, s.m->q0, sizeof *q2 * (size_t)s.m->nq);
        for (int i = 0; i < 2; i++) moves_point(&s.moves, q2, q2, s.dx, .5);
        assert_true(worst(q2, q1, s.m->nq) < 1e-14);
        moves_point(&s.moves, q2, s.m->q0, s.dx, .3);
        for (int i = 0; i < s.m->njoint; i++) {
            const struct model_joint *j = &s.m->joint[i];
            bool turns = tree_turns(j, s.m->space);
            int plain = turns ? j->nq - 4 : j->nv;
            for (int k = 0; k < plain; k++) assert_true(q2[j->iq[k]] == s.m->q0[j->iq[k]] + .3 * s.dx[j->iv[k]]);
            if (!turns) continue;
            double q[4];
            quat_move(q, s.m->q0 + j->iq[plain], s.dx + j->iv[plain], .3);
            assert_true(worst(q, q2 + j->iq[plain], 4) == 0);
            moves_left(&s.moves, back, q2, s.m->q0, s.dx, .8); /* what is left of a way leads there */
            double there[4];
            quat_move(there, s.m->q0 + j->iq[plain], s.dx + j->iv[plain], .8);
            quat_move(q, q, back + j->iv[plain], 1);
            assert_true(worst(q, there, 4) < 1e-14);
        }
        arena_close(s.arena);
    }
}

/* What a straight way misses of rotations whose velocities v + (t - h/2) a are, times h^3/12, against many short ways: of
 * order 2; and where they are constant, five of them composed to order 4 as in engine/composed.h, which turn too little. */
static void test_bend(void **state)
{
    enum { PARTS = 4000 };
    static const double h = .02, H = .06, b = .414490771794376, late = .0744 / 80;
    (void)state;
    int turns = 0;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene s;
        open_scene(&s, 3, seed, 0);
        turns += s.moves.nturn;
        double q1[MOST], q2[MOST], way[MOST], off[MOST], want[MOST] = {0};
        for (int i = 0; i < s.m->n; i++) way[i] = h * s.v[i];
        moves_point(&s.moves, q1, s.m->q0, way, 1);
        memcpy(q2, s.m->q0, sizeof *q2 * (size_t)s.m->nq);
        for (int k = 0; k < PARTS; k++) {
            for (int i = 0; i < s.m->n; i++) way[i] = h / PARTS * (s.v[i] + h * ((k + .5) / PARTS - .5) * s.dx[i]);
            moves_point(&s.moves, q2, q2, way, 1);
        }
        moves_diff(&s.moves, off, q2, q1);
        moves_bend(&s.moves, want, s.v, s.dx, 2);
        for (int i = 0; i < s.m->n; i++) want[i] *= h * h * h / 12;
        assert_true(worst(off, want, s.m->n) < .1 * h * h * h / 12);
        memcpy(q1, s.m->q0, sizeof *q1 * (size_t)s.m->nq);
        memcpy(q2, s.m->q0, sizeof *q2 * (size_t)s.m->nq);
        for (int k = 0; k < 5; k++) {
            for (int i = 0; i < s.m->n; i++) way[i] = (k == 2 ? 1 - 4 * b : b) * H * s.v[i];
            moves_point(&s.moves, q1, q1, way, 1);
        }
        for (int i = 0; i < s.m->n; i++) way[i] = H / PARTS * s.v[i];
        for (int k = 0; k < PARTS; k++) moves_point(&s.moves, q2, q2, way, 1);
        moves_diff(&s.moves, off, q2, q1);
        moves_bend(&s.moves, want, s.v, s.dx, 4);
        for (int i = 0; i < s.m->n; i++) want[i] *= late * pow(H, 5);
        assert_true(worst(off, want, s.m->n) < .1 * late * pow(H, 5));
        arena_close(s.arena);
    }
    assert_true(turns > SEEDS / 2);
}

/* dx of the moving q = q0 (+) dx against differences: q turns on by (+) h v. */
static void test_rate(void **state)
{
    (void)state;
    const double h = 1e-5;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene s;
        open_scene(&s, 3, seed, 0);
        double q1[MOST], q[MOST], next[MOST], last[MOST], rate[MOST];
        moves_rate(&s.moves, rate, s.dx, s.v);
        moves_point(&s.moves, q1, s.m->q0, s.dx, 1);
        moves_point(&s.moves, q, q1, s.v, 0);
        assert_true(worst(q, q1, s.m->nq) < 1e-15);
        double hv[MOST];
        for (int i = 0; i < s.m->n; i++) hv[i] = h * s.v[i];
        moves_point(&s.moves, q, q1, hv, 1);
        moves_diff(&s.moves, next, q, s.m->q0);
        moves_point(&s.moves, q, q1, hv, -1);
        moves_diff(&s.moves, last, q, s.m->q0);
        for (int i = 0; i < s.m->n; i++) next[i] = (next[i] - last[i]) / (2 * h);
        assert_true(worst(next, rate, s.m->n) < 1e-8);
        arena_close(s.arena);
    }
}

static void test_plain_models_need_nothing(void **state)
{
    (void)state;
    for (unsigned seed = 0; seed < SEEDS; seed++) {
        struct scene s;
        open_scene(&s, 3, seed, TREE_LIGHT | TREE_FAST_LEAVES);
        assert_int_equal(s.moves.nturn, 0);
        assert_int_equal(s.moves.nfirst, s.m->n);
        arena_close(s.arena);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_point_and_diff),
        cmocka_unit_test(test_bend),
        cmocka_unit_test(test_rate),
        cmocka_unit_test(test_plain_models_need_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
