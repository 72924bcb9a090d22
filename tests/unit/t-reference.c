/* t-reference.c -- runs in memory, compared: which instants are common, where motions part, what a column is uncertain by,
 * what is noise, errors over ranges; and what counts cost. */
#include "study/reference.h"

#include <math.h>
#include <string.h>

#include "multirate/schemes.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { COLUMNS = 5, T = 0, QUICK, LAZY, FORCE, LITTLE };

/* t, a fast angle 0...4, a slow angle 10...12, a force -8...8, a force of 1e-12. */
static struct outcome run_of(int rows, struct arena *life)
{
    struct outcome o = {.n = COLUMNS};
    for (int i = 0; i < rows; i++) {
        const double x[COLUMNS] = {.5 * i, i, 10 + .5 * i, i % 2 ? -8 : 8, 1e-12 * (i + 1)};
        outcome_keep(&o, x, life);
    }
    return o;
}

static void columns_of(struct outcome_column *o)
{
    static char newton[] = "N"; /* the same words at another place */
    o[T] = (struct outcome_column){"t", "s", -1, false, 0};
    o[QUICK] = (struct outcome_column){"fast", "rad", 1, true, 0};
    o[LAZY] = (struct outcome_column){"slow", "rad", 0, true, 0};
    o[FORCE] = (struct outcome_column){"force", "N", -1, true, 0};
    o[LITTLE] = (struct outcome_column){"little", newton, -1, true, 0};
}

static double *at(struct outcome *o, int row, int column)
{
    return &o->x[row * o->n + column];
}

static void test_rows(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct outcome a = run_of(5, life), b = run_of(5, life);
    int r[2] = {-1, -1};
    assert_int_equal(a.rows, 5);
    assert_true(outcome_row(&a, 3)[T] == 1.5 && outcome_row(&a, 4)[LAZY] == 12);
    *at(&b, 1, T) = .25;          /* in the first only: .5; in the second only: .25 */
    *at(&a, 2, T) = 1 + .9e-9;    /* one instant */
    *at(&b, 3, T) = 1.5 + 1.6e-9; /* another */
    const int common[][2] = {{0, 0}, {2, 2}, {4, 4}};
    for (int i = 0; i < 3; i++) {
        assert_true(outcome_next(r, &a, &b));
        assert_int_equal(r[0], common[i][0]);
        assert_int_equal(r[1], common[i][1]);
    }
    assert_false(outcome_next(r, &a, &b));
    arena_close(life);
}

static void test_units(void **state)
{
    (void)state;
    struct outcome_column c[COLUMNS], none = {.name = "x"};
    columns_of(c);
    assert_true(same_unit(&c[FORCE], &c[LITTLE]) && same_unit(&none, &none));
    assert_false(same_unit(&c[FORCE], &c[QUICK]) || same_unit(&none, &c[QUICK]) || same_unit(&c[QUICK], &none));
}

/* Two runs that differ by so much; what each column is uncertain by, and which are not compared. */
static void test_between(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct reference o = {.run = run_of(5, life)};
    struct outcome b = run_of(5, life);
    struct outcome_column c[COLUMNS];
    struct subject subject = {.column = c, .ncolumn = COLUMNS};
    columns_of(c);
    *at(&b, 2, QUICK) += .002;
    *at(&b, 4, LAZY) -= .02;
    *at(&b, 3, FORCE) += .48;
    reference_between(&o, &b, .1, .02, &subject, life);
    assert_true(o.whole && o.horizon == 2);
    assert_true(o.range[QUICK] == 4 && o.range[LAZY] == 2 && o.range[FORCE] == 16);
    assert_true(o.largest[QUICK] == 4 && o.largest[LAZY] == 12 && o.largest[FORCE] == 8);
    assert_true(o.least[QUICK] == 1e-9 * 12 && o.least[LAZY] == 1e-9 * 12 && o.least[LITTLE] == 1e-9 * 8);
    assert_true(fabs(o.uncertain[QUICK] - .0005) < 1e-14 && fabs(o.uncertain[LAZY] - .01) < 1e-14);
    assert_true(fabs(o.uncertain[FORCE] - .03) < 1e-14 && o.uncertain[LITTLE] == 0);
    assert_true(fabs(o.apart - .01) < 1e-14); /* of coordinates */
    assert_true(c[QUICK].compared && c[LAZY].compared && !c[FORCE].compared && !c[LITTLE].compared && !c[T].compared);
    assert_int_equal(o.left_out, 1);
    assert_string_equal(o.left_out_name, "force");
    reference_up_to(&o, 1);
    assert_true(o.horizon == 1 && o.range[QUICK] == 2 && o.largest[LAZY] == 11);
    arena_close(life);
}

/* Coordinates part in the fourth row: what is compared ends before it. */
static void test_parting(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct reference o = {.run = run_of(5, life)};
    struct outcome b = run_of(5, life);
    struct outcome_column c[COLUMNS];
    struct subject subject = {.column = c, .ncolumn = COLUMNS};
    columns_of(c);
    *at(&b, 1, FORCE) = 0; /* no coordinate */
    *at(&b, 3, LAZY) += .0201;
    *at(&b, 4, QUICK) = 100;
    reference_between(&o, &b, .01, 1, &subject, life);
    assert_true(!o.whole && o.horizon == 1);
    assert_true(o.range[QUICK] == 2 && o.range[LAZY] == 1 && o.uncertain[QUICK] == 0 && o.uncertain[LAZY] == 0);
    assert_true(o.uncertain[FORCE] == .5 && o.left_out == 0 && o.left_out_name == NULL && o.apart == 0);
    /* by no more than the second run's tolerance of what is usual they do not */
    c[LAZY].usual = 1;
    o.second.tolerance = .0202;
    reference_between(&o, &b, .01, 1, &subject, life);
    assert_true(!o.whole && o.horizon == 1.5);
    o.second.tolerance = .02;
    reference_between(&o, &b, .01, 1, &subject, life);
    assert_true(o.horizon == 1);
    arena_close(life);
}

/* What does not move is compared by its size, what is nothing beside its unit by the least. */
static void test_still(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct reference o = {.run = run_of(3, life)};
    struct outcome b = run_of(3, life);
    struct outcome_column c[COLUMNS];
    struct subject subject = {.column = c, .ncolumn = COLUMNS};
    columns_of(c);
    for (int i = 0; i < 3; i++) {
        *at(&o.run, i, LAZY) = 10 + 1e-8 * i; /* rests at 10 but for 2e-8 */
        *at(&o.run, i, LITTLE) = 0;
        *at(&b, i, LITTLE) = 4e-10;
        *at(&b, i, LAZY) = 10 + 1e-8 * i + .01;
    }
    reference_between(&o, &b, 1, 1, &subject, life);
    assert_true(fabs(o.uncertain[LAZY] - .001) < 1e-10);
    assert_true(fabs(o.uncertain[LITTLE] - .05) < 1e-14);
    c[QUICK].usual = 100;
    reference_between(&o, &b, 1, 1, &subject, life);
    assert_true(o.least[QUICK] == 1e-9 * 100 && o.least[LAZY] == 1e-9 * (10 + 2e-8));
    arena_close(life);
}

static void test_compare(void **state)
{
    (void)state;
    struct arena *life = arena_open();
    struct reference o = {.run = run_of(5, life)};
    struct outcome same = run_of(5, life), b = run_of(5, life);
    struct outcome_column c[COLUMNS];
    struct subject subject = {.column = c, .ncolumn = COLUMNS};
    struct errors e;
    columns_of(c);
    reference_between(&o, &same, 1, 1, &subject, life);
    reference_compare(&e, &o, &subject, &same);
    assert_true(e.fast == 0 && e.slow == 0 && e.instants == 4 && e.column == -1);
    *at(&b, 1, QUICK) += .02;
    *at(&b, 2, QUICK) -= .04; /* of 4 */
    *at(&b, 3, LAZY) += .06;  /* of 12 at most, 2 apart */
    *at(&b, 4, FORCE) += .4;  /* of 16 */
    reference_compare(&e, &o, &subject, &b);
    assert_true(fabs(e.fast - .01) < 1e-14 && fabs(e.slow - .005) < 1e-14);
    assert_true(e.column == LAZY && fabs(e.worst - .03) < 1e-14 && fabs(e.absolute - .06) < 1e-14);
    c[LAZY].compared = false;
    reference_compare(&e, &o, &subject, &b);
    assert_true(e.column == FORCE && fabs(e.worst - .025) < 1e-14 && fabs(e.absolute - .4) < 1e-14);
    reference_up_to(&o, 1);
    reference_compare(&e, &o, &subject, &b);
    assert_true(e.instants == 2 && e.column == QUICK && fabs(e.worst - .02) < 1e-14 && e.slow == 0);
    reference_up_to(&o, 2);
    b.rows = 4; /* stopped on the way */
    reference_compare(&e, &o, &subject, &b);
    assert_true(isinf(e.fast) && isinf(e.slow) && isinf(e.worst) && isinf(e.absolute));
    b.rows = 5;
    for (int i = 0; i < COLUMNS; i++) c[i].compared = false, c[i].rate = -1;
    reference_compare(&e, &o, &subject, &b);
    assert_true(isnan(e.fast) && isnan(e.slow) && isnan(e.worst) && isnan(e.absolute) && e.column == -1);
    arena_close(life);
}

/* Where evaluations cost 2 s, a quarter of one the fast part; full matrices 7 s, structured 5. */
static void test_price(void **state)
{
    (void)state;
    const struct price p = {.evaluation = 2, .full = 7, .structured = 5, .fast = .25, .balance = 1.5, .look = .125};
    const struct effort e = {.slow = 8, .fast = 16, .factors = 3, .majors = 4};
    assert_true(price_seconds(&p, stepper_find("midpoint"), &e) == 2 * (8 * .75 + 16 * .25) + 15);
    assert_true(price_seconds(&p, stepper_find("radau5"), &e) == 2 * (8 * .75 + 16 * .25) + 21);
    const double books = 2 * 1.5 * (8 * .75 + 16 * .25) + .5;
    assert_true(price_whole(&p, stepper_find("midpoint"), &e) == 2 * (8 * .75 + 16 * .25) + 15 + books);
    assert_true(price_whole(&p, stepper_find("radau5"), &e) == 2 * (8 * .75 + 16 * .25) + 21 + books);
}

static void test_kinds(void **state)
{
    (void)state;
    struct subject subject = {.n = MOST_DENSE};
    const struct stepper_kind *full = stepper_find("radau5"), *plain = stepper_find("rk4");
    assert_true(by_tolerance(full) && by_tolerance(stepper_find("dopri5")));
    assert_false(too_full(full, &subject));
    subject.n++;
    assert_true(too_full(full, &subject));
    assert_false(too_full(plain, &subject));
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rows),    cmocka_unit_test(test_units),
                                       cmocka_unit_test(test_between), cmocka_unit_test(test_parting),
                                       cmocka_unit_test(test_still),   cmocka_unit_test(test_compare),
                                       cmocka_unit_test(test_price),   cmocka_unit_test(test_kinds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
