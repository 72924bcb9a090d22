/* t-arena.c -- memory: zeroed and aligned, given back by marks, lists that grow, what was deferred. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/status.h"

#include <cmocka.h>

static void taken(void **state)
{
    (void)state;
    struct arena *a = arena_open();
    for (int k = 0; k < 200; k++) {
        unsigned char *x = arena_take(a, (size_t)k, 37);
        assert_int_equal((uintptr_t)x % _Alignof(max_align_t), 0);
        for (int i = 0; i < 37 * k; i++) assert_int_equal(x[i], 0);
        memset(x, 1, (size_t)(37 * k));
    }
    arena_close(a);
}

/* What is taken after a rewind is zero again. */
static void marks(void **state)
{
    (void)state;
    struct arena *a = arena_open();
    const struct arena_mark mark = arena_mark(a);
    const long grown = arena_grown(a);
    for (int k = 0; k < 1000; k++) {
        int *x = TAKE(a, int, 1000);
        for (int i = 0; i < 1000; i++) {
            assert_int_equal(x[i], 0);
            x[i] = -1;
        }
        arena_rewind(a, mark);
    }
    assert_true(arena_grown(a) <= grown + 1);
    arena_close(a);
}

static void lists(void **state)
{
    (void)state;
    struct arena *a = arena_open();
    double(*x)[3] = NULL;
    int n = 0, room = 0, moved = 0;
    for (; n < 5000; n++) {
        double(*more)[3] = arena_more(a, x, n, &room, sizeof *x);
        assert_true(room > n);
        moved += more != x;
        x = more;
        for (int k = 0; k < 3; k++) x[n][k] = 3 * n + k;
    }
    for (int i = 0; i < n; i++)
        for (int k = 0; k < 3; k++) assert_true(x[i][k] == 3 * i + k);
    assert_true(moved < 16);
    arena_close(a);
}

static char order[4];

static void note(void *letter)
{
    strncat(order, letter, 1);
}

static void deferred(void **state)
{
    (void)state;
    struct arena *a = arena_open();
    arena_defer(a, note, "a");
    arena_defer(a, note, "b");
    arena_defer(a, note, "c");
    assert_string_equal(order, "");
    arena_close(a);
    assert_string_equal(order, "cba");
    arena_close(NULL);
}

/* What cannot be is told before it is taken; a product that overflows is too much, whatever is left of it. */
static void allowed(void **state)
{
    (void)state;
    assert_true(arena_allows(1000, 1000));
    assert_false(arena_allows(SIZE_MAX / 8 + 2, 8));
    assert_false(arena_allows(SIZE_MAX / 16, 8));
    struct arena *a = arena_open();
    double *M = TAKE_MATRIX(a, double, 30, 20);
    for (int i = 0; i < 600; i++) assert_true(M[i] == 0);
    arena_close(a);
}

/* 46341 squared is no int: the process ends with the code of a limit, in a child. */
static void too_large(void **state)
{
    (void)state;
    const pid_t child = fork();
    if (child == 0) {
        close(STDERR_FILENO);
        struct arena *a = arena_open();
        (void)TAKE_MATRIX(a, char, 46341, 46341);
        _exit(0);
    }
    int how;
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFEXITED(how) && WEXITSTATUS(how) == E_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(taken),   cmocka_unit_test(marks),
                                       cmocka_unit_test(lists),   cmocka_unit_test(deferred),
                                       cmocka_unit_test(allowed), cmocka_unit_test(too_large)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
