/* t-closing.c -- closing.h by itself, on random linkages with drives. */
#include "unit/condensed.h"

/* A closed posture in o->q. */
static bool open_closed(struct bench *o, int space, unsigned seed)
{
    struct miss miss;
    open_bench(o, space, seed);
    weigh(o, NULL);
    if (!(choose(o, o->q) > 1e-2) || o->split.part[0].nr < o->nrow || o->split.n == 0) return false;
    memset(o->x, 0, sizeof *o->x * (size_t)o->n);
    const struct way way = {.base = o->mechanism.model.q0, .s = 1, .dx = o->x};
    return closing_close(&o->closing, o->q, &miss, &way, 0) && choose(o, o->q) > 1e-2;
}

static double apart(const double *a, const double *b, int n)
{
    double most = 0;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/* How far the closed end is from where the tangent leads, of a way and a time that are `part` of a whole. */
static double prediction_misses(struct bench *o, double part)
{
    struct miss miss;
    for (int i = 0; i < o->n; i++) o->x[i] = part * o->v[i];
    assert_int_equal(closing_tangent(&o->closing, o->q), 1);
    loops_when(o->rows.loops, .005 * part, 0);
    closing_predict(&o->closing, o->x);
    memcpy(o->y, o->x, sizeof *o->y * (size_t)o->n);
    const struct way way = {.base = o->q, .s = 1, .dx = o->x};
    return closing_close(&o->closing, o->q1, &miss, &way, 0) ? apart(o->x, o->y, o->n) : NAN;
}

/* Independents and drives: half the way, a quarter of the miss. */
static void tangents_are_of_second_order(void **state)
{
    (void)state;
    double least = INFINITY, most = 0;
    int done = 0;
    for (unsigned seed = 1; seed <= 100; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        if (open_closed(&o, 2 + (int)(seed % 2), seed)) {
            roll(o.v, o.n, .005, &d);
            const double whole = prediction_misses(&o, 1), half = prediction_misses(&o, .5);
            if (whole > 1e-8) least = fmin(least, whole / half), most = fmax(most, whole / half), done++;
        }
        arena_close(o.arena);
    }
    print_message("%d tangents: %.2f to %.2f times closer at half the way\n", done, least, most);
    assert_true(done > 20 && least > 3.2 && most < 4.8);
}

struct ways {
    double open, worst; /* |C|; what independents and ends miss by */
    int done, quickly, split_anew;
};

/* From another end nearby. */
static void try_again(struct bench *o, struct ways *w, const double *end, struct tree_dice *d)
{
    struct miss miss;
    for (int i = 0; i < o->split.n; i++) o->a[i] = o->v[i] + tree_roll(d, -1e-6, 1e-6);
    assert_int_equal(closing_point(&o->closing, o->q1, &miss, o->q, o->a, 1, 0), 1);
    if (!closing_again(&o->closing, o->q1, o->q, o->v, 1, &(struct again){.corrections = 3})) return;
    w->worst = fmax(w->worst, apart(o->q1, end, o->mechanism.model.nq));
    w->quickly++;
}

/* By another split, in place; o->x: the whole way. */
static void try_another_split(struct bench *o, struct ways *w, const double *end, struct tree_dice *d)
{
    struct miss miss;
    const int before = o->split.ind[0];
    weigh(o, d);
    if (!(choose(o, o->q) > 1e-2)) return;
    w->split_anew += o->split.ind[0] != before;
    for (int i = 0; i < o->split.n; i++) o->v[i] = o->x[o->split.ind[i]];
    assert_int_equal(closing_point(&o->closing, o->q, &miss, o->q, o->v, 1, 0), 1);
    w->worst = fmax(w->worst, apart(o->q, end, o->mechanism.model.nq));
}

static void try_way(struct bench *o, struct ways *w, unsigned seed)
{
    struct tree_dice d = {seed};
    struct miss miss;
    int row;
    roll(o->v, o->split.n, .05, &d);
    if (!closing_point(&o->closing, o->q1, &miss, o->q, o->v, 1, 0)) return;
    w->open = fmax(w->open, rows_misfit(o->C, &row, &o->rows, o->q1));
    moves_diff(&o->tree.moves, o->x, o->q1, o->q);
    for (int i = 0; i < o->split.n; i++) w->worst = fmax(w->worst, fabs(o->x[o->split.ind[i]] - o->v[i]));
    double *end = TAKE(o->arena, double, o->mechanism.model.nq);
    memcpy(end, o->q1, sizeof *end * (size_t)o->mechanism.model.nq);
    try_again(o, w, end, &d);
    try_another_split(o, w, end, &d);
    w->done++;
}

/* A way ends closed, where it is told to, whichever coordinates are dependent; from a neighbour of its end, too. */
static void a_way_ends_where_it_should(void **state)
{
    (void)state;
    struct ways w = {0};
    for (unsigned seed = 1; seed <= 300; seed++) {
        struct bench o;
        if (open_closed(&o, 2 + (int)(seed % 2), seed)) try_way(&o, &w, seed);
        arena_close(o.arena);
    }
    print_message("%d ways: |C| %.2g, ends miss by %.2g; %d by another split, %d from a neighbour\n", w.done, w.open,
                  w.worst, w.split_anew, w.quickly);
    assert_true(w.done > 100 && w.split_anew > 10 && w.quickly > 100 && w.open < 1e-13 && w.worst < 1e-10);
}

/* The first correction of a way of time h along the velocities. */
static double first_correction(struct bench *o, double h)
{
    struct miss miss;
    for (int i = 0; i < o->split.n; i++) o->a[i] = h * o->v[i];
    loops_when(o->rows.loops, h, 0);
    return closing_point(&o->closing, o->q1, &miss, o->q, o->a, 1, 0) == WAY_CLOSED ? o->closing.first : NAN;
}

/* Along the velocities, where nothing accelerates by itself, drives as they go: half the time, an eighth of the miss; and where
 * the tangent was near enough, it stays. */
static void bends_are_of_third_order(void **state)
{
    (void)state;
    double least = INFINITY, most = 0;
    int done = 0;
    for (unsigned seed = 1; seed <= 200; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        if (open_closed(&o, 2, seed)) {
            roll(o.v, o.split.n, 1, &d);
            loops_when(o.rows.loops, 0, 0);
            assert_int_equal(closing_tangent(&o.closing, o.q), 1);
            assert_int_equal(solve_motion(&o.solve, o.x, o.y, o.q, o.v, NULL, 0, NULL), OK);
            o.closing.first = 1e-10;
            closing_bend(&o.closing, o.x, o.y);
            const double tangent = first_correction(&o, 2e-3);
            loops_when(o.rows.loops, 0, 0);
            assert_int_equal(solve_motion(&o.solve, o.x, o.y, o.q, o.v, NULL, 0, NULL), OK);
            o.closing.first = 1;
            closing_bend(&o.closing, o.x, o.y);
            const double whole = first_correction(&o, 2e-3), half = first_correction(&o, 1e-3);
            if (half > 1e-11 && tangent > 1e-7) {
                least = fmin(least, whole / half), most = fmax(most, whole / half), done++;
                assert_true(whole < tangent);
            }
        }
        arena_close(o.arena);
    }
    print_message("%d bends: %.2f to %.2f times closer in half the time\n", done, least, most);
    assert_true(done > 20 && least > 6 && most < 11);
}

/* Of what is factored beside a base: nearly the tangent there, and the same bits whenever it is made anew. */
static void a_tangent_may_be_of_beside(void **state)
{
    (void)state;
    int beside = 0;
    double worst = 0;
    for (unsigned seed = 1; seed <= 200; seed++) {
        struct bench o;
        struct tree_dice d = {seed};
        struct miss miss;
        if (open_closed(&o, 2 + (int)(seed % 2), seed) && loops_drive_coordinates(o.rows.loops)) {
            const size_t size = sizeof *o.x * (size_t)o.n;
            roll(o.a, o.split.n, 1e-8, &d);
            roll(o.v, o.n, 1, &d);
            assert_int_equal(closing_point(&o.closing, o.q1, &miss, o.q, o.a, 1, 0), 1);
            memcpy(o.x, o.v, size);
            assert_int_equal(closing_tangent(&o.closing, o.q1), 1);
            closing_predict(&o.closing, o.x); /* at q1 */
            assert_int_equal(closing_tangent(&o.closing, o.q), 1);
            assert_int_equal(closing_tangent_about(&o.closing, o.q1), 1); /* with what is factored at q */
            memcpy(o.y, o.v, size);
            closing_predict(&o.closing, o.y);
            beside += memcmp(o.x, o.y, size) != 0;
            worst = fmax(worst, apart(o.x, o.y, o.n));
            assert_int_equal(closing_tangent(&o.closing, o.q), 1);
            assert_int_equal(closing_tangent(&o.closing, o.q1), 1);
            closing_predict(&o.closing, o.v);
            assert_memory_equal(o.v, o.y, size);
        }
        arena_close(o.arena);
    }
    print_message("%d tangents beside their base: off by %.2g\n", beside, worst);
    assert_true(beside > 5 && worst < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangents_are_of_second_order),
        cmocka_unit_test(bends_are_of_third_order),
        cmocka_unit_test(a_tangent_may_be_of_beside),
        cmocka_unit_test(a_way_ends_where_it_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
