/* Names found among many things while the list grows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "base/index.h"

struct thing {
    int number;
    const char *name;
};

static int find(struct index *o, const char *text, const struct thing *things, int count)
{
    return index_find(o, text, strlen(text), &things->name, sizeof *things, count);
}

static void test_growing(void **state)
{
    enum { MANY = 5000 };
    static struct thing things[MANY];
    static char name[MANY][12];
    struct arena *life = arena_open();
    struct index o = {.life = life};
    (void)state;
    for (int i = 0; i < MANY; i++) {
        snprintf(name[i], sizeof name[i], "link%d", i);
        things[i].name = i % 7 == 3 ? NULL : name[i];
        assert_int_equal(find(&o, name[i], things, i), -1);
        assert_int_equal(find(&o, name[i], things, i + 1), i % 7 == 3 ? -1 : i);
    }
    for (int i = 0; i < MANY; i++) assert_int_equal(find(&o, name[i], things, MANY), i % 7 == 3 ? -1 : i);
    assert_int_equal(index_find(&o, "link12345", 6, &things->name, sizeof *things, MANY), 12);
    assert_int_equal(find(&o, "", things, MANY), -1);
    arena_close(life);
}

/* Of two with one name the first. */
static void test_twice(void **state)
{
    const struct thing things[] = {{0, "a"}, {1, "b"}, {2, "b"}};
    struct arena *life = arena_open();
    struct index o = {.life = life};
    (void)state;
    assert_int_equal(find(&o, "b", things, 3), 1);
    assert_int_equal(find(&o, "a", things, 3), 0);
    arena_close(life);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_growing), cmocka_unit_test(test_twice)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
