/* t-columns.c -- columns chosen by patterns. */
#include "out/columns.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

static const struct column all[] = {{"t", "s", "time"},
                                    {"hub.angle", "rad", "angle"},
                                    {"hub.angle_rate", "rad/s", "its rate"},
                                    {"guide.displacement", "m", "displacement"},
                                    {"guide.displacement_rate", "m/s", "its rate"},
                                    {"energy.kinetic", "J", "kinetic energy"},
                                    {"energy.residual", "J", "what (2-26) leaves"}};
enum { N = sizeof all / sizeof *all };

static struct arena *life;
static struct report report;
static struct selection chosen;

static enum status choose(const char *list)
{
    int n;
    const char **patterns = columns_split(&n, list, life);
    report = (struct report){0};
    return columns_select(&chosen, all, N, patterns, n, E_USAGE, life, &report);
}

/* The chosen names, joined by blanks. */
static const char *names(const char *list)
{
    const char *text = "";
    assert_int_equal(choose(list), OK);
    assert_int_equal(chosen.wrong, -1);
    for (int i = 0; i < chosen.n; i++)
        text = arena_print(life, "%s%s%s", text, i ? " " : "", all[chosen.index[i]].name);
    return text;
}

static void order_is_that_of_the_patterns(void **state)
{
    (void)state;
    assert_string_equal(names("guide.displacement,hub.angle"), "t guide.displacement hub.angle");
    assert_string_equal(names("energy.*,hub.*"), "t energy.kinetic energy.residual hub.angle hub.angle_rate");
    assert_string_equal(names("*_rate"), "t hub.angle_rate guide.displacement_rate");
    assert_string_equal(names("?ub.angle"), "t hub.angle");
}

static void time_comes_first_and_nothing_twice(void **state)
{
    (void)state;
    assert_string_equal(names(""), "t");
    assert_string_equal(names("hub.angle,t"), "t hub.angle");
    assert_string_equal(names("hub.angle,hub.*,hub.angle"), "t hub.angle hub.angle_rate");
    assert_string_equal(names("*"), "t hub.angle hub.angle_rate guide.displacement guide.displacement_rate "
                                    "energy.kinetic energy.residual");
}

static void wrong(const char *list, int index, const char *words)
{
    assert_int_equal(choose(list), E_USAGE);
    assert_int_equal(chosen.wrong, index);
    assert_int_equal(report.status, E_USAGE);
    assert_string_equal(report.text, words);
}

static void a_pattern_without_match_names_the_nearest(void **state)
{
    (void)state;
    wrong("t,hub.angel", 1, "no column matches 'hub.angel'; did you mean 'hub.angle'?");
    wrong("energy.residuall,x", 0, "no column matches 'energy.residuall'; did you mean 'energy.residual'?");
    wrong("hub.angle,quite.else", 1, "no column matches 'quite.else'");
    wrong("hob.*", 0, "no column matches 'hob.*'; did you mean 'hub.*'?");
    wrong("enrgy.*", 0, "no column matches 'enrgy.*'; did you mean 'energy.*'?");
    wrong("guiide.displacement*", 0, "no column matches 'guiide.displacement*'; did you mean 'guide.displacement*'?");
    wrong("*.nothing", 0, "no column matches '*.nothing'");
    wrong("Hub.angle", 0, "no column matches 'Hub.angle'; did you mean 'hub.angle'?");
}

static void lists_are_split_at_commas(void **state)
{
    (void)state;
    int n;
    const char **p = columns_split(&n, " t , hub.*,,\trod.x ,", life);
    assert_int_equal(n, 3);
    assert_string_equal(p[0], "t");
    assert_string_equal(p[1], "hub.*");
    assert_string_equal(p[2], "rod.x");
    columns_split(&n, " , ", life);
    assert_int_equal(n, 0);
    p = columns_split(&n, "v=hypot(rod.x, min(t, 2)) ,t,w=(1", life);
    assert_int_equal(n, 3);
    assert_string_equal(p[0], "v=hypot(rod.x, min(t, 2))");
    assert_string_equal(p[1], "t");
    assert_string_equal(p[2], "w=(1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_is_that_of_the_patterns),
        cmocka_unit_test(time_comes_first_and_nothing_twice),
        cmocka_unit_test(a_pattern_without_match_names_the_nearest),
        cmocka_unit_test(lists_are_split_at_commas),
    };
    life = arena_open();
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    arena_close(life);
    return failed;
}
