/* t-points.c -- the points of a sweep and what it keeps of their runs: values of lists, ranges and distributions, their
 * combinations, quantiles from tables; integrals over records by hand. */
#include "sweep/points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/wanted.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static struct arena *life;

static int open_arena(void **state)
{
    (void)state;
    life = arena_open();
    return 0;
}

static int close_arena(void **state)
{
    (void)state;
    arena_close(life);
    return 0;
}

/* The values of one factor, joined by bars. */
static const char *values_of(const char *text)
{
    static char joined[400];
    char buffer[POINT_TEXT];
    static struct report report;
    struct pointset o = {0};
    report = (struct report){0};
    *joined = 0;
    if (points_add(&o, text, life, &report) != OK || points_close(&o, 0, life, &report) != OK) return report.text;
    for (long i = 0; i < o.n; i++) {
        strcat(joined, i ? "|" : "");
        strcat(joined, points_value(&o, i, 0, buffer));
    }
    return joined;
}

static void test_lists(void **state)
{
    (void)state;
    assert_string_equal(values_of("k=[1]"), "1");
    assert_string_equal(values_of(" k = [ 1, \t2.50 ,x y]"), "1|2.50|x y");
    assert_string_equal(values_of("k=[[1, 2], {a: 3, b: (4, 5)}, \"6, ]\", '7,\"8', 9]"),
                        "[1, 2]|{a: 3, b: (4, 5)}|\"6, ]\"|'7,\"8'|9");
    assert_string_equal(values_of("k=[1, 2"), "--over 'k=[1, 2': a list ends with ]");
    assert_string_equal(values_of("k=[1, ,2]"), "--over 'k=[1, ,2]': an empty value in the list");
    assert_string_equal(values_of("k=[1,]"), "--over 'k=[1,]': an empty value in the list");
}

static void test_ranges(void **state)
{
    (void)state;
    assert_string_equal(values_of("k=0:1:5"), "0|0.25|0.5|0.75|1");
    assert_string_equal(values_of("k=2:-1:lin:4"), "2|1|0|-1");
    assert_string_equal(values_of("k=1:16:log:5"), "1|2|4|8|16");
    assert_string_equal(values_of("k=-1e-3:-1e3:log:3"), "-0.001|-1|-1000");
    assert_string_equal(values_of("k=3:7:1"), "3");
    assert_string_equal(values_of("k=3:7:log:2"), "3|7");
    assert_string_equal(values_of("k=1:2"), "--over 'k=1:2': a range is from:to:n or from:to:log:n");
    assert_string_equal(values_of("k=1"), "--over 'k=1': values are [a, b, ...], from:to:n or from:to:log:n");
    assert_string_equal(values_of("k=x:1:2"), "--over 'k=x:1:2': values are [a, b, ...], from:to:n or from:to:log:n");
    assert_string_equal(values_of("k=1:inf:3"), "--over 'k=1:inf:3': a range is from:to:n or from:to:log:n");
    assert_string_equal(values_of("k=-inf:1:3"), "--over 'k=-inf:1:3': a range is from:to:n or from:to:log:n");
    for (int i = 0; i < 4; i++) {
        static const char *const counts[] = {"k=1:2:0", "k=1:2:3x", "k=1:2:", "k=1:2:10000001"};
        assert_non_null(strstr(values_of(counts[i]), "a range ends with the number of its values"));
    }
    assert_non_null(strstr(values_of("k=0:1:log:3"), "both ends of a logarithmic range are of one sign and not 0"));
    assert_non_null(strstr(values_of("k=-1:1:log:3"), "both ends of a logarithmic range"));
}

static void test_names(void **state)
{
    (void)state;
    struct pointset o = {0};
    struct report report = {0};
    assert_string_equal(values_of("=[1]"), "--over '=[1]': expected name=values or name~distribution");
    assert_string_equal(values_of("k="), "--over 'k=': expected name=values or name~distribution");
    assert_string_equal(values_of("k"), "--over 'k': expected name=values or name~distribution");
    assert_int_equal(points_close(&o, 0, life, &report), E_USAGE);
    assert_string_equal(report.text, "a sweep needs --over 'name=values'");
    assert_int_equal(points_add(&o, "a=[1]", life, &report), OK);
    report = (struct report){0};
    assert_int_equal(points_add(&o, "a ~uniform(0,1)", life, &report), E_USAGE);
    assert_string_equal(report.text, "--over 'a ~uniform(0,1)': the name is given twice");
}

/* All combinations, the last factor fastest; so many draws for each. */
static void test_combinations(void **state)
{
    (void)state;
    struct pointset o = {.seed = 7};
    struct report report = {0};
    char buffer[POINT_TEXT], first[POINT_TEXT];
    assert_int_equal(points_add(&o, "a=[1, 2]", life, &report), OK);
    assert_int_equal(points_add(&o, "b=[x, y, z]", life, &report), OK);
    assert_int_equal(points_close(&o, 3, life, &report), E_USAGE);
    assert_string_equal(report.text, "--sample: nothing is drawn; --over 'name~normal(mean,deviation)'");
    assert_int_equal(points_add(&o, "c~uniform(10,14)", life, &report), OK);
    assert_int_equal(points_add(&o, "d=[u, v]", life, &report), OK);
    assert_int_equal(points_close(&o, 0, life, &report), E_USAGE);
    assert_int_equal(points_close(&o, 7, life, &report), OK);
    assert_true(o.n == 2 * 3 * 2 * 7 && o.draws == 7);
    for (long i = 0; i < o.n; i++) {
        const long combination = i / 7;
        static const char *const a[] = {"1", "2"}, *const b[] = {"x", "y", "z"}, *const d[] = {"u", "v"};
        assert_string_equal(points_value(&o, i, 0, buffer), a[combination / 6]);
        assert_string_equal(points_value(&o, i, 1, buffer), b[combination / 2 % 3]);
        assert_string_equal(points_value(&o, i, 3, buffer), d[combination % 2]);
        strcpy(first, points_value(&o, i % 7, 2, buffer));
        assert_string_equal(points_value(&o, i, 2, buffer), first); /* by the draw's number alone */
    }
    assert_true(fabs(strtod(points_value(&o, 5, 2, buffer), NULL) - (10 + 4 * 0.4716205358180655)) < 1e-12);
}

static void test_limit(void **state)
{
    (void)state;
    struct pointset o = {0};
    struct report report = {0};
    assert_int_equal(points_add(&o, "a=0:1:10000", life, &report), OK);
    assert_int_equal(points_add(&o, "b=0:1:1000", life, &report), OK);
    assert_int_equal(points_close(&o, 0, life, &report), OK);
    assert_int_equal(o.n, MOST_POINTS);
    assert_int_equal(points_add(&o, "c=[1, 2]", life, &report), OK);
    assert_int_equal(points_close(&o, 0, life, &report), E_USAGE);
    assert_string_equal(report.text, "2e+07 points: the limit is 10000000");
}

/* The generator's first number of Vigna's splitmix64 is 0xe220a8397b1dcdaf; the chain of three, worked out by itself. */
static void test_uniform(void **state)
{
    (void)state;
    assert_true(points_uniform(1, 0, 0) == 0.6935121390102293);
    assert_true(points_uniform(7, 2, 5) == 0.4716205358180655);
}

/* Quantiles by the inverse of the error function, 16 digits. */
static void test_normal(void **state)
{
    (void)state;
    static const double u[] = {.975, .25, .001, 1e-10, 1e-20, .9, .0764, .075},
                        x[] = {1.9599639845400536, -0.6744897501960817, -3.090232306167813,  -6.361340902404056,
                               -9.262340089798405, 1.2815515655446008,  -1.4297109367680978, -1.4395314709384557};
    for (int i = 0; i < 8; i++) assert_true(fabs(points_normal(u[i]) - x[i]) < 4e-15 * fabs(x[i]));
    assert_true(points_normal(.5) == 0);
}

/* The only draw of a factor. */
static double drawn(const char *text, double *u)
{
    struct pointset o = {.seed = 11};
    struct report report = {0};
    char buffer[POINT_TEXT];
    assert_int_equal(points_add(&o, text, life, &report), OK);
    assert_int_equal(points_close(&o, 1, life, &report), OK);
    *u = points_uniform(11, 0, 0);
    return strtod(points_value(&o, 0, 0, buffer), NULL);
}

static void test_distributions(void **state)
{
    (void)state;
    double u;
    struct pointset o = {0};
    struct report report = {0};
    const double n = drawn("k~normal(5,2)", &u), e = drawn("k~uniform(-3,1)", &u), l = drawn("k~loguniform(2,32)", &u);
    assert_true(fabs(n - (5 + 2 * points_normal(u))) < 1e-13);
    assert_true(fabs(e - (-3 + 4 * u)) < 1e-13);
    assert_true(fabs(l - 2 * pow(16, u)) < 1e-12);
    static const char *const bad[][2] = {
        {"k~normal(1)", "a distribution has two numbers, such as normal(1e4,1e3)"},
        {"k~normal(1,2", "a distribution has two numbers, such as normal(1e4,1e3)"},
        {"k~normal(,2)", "a distribution has two numbers, such as normal(1e4,1e3)"},
        {"k~normal(1,)", "a distribution has two numbers, such as normal(1e4,1e3)"},
        {"k~normal(1,inf)", "a distribution has two numbers, such as normal(1e4,1e3)"},
        {"k~uniform(nan,1)", "a distribution has two numbers, such as normal(1e4,1e3)"},
        {"k~cauchy(1,2)", "a distribution is normal(mean,deviation), uniform(from,to) or loguniform(from,to)"},
        {"k~normal(1,-2)", "a deviation is not negative"},
        {"k~loguniform(0,2)", "both ends of loguniform are of one sign and not 0"},
        {"k~loguniform(-1,2)", "both ends of loguniform are of one sign and not 0"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        report = (struct report){0};
        assert_int_equal(points_add(&o, bad[i][0], life, &report), E_USAGE);
        assert_non_null(strstr(report.text, bad[i][1]));
    }
    assert_int_equal(points_add(&o, "a~normal(1,0)", life, &report), OK);
    assert_int_equal(points_add(&o, "b~uniform(2,-2)", life, &report), OK);
    assert_int_equal(points_add(&o, "c~loguniform(-2,-1)", life, &report), OK);
}

/* Latin hypercube: each eighth once, in an order worked out by itself. */
static void test_latin(void **state)
{
    (void)state;
    static const int part[][8] = {{3, 2, 1, 5, 0, 4, 6, 7}, {3, 0, 6, 4, 1, 7, 5, 2}};
    struct pointset o = {.seed = 3, .latin = true};
    struct report report = {0};
    char buffer[POINT_TEXT];
    assert_int_equal(points_add(&o, "a~uniform(0,8)", life, &report), OK);
    assert_int_equal(points_add(&o, "b~uniform(0,8)", life, &report), OK);
    assert_int_equal(points_add(&o, "c=[1]", life, &report), OK);
    assert_int_equal(points_close(&o, 8, life, &report), OK);
    assert_null(o.factor[2].part);
    for (int f = 0; f < 2; f++)
        for (int i = 0; i < 8; i++) {
            const double x = strtod(points_value(&o, i, f, buffer), NULL);
            assert_int_equal((int)floor(x), part[f][i]);
            assert_true(fabs(x - part[f][i] - points_uniform(3, (uint64_t)f, (uint64_t)i)) < 1e-13);
        }
}

/* ---- what is kept ---- */

static struct wanted want(const char *list, enum status status, const char *words)
{
    struct wanted o = {0};
    struct report report = {0};
    assert_int_equal(wanted_read(&o, list, life, &report), status);
    if (words) assert_string_equal(report.text, words);
    return o;
}

#define KINDS_SAID "FUNCTION one of last, first, min, max, absmax, range, mean, rms"

static void test_wanted_words(void **state)
{
    (void)state;
    const struct wanted o = want("max(a.b_1), rms(x - 1),mean(c)", OK, NULL);
    assert_int_equal(o.n, 3);
    assert_string_equal(o.want[0].column, "a.b_1");
    assert_null(o.want[0].formula);
    assert_string_equal(o.want[1].column, "of2");
    assert_string_equal(o.want[1].formula, "x - 1");
    assert_string_equal(o.want[2].text, "mean(c)");
    want("maxx(a)", E_USAGE, "--of 'maxx(a)': expected FUNCTION(COLUMN); did you mean 'max'?, " KINDS_SAID);
    want("max", E_USAGE, "--of 'max': expected FUNCTION(COLUMN), " KINDS_SAID);
    want("max()", E_USAGE, "--of 'max()': expected FUNCTION(COLUMN), " KINDS_SAID);
    want("max(a", E_USAGE, "--of 'max(a': expected FUNCTION(COLUMN), " KINDS_SAID);
    want("", E_USAGE, "--of names nothing");
}

/* Records at t = 1, 2, 4 of x = 3, -5, 1: the mean of straight lines (-1 - 4)/3, the squares' (9 - 15 + 25)/3 + 2 (25 - 5 +
 * 1)/3 over 3 s. */
static void test_tallies(void **state)
{
    (void)state;
    static const double rows[][3] = {{1, 99, 3}, {2, 99, -5}, {4, 99, 1}};
    struct wanted o = want("last(x), first(x), min(x), max(x), absmax(x), range(x), mean(x), rms(x)", OK, NULL);
    const struct column columns[] = {{.name = "t"}, {.name = "y"}, {.name = "x"}};
    const double expected[] = {1, 3, -5, 3, 5, 8, -5. / 3, sqrt((19. / 3 + 14) / 3)};
    struct tally tally[8] = {{0}};
    struct report report = {0};
    assert_true(isnan(wanted_value(&tally[0], &o.want[0])));
    assert_int_equal(wanted_find(&o, columns, 3, &report), OK);
    wanted_add(tally, &o, rows[0]);
    assert_true(wanted_value(&tally[6], &o.want[6]) == 3 && wanted_value(&tally[7], &o.want[7]) == 3);
    wanted_add(tally, &o, rows[1]);
    wanted_add(tally, &o, rows[2]);
    for (int i = 0; i < 8; i++) assert_true(fabs(wanted_value(&tally[i], &o.want[i]) - expected[i]) < 1e-15 * 8);
    assert_int_equal(wanted_find(&o, columns, 2, &report), E_USAGE);
    assert_string_equal(report.text, "--of 'last(x)': no such column");
    const double lost[] = {5, 99, NAN}, found[] = {6, 99, 0};
    wanted_add(tally, &o, lost);
    wanted_add(tally, &o, found);
    assert_true(isnan(wanted_value(&tally[2], &o.want[2])) && isnan(wanted_value(&tally[3], &o.want[3])));
}

static void test_last_of_all(void **state)
{
    (void)state;
    const struct column columns[] = {{.name = "t"}, {.name = "y"}, {.name = "x"}};
    struct wanted o;
    wanted_last(&o, columns, 3, life);
    assert_int_equal(o.n, 2);
    assert_string_equal(o.want[1].text, "last(x)");
    assert_string_equal(o.want[1].column, "x");
    assert_int_equal(o.want[1].index, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lists),        cmocka_unit_test(test_ranges),        cmocka_unit_test(test_names),
        cmocka_unit_test(test_combinations), cmocka_unit_test(test_limit),         cmocka_unit_test(test_uniform),
        cmocka_unit_test(test_normal),       cmocka_unit_test(test_distributions), cmocka_unit_test(test_latin),
        cmocka_unit_test(test_wanted_words), cmocka_unit_test(test_tallies),       cmocka_unit_test(test_last_of_all)};
    return cmocka_run_group_tests(tests, open_arena, close_arena);
}
