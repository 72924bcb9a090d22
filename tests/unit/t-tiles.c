/* t-tiles.c -- products by tiles against sums by the definition, for as many columns as one, two and more passes take */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include "la/tiles.h"
#include "unit/oscillators.h"

#include <cmocka.h>

enum { ROWS = 13, MOST = 30 };

struct product {
    int rows, n;
    double X[ROWS * MOST], A[16 * MOST], x[MOST], base[16], sum[16]; /* X by column, A the same by tiles */
};

static void make(struct product *o, int n, struct dice *dice)
{
    *o = (struct product){.rows = tiles_rows(ROWS), .n = n};
    for (int j = 0; j < n; j++) o->x[j] = dice_range(dice, -1, 1);
    for (int i = 0; i < ROWS; i++) {
        o->base[i] = dice_range(dice, -1, 1);
        for (int j = 0; j < n; j++) {
            o->X[i + ROWS * j] = o->A[tiles_at(i, j, n)] = dice_range(dice, -1, 1);
            o->sum[i] += o->X[i + ROWS * j] * o->x[j];
        }
    }
}

static void test_times(void **state)
{
    (void)state;
    struct dice dice = {11};
    struct product o;
    for (int n = 1; n <= MOST; n++) {
        double y[17] = {[16] = 7};
        make(&o, n, &dice);
        assert_int_equal(o.rows, 16);
        tiles_times(y, o.base, o.A, o.x, o.rows, n);
        for (int i = 0; i < 16; i++) assert_true(fabs(y[i] - (o.base[i] + o.sum[i])) < 1e-14);
        assert_true(y[ROWS] == 0 && y[15] == 0 && y[16] == 7);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_times)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
