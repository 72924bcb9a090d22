/* t-solve.c -- rows.h and solve.h by themselves, on random linkages with drives: against differences and a
 * dense augmented system; caches, and what is asserted of them. */
#include <sys/wait.h>
#include <unistd.h>

#include "la/dense.h"
#include "unit/condensed.h"

/* --- rows ------------------------------------------------------------------------------------------------ */

/* By how much column k of C_q misses the differences of C(q (+) dx) at dx = x. */
static double column_misses(struct bench *o, const double *Cq, int k, const double *q, double *x)
{
    static const double h = 1e-5;
    const double at = x[o->rows.component[0].k[k]];
    double worst = 0;
    int row;
    for (int side = 0; side < 2; side++) {
        x[o->rows.component[0].k[k]] = at + (side ? h : -h);
        moves_point(&o->tree.moves, o->q1, q, x, 1);
        rows_misfit(side ? o->C1 : o->C, &row, &o->rows, o->q1);
    }
    x[o->rows.component[0].k[k]] = at;
    for (int r = 0; r < o->nrow; r++) worst = fmax(worst, fabs((o->C1[r] - o->C[r]) / (2 * h) - Cq[r]));
    return worst;
}

static double C_q_misses(struct bench *o, const double *q, double *x)
{
    const struct component *c = &o->rows.component[0];
    double *Cq = TAKE(o->arena, double, o->nrow * c->nk), worst = 0;
    for (int k = 0; k < c->nk; k++)
        for (int r = 0; r < c->nrow; r++) Cq[c->row[r] + k * o->nrow] = number(c, r, k);
    for (int k = 0; k < c->nk; k++) worst = fmax(worst, column_misses(o, Cq + k * o->nrow, k, q, x));
    return worst;
}

/* C_q is the slope of C at any posture; turned, along the Cayley vectors of a way to there. */
static void rows_are_slopes(void **state)
{
    (void)state;
    double worst[2] = {0, 0};
    int turned = 0, screws = 0;
    for (unsigned seed = 1; seed <= 300; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        open_bench(&o, seed % 4 ? 3 : 2, seed);
        for (int l = 0; l < o.mechanism.model.nloop; l++) screws += o.mechanism.model.loop[l].type == JOINT_SCREW;
        bool marked[MOST_BODIES];
        for (int i = 0; i < MOST_BODIES; i++) marked[i] = true;
        roll(o.x, o.n, .5, &d);
        moves_point(&o.tree.moves, o.q, o.mechanism.model.q0, o.x, 1);
        memset(o.y, 0, sizeof *o.y * (size_t)o.n);
        rows_linearize(&o.rows, o.q);
        worst[0] = fmax(worst[0], C_q_misses(&o, o.q, o.y));
        rows_linearize(&o.rows, o.q);
        rows_turn(&o.rows, o.x, marked);
        if (o.rows.component[0].nturn == 0) assert_true(o.rows.linear == o.rows.placed || o.rows.constant);
        if (o.rows.component[0].nturn) assert_true(o.rows.linear == 0), turned++;
        worst[1] = fmax(worst[1], C_q_misses(&o, o.mechanism.model.q0, o.x));
        arena_close(o.arena);
    }
    print_message("C_q misses differences by %.2g, turned by %.2g\n", worst[0], worst[1]);
    assert_true(worst[0] < 1e-8 && worst[1] < 1e-8 && turned > 20 && screws > 5);
}

/* --- solve ----------------------------------------------------------------------------------------------- */

/* C' = 0 for the velocities found, C'' = 0 for the accelerations, in every row that is used. */
static void motion_keeps_the_rows(void **state)
{
    (void)state;
    double worst[2] = {0, 0};
    int done = 0;
    for (unsigned seed = 1; seed <= 200; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        if (open_anywhere(&o, 2 + (int)(seed % 2), seed, &d)) {
            const struct component *c = &o.rows.component[0];
            const struct part *p = &o.split.part[0];
            double most = 1;
            loops_when(o.rows.loops, .3, 0);
            assert_int_equal(solve_motion(&o.solve, o.x, o.y, o.q, o.v, o.a, .3, NULL), OK);
            for (int i = 0; i < o.split.n; i++) {
                assert_true(o.x[o.split.ind[i]] == o.v[i]);
                assert_true(o.y[o.split.ind[i]] == o.a[i]);
            }
            for (int i = 0; i < o.n; i++) most = fmax(most, fmax(fabs(o.x[i]), fabs(o.y[i])));
            o.tree.ops->accelerate(o.tree.sweep, o.x, o.y, ALL);
            loops_second(o.C, o.rows.loops, o.tree.sweep, o.y);
            for (int r = 0; r < p->nr; r++) {
                double rate = -o.rows.loops->c1[p->row[r]];
                for (int k = 0; k < c->nk; k++) rate += number(c, p->kept[r], k) * o.x[c->k[k]];
                worst[0] = fmax(worst[0], fabs(rate) / most);
                worst[1] = fmax(worst[1], fabs(o.C[p->row[r]]) / (most * most));
            }
            done++;
        }
        arena_close(o.arena);
    }
    print_message("%d linkages: C' misses %.2g, C'' %.2g\n", done, worst[0], worst[1]);
    assert_true(done > 100 && worst[0] < 1e-12 && worst[1] < 1e-11);
}

/* x: accelerations and multipliers of [M C_q'; C_q 0] x = [load; 0], dense, of the rows used. */
static void solve_augmented(const struct bench *o, double *x, const double *M, const double *load)
{
    const struct component *c = &o->rows.component[0];
    const struct part *p = &o->split.part[0];
    const int n = o->n, all = n + p->nr;
    double *A = TAKE(o->arena, double, all *all);
    int *swap = TAKE(o->arena, int, all);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) A[i + j * all] = M[i + j * n];
    for (int r = 0; r < p->nr; r++)
        for (int k = 0; k < c->nk; k++)
            A[n + r + c->k[k] * all] = A[c->k[k] + (n + r) * all] = number(c, p->kept[r], k);
    memcpy(x, load, sizeof *x * (size_t)n);
    memset(x + n, 0, sizeof *x * (size_t)p->nr);
    assert_int_equal(dense_lu(A, swap, all, all), -1);
    dense_lu_solve(A, swap, x, all, all);
}

/* The multipliers of the tree's residual M a - load are those of the augmented system, and nothing is left over. */
static void multipliers_of_the_augmented_system(void **state)
{
    (void)state;
    double worst[2] = {0, 0};
    int done = 0, redundant = 0;
    for (unsigned seed = 1; seed <= 200; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        if (open_anywhere(&o, 2 + (int)(seed % 2), seed, &d)) {
            const struct part *p = &o.split.part[0];
            const struct ode2 *tree = &o.tree.ode;
            double *M = TAKE(o.arena, double, o.n *o.n), *x = TAKE(o.arena, double, o.n + p->nr), most = 1;
            assert_int_equal(solve_factor(&o.solve, o.q, 0, NULL), OK);
            assert_int_equal(tree->ops->mass(tree, M, o.q, 0, ALL, NULL), OK);
            solve_augmented(&o, x, M, o.v);
            for (int i = 0; i < o.n; i++) o.y[i] = -o.v[i];
            dense_gemv(o.y, 1, M, x, o.n, o.n, o.n);
            for (int i = 0; i < o.nrow; i++) o.C[i] = o.C1[i] = NAN;
            solve_multipliers(&o.solve, o.C, o.y);
            solve_reduce(&o.solve, o.x, o.C1, o.y);
            assert_memory_equal(o.C, o.C1, sizeof *o.C * (size_t)o.nrow);
            for (int r = 0; r < p->nr; r++) most = fmax(most, fabs(x[o.n + r]));
            for (int r = 0; r < p->nr; r++) worst[0] = fmax(worst[0], fabs(o.C[p->row[r]] - x[o.n + r]) / most);
            for (int r = p->nr; r < o.nrow; r++) assert_true(o.C[p->row[r]] == 0), redundant++;
            for (int i = 0; i < o.split.n; i++) worst[1] = fmax(worst[1], fabs(o.x[i]) / most);
            done++;
        }
        arena_close(o.arena);
    }
    print_message("%d linkages: lambda misses %.2g, r %.2g; %d rows redundant\n", done, worst[0], worst[1], redundant);
    assert_true(done > 100 && worst[0] < 1e-10 && worst[1] < 1e-10);
}

/* --- caches ---------------------------------------------------------------------------------------------- */

/* Asked at the same place for the same split nothing is made again; elsewhere, and for another split, everything, but a
 * C_q that is the same everywhere; back there, the same bits. */
static void caches_hold_while_nothing_moves(void **state)
{
    (void)state;
    for (unsigned seed = 1; seed <= 20; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        if (open_anywhere(&o, 3, seed, &d) && o.split.part[0].nr > 0) {
            double *F = o.rows.component[0].F, *A = o.solve.block[0].C_qd.store.x;
            const double C_q = F[0];
            assert_int_equal(solve_G(&o.solve, o.q, 0, NULL), OK);
            const double pivot = A[o.split.part[0].band[1]];
            const long here = o.rows.linear;
            F[0] += 1;
            assert_int_equal(solve_G(&o.solve, o.q, 0, NULL), OK);
            assert_true(F[0] == C_q + 1 && A[o.split.part[0].band[1]] == pivot && o.rows.linear == here);
            roll(o.x, o.n, 1e-3, &d);
            moves_point(&o.tree.moves, o.q1, o.q, o.x, 1);
            assert_int_equal(solve_G(&o.solve, o.q1, 0, NULL), OK);
            assert_true((o.rows.linear == here) == o.rows.constant);
            if (o.rows.constant) F[0] = C_q; /* nobody else does */
            assert_int_equal(solve_G(&o.solve, o.q, 0, NULL), OK);
            assert_true(F[0] == C_q && A[o.split.part[0].band[1]] == pivot &&
                        (o.rows.linear == here) == o.rows.constant);
            A[o.split.part[0].band[1]] += 1;
            split_keep(&o.split, &o.split.part[0]);
            split_return(&o.split, &o.split.part[0]); /* a split like the one before is another one */
            assert_int_equal(solve_G(&o.solve, o.q, 0, NULL), OK);
            assert_true(A[o.split.part[0].band[1]] == pivot);
        }
        arena_close(o.arena);
    }
}

/* --- what is asserted ------------------------------------------------------------------------------------ */

static void elsewhere(struct bench *o)
{
    for (int i = 0; i < o->n; i++) o->x[i] = 1e-3;
    moves_point(&o->tree.moves, o->q1, o->q, o->x, 1);
}

static void rates_elsewhere(struct bench *o, bool wrong)
{
    elsewhere(o);
    if (wrong) rows_place(&o->rows, o->q1);
    solve_follow(&o->solve, o->x, o->rows.loops->c1);
}

static void multipliers_elsewhere(struct bench *o, bool wrong)
{
    elsewhere(o);
    if (wrong) open_place(&o->tree, o->q1);
    solve_multipliers(&o->solve, o->C, o->x);
}

static void reduced_after_a_choice(struct bench *o, bool wrong)
{
    if (wrong) choose(o, o->q);
    solve_reduce(&o->solve, o->v, o->C, o->x);
}

static void G_that_was_not_made(struct bench *o, bool wrong)
{
    if (!wrong && solve_G(&o->solve, o->q, 0, NULL) != OK) return;
    solve_G_of(&o->solve, 0);
}

static void values_elsewhere(struct bench *o, bool wrong)
{
    elsewhere(o);
    if (wrong) open_place(&o->tree, o->q1);
    rows_values(o->C, &o->rows);
}

static void turned_twice(struct bench *o, bool wrong)
{
    bool marked[MOST_BODIES];
    for (int i = 0; i < MOST_BODIES; i++) marked[i] = true;
    rows_turn(&o->rows, o->x, marked);
    if (wrong) rows_turn(&o->rows, o->x, marked);
}

static void tangent_of_another_split(struct bench *o, bool wrong)
{
    if (closing_tangent(&o->closing, o->q) && wrong) choose(o, o->q);
    closing_predict(&o->closing, o->x);
}

static void drives_of_another_time(struct bench *o, bool wrong)
{
    if (solve_motion(&o->solve, o->x, NULL, o->q, o->v, NULL, wrong ? .1 : 0, NULL) != OK) return;
}

static void residual_before_motion(struct bench *o, bool wrong)
{
    const struct instant x = {.q = o->q, .v = o->v, .a = o->a};
    elsewhere(o);
    open_move(&o->tree, o->q, o->v);
    if (wrong) open_place(&o->tree, o->q1);
    if (open_resid(&o->tree, o->y, NULL, NULL, &x, ALL, NULL) != OK) return;
}

/* Does the call end in abort()? */
static bool aborts(struct bench *o, void (*call)(struct bench *o, bool wrong), bool wrong)
{
    int end = 0;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        if (!freopen("/dev/null", "w", stderr)) _exit(1);
        call(o, wrong);
        _exit(0);
    }
    assert_int_equal(waitpid(child, &end, 0), child);
    if (!WIFSIGNALED(end)) assert_int_equal(WEXITSTATUS(end), 0);
    return WIFSIGNALED(end) && WTERMSIG(end) == SIGABRT;
}

/* Each of these calls is right in order, and asserted where something that it relies on has moved on. */
static void what_is_stale_is_asserted(void **state)
{
    (void)state;
#ifdef NDEBUG
    skip();
#endif
    static const struct {
        const char *name;
        void (*call)(struct bench *o, bool wrong);
    } calls[] = {{"rates elsewhere", rates_elsewhere},
                 {"multipliers elsewhere", multipliers_elsewhere},
                 {"reduced after a choice", reduced_after_a_choice},
                 {"G that was not made", G_that_was_not_made},
                 {"values elsewhere", values_elsewhere},
                 {"turned twice", turned_twice},
                 {"tangent of another split", tangent_of_another_split},
                 {"drives of another time", drives_of_another_time},
                 {"residual before motion", residual_before_motion}};
    struct bench o;
    unsigned seed = 1;
    for (bool good = false; !good; seed++) { /* a linkage with a ball among its coordinates */
        struct tree_dice d = {seed};
        good = open_anywhere(&o, 3, seed, &d) && o.rows.component[0].nturn > 0 && o.mechanism.model.ndrive > 0;
        if (!good) arena_close(o.arena);
    }
    assert_int_equal(solve_factor(&o.solve, o.q, 0, NULL), OK);
    for (size_t i = 0; i < sizeof calls / sizeof *calls; i++) {
        if (aborts(&o, calls[i].call, false)) fail_msg("%s: asserted where it is right", calls[i].name);
        if (!aborts(&o, calls[i].call, true)) fail_msg("%s: not asserted", calls[i].name);
    }
    arena_close(o.arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_slopes),
        cmocka_unit_test(motion_keeps_the_rows),
        cmocka_unit_test(multipliers_of_the_augmented_system),
        cmocka_unit_test(caches_hold_while_nothing_moves),
        cmocka_unit_test(what_is_stale_is_asserted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
