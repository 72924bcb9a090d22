/* t-deck.c -- decks from text to tree: places, aliases, include, --set, parameters, repeat, limits, printing that reads
 * back, files beside the deck, and a deck damaged byte by byte. */
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "deck/deck.h" /* before cmocka.h, which has a macro fail */
#include "unit/told.h"

#include <cmocka.h>

static struct arena *arena;
static struct diags *diags;
static struct report report;
static char folder[] = "/tmp/fmdsub-t-deck.XXXXXX";

/* Also between the cases of one test. */
static int setup(void **state)
{
    (void)state;
    arena_close(arena);
    arena = arena_open();
    diags = diags_open(arena);
    report = (struct report){0};
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    arena_close(arena);
    arena = NULL;
    return 0;
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : 1;
}

static int drop_folder(void **state)
{
    (void)state;
    char command[100];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return system(command);
}

static const char *path_of(const char *name)
{
    return arena_print(arena, "%s/%s", folder, name);
}

static const char *write_bytes(const char *name, const char *text, size_t len)
{
    const char *path = path_of(name);
    FILE *to = fopen(path, "w");
    if (len) fwrite(text, 1, len, to);
    fclose(to);
    return path;
}

static const char *write_text(const char *name, const char *text)
{
    return write_bytes(name, text, strlen(text));
}

static enum status load_set(struct deck **deck, const char *text, int nset, const char *const *set)
{
    struct deck_options options = {.nset = nset, .set = set};
    return deck_load(deck, write_text("deck.yaml", text), &options, diags, arena, &report);
}

static struct deck *good(const char *text)
{
    struct deck *deck = NULL;
    if (load_set(&deck, text, 0, NULL) != OK || diags_status(diags) != OK) {
        diags_print(stderr, diags, false);
        fail_msg("'%s' does not load", text);
    }
    return deck;
}

static const char *messages(void)
{
    return told(diags, arena);
}

/* The node at a path of keys and list numbers. */
static struct node *at(const struct deck *deck, const char *path)
{
    struct node *n = deck->root;
    char copy[200];
    snprintf(copy, sizeof copy, "%s", path);
    for (char *key = strtok(copy, "/"); key; key = strtok(NULL, "/")) {
        n = n->type == NODE_LIST ? n->item[atoi(key)] : node_find(n, key);
        if (!n) fail_msg("nothing at '%s' of '%s'", key, path);
    }
    return n;
}

static double number(struct deck *deck, const char *path)
{
    double x = NAN;
    if (deck_number(&x, at(deck, path), deck) != OK) fail_msg("%s: %s", path, messages());
    return x;
}

static const char *text_at(const struct deck *deck, const char *path)
{
    return at(deck, path)->text;
}

static void assert_marks(const struct node *n, int line, int col, int end_line, int end_col)
{
    assert_int_equal(n->mark.line, line);
    assert_int_equal(n->mark.col, col);
    assert_int_equal(n->end.line, end_line);
    assert_int_equal(n->end.col, end_col);
}

/* ---- the tree ---- */

static void marks(void **state)
{
    (void)state;
    struct deck *deck = good("a: 1\n"
                             "k\xc3\xa9y: \xc3\xa9l\n"
                             "map:\n"
                             "  list: [1, \"two\", {x: 3}]\n"
                             "  block:\n"
                             "    - u\n"
                             "    - v\n"
                             "end: |\n"
                             "  one\n"
                             "  two\n");
    assert_marks(at(deck, "a"), 1, 4, 1, 5);
    const struct node *n = at(deck, "k\xc3\xa9y");
    assert_marks(n, 2, 6, 2, 8);
    assert_true(n->key_mark.line == 2 && n->key_mark.col == 1 && n->key_end.col == 4);
    assert_marks(at(deck, "map/list"), 4, 9, 4, 27);
    assert_marks(at(deck, "map/list/1"), 4, 13, 4, 18);
    assert_true(at(deck, "map/list/1")->quoted && !at(deck, "map/list/0")->quoted);
    assert_marks(at(deck, "map/list/2/x"), 4, 24, 4, 25);
    assert_marks(at(deck, "map/block"), 6, 5, 7, 8);
    assert_string_equal(text_at(deck, "end"), "one\ntwo\n");
    assert_true(at(deck, "end")->quoted);
    assert_int_equal(at(deck, "map")->count, 2);
    assert_null(node_find(deck->root, "b"));
    assert_null(node_find(at(deck, "a"), "b"));
    assert_string_equal(deck->name, "deck");
}

static void aliases(void **state)
{
    (void)state;
    struct deck *deck = good("a: &a {x: [1, 2], y: &y 7}\nb: *a\nc: [*a, *y]\n");
    assert_int_equal(number(deck, "b/x/1"), 2);
    assert_int_equal(number(deck, "c/0/y"), 7);
    assert_int_equal(number(deck, "c/1"), 7);
    assert_ptr_not_equal(at(deck, "a/x"), at(deck, "b/x"));
    assert_ptr_not_equal(at(deck, "a/x/0"), at(deck, "c/0/x/0"));
    assert_marks(at(deck, "b"), 2, 4, 2, 6);
    /* 1000 levels, each an alias of the last, would be 1000 deep */
    char *text = TAKE(arena, char, 100000), *p = text;
    p += sprintf(p, "x0: &x0 [1]\n");
    for (int i = 1; i < 100; i++) p += sprintf(p, "x%d: &x%d [*x%d]\n", i, i, i - 1);
    assert_int_equal(load_set(&deck, text, 0, NULL), E_LIMIT);
    assert_non_null(
        strstr(messages(), "deck.yaml:64:12: error: lists and maps are nested more than 64 deep [E-limit-depth]"));
}

/* One below, on, above. */
static void limits(void **state)
{
    (void)state;
    struct deck *deck;
    static char text[4000000];
    for (int depth = MAX_DEPTH - 1; depth <= MAX_DEPTH + 1; depth++) {
        setup(NULL);
        char *p = text + sprintf(text, "a: ");
        for (int i = 1; i < depth; i++) *p++ = '[';
        for (int i = 1; i < depth; i++) *p++ = ']';
        *p = 0;
        assert_int_equal(load_set(&deck, text, 0, NULL), depth > MAX_DEPTH ? E_LIMIT : OK);
    }
    for (int n = MAX_ANCHORS - 1; n <= MAX_ANCHORS + 1; n++) {
        setup(NULL);
        char *p = text;
        for (int i = 0; i < n; i++) p += sprintf(p, "a%d: &a%d 1\n", i, i);
        assert_int_equal(load_set(&deck, text, 0, NULL), n > MAX_ANCHORS ? E_LIMIT : OK);
        setup(NULL);
        p = text + sprintf(text, "a: &a 1\nb: [");
        for (int i = 0; i < n; i++) p += sprintf(p, "*a,");
        strcpy(p, "]\n");
        assert_int_equal(load_set(&deck, text, 0, NULL), n > MAX_ANCHORS ? E_LIMIT : OK);
    }
    for (int n = MAX_NODES - 1; n <= MAX_NODES + 1; n++) { /* root, list, items */
        setup(NULL);
        char *p = text + sprintf(text, "a: [");
        for (int i = 0; i < n - 2; i++) p += sprintf(p, "1,");
        strcpy(p, "]\n");
        assert_int_equal(load_set(&deck, text, 0, NULL), n > MAX_NODES ? E_LIMIT : OK);
    }
    for (int n = MAX_SCALAR - 1; n <= MAX_SCALAR + 1; n++) {
        setup(NULL);
        char *p = text + sprintf(text, "a: ");
        memset(p, 'x', (size_t)n);
        p[n] = 0;
        assert_int_equal(load_set(&deck, text, 0, NULL), n > MAX_SCALAR ? E_LIMIT : OK);
    }
    setup(NULL);
    struct deck_options small = {.max_bytes = 10};
    assert_int_equal(deck_load(&deck, write_text("small.yaml", "a: 1234567"), &small, diags, arena, &report), OK);
    assert_int_equal(deck_load(&deck, write_text("small.yaml", "a: 12345678"), &small, diags, arena, &report), E_LIMIT);
    assert_non_null(strstr(report.text, "small.yaml: larger than 10 bytes"));
}

/* ---- numbers ---- */

static void numbers(void **state)
{
    (void)state;
    struct deck *deck = good("parameters: {l: 2, w: 2*l + m, m: \"max(l, 3)\", \"q\": -l}\n"
                             "a: [1, -0, +1, .5, 5., 1e3, 1.5E-2, -.5e+1, 1.0e+3, \"2\", l, -l, 2*w^2, \" 3 \"]\n");
    const double want[] = {1, -0., 1, .5, 5, 1000, .015, -5, 1000, 2, 2, -2, 98, 3};
    for (int i = 0; i < 14; i++) {
        double x = number(deck, arena_print(arena, "a/%d", i));
        assert_memory_equal(&x, &want[i], sizeof x);
        assert_true(at(deck, arena_print(arena, "a/%d", i))->has_value);
    }
    double w;
    assert_int_equal(deck_parameter(&w, "w", deck), 0);
    assert_true(w == 7);
    assert_int_equal(deck_parameter(&w, "v", deck), 1);
    assert_int_equal(diags_warnings(diags), 0);
    deck = good("a: 1e-320\n");
    assert_true(number(deck, "a") == 1e-320);
    assert_non_null(strstr(messages(), "deck.yaml:1:4: warning: "));
}

static void number_errors(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } list[] = {
        {"heavy", "1:4: error: expected a number, found 'heavy' [E-number]"},
        {"lenght", "1:4: error: expected a number, found 'lenght' [E-number]"},
        {"", "1:1: error: expected a number, found nothing [E-type]"},
        {"~", "1:1: error: expected a number, found nothing [E-type]"},
        {"\"\"", "1:4: error: expected a number, found an empty text [E-type]"},
        {"[1]", "1:4: error: expected a number, found a list [E-type]"},
        {"{b: 1}", "1:4: error: expected a number, found a map [E-type]"},
        {"yes", "1:4: error: expected a number, found 'yes' [E-number]"},
        {"0x10", "1:4: error: '0x10' is not a number: only decimal numbers are read [E-number]"},
        {"-0b1", "1:4: error: '-0b1' is not a number: only decimal numbers are read [E-number]"},
        {"010", "1:4: error: '010' is not a number: a number does not begin with 0 [E-number]"},
        {"1_000", "1:4: error: '1_000' is not a number: a number cannot be followed by '_000' [E-number]"},
        {"1,5", "1:4: error: '1,5' is not a number: expected an operator, found ',' [E-number]"},
        {"1.5e", "1:4: error: '1.5e' is not a number: the exponent has no digits [E-number]"},
        {"1 2", "1:4: error: '1 2' is not a number: expected an operator, found '2' [E-number]"},
        {"12:30", "1:4: error: '12:30' is not a number: expected an operator, found ':' [E-number]"},
        {"1e400", "1:4: error: '1e400' is not a number: out of range: the largest number is 1.8e308 [E-number]"},
        {"-1e400", "1:4: error: '-1e400' is not a number: out of range: the largest number is 1.8e308 [E-number]"},
        {"1e-400", "1:4: error: '1e-400' is not a number: out of range: the smallest number is 4.9e-324 [E-number]"},
        {".nan", "1:4: error: '.nan' is not a number: it is not finite [E-number]"},
        {"-Infinity", "1:4: error: '-Infinity' is not a number: it is not finite [E-number]"},
        {"5 kg", "1:4: error: '5 kg' is not a number: expected an operator, found 'kg' [E-number]"},
        {"30deg", "1:4: error: '30deg' is not a number: a number cannot be followed by 'deg' [E-number]"},
        {"\xd9\xa1", "1:4: error: expected a number or a name, found '\xd9\xa1' [E-expression]"},
        {"2*lenght", "1:6: error: unknown name 'lenght' [E-expression]"},
        {"\"2*lenght\"", "1:7: error: unknown name 'lenght' [E-expression]"},
        {"'1 + (2'", "1:11: error: expected ')', found the end [E-expression]"},
        {"\"2*\\x6cenght\"", "1:4: error: unknown name 'lenght' [E-expression]"},
        {"2*\n  lenght", "1:4: error: unknown name 'lenght' [E-expression]"},
        {"1/(2 - 2)", "1:5: error: division by zero [E-expression]"},
        {"sqrt(-1)", "1:4: error: 'sqrt' gives no finite number here [E-expression]"},
        {"1e308*10", "1:9: error: '*' gives no finite number here [E-expression]"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct deck *deck;
        double x;
        setup(NULL);
        assert_int_equal(load_set(&deck, arena_print(arena, "a: %s\nparameters: {length: 1}\n", list[i].text), 0, NULL),
                         OK);
        assert_int_equal(diags_errors(diags), 0);
        assert_int_equal(deck_number(&x, at(deck, "a"), deck), E_DECK);
        const char *got = messages(), *from = strstr(got, "deck.yaml:") + strlen("deck.yaml:");
        if (strncmp(from, list[i].message, strlen(list[i].message)))
            fail_msg("wanted %s\ngot %s", list[i].message, got);
        if (strstr(list[i].text, "enght")) assert_non_null(strstr(got, "did you mean 'length'?"));
        int before = diags_errors(diags);
        assert_int_equal(deck_number(&x, at(deck, "a"), deck), E_DECK); /* told once */
        assert_int_equal(diags_errors(diags), before);
    }
    setup(NULL);
}

static int find_t(void *self, int *slot, double *value, const char *name, struct expr_error *error)
{
    (void)self, (void)value, (void)error;
    *slot = 0;
    return strcmp(name, "t") != 0;
}

static void formulas(void **state)
{
    (void)state;
    struct deck *deck = good("parameters: {w: 3}\n"
                             "forces:\n"
                             "  f$i: {repeat: {i: [1, 2]}, value: w*t + i}\n"
                             "bad: 2*T\n");
    struct expr_names names = {.find = find_t, .self = NULL};
    struct expr *e;
    assert_int_equal(deck_expr(&e, at(deck, "forces/f2/value"), &names, deck), OK);
    assert_true(expr_value(e, (double[]){10}) == 32);
    assert_int_equal(deck_expr(&e, at(deck, "bad"), &names, deck), E_DECK);
    assert_non_null(strstr(messages(), "deck.yaml:4:8: error: unknown name 'T' [E-expression]"));
}

static void parameters(void **state)
{
    (void)state;
    struct deck *deck;
    /* a long chain in the worst order needs no deep stack */
    char *text = TAKE(arena, char, 3000000), *p = text + sprintf(text, "parameters:\n");
    const int n = 20000;
    for (int i = 0; i < n; i++) p += sprintf(p, "  p%05d: p%05d + 1\n", i, i + 1);
    sprintf(p, "  p%05d: 1\nx: p00000\n", n);
    deck = good(text);
    assert_true(number(deck, "x") == n + 1);
    setup(NULL);
    assert_int_equal(load_set(&deck, "parameters: {a: b, b: c + 1, c: 2*b, d: a + 1, e: 2}\nx: d\ny: e\n", 0, NULL),
                     OK);
    assert_int_equal(diags_errors(diags), 1); /* who needs a circle is not told again */
    assert_non_null(strstr(messages(), "parameters in a circle: b -> c -> b [E-cycle]"));
    double x;
    assert_int_equal(deck_number(&x, at(deck, "x"), deck), E_DECK);
    assert_int_equal(diags_errors(diags), 1);
    assert_true(number(deck, "y") == 2);
    setup(NULL);
    assert_int_equal(load_set(&deck, "parameters: {a: a}\n", 0, NULL), OK);
    assert_non_null(strstr(messages(), "deck.yaml:1:17: error: parameters in a circle: a -> a [E-cycle]"));
    setup(NULL);
    assert_int_equal(load_set(&deck, "parameters: {sin: 1, 2x: 1, x.y: 1, t: 1}\n", 0, NULL), OK);
    assert_int_equal(diags_errors(diags), 4);
}

/* ---- repeat ---- */

static void repeats(void **state)
{
    (void)state;
    struct deck *deck =
        good("parameters: {N: 3}\n"
             "bodies:\n"
             "  first: {mass: 1}\n"
             "  link$i: {repeat: {i: [1, N]}, mass: i^2, names: [link$(i-1), \"a$i b\", plain], more: {x: 2*i}}\n"
             "  last: {mass: 2}\n"
             "none:\n"
             "  none$i: {repeat: {i: [1, N - 3]}, mass: 1}\n"
             "grid:\n"
             "  p$(i)_$j: {repeat: {i: [0, 1], j: [i, 2]}, at: [i, j]}\n"
             "outer:\n"
             "  o$i:\n"
             "    repeat: {i: [1, 2]}\n"
             "    inner:\n"
             "      n$(j)of$i: {repeat: {j: [1, i]}, x: 10*i + j, y: $i$j}\n");
    assert_int_equal(at(deck, "bodies")->count, 5);
    assert_string_equal(at(deck, "bodies")->item[2]->key, "link2");
    assert_true(number(deck, "bodies/link3/mass") == 9);
    assert_true(number(deck, "bodies/link3/more/x") == 6);
    assert_string_equal(text_at(deck, "bodies/link2/names/0"), "link1");
    assert_string_equal(text_at(deck, "bodies/link2/names/1"), "a2 b");
    assert_string_equal(text_at(deck, "bodies/link2/names/2"), "plain");
    assert_null(node_find(at(deck, "bodies/link1"), "repeat"));
    assert_int_equal(at(deck, "none")->count, 0);
    assert_int_equal(at(deck, "grid")->count, 5);
    assert_true(number(deck, "grid/p1_2/at/0") == 1 && number(deck, "grid/p1_2/at/1") == 2);
    assert_int_equal(at(deck, "outer/o1/inner")->count, 1);
    assert_int_equal(at(deck, "outer/o2/inner")->count, 2);
    assert_true(number(deck, "outer/o2/inner/n2of2/x") == 22);
    assert_string_equal(text_at(deck, "outer/o2/inner/n2of2/y"), "22");
    assert_int_equal(at(deck, "bodies/link2")->mark.line, 4);
}

static void repeat_errors(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } list[] = {
        {"a$i: 1", "1:1: error: 'a$i': unknown name 'i' [E-repeat]"},
        {"a$i: {x: 1}", "1:1: error: 'a$i' has no repeat: [E-repeat]"},
        {"a$i: {repeat: 3}", "1:15: error: expected one to four variables with ranges: {i: [1, 10]} [E-repeat]"},
        {"a$i: {repeat: {}}", "1:15: error: expected one to four variables with ranges: {i: [1, 10]} [E-repeat]"},
        {"a$i: {repeat: {i: 3}}", "1:19: error: expected the first and last value of 'i': [1, 10] [E-repeat]"},
        {"a$i: {repeat: {i: [1, 2, 3]}}", "1:19: error: expected the first and last value of 'i': [1, 10] [E-repeat]"},
        {"a$i: {repeat: {i: [1, x]}}", "1:23: error: expected a number, found 'x' [E-number]"},
        {"a$i: {repeat: {i: [0.5, 2]}}", "1:20: error: expected a whole number, found 0.5 [E-integer]"},
        {"a$i: {repeat: {i: [3, 1]}}", "1:19: error: the range runs backwards: 3 to 1 [E-repeat]"},
        {"a$i: {repeat: {i: [1, 2e9]}}", "1:23: error: expected a whole number, found 2e+09 [E-integer]"},
        {"a$i: {repeat: {t: [1, 2]}}", "1:16: error: 't' cannot be a parameter: it is the time [E-repeat]"},
        {"a: {repeat: {i: [1, 2]}}",
         "1:5: error: the key 'a' of a repeated member needs its variable: 'a$i' [E-repeat]"},
        {"a$j: {repeat: {i: [1, 2]}}", "1:1: error: key 'a$j' is given twice [E-duplicate]"},
        {"a$i: {repeat: {i: [1, 2]}, x: b$(i}", "1:31: error: 'b$(i': expected $i or $(i - 1) [E-repeat]"},
        {"a$i: {repeat: {i: [1, 2]}, x: \"b$(i\"}", "1:31: error: 'b$(i': expected $i or $(i - 1) [E-repeat]"},
        {"a$i: {repeat: {i: [1, 2]}, x: b$(i/2)}", "1:31: error: 'b$(i/2)': 0.5 is not a whole number [E-repeat]"},
        {"a$i: {repeat: {i: [1, 2]}, x: $ 5}", "1:31: error: '$ 5': expected $i or $(i - 1) [E-repeat]"},
        {"a$i: {repeat: {i: [1, 2]}}\na2: 1", "2:1: error: key 'a2' is given twice [E-duplicate]"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct deck *deck;
        setup(NULL);
        assert_int_equal(load_set(&deck, list[i].text, 0, NULL), OK);
        if (!strstr(messages(), arena_print(arena, "deck.yaml:%s", list[i].message)))
            fail_msg("%s\nwanted %s\ngot %s", list[i].text, list[i].message, messages());
    }
    setup(NULL);
    struct deck *deck;
    assert_int_equal(load_set(&deck, "a$i: {repeat: {i: [1, 100000]}}\n", 0, NULL), OK);
    assert_int_equal(deck->root->count, MAX_COPIES);
    assert_int_equal(load_set(&deck, "a$i: {repeat: {i: [1, 100001]}}\n", 0, NULL), E_LIMIT);
}

/* ---- --set ---- */

static void settings(void **state)
{
    (void)state;
    struct deck *deck;
    static const char text[] = "parameters: {N: 2}\n"
                               "bodies:\n"
                               "  rod: {mass: 1, at: [1, 2]}\n"
                               "  link$i: {repeat: {i: [1, N]}, mass: i}\n"
                               "  odd.name: {mass: 1, \"a.b\": {c: 1}}\n"
                               "initial: {hub.angle: 0.5}\n";
    static const char *const set[] = {"parameters.N=3",
                                      "bodies.rod.mass=2*N",
                                      "bodies.rod.at.1=7",
                                      "bodies.link3.mass=30",
                                      "bodies.link$i.extra=i+1",
                                      "bodies.odd.name.a.b.c=5",
                                      "initial.hub.angle=0.25",
                                      "initial.hub.rate=1",
                                      "integrate.step=1e-3",
                                      "output={every: 0.1, columns: [a, \"b\"]}",
                                      "bodies.\"odd.name\".mass=9"};
    assert_int_equal(load_set(&deck, text, 11, set), OK);
    assert_string_equal(messages(), "");
    assert_true(number(deck, "bodies/rod/mass") == 6);
    assert_true(number(deck, "bodies/rod/at/1") == 7);
    assert_true(number(deck, "bodies/link3/mass") == 30);
    assert_true(number(deck, "bodies/link2/mass") == 2);
    assert_true(number(deck, "bodies/link2/extra") == 3);
    assert_true(number(deck, "bodies/odd.name/a.b/c") == 5);
    assert_true(number(deck, "bodies/odd.name/mass") == 9);
    assert_true(number(deck, "initial/hub.angle") == .25);
    assert_true(number(deck, "initial/hub.rate") == 1);
    assert_true(number(deck, "integrate/step") == 1e-3);
    assert_string_equal(text_at(deck, "output/columns/1"), "b");
    static const char *const bad[] = {"nonsense", "=1",     "bodies.rod.at.2=1",    "bodies.rod.mass.x=1",
                                      "a=[1",     "b=\xff", "bodies.rod.mass=heavy"};
    static const char *const wanted[] = {
        "--set:1:1: error: expected path=value [E-set]\n    1 | nonsense\n      | ^~~~~~~~\n",
        "--set:1:1: error: expected path=value [E-set]",
        "--set:1:1: error: no item '2' in a list of 2 [E-set]",
        "--set:1:1: error: 'x' is below a value that is not a map [E-set]",
        "--set:1:5: error: expected ',' or ']' [E-unclosed]",
        "--set:1:3: error: a character that cannot be in a deck [E-character]",
        "--set:1:17: error: expected a number, found 'heavy' [E-number]",
    };
    for (int i = 0; i < 7; i++) {
        double x;
        setup(NULL);
        assert_int_equal(load_set(&deck, text, 1, bad + i), OK);
        (void)deck_number(&x, at(deck, "bodies/rod/mass"), deck); /* the text is judged */
        if (!strstr(messages(), wanted[i])) fail_msg("wanted %s\ngot %s", wanted[i], messages());
    }
    setup(NULL);
    char *deep = TAKE(arena, char, 5000);
    for (int i = 0; i < 1000; i++) memcpy(deep + 2 * i, "a.", 2);
    strcpy(deep + 2000, "a=1");
    assert_int_equal(load_set(&deck, text, 1, (const char *const[]){deep}), OK);
    assert_int_equal(diags_status(diags), E_DECK);
}

/* ---- include ---- */

static void includes(void **state)
{
    (void)state;
    mkdir(path_of("sub"), 0777);
    write_text("sub/inner.yaml", "gravity: [0, -1]\nbodies: {c: {mass: 3}}\n");
    write_text("sub/part.yaml",
               "include: inner.yaml\nbodies: {a: {mass: 1, x: 1}, b: {mass: 2}}\nparameters: {p: 5, q: 1}\n");
    write_text("twin.yaml", "bodies: {b: {mass: 2, y: 1}}\n");
    struct deck *deck = good("include: [sub/part.yaml, twin.yaml]\nbodies: {a: {mass: p}}\nparameters: {q: 2}\n");
    assert_null(node_find(deck->root, "include"));
    assert_true(number(deck, "bodies/a/mass") == 5); /* the deck's own value wins */
    assert_true(number(deck, "bodies/a/x") == 1);
    assert_true(number(deck, "bodies/b/mass") == 2);
    assert_true(number(deck, "bodies/b/y") == 1);
    assert_true(number(deck, "bodies/c/mass") == 3);
    assert_true(number(deck, "gravity/1") == -1);
    assert_true(number(deck, "parameters/q") == 2);
    assert_string_equal(diags_source(diags, at(deck, "bodies/c")->file)->path, "sub/inner.yaml");
    uint64_t hash = deck->hash;
    write_text("twin.yaml", "bodies: {b: {mass: 2, y: 2}}\n");
    deck = good("include: [sub/part.yaml, twin.yaml]\nbodies: {a: {mass: p}}\nparameters: {q: 2}\n");
    assert_true(deck->hash != hash);
    write_text("twin.yaml",
               "gravity: {x: 3}\nbodies: {a: {mass: 7, x: 8}, b: {mass: 9}}\nparameters: {p: 6}\n"); /* it differs */
    deck = good("include: [sub/part.yaml, twin.yaml]\ngravity: [0, -2]\n"
                "bodies: {a: {mass: p, x: 4}, b: {mass: 5}}\nparameters: {p: 3}\n");
    assert_true(number(deck, "bodies/a/mass") == 3);
    assert_true(number(deck, "bodies/a/x") == 4);
    assert_true(number(deck, "bodies/b/mass") == 5);
    assert_true(number(deck, "gravity/1") == -2);
    setup(NULL);
    assert_int_equal(load_set(&deck, "include: [sub/part.yaml, twin.yaml]\nbodies: {a: {mass: 1}}\n", 0, NULL), OK);
    assert_non_null(strstr(messages(), "differ in 'x'"));
    assert_non_null(strstr(messages(), "differ in 'p'"));
    assert_non_null(strstr(messages(), "differ in 'gravity'"));
}

static void include_errors(void **state)
{
    (void)state;
    struct deck *deck;
    static const char *const bad[][2] = {
        {"/etc/passwd", "1:10: error: '/etc/passwd': is outside the deck's folder [E-path]"},
        {"sub/../../x.yaml", "1:10: error: 'sub/../../x.yaml': is outside the deck's folder [E-path]"},
        {"out.yaml", "1:10: error: 'out.yaml': is outside the deck's folder [E-path]"},
        {"out/passwd", "1:10: error: 'out/passwd': is outside the deck's folder [E-path]"},
        {"none.yaml", "1:10: error: 'none.yaml': No such file or directory [E-path]"},
        {"sub", "1:10: error: 'sub': is not a regular file [E-path]"},
        {"fifo", "1:10: error: 'fifo': is not a regular file [E-path]"},
        {"deck.yaml", "1:10: error: files include each other: "},
        {"", "1:1: error: expected a file name, found nothing [E-include]"},
        {"[[a]]", "1:11: error: expected a file name, found a list [E-include]"},
    };
    mkdir(path_of("sub"), 0777);
    if (symlink("/etc/passwd", path_of("out.yaml")) && errno != EEXIST) fail_msg("symlink");
    if (symlink("/etc", path_of("out")) && errno != EEXIST) fail_msg("symlink");
    if (symlink("sub/target.yaml", path_of("in.yaml")) && errno != EEXIST) fail_msg("symlink");
    mkfifo(path_of("fifo"), 0666);
    write_text("sub/target.yaml", "x: 1\n");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        setup(NULL);
        assert_int_equal(load_set(&deck, arena_print(arena, "include: %s\n", bad[i][0]), 0, NULL), OK);
        if (!strstr(messages(), bad[i][1])) fail_msg("wanted %s\ngot %s", bad[i][1], messages());
    }
    setup(NULL);
    assert_true(number(good("include: in.yaml\n"), "x") == 1); /* a link that stays inside */
    assert_int_equal(load_set(&deck, arena_print(arena, "include: %05000d\n", 1), 0, NULL), OK);
    assert_non_null(strstr(messages(), "its name is empty or too long"));
    setup(NULL);
    write_text("broken.yaml", "a: [1\n");
    assert_int_equal(load_set(&deck, "include: broken.yaml\n", 0, NULL), OK);
    assert_non_null(strstr(messages(), "broken.yaml:"));
    /* 16 deep and no more */
    for (int n = INCLUDE_DEPTH; n <= INCLUDE_DEPTH + 1; n++) {
        setup(NULL);
        for (int i = 1; i < n; i++)
            write_text(arena_print(arena, "d%d.yaml", i), arena_print(arena, "include: d%d.yaml\n", i + 1));
        write_text(arena_print(arena, "d%d.yaml", n), "x: 1\n");
        assert_int_equal(load_set(&deck, "include: d1.yaml\n", 0, NULL), OK);
        assert_int_equal(diags_status(diags), n > INCLUDE_DEPTH ? E_DECK : OK);
    }
}

/* ---- printing ---- */

static bool same_tree(const struct node *a, const struct node *b)
{
    if (a->type != b->type || a->count != b->count) return false;
    if (a->type == NODE_SCALAR) return (node_is_null(a) && node_is_null(b)) || !strcmp(a->text, b->text);
    for (int i = 0; i < a->count; i++) {
        if (a->type == NODE_MAP && strcmp(a->item[i]->key, b->item[i]->key)) return false;
        if (!same_tree(a->item[i], b->item[i])) return false;
    }
    return true;
}

static const char *printed(const struct deck *deck)
{
    char *text;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    deck_print(to, deck);
    fclose(to);
    const char *copy = arena_copy(arena, text, size);
    free(text);
    return copy;
}

static void prints(void **state)
{
    (void)state;
    struct deck *deck =
        good("parameters: {N: 2, w: 0.1 + 0.2}\n"
             "title: \"a: b # c\"\n"
             "bodies:\n"
             "  link$i: {repeat: {i: [1, N]}, mass: i/10, at: [i - 0.5, 0], f: i*t, names: [link$i, \"a b\"]}\n"
             "table: [[0, 1], [2, 3]]\n"
             "empty: {}\n");
    struct expr *e;
    for (int i = 1; i <= 2; i++) {
        number(deck, arena_print(arena, "bodies/link%d/mass", i));
        number(deck, arena_print(arena, "bodies/link%d/at/0", i));
        assert_int_equal(deck_expr(&e, at(deck, arena_print(arena, "bodies/link%d/f", i)),
                                   &(struct expr_names){.find = find_t, .self = NULL}, deck),
                         OK);
    }
    assert_string_equal(printed(deck), "parameters:\n"
                                       "  N: 2\n"
                                       "  w: 0.30000000000000004\n"
                                       "title: \"a: b # c\"\n"
                                       "bodies:\n"
                                       "  link1:\n"
                                       "    mass: 0.1\n"
                                       "    at: [0.5, 0]\n"
                                       "    f: 1*t\n"
                                       "    names: [link1, \"a b\"]\n"
                                       "  link2:\n"
                                       "    mass: 0.2\n"
                                       "    at: [1.5, 0]\n"
                                       "    f: 2*t\n"
                                       "    names: [link2, \"a b\"]\n"
                                       "table:\n"
                                       "  - [0, 1]\n"
                                       "  - [2, 3]\n"
                                       "empty: {}\n");
    deck = good("a: [1e-5, 1e22, 1.5e300, 123456789, 0.1, -0, 1e15]\n");
    for (int i = 0; i < 7; i++) number(deck, arena_print(arena, "a/%d", i));
    assert_string_equal(printed(deck), "a: [1.0e-05, 1.0e+22, 1.5e+300, 123456789, 0.1, -0, 1.0e+15]\n");
}

static uint64_t seed = 1;

static int dice(int n)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (int)((double)(seed >> 11) * 0x1p-53 * n);
}

static char *nasty(void)
{
    static const char *const pieces[] = {"a",        "-",    "- ",  ":",   ": ",  "#",        " #",
                                         "'",        "\"",   "\\",  "[",   "}",   ",",        "&",
                                         "*",        "!",    "|",   ">",   "%",   "@",        "`",
                                         "\n",       "\t",   " ",   "?",   "~",   "=",        "<<",
                                         "$",        "null", "1e3", "...", "---", "\xc3\xa9", "\xe2\x80\xa8",
                                         "\xc2\x85", "yes",  "0x1", "{",   "\r",  "\x1b",     "\xf0\x9f\x98\x80"};
    char text[200] = "";
    for (int i = dice(6); i >= 0; i--) strcat(text, pieces[dice(42)]);
    return arena_copy(arena, text, strlen(text));
}

static struct node *random_node(int depth)
{
    struct node *n = TAKE(arena, struct node, 1);
    n->type = depth > 0 ? (enum node_type)dice(3) : NODE_SCALAR;
    n->text = n->type == NODE_SCALAR && dice(10) ? nasty() : "";
    n->len = strlen(n->text);
    n->quoted = n->type == NODE_SCALAR && (n->len > 0 || dice(2));
    if (n->type == NODE_SCALAR) return n;
    n->count = dice(4);
    n->item = TAKE(arena, struct node *, n->count);
    for (int i = 0; i < n->count; i++) {
        n->item[i] = random_node(depth - 1);
        char *key = nasty();
        for (char *p = key; (p = strchr(p, '$'));) *p = '+'; /* $ in keys is for repeat: */
        if (n->type == NODE_MAP)
            n->item[i]->key =
                arena_print(arena, "%d%s%.*s", i, key, dice(30) ? 0 : 1200, arena_print(arena, "%01200d", 1));
    }
    return n;
}

/* Any tree reads back as itself. */
static void reads_back(void **state)
{
    (void)state;
    long nodes = 0;
    for (int trial = 0; trial < 3000; trial++) {
        setup(NULL);
        struct deck deck = {.root = random_node(5)}, *again;
        if (deck.root->type == NODE_MAP) {
            const char *text = printed(&deck);
            bool fine =
                load_set(&again, text, 0, NULL) == OK && diags_status(diags) == OK && same_tree(deck.root, again->root);
            if (!fine) fail_msg("%s\n%s", text, messages());
            nodes += again->pool.nodes;
        }
    }
    assert_true(nodes > 5000);
}

/* ---- files ---- */

static void files(void **state)
{
    (void)state;
    struct deck *deck;
    assert_int_equal(deck_load(&deck, path_of("none.yaml"), NULL, diags, arena, &report), E_FILE);
    assert_non_null(strstr(report.text, "/none.yaml: No such file or directory"));
    report = (struct report){0};
    assert_int_equal(deck_load(&deck, folder, NULL, diags, arena, &report), E_FILE);
    assert_string_equal(report.text, arena_print(arena, "%s: is a directory", folder));
    assert_null(deck);
    report = (struct report){0};
    assert_int_equal(deck_load(&deck, "/dev/zero", NULL, diags, arena, &report), E_LIMIT);
    assert_string_equal(report.text, "/dev/zero: larger than 16777216 bytes");
    if (geteuid() != 0) {
        const char *path = write_text("secret.yaml", "a: 1\n");
        chmod(path, 0);
        report = (struct report){0};
        assert_int_equal(deck_load(&deck, path, NULL, diags, arena, &report), E_FILE);
    }
    /* a pipe that gives its bytes in pieces, as stdin */
    int ends[2], keep = dup(STDIN_FILENO);
    assert_int_equal(pipe(ends), 0);
    if (fork() == 0) {
        for (const char *p = "\xef\xbb\xbf"
                             "fmdsub: 1\r\nx: [1, 2]\r\n";
             *p; p++)
            if (write(ends[1], p, 1) != 1) _exit(1);
        _exit(0);
    }
    close(ends[1]);
    dup2(ends[0], STDIN_FILENO);
    report = (struct report){0};
    assert_int_equal(deck_load(&deck, "-", NULL, diags, arena, &report), OK);
    dup2(keep, STDIN_FILENO);
    close(ends[0]), close(keep);
    assert_true(number(deck, "x/1") == 2);
    assert_string_equal(deck->path, "<stdin>");
    assert_int_equal(at(deck, "fmdsub")->key_mark.col, 1); /* the byte order mark does not count */
}

static void tables(void **state)
{
    (void)state;
    struct deck *deck = good("file: table.csv\n");
    double *x;
    int rows;
    write_text("table.csv", "# made by hand\nt, force\n0, 1\r\n\n 1.5e0 ,-2\n+2,.5\n");
    assert_int_equal(deck_csv(&x, &rows, 2, at(deck, "file"), deck), OK);
    assert_int_equal(rows, 3);
    const double want[] = {0, 1, 1.5, -2, 2, .5};
    assert_memory_equal(x, want, sizeof want);
    char *text = TAKE(arena, char, 100000), *p = text;
    for (int i = 0; i < 5000; i++) p += sprintf(p, "%d,%d\n", i, i * i);
    write_text("table.csv", text);
    assert_int_equal(deck_csv(&x, &rows, 2, at(deck, "file"), deck), OK);
    assert_true(rows == 5000 && x[9999] == 4999. * 4999);
    static const char *const bad[][2] = {
        {"0,1\n1,two\n", "table.csv:2:3: error: expected a number, found 'two' [E-csv]"},
        {"0,1\n1\n", "table.csv:2:1: error: expected 2 columns, found 1 [E-csv]"},
        {"0,1,\n", "table.csv:1:1: error: expected 2 columns, found 3 [E-csv]"},
        {"0;1\n", "table.csv:1:1: error: expected 2 columns, found 1 [E-csv]"},
        {"a,b\nc,d\n", "table.csv:2:1: error: expected a number, found 'c' [E-csv]"},
        {"0,nan\n", "table.csv:1:3: error: expected a number, found 'nan' [E-csv]"},
        {"0,1e999\n", "table.csv:1:3: error: expected a number, found '1e999' [E-csv]"},
        {"0,0x10\n", "table.csv:1:3: error: expected a number, found '0x10' [E-csv]"},
        {"0,\n", "table.csv:1:3: error: expected a number, found nothing [E-csv]"},
        {"", "deck.yaml:1:7: error: 'table.csv' holds no rows [E-csv]"},
        {"t,x\n", "deck.yaml:1:7: error: 'table.csv' holds no rows [E-csv]"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        setup(NULL);
        deck = good("file: table.csv\n");
        write_text("table.csv", bad[i][0]);
        assert_int_equal(deck_csv(&x, &rows, 2, at(deck, "file"), deck), E_DECK);
        if (!strstr(messages(), bad[i][1])) fail_msg("wanted %s\ngot %s", bad[i][1], messages());
    }
    setup(NULL);
    write_bytes("table.csv", "0,1\0\n", 5);
    deck = good("file: table.csv\nout: ../x.csv\n");
    assert_int_equal(deck_csv(&x, &rows, 2, at(deck, "file"), deck), E_DECK);
    assert_int_equal(deck_csv(&x, &rows, 2, at(deck, "out"), deck), E_DECK);
    assert_non_null(strstr(messages(), "'../x.csv': is outside the deck's folder [E-path]"));
}

/* ---- damage ---- */

static const char whole[] = "fmdsub: 1\n"
                            "title: Pendulum # one\n"
                            "parameters: {l: 2, w: \"max(l, 3)\", N: 3}\n"
                            "gravity: [0, -9.81]\n"
                            "bodies:\n"
                            "  rod: &rod {mass: 2*l, inertia: 0.5, at: [l/2, 0]}\n"
                            "  copy: *rod\n"
                            "  link$i:\n"
                            "    repeat: {i: [1, N]}\n"
                            "    mass: i^2\n"
                            "    at: [i - 0.5, 0]\n"
                            "    names: [link$(i-1), link$i]\n"
                            "constraints:\n"
                            "  hub: {revolute: [ground, rod], at: [0, 0]}\n"
                            "forces:\n"
                            "  motor: {torque: hub, value: 'if(t < 1, w*t, w)'}\n"
                            "  list:\n"
                            "  - 1\n"
                            "  - {a: b}\n"
                            "text: |\n"
                            "  two\n"
                            "  lines\n"
                            "integrate: {scheme: midpoint, step: 1.0e-3, until: 2}\n"
                            "output: {every: 0.01, columns: [hub.*, \"energy.*\"]}\n"
                            "last: \"k\\xe9y \xc3\xa9\"\n";

static void numbers_below(struct node *n, struct deck *deck)
{
    double x;
    struct expr *e;
    if (n->type == NODE_SCALAR) {
        (void)deck_number(&x, n, deck); /* broken ones, too */
        (void)deck_expr(&e, n, NULL, deck);
    }
    for (int i = 0; i < n->count; i++) numbers_below(n->item[i], deck);
}

static void survive(const char *text, size_t len, FILE *nowhere)
{
    struct deck *deck;
    setup(NULL);
    enum status status = deck_load(&deck, write_bytes("deck.yaml", text, len), NULL, diags, arena, &report);
    if (status != OK && status != E_DECK) fail_msg("%d for %.*s", status, (int)len, text);
    if (status == OK) numbers_below(deck->root, deck);
    if (status == OK) deck_print(nowhere, deck);
    assert_true((status == OK) == (deck != NULL));
    assert_true(status == OK || diags_errors(diags) > 0);
    diags_print(nowhere, diags, true);
}

/* Of this process: others may use the machine. */
static double seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

/* Every byte deleted, every byte replaced by each of 16 others, every beginning: an answer, never a signal. */
static void damaged(void **state)
{
    (void)state;
    static const char others[16] = {0,   '\n', '\t', ' ', ':', '[', '}',        '"',
                                    '*', '&',  '$',  '(', '0', '-', (char)0xff, (char)0xc3};
    char text[sizeof whole];
    size_t len = strlen(whole);
    FILE *nowhere = fopen("/dev/null", "w");
    double start = seconds();
    long n = 0;
    for (size_t i = 0; i < len; i++) {
        memcpy(text, whole, i);
        memcpy(text + i, whole + i + 1, len - i - 1);
        survive(text, len - 1, nowhere);
        survive(whole, i, nowhere);
        memcpy(text, whole, len);
        for (int k = 0; k < 16; k++) {
            text[i] = others[k];
            survive(text, len, nowhere);
        }
        n += 18;
        if (seconds() - start > 20) fail_msg("%ld decks took %g s", n, seconds() - start);
    }
    print_message("%ld damaged decks in %.2f s\n", n, seconds() - start);
    fclose(nowhere);
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(marks),    TEST(aliases),        TEST(limits),  TEST(numbers),       TEST(number_errors),
        TEST(formulas), TEST(parameters),     TEST(repeats), TEST(repeat_errors), TEST(settings),
        TEST(includes), TEST(include_errors), TEST(prints),  TEST(reads_back),    TEST(files),
        TEST(tables),   TEST(damaged),
    };
    return cmocka_run_group_tests(tests, make_folder, drop_folder);
}
