/* t-read.c -- key tables filled from maps: every type, every refusal with its place, defaults that show when printed.
 */
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "deck/read.h" /* before cmocka.h, which has a macro fail */
#include "unit/told.h"

#include <cmocka.h>

struct thing {
    double mass, ratio, angle;
    int count, flag, word;
    const char *label;
    const struct node *shape;
    double along[3], about[3];
    struct points curve;
};

static const struct key keys[] = {
    PARAM_REAL(struct thing, mass, "mass", "kg", 0, INFINITY, KEY_REQUIRED | KEY_ABOVE, NULL, "how heavy"),
    PARAM_REAL(struct thing, ratio, "ratio", NULL, 0, 1, KEY_BELOW, "1/2", "in [0, 1)"),
    PARAM_REAL(struct thing, angle, "angle", "rad", -INFINITY, INFINITY, KEY_PLANAR, NULL, "turn in the plane"),
    PARAM_INT(struct thing, count, "count", 1, 100, 0, "3", "how many"),
    PARAM_BOOL(struct thing, flag, "flag", 0, "true", "yes or no"),
    PARAM_WORD(struct thing, word, "word", "newmark|midpoint|subcycle", 0, "midpoint", "a choice"),
    PARAM_TEXT(struct thing, label, "label", 0, "none", "words"),
    PARAM_NODE(struct thing, shape, "shape", "shape", KEY_SPATIAL, "its form"),
    KEYS_END,
};

static struct arena *arena;
static struct reader rd;
static char path[] = "/tmp/fmdsub-t-read.XXXXXX";

static int make_file(void **state)
{
    (void)state;
    int fd = mkstemp(path);
    return fd < 0 || close(fd);
}

static int drop_file(void **state)
{
    (void)state;
    return unlink(path);
}

static int setup(void **state)
{
    (void)state;
    arena = arena_open();
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    arena_close(arena);
    return 0;
}

/* The deck `parameters: {p: 5}, x: TEXT`; the value of x begins at 2:4. */
static struct node *value(const char *text)
{
    struct report report = {0};
    FILE *to = fopen(path, "w");
    fprintf(to, "parameters: {p: 5, width: 1}\nx: %s\n", text);
    fclose(to);
    rd = (struct reader){.diags = diags_open(arena)};
    assert_int_equal(deck_load(&rd.deck, path, NULL, rd.diags, arena, &report), OK);
    return node_find(rd.deck->root, "x");
}

static const char *messages(void)
{
    return told(rd.diags, arena);
}

static void whole_table(void **state)
{
    (void)state;
    struct thing x = {0};
    struct node *n = value("{mass: 2*p, ratio: 0.25, angle: 1, count: p + 2, flag: false, word: subcycle, "
                           "label: \"a b\", shape: {box: 1}, mine: 7}");
    rd.space = 0;
    assert_int_equal(read_keys(&x, keys, n, (const char *const[]){"mine", NULL}, "thing 'x'", &rd), 0);
    assert_string_equal(messages(), "");
    assert_true(x.mass == 10 && x.ratio == .25 && x.angle == 1 && x.count == 7 && x.flag == 0 && x.word == 2);
    assert_string_equal(x.label, "a b");
    assert_int_equal(x.shape->type, NODE_MAP);
}

static void defaults(void **state)
{
    (void)state;
    struct thing x = {.angle = 77};
    struct node *n = value("{mass: 1}");
    for (int again = 0; again < 2; again++) { /* the second time they are there already */
        assert_int_equal(read_keys(&x, keys, n, NULL, "thing 'x'", &rd), 0);
        assert_true(x.mass == 1 && x.ratio == .5 && x.angle == 77 && x.count == 3 && x.flag == 1 && x.word == 1);
        assert_true(x.shape == NULL);
        assert_string_equal(x.label, "none");
    }
    const struct key other[] = {PARAM_REAL(struct thing, mass, "mass", "kg", 0, 0, 0, NULL, ""), KEYS_END};
    assert_int_equal(read_keys(&x, other, n, NULL, "the same map for another table", &rd), 0);
    char *text;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    deck_print(to, rd.deck);
    fclose(to);
    assert_string_equal(text, "parameters:\n  p: 5\n  width: 1\nx:\n  mass: 1\n  ratio: 0.5\n  count: 3\n  flag: "
                              "true\n  word: midpoint\n  label: none\n");
    free(text);
}

/* {text, what the first message says, hint or NULL} for a thing with mass 1. */
static void refusals(void **state)
{
    (void)state;
    static const struct {
        int space;
        const char *text, *message, *hint;
    } list[] = {
        {0, "{mass: 1, masss: 2}", "2:14: error: unknown key 'masss' in thing 'x' [E-unknown-key]",
         "did you mean 'mass'?"},
        {0, "{mass: 1, mien: 2}", "2:14: error: unknown key 'mien' in thing 'x' [E-unknown-key]",
         "did you mean 'mine'?"},
        {0, "{mass: 1, zzzzzzzz: 2}", "2:14: error: unknown key 'zzzzzzzz' in thing 'x' [E-unknown-key]",
         "known here: mass, ratio, angle, count, flag, word, label, shape, mine"},
        {0, "{}", "2:1: error: thing 'x' has no 'mass' [E-missing-key]", "mass: how heavy [kg]"},
        {0, "[1]", "2:4: error: thing 'x': expected a map, found a list [E-type]", NULL},
        {0, "mass:1", "2:4: error: thing 'x': expected a map, found 'mass:1' [E-type]",
         "is a space missing after ':'?"},
        {0, "", "2:1: error: thing 'x': expected a map, found nothing [E-type]", NULL},
        {0, "{mass: heavy}", "2:11: error: expected a number, found 'heavy' [E-number]", "no parameter has this name"},
        {0, "{mass: widht}", "2:11: error: expected a number, found 'widht' [E-number]", "did you mean 'width'?"},
        {0, "{mass: 0}", "2:11: error: 'mass' must be above 0 kg, not 0 [E-range]", NULL},
        {0, "{mass: p - 6}", "2:11: error: 'mass' must be above 0 kg, not -1 [E-range]", NULL},
        {0, "{mass: 1, ratio: 1}", "2:21: error: 'ratio' must be at least 0 and below 1, not 1 [E-range]", NULL},
        {0, "{mass: 1, ratio: -1.0e-9}", "2:21: error: 'ratio' must be at least 0 and below 1, not -1.0e-09 [E-range]",
         NULL},
        {0, "{mass: 1, count: 2.5}", "2:21: error: 'count' must be a whole number, not 2.5 [E-integer]", NULL},
        {0, "{mass: 1, count: 99999999999}",
         "2:21: error: 'count' must be at most 2147483647 in size, not 99999999999 [E-integer]", NULL},
        {0, "{mass: 1, count: 101}", "2:21: error: 'count' must be at least 1 and at most 100, not 101 [E-range]",
         NULL},
        {0, "{mass: 1, flag: yes}", "2:20: error: expected true or false, found 'yes' [E-boolean]", "write true"},
        {0, "{mass: 1, flag: NO}", "2:20: error: expected true or false, found 'NO' [E-boolean]", "write false"},
        {0, "{mass: 1, flag: True}", "2:20: error: expected true or false, found 'True' [E-boolean]", "write true"},
        {0, "{mass: 1, flag: \"true\"}", "2:20: error: expected true or false, found 'true' [E-boolean]",
         "write true, without quotes"},
        {0, "{mass: 1, flag: 2}", "2:20: error: expected true or false, found '2' [E-boolean]", NULL},
        {0, "{mass: 1, word: newmarc}", "2:20: error: unknown word 'newmarc' for 'word' [E-choice]",
         "did you mean 'newmark'?"},
        {0, "{mass: 1, word: rk4}", "2:20: error: unknown word 'rk4' for 'word' [E-choice]",
         "known here: newmark, midpoint, subcycle"},
        {0, "{mass: 1, word: [newmark]}", "2:20: error: expected a text, found a list [E-type]", NULL},
        {0, "{mass: 1, label: }", "2:14: error: expected a text, found nothing [E-type]", NULL},
        {3, "{mass: 1, angle: 2}", "2:14: error: 'angle' is for 2-D decks; this one is 3-D [E-dimension]", NULL},
        {2, "{mass: 1, shape: 2}", "2:14: error: 'shape' is for 3-D decks; this one is 2-D [E-dimension]", NULL},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct thing x = {.mass = -1, .count = -1, .flag = -1, .word = -1};
        struct node *n = value(list[i].text);
        rd.space = list[i].space;
        assert_int_equal(read_keys(&x, keys, n, (const char *const[]){"mine", NULL}, "thing 'x'", &rd), 1);
        const char *got = messages(), *want = arena_print(arena, "%s:%s\n", path, list[i].message);
        if (strncmp(got, want, strlen(want))) fail_msg("%s\nwanted %s\ngot %s", list[i].text, want, got);
        if (list[i].hint ? !strstr(got, arena_print(arena, "| %s\n", list[i].hint))
                         : strstr(got, "did you mean") || strstr(got, "| write"))
            fail_msg("%s\nhint %s\ngot %s", list[i].text, list[i].hint, got);
        assert_int_equal(diags_errors(rd.diags), 1);
    }
    /* several at once */
    struct thing x;
    assert_int_equal(read_keys(&x, keys, value("{heft: 1, count: x, flag: 3}"), NULL, "thing 'x'", &rd), 4);
    assert_int_equal(diags_errors(rd.diags), 4);
    /* what is missing for a slip of spelling was told by that */
    assert_int_equal(read_keys(&x, keys, value("{masss: 1, count: x, flag: 3}"), NULL, "thing 'x'", &rd), 3);
    assert_int_equal(diags_errors(rd.diags), 3);
}

static void single(void **state)
{
    (void)state;
    double x[3] = {0};
    int i;
    assert_int_equal(read_vector(x, 3, value("[1, p, -p]"), "a point", &rd), 0);
    assert_true(x[0] == 1 && x[1] == 5 && x[2] == -5);
    assert_int_equal(read_vector(x, 3, value("[1, 2]"), "a point", &rd), 1);
    assert_non_null(strstr(messages(), ":2:4: error: a point: expected 3 numbers, found 2 [E-count]"));
    assert_int_equal(read_vector(x, 2, value("5"), "a point", &rd), 1);
    assert_non_null(strstr(messages(), ":2:4: error: a point: expected a list of 2 numbers, found '5' [E-type]"));
    assert_int_equal(read_vector(x, 2, value("[a, b]"), "a point", &rd), 1);
    assert_int_equal(diags_errors(rd.diags), 2);
    assert_int_equal(read_int(&i, value("1e1"), NULL, &rd), 0);
    assert_int_equal(i, 10);
    assert_int_equal(read_int(&i, value("-2147483647"), NULL, &rd), 0);
    assert_int_equal(i, -INT_MAX);
    assert_int_equal(read_int(&i, value("2147483648"), NULL, &rd), 1);
    read_unknown(value("rodd"), AT_VALUE, "E-unknown-body", "body", "rodd", (const char *const[]){"ground", "rod"}, 2,
                 &rd);
    assert_non_null(strstr(messages(), ":2:4: error: unknown body 'rodd' [E-unknown-body]\n    2 | x: rodd\n      |    "
                                       "^~~~\n      | did you mean 'rod'?\n"));
}

/* What is wrong in a repeated member is told once; its loop variable is known to numbers. */
static void copies(void **state)
{
    (void)state;
    struct thing x;
    struct node *n = value("\n  y$i: {repeat: {i: [1, 3]}, mass: i, cuont: 2}");
    for (int i = 0; i < 3; i++) {
        assert_int_equal(read_keys(&x, keys, n->item[i], NULL, arena_print(arena, "thing 'y%d'", i + 1), &rd), 1);
        assert_true(x.mass == i + 1);
    }
    assert_int_equal(diags_errors(rd.diags), 1);
    assert_non_null(strstr(messages(), ":3:39: error: unknown key 'cuont' in thing 'y1' [E-unknown-key]"));
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, setup, teardown)

static const struct key lists[] = {
    PARAM_VECTOR(struct thing, along, "along", "N/m", 0, INFINITY, 0, "along axes"),
    PARAM_VECTOR(struct thing, about, "about", "N m/rad", 0, INFINITY, KEY_ABOUT, "about axes"),
    PARAM_TABLE(struct thing, curve, "table", "[[x, y], ...]", 0, "points"),
    PARAM_CSV(struct thing, curve, "file", 0, "points in a file"),
    KEYS_END,
};

static void vectors(void **state)
{
    (void)state;
    struct thing x = {0};
    for (int space = 2; space <= 3; space++) {
        struct node *n = value(space == 2 ? "{along: [1, p], about: 7}" : "{along: [1, p, 3], about: [0, 0, 7]}");
        rd.space = space;
        assert_int_equal(read_keys(&x, lists, n, NULL, "thing 'x'", &rd), 0);
        assert_true(x.along[0] == 1 && x.along[1] == 5 && x.along[2] == (space == 2 ? 0 : 3));
        assert_true(x.about[0] == 0 && x.about[1] == 0 && x.about[2] == 7);
    }
    struct node *n = value("{along: [1, 2], about: [0, -1, 0]}");
    rd.space = 3;
    assert_int_equal(read_keys(&x, lists, n, NULL, "thing 'x'", &rd), 2);
    assert_non_null(strstr(messages(), "'along': expected 3 numbers, found 2"));
    assert_non_null(strstr(messages(), "2:31: error: 'about' must be at least 0 N m/rad, not -1"));
}

static void tables(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } wrong[] = {{"{table: [[0, 1], [0, 2]]}", "2:21: error: the first numbers of a table must increase: 0 after 0"},
                 {"{table: []}", "2:12: error: an empty table"},
                 {"{table: [[0, 1, 2]]}", "2:13: error: a row of 'table': expected 2 numbers, found 3"},
                 {"{file: nowhere.csv}", "2:11: error: 'nowhere.csv': No such file or directory"}};
    struct thing x = {0};
    struct node *n = value("{table: [[-1, 2], [0, p], [3, 1/2]]}");
    assert_int_equal(read_keys(&x, lists, n, NULL, "thing 'x'", &rd), 0);
    assert_true(x.curve.n == 3 && x.curve.x[0] == -1 && x.curve.y[1] == 5 && x.curve.x[2] == 3 && x.curve.y[2] == .5);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        n = value(wrong[i].text);
        assert_int_equal(read_keys(&x, lists, n, NULL, "thing 'x'", &rd), 1);
        if (!strstr(messages(), wrong[i].message)) fail_msg("%s: %s", wrong[i].text, messages());
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(whole_table), TEST(defaults), TEST(vectors), TEST(tables),
                                       TEST(refusals),    TEST(single),   TEST(copies)};
    return cmocka_run_group_tests(tests, make_file, drop_file);
}
