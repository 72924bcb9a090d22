/* t-split.c -- split.h and factor.h by themselves: random matrices of random loops, with nothing behind them. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "la/dense.h"
#include "loop/factor.h"
#include "unit/trees.h"

#include <cmocka.h>

struct bench {
    struct arena *arena;
    struct model model;
    struct open_tree tree;
    struct loops loops;
    struct component component;
    struct rows rows;
    struct split split;
    struct part *part;
};

/* --- loops of nothing but numbers -------------------------------------------------------------------- */

/* nloop loops of three rows; loop l has `reach` coordinates from 4 l on, some of which the next one has, too. */
static void list_loops(struct bench *o, int nloop, int reach)
{
    struct loops *l = &o->loops;
    *l = (struct loops){.model = &o->model, .nrow = 3 * nloop};
    l->row = TAKE(o->arena, struct loop_row, l->nrow);
    l->first = TAKE(o->arena, int, nloop + 1);
    l->nk = TAKE(o->arena, int, nloop);
    l->k = TAKE(o->arena, int *, nloop);
    for (int i = 0; i < nloop; i++) {
        for (int r = 0; r < 3; r++) l->row[3 * i + r].loop = i;
        l->first[i + 1] = 3 * (i + 1);
        l->nk[i] = reach;
        l->k[i] = TAKE(o->arena, int, reach);
        for (int k = 0; k < reach; k++) l->k[i][k] = 4 * i + k;
    }
}

static void fill(struct component *c, const struct loops *l, struct tree_dice *d, struct arena *arena)
{
    c->start = TAKE(arena, int, c->nrow + 1);
    for (int r = 0; r < c->nrow; r++) c->start[r + 1] = c->start[r] + l->nk[l->row[r].loop];
    c->at = TAKE(arena, int, c->start[c->nrow]);
    c->F = TAKE(arena, double, c->start[c->nrow]);
    for (int r = 0; r < c->nrow; r++)
        for (int e = c->start[r]; e < c->start[r + 1]; e++) {
            c->at[e] = l->k[l->row[r].loop][e - c->start[r]];
            c->F[e] = tree_roll(d, -1, 1);
        }
}

static void open_bench(struct bench *o, int nloop, int reach, unsigned seed)
{
    struct tree_dice d = {seed};
    memset(o, 0, sizeof *o);
    o->arena = arena_open();
    const int n = 4 * (nloop - 1) + reach;
    bool *urgent = TAKE(o->arena, bool, n);
    for (int i = 0; i < n; i++) urgent[i] = tree_pick(&d, 4) == 0;
    o->model = (struct model){.n = n, .nq = n, .nloop = nloop, .urgent = urgent};
    o->model.loop = TAKE(o->arena, struct model_loop, nloop);
    o->tree.model = &o->model;
    list_loops(o, nloop, reach);
    struct component *c = &o->component;
    *c = (struct component){.nrow = o->loops.nrow, .nk = n};
    c->k = TAKE(o->arena, int, n);
    c->row = TAKE(o->arena, int, c->nrow);
    for (int r = 0; r < c->nrow; r++) c->row[r] = r;
    fill(c, &o->loops, &d, o->arena);
    o->rows = (struct rows){.tree = &o->tree, .loops = &o->loops, .n = n, .ncomponent = 1, .component = c};
    o->rows.owner = TAKE(o->arena, int, n);
    o->rows.column = TAKE(o->arena, int, n);
    o->rows.size = TAKE(o->arena, double, n);
    o->rows.per = TAKE(o->arena, double, n);
    for (int i = 0; i < n; i++) {
        c->k[i] = o->rows.column[i] = i;
        o->rows.size[i] = pow(10, tree_roll(&d, -1, 1));
        o->rows.per[i] = 1 / o->rows.size[i];
    }
    split_build(&o->split, &o->rows, o->arena);
    o->part = &o->split.part[0];
    for (int k = 0; k < n; k++) o->part->weight[k] = 1;
}

/* Row r := a sum of the two before it in its loop, which all have the same coordinates. */
static void repeat_row(struct component *c, int r)
{
    const int n = c->start[r + 1] - c->start[r];
    for (int e = 0; e < n; e++) c->F[c->start[r] + e] = .7 * c->F[c->start[r - 1] + e] - .4 * c->F[c->start[r - 2] + e];
}

static void choose(struct bench *o)
{
    o->part->nr = split_rank(&o->split, o->part, 1e-8);
    o->part->ni = o->component.nk - o->part->nr;
    split_choose(&o->split, o->part, o->rows.size, 1);
    split_number(&o->split);
}

/* A number of C_q, by rows and coordinates of the component. */
static double number(const struct component *c, int r, int k)
{
    for (int e = c->start[r]; e < c->start[r + 1]; e++)
        if (c->at[e] == k) return c->F[e];
    return 0;
}

/* Small with `whole` C_q, in a few loops; large, by rows. */
static const struct {
    int nloop, reach;
} sizes[] = {{1, 3}, {1, 5}, {2, 4}, {4, 5}, {7, 6}, {40, 5}, {40, 9}, {40, 40}};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* --- laws ---------------------------------------------------------------------------------------------- */

static void is_sorted_out(const struct bench *o)
{
    const struct part *p = o->part;
    const struct component *c = &o->component;
    bool *seen = TAKE(o->arena, bool, c->nk), *used = TAKE(o->arena, bool, c->nrow);
    for (int j = 0; j < p->nr + p->ni; j++) {
        const int k = j < p->nr ? p->dep[j] : p->ind[j - p->nr];
        assert_false(seen[k]);
        seen[k] = true;
        assert_int_equal(p->place[k], j < p->nr ? j : -1 - (j - p->nr));
    }
    for (int r = 0; r < c->nrow; r++) {
        assert_false(used[p->kept[r]]);
        used[p->kept[r]] = true;
        assert_int_equal(p->row[r], c->row[p->kept[r]]);
        assert_int_equal(split_drops(&o->split, p->row[r]), r >= p->nr);
    }
    for (int j = 1; j < p->ni; j++) assert_true(o->model.urgent[p->ind[j - 1]] >= o->model.urgent[p->ind[j]]);
}

/* Every coordinate is dependent or independent, fast ones first, every row used or redundant; what is listed is all of
 * C_q, and C_qd inside its band, which is narrow where loops reach few others. */
static void a_split_is_a_partition(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed <= 10 * SIZES; seed++) {
        struct bench o;
        open_bench(&o, sizes[seed % SIZES].nloop, sizes[seed % SIZES].reach, seed);
        choose(&o);
        const struct part *p = o.part;
        const struct component *c = &o.component;
        is_sorted_out(&o);
        int listed = 0, there = 0;
        for (int r = 0; r < p->nr; r++) there += c->start[p->kept[r] + 1] - c->start[p->kept[r]];
        for (int i = 0; i < p->nof_dep; i++, listed++) {
            const struct entry *e = &p->of_dep[i];
            const int j = p->place[e->k], r = e->at - p->band[1] - j * p->ld;
            assert_true(r >= 0 && r < p->nr && r - j <= p->band[0] && j - r <= p->band[1]);
            assert_true(c->F[e->e] == number(c, p->kept[r], e->k));
        }
        for (int r = 0; r < p->nr; r++)
            for (int i = p->from[r]; i < p->from[r + 1]; i++, listed++) {
                const struct entry *e = &p->of_ind[i];
                assert_int_equal(p->ind[e->at], e->k);
                assert_int_equal(o.split.ind[e->slot], e->k);
                assert_true(c->F[e->e] == number(c, p->kept[r], e->k));
            }
        assert_int_equal(listed, there);
        if (o.model.nloop == 40 && o.loops.nk[0] == 5) assert_true(p->ld < 20); /* loops in a row */
        arena_close(o.arena);
    }
}

/* Rows that repeat others are found, wherever they are, and none else. */
static void rank_is_found(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed <= 10 * SIZES; seed++) {
        struct bench o;
        struct tree_dice d = {seed * 7u};
        int repeated = 0;
        open_bench(&o, sizes[seed % SIZES].nloop, sizes[seed % SIZES].reach, seed);
        const int fits = o.component.nk < o.component.nrow ? o.component.nk : o.component.nrow;
        for (int l = 0; l < o.model.nloop; l++)
            if (tree_pick(&d, 3) == 0) repeat_row(&o.component, 3 * l + 2), repeated++;
        choose(&o);
        const int left = o.component.nrow - repeated;
        assert_int_equal(o.part->nr, left < fits ? left : fits);
        is_sorted_out(&o);
        arena_close(o.arena);
    }
}

/* Columns of little weight stay independent where they can; a number goes on with every choice; a split comes back. */
static void weights_choose(void **state)
{
    (void)state;
    int stayed = 0, could = 0;
    for (unsigned seed = 1; seed <= 10 * SIZES; seed++) {
        struct bench o;
        open_bench(&o, sizes[seed % SIZES].nloop, sizes[seed % SIZES].reach, seed);
        choose(&o);
        struct part *p = o.part;
        const long number = o.split.number;
        int *dep = TAKE(o.arena, int, p->nr), *kept = TAKE(o.arena, int, o.component.nrow), wanted = p->dep[0];
        memcpy(dep, p->dep, sizeof *dep * (size_t)p->nr);
        memcpy(kept, p->kept, sizeof *kept * (size_t)o.component.nrow);
        split_keep(&o.split, p);
        p->weight[wanted] = 1e-6;
        split_choose(&o.split, p, o.rows.size, 1);
        assert_true(o.split.number > number);
        is_sorted_out(&o);
        could += p->ni > 0;
        stayed += p->place[wanted] < 0;
        split_return(&o.split, p);
        assert_true(o.split.number > number + 1);
        assert_memory_equal(p->dep, dep, sizeof *dep * (size_t)p->nr);
        assert_memory_equal(p->kept, kept, sizeof *kept * (size_t)o.component.nrow);
        is_sorted_out(&o);
        arena_close(o.arena);
    }
    assert_true(could > 5 * SIZES);
    assert_int_equal(stayed, could);
}

/* --- C_qd, factored ------------------------------------------------------------------------------------ */

/* C_qd and C_qi by column, from C_q itself. */
static void blocks(const struct bench *o, double *D, double *I)
{
    const struct part *p = o->part;
    for (int r = 0; r < p->nr; r++) {
        for (int j = 0; j < p->nr; j++) D[r + j * p->nr] = number(&o->component, p->kept[r], p->dep[j]);
        for (int j = 0; j < p->ni; j++) I[r + j * p->nr] = number(&o->component, p->kept[r], p->ind[j]);
    }
}

static void near_all(const double *a, const double *b, int n, double within)
{
    double most = 1;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(b[i]));
    for (int i = 0; i < n; i++)
        if (!(fabs(a[i] - b[i]) <= within * most)) fail_msg("[%d] of %d: %.15g, %.15g", i, n, a[i], b[i]);
}

/* G, its columns and rows, solutions and what independents bring: all against C_q, dense. */
static void a_factor_solves(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed <= 10 * SIZES; seed++) {
        struct bench o;
        struct tree_dice d = {seed * 3u};
        struct factor f;
        open_bench(&o, sizes[seed % SIZES].nloop, sizes[seed % SIZES].reach, seed);
        choose(&o);
        const int nr = o.part->nr, ni = o.part->ni, n = o.component.nk;
        factor_build(&f, o.part, o.component.F, o.arena);
        factor_fit(&f, o.arena);
        assert_int_equal(factor_make(&f), 1);
        double *D = TAKE(o.arena, double, nr *nr), *I = TAKE(o.arena, double, nr *ni + 1);
        double *G = TAKE(o.arena, double, nr *ni + 1), *DG = TAKE(o.arena, double, nr *ni + 1);
        double *x = TAKE(o.arena, double, n), *y = TAKE(o.arena, double, n), *z = TAKE(o.arena, double, n);
        blocks(&o, D, I);
        factor_G(&f, G);
        dense_gemm(DG, -1, D, G, nr, nr, ni, nr, nr, nr);
        near_all(DG, I, nr * ni, 1e-9);
        for (int j = 0; j < ni; j++) x[j] = tree_roll(&d, -1, 1);
        factor_times_G(&f, y, x);
        dense_gemv(z, 1, G, x, nr, ni, nr);
        near_all(y, z, nr, 1e-9);
        factor_row_of_G(&f, x, y, nr - 1);
        for (int j = 0; j < ni; j++) z[j] = G[nr - 1 + j * nr];
        near_all(x, z, ni, 1e-9);
        for (int r = 0; r < nr; r++) x[r] = y[r] = tree_roll(&d, -1, 1);
        memset(z, 0, sizeof *z * (size_t)n);
        factor_tsolve(&f, x);
        dense_gemtv(z, 1, D, x, nr, nr, nr);
        near_all(z, y, nr, 1e-9);
        for (int k = 0; k < n; k++) x[k] = tree_roll(&d, -1, 1);
        memset(y, 0, sizeof *y * (size_t)nr);
        memset(z, 0, sizeof *z * (size_t)nr);
        factor_take(&f, y, x); /* y = -C_qi x_i, so that D z + C_qi x_i = 0 */
        for (int j = 0; j < ni; j++)
            for (int r = 0; r < nr; r++) z[r] -= I[r + j * nr] * x[o.part->ind[j]];
        near_all(y, z, nr, 1e-13);
        arena_close(o.arena);
    }
}

static bool is_among(const int *x, int n, int k)
{
    for (int i = 0; i < n; i++)
        if (x[i] == k) return true;
    return false;
}

/* Chooses anew, fast ones with that weight, and finds who is fast then. */
static void choose_again(struct bench *o, struct factor *f, double fast)
{
    split_keep(&o->split, o->part);
    split_choose(&o->split, o->part, o->rows.size, fast);
    factor_fit(f, o->arena);
    assert_int_equal(factor_make(f), 1);
    split_succeed(&o->split, o->part, f);
    split_number(&o->split);
}

/* Where fast coordinates become dependent, others are fast: no fewer; first those that stay, then new ones, before any
 * that was slow; and that is so until they are back. */
static void fast_ones_have_successors(void **state)
{
    (void)state;
    int gone = 0, stood_in = 0;
    for (unsigned seed = 1; seed <= 20 * SIZES; seed++) {
        struct bench o;
        struct factor f;
        open_bench(&o, sizes[seed % SIZES].nloop, sizes[seed % SIZES].reach, seed);
        const bool *urgent = o.model.urgent;
        struct part *p = o.part;
        p->nr = split_rank(&o.split, p, 1e-8);
        p->ni = o.component.nk - p->nr;
        factor_build(&f, p, o.component.F, o.arena);
        split_choose(&o.split, p, o.rows.size, 1e-6);
        while (p->nfast < p->ni && urgent[p->ind[p->nfast]]) p->nfast++;
        int *before = TAKE(o.arena, int, p->ni + 1), *first = TAKE(o.arena, int, p->ni + 1);
        memcpy(before, p->ind, sizeof *before * (size_t)p->ni);
        choose_again(&o, &f, 1e6);
        bool new_left = false;
        for (int j = p->nfast; j < p->ni; j++) new_left |= !is_among(before, p->ni, p->ind[j]);
        for (int j = 0; j < p->ni; j++) {
            const int k = p->ind[j];
            const bool fast = j < p->nfast, was = is_among(before, p->nfast, k),
                       slow = is_among(before, p->ni, k) && !was;
            if (was) assert_true(fast);
            if (slow && fast && !urgent[k]) assert_false(new_left);
            gone += fast && !urgent[k];
        }
        memcpy(first, p->ind, sizeof *first * (size_t)p->ni);
        choose_again(&o, &f, 1e6); /* the same once more: who stands in goes on */
        for (int j = 0; j < p->nfast; j++) stood_in += is_among(p->ind, p->nfast, first[j]) && !urgent[first[j]];
        choose_again(&o, &f, 1e-6); /* and back */
        for (int j = 0; j < p->nfast; j++) assert_true(urgent[p->ind[j]]);
        arena_close(o.arena);
    }
    assert_true(gone > 100);
    assert_int_equal(stood_in, gone);
}

/* The largest number of G in scales; the estimate is never above it, and seldom far below. */
static void gain_is_the_largest_number(void **state)
{
    (void)state;
    double least = 1, sum = 0;
    int count = 0;
    for (unsigned seed = 1; seed <= 200; seed++) {
        struct bench o;
        struct factor f;
        double most = 0;
        open_bench(&o, sizes[seed % SIZES].nloop, sizes[seed % SIZES].reach, seed);
        choose(&o);
        const struct part *p = o.part;
        factor_build(&f, p, o.component.F, o.arena);
        factor_fit(&f, o.arena);
        assert_int_equal(factor_make(&f), 1);
        double *G = TAKE(o.arena, double, p->nr * p->ni + 1);
        factor_G(&f, G);
        for (int j = 0; j < p->ni; j++)
            for (int r = 0; r < p->nr; r++)
                most = fmax(most, fabs(G[r + j * p->nr]) * o.rows.size[p->ind[j]] / o.rows.size[p->dep[r]]);
        const double exact = split_gain(&o.split, p, G), near = split_gain_estimate(&o.split, p, &f);
        assert_true(fabs(exact - most) <= 1e-14 * most);
        assert_true(near <= most * (1 + 1e-9));
        if (most > 0) least = fmin(least, near / most), sum += near / most, count++;
        arena_close(o.arena);
    }
    print_message("estimates of the gain: %.3f of it at least, %.3f in the mean\n", least, sum / count);
    assert_true(count > 100 && sum / count > .95 && least > .5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_split_is_a_partition),
        cmocka_unit_test(rank_is_found),
        cmocka_unit_test(weights_choose),
        cmocka_unit_test(a_factor_solves),
        cmocka_unit_test(fast_ones_have_successors),
        cmocka_unit_test(gain_is_the_largest_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
