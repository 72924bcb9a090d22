/* t-sift.c -- products with sifted matrices against the plain ones, to the bit. */
#include "la/sift.h"

#include <stdint.h>
#include <string.h>

#include "la/dense.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { ROWS = 203, COLS = 14 };

static double roll(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 * 2 - 1;
}

/* Where row i has entries: classes by i mod kinds; `stray` rows lose or win some. */
static int there(int i, int j, int kinds, int stray)
{
    if (i % 7 == 3) return 0;
    if (stray && i % stray == 1) return (i * 5 + j * 3) % 4 == 0;
    return kinds == 1 || j % kinds == i % kinds;
}

static void compare(int kinds, int stray, int ngroup, uint64_t *dice)
{
    struct arena *life = arena_open();
    struct sift o;
    double A[ROWS * COLS], base[ROWS], x[COLS], expect[ROWS], y[ROWS];
    for (int j = 0; j < COLS; j++)
        for (int i = 0; i < ROWS; i++) A[i + ROWS * j] = there(i, j, kinds, stray) ? roll(dice) : 0;
    for (int i = 0; i < ROWS; i++) base[i] = roll(dice);
    sift_build(&o, A, base, ROWS, COLS, life);
    assert_int_equal(o.ngroup, ngroup);
    memcpy(y, base, sizeof y);
    for (int round = 0; round < 3; round++) {
        for (int j = 0; j < COLS; j++) x[j] = roll(dice);
        memcpy(expect, base, sizeof expect);
        dense_gemv(expect, 1, A, x, ROWS, COLS, ROWS);
        sift_at(y, &o, x);
        for (int i = 0; i < ROWS; i++) assert_true(y[i] == expect[i]);
    }
    memset(expect, 0, sizeof expect);
    memset(y, 0, sizeof y);
    dense_gemv(expect, 1, A, x, ROWS, COLS, ROWS);
    sift_times(y, &o, x);
    for (int i = 0; i < ROWS; i++) assert_true(y[i] == expect[i]);
    arena_close(life);
}

static void test_products(void **state)
{
    uint64_t dice = 5;
    (void)state;
    compare(2, 0, 2, &dice);
    compare(3, 0, 3, &dice);
    compare(3, 8, 4, &dice);
    compare(1, 0, 1, &dice);
    compare(1, 4, 2, &dice);
}

/* Rows with places of their own make too many groups: all rows stand in one. */
static void test_many(void **state)
{
    struct arena *life = arena_open();
    struct sift o;
    double A[ROWS * COLS] = {0}, x[COLS], expect[ROWS] = {0}, y[ROWS];
    uint64_t dice = 7;
    (void)state;
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < 4; j++) A[i + ROWS * ((i * (2 * j + 1) + i / COLS + j) % COLS)] = roll(&dice);
    for (int j = 0; j < COLS; j++) x[j] = roll(&dice);
    sift_build(&o, A, NULL, ROWS, COLS, life);
    assert_int_equal(o.ngroup, 1);
    assert_int_equal(o.group[0].ncol, COLS);
    dense_gemv(expect, 1, A, x, ROWS, COLS, ROWS);
    sift_times(y, &o, x);
    for (int i = 0; i < ROWS; i++) assert_true(y[i] == expect[i]);
    arena_close(life);
}

static void test_zero(void **state)
{
    struct arena *life = arena_open();
    struct sift o;
    const double A[ROWS * COLS] = {0}, x[COLS] = {1};
    double y[ROWS] = {3};
    (void)state;
    sift_build(&o, A, NULL, ROWS, COLS, life);
    assert_true(sift_empty(&o));
    sift_times(y, &o, x);
    assert_true(y[0] == 3);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_products),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
