/* t-recall.c -- spans come back to the last bit, and are told apart. */
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include "base/recall.h"

struct thing {
    double x[40], y;
    int i[3];
    long n;
    bool is[2];
    struct {
        int other;
        double x;
    } list[5];
};

static void thing_recall(struct thing *o, struct recall *r)
{
    recall_within(r, "thing");
    recall_list(r, "x", o->x, 40);
    recall_within(r, "inner");
    recall_one(r, "y", o->y);
    recall_list(r, "i", o->i, 3);
    recall_without(r);
    recall_one(r, "n", o->n);
    recall_list(r, "is", o->is, 2);
    recall_each(r, "list", o->list, x, 5);
    recall_without(r);
}

static struct thing example(void)
{
    struct thing o = {.y = NAN, .i = {-1, 0, 2147483647}, .n = -5000000000, .is = {true, false}};
    const double x[] = {0.1, -0.0, 0, 0, 5e-324, -INFINITY, 1 / 3., 0, 1e308};
    memcpy(o.x, x, sizeof x);
    o.x[39] = -1.5;
    for (int k = 0; k < 5; k++) o.list[k].x = k - 2;
    return o;
}

static void back_to_the_bit(void **state)
{
    struct arena *arena = arena_open();
    struct thing a = example(), b = {.list = {{.other = 7}}};
    struct recall keep, back;
    (void)state;
    recall_keep(&keep, arena);
    thing_recall(&a, &keep);
    assert_int_equal(keep.n, 6);
    assert_string_equal(keep.span[1].name, "thing.inner.y");
    assert_string_equal(keep.span[2].text, "ffffffffffffffff 0 7fffffff");
    recall_back(&back, keep.span, keep.n);
    assert_true(recall_has(&back, "thing"));
    assert_false(recall_has(&back, "thin"));
    thing_recall(&b, &back);
    assert_string_equal(back.wrong, "");
    assert_memory_equal(a.x, b.x, sizeof a.x);
    assert_memory_equal(&a.y, &b.y, sizeof a.y);
    assert_memory_equal(a.i, b.i, sizeof a.i);
    assert_true(b.n == a.n && b.is[0] && !b.is[1] && b.list[0].other == 7);
    for (int k = 0; k < 5; k++) assert_true(b.list[k].x == a.list[k].x);
    arena_close(arena);
}

/* Each of these is noticed, and the first of them is named. */
static void told_apart(void **state)
{
    static const char *const text[] = {"", "1", "1 2", "1 2 3 4", "1 z3", "1 2 x", "z", "z2 3 -", "1 2 3 "};
    (void)state;
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        struct recalled span[] = {{"a.i", text[k]}};
        struct recall r;
        int i[3];
        recall_back(&r, span, 1);
        recall_within(&r, "a");
        recall_list(&r, "i", i, 3);
        recall_list(&r, "j", i, 3);
        assert_string_equal(r.wrong, "a.i");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(back_to_the_bit), cmocka_unit_test(told_apart)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
