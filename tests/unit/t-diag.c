/* t-diag.c -- messages to the byte: form, carets, order, limits; and that every code has its cure. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <dirent.h>

#include "unit/told.h" /* before cmocka.h, which has a macro fail */

#include <cmocka.h>

static struct arena *arena;

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

static struct diags *with_source(const char *path, const char *text, size_t len)
{
    struct diags *d = diags_open(arena);
    diags_add_source(d, source_of(path, text, len, arena));
    return d;
}

/* Characters [from, to) of a line. */
static struct span at(int line, int from, int to)
{
    return (struct span){0, {line, from}, {line, to}};
}

static void form(void **state)
{
    (void)state;
    static const char text[] = "a: 1\nbodies:\n  rod: {masss: 2}\n";
    struct diags *d = with_source("x.yaml", text, strlen(text));
    struct node key = {
        .file = 0, .mark = {3, 16}, .end = {3, 17}, .key = "masss", .key_mark = {3, 9}, .key_end = {3, 14}};
    struct node second = {.file = 0, .mark = {2, 1}, .end = {2, 7}};
    assert_int_equal(diags_status(d), OK);
    diag_error(d, &key, AT_KEY, "E-unknown-key", "unknown key '%s'", key.key);
    diag_suggest(d, "masss", (const char *const[]){"inertia", "mass"}, 2);
    diag_note_in(d, at(1, 1, 2), "a second %s", "place");
    diag_error(d, &key, AT_VALUE, "E-range", "too small");
    diag_hint(d, "one");
    diag_hint(d, "two");
    diag_warn(d, &second, AT_VALUE, "W-denormal", "small");
    assert_int_equal(diags_status(d), E_DECK);
    assert_int_equal(diags_errors(d), 2);
    assert_int_equal(diags_warnings(d), 1);
    assert_string_equal(told(d, arena), "x.yaml:2:1: warning: small [W-denormal]\n"
                                        "    2 | bodies:\n"
                                        "      | ^~~~~~\n"
                                        "x.yaml:3:9: error: unknown key 'masss' [E-unknown-key]\n"
                                        "    3 |   rod: {masss: 2}\n"
                                        "      |         ^~~~~\n"
                                        "      | did you mean 'mass'?\n"
                                        "x.yaml:1:1: note: a second place\n"
                                        "    1 | a: 1\n"
                                        "      | ^\n"
                                        "x.yaml:3:16: error: too small [E-range]\n"
                                        "    3 |   rod: {masss: 2}\n"
                                        "      |                ^\n"
                                        "      | one\n"
                                        "      | two\n");
}

static void carets(void **state)
{
    (void)state;
    static const struct {
        const char *line;
        int from, to;
        const char *shown, *under;
    } list[] = {
        {"k\xc3\xa9y: v", 6, 7, "k\xc3\xa9y: v", "     ^"},                              /* one column for two bytes */
        {"\xe6\x97\xa5\xe6\x9c\xac: v", 5, 6, "\xe6\x97\xa5\xe6\x9c\xac: v", "      ^"}, /* wide letters */
        {"\xe6\x97\xa5\xe6\x9c\xac: v", 1, 3, "\xe6\x97\xa5\xe6\x9c\xac: v", "^~~~"},
        {"e\xcc\x81: v", 5, 6, "e\xcc\x81: v", "   ^"}, /* an accent of its own */
        {"\ta: v", 2, 3, " a: v", " ^"},
        {"a\x1b[31mb: v", 9, 10, "a\\x1b[31mb: v", "           ^"},
        {"a\xe2\x80\xae: v", 5, 6, "a\\u202e: v", "         ^"},
        {"a\xff: v", 5, 6, "a\\xff: v", "       ^"},
        {"abc", 4, 4, "abc", "   ^"}, /* the end of the line */
        {"abc", 2, 9, "abc", " ^~"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        struct diags *d = with_source("x", list[i].line, strlen(list[i].line));
        diag_error_in(d, at(1, list[i].from, list[i].to), "E-yaml", "x");
        const char *want = arena_print(arena, "x:1:%d: error: x [E-yaml]\n    1 | %s\n      | %s\n", list[i].from,
                                       list[i].shown, list[i].under);
        assert_string_equal(told(d, arena), want);
    }
}

/* A line is shown around the caret, never whole when it is long. */
static void long_lines(void **state)
{
    (void)state;
    static char text[100000];
    for (size_t i = 0; i < sizeof text; i++) text[i] = "abcdefghij"[i % 10];
    const int places[] = {1, 60, 50000, 100000};
    for (int i = 0; i < 4; i++) {
        struct diags *d = with_source("x", text, sizeof text);
        diag_error_in(d, at(1, places[i], places[i] + 3), "E-yaml", "x");
        const char *out = told(d, arena), *line = strchr(out, '\n') + 1, *under = strchr(line, '\n') + 1;
        assert_true(strlen(out) < 400);
        size_t caret = (size_t)(strchr(under, '^') - under);
        assert_int_equal(line[caret], "abcdefghij"[(places[i] - 1) % 10]);
    }
}

static void order_and_limit(void **state)
{
    (void)state;
    char text[200];
    memset(text, '\n', sizeof text);
    struct diags *d = with_source("x", text, sizeof text);
    for (int i = 0; i < 25; i++) diag_error_in(d, at(1 + (i * 7) % 25, 1, 1), "E-yaml", "error %d", i);
    const char *out = told(d, arena), *p = out;
    for (int line = 1; line <= DIAGS_SHOWN; line++) {
        p = strstr(p, arena_print(arena, "x:%d:1: error", line));
        assert_non_null(p);
    }
    assert_null(strstr(p, "x:21:1"));
    assert_non_null(strstr(p, "\nand 5 more errors\n"));
    for (int i = 0; i < 3000; i++) diag_error_in(d, at(1 + i % 200, 2, 2), "E-yaml", "again %d", i);
    assert_int_equal(diags_errors(d), 3025);
    assert_non_null(strstr(told(d, arena), "\nand 3005 more errors\n"));
    assert_int_equal(diags_status(d), E_DECK);
    diag_error_in(d, at(1, 1, 1), "E-limit-nodes", "too many");
    assert_int_equal(diags_status(d), E_LIMIT);
}

/* The same fault in the copies of one member is told once; two faults at one place both. */
static void told_once(void **state)
{
    (void)state;
    struct diags *d = with_source("x", "link$i: {}\n", 11);
    struct scope scope[3];
    for (int i = 0; i < 3; i++) {
        scope[i] = (struct scope){NULL, "i", i};
        struct node n = {
            .mark = {1, 9}, .end = {1, 11}, .key = "link", .key_mark = {1, 1}, .key_end = {1, 7}, .scope = &scope[i]};
        diag_error(d, &n, AT_KEY, "E-missing-key", "link%d has no 'mass'", i);
        diag_error(d, &n, AT_KEY, "E-missing-key", "link%d has no '%s'", i, "inertia");
    }
    assert_int_equal(diags_errors(d), 2);
    diag_error_in(d, at(1, 1, 2), "E-yaml", "same");
    diag_error_in(d, at(1, 1, 2), "E-yaml", "same");
    diag_note_in(d, at(1, 1, 2), "a note of what was not kept");
    diag_hint(d, "likewise");
    assert_int_equal(diags_errors(d), 3);
    assert_null(strstr(told(d, arena), "not kept"));
    assert_null(strstr(told(d, arena), "likewise"));
}

static void color_and_paths(void **state)
{
    (void)state;
    struct diags *d = with_source("bad\x1b\nname", "a\n", 2);
    diag_error_in(d, at(1, 1, 2), "E-yaml", "a\x07\xe2\x80\xae\xff");
    assert_string_equal(told(d, arena),
                        "bad\\x1b\\x0aname:1:1: error: a\\x07\\u202e\\xff [E-yaml]\n    1 | a\n      | ^\n");
    char *text;
    size_t size;
    FILE *to = open_memstream(&text, &size);
    diags_print(to, d, true);
    fclose(to);
    assert_non_null(strstr(text, "\033[31merror\033[0m"));
    free(text);
    assert_string_equal(diag_clip(d, "short"), "short");
    assert_string_equal(diag_clip(d, "0123456789012345678901234567890123456789"),
                        "0123456789012345678901234567890123456789");
    assert_string_equal(diag_clip(d, "\xc3\xa9"
                                     "123456789012345678901234567890123456789x"),
                        "\xc3\xa9"
                        "123456789012345678901234567890123456789...");
}

/* ---- codes ---- */

static void codes(void **state)
{
    (void)state;
    int n = 0;
    for (const struct diag_help *h = diag_helps; h->code; h++, n++) {
        const bool word = h->code[0] >= 'a' && h->code[0] <= 'z'; /* a stop, or what is not there yet */
        assert_true(word || ((h->code[0] == 'E' || h->code[0] == 'W') && h->code[1] == '-'));
        assert_true(strlen(h->cure) > 20 && h->cure[strlen(h->cure) - 1] == '.');
        for (const struct diag_help *k = h + 1; k->code; k++) assert_string_not_equal(h->code, k->code);
        assert_ptr_equal(diag_cure(h->code), h->cure);
    }
    assert_true(n > 40);
    assert_non_null(diag_cure("e-unknown-KEY"));
    assert_null(diag_cure("E-nonsense"));
}

/* Of a line of source: the stop that a message ends with, "... [no-start]", or that a row of sim/stops.c names; "": none.
 * Units and other words in brackets are short. */
static const char *stop_of(char *code, const char *line)
{
    const char *row = strstr(line, "[TROUBLE_"), *at = row ? strchr(row, '"') : NULL;
    code[0] = 0;
    if (at) return sscanf(at, "\"%63[EWa-z-]\"", code) == 1 ? code : "";
    for (at = line; (at = strchr(at, '[')); at++) {
        if (sscanf(at, "[%63[a-z-]]\"", code) != 1 || strlen(code) < 5) continue;
        if (strncmp(at + 1 + strlen(code), "]\"", 2) == 0) return code;
    }
    return "";
}

/* Words "E-..." and stops of one file that the table does not have. */
static int without_cure(int *stops, const char *path)
{
    int bad = 0;
    char line[4096], code[64];
    FILE *f = fopen(path, "r");
    if (!f) return 0;
    while (fgets(line, sizeof line, f)) {
        const char *stop = stop_of(code, line);
        *stops += *stop != 0;
        if (*stop && !diag_cure(stop)) {
            print_error("%s: the stop '%s' has no cure\n", path, stop);
            bad++;
        }
        for (const char *p = line; (p = strchr(p, '"')); p++) {
            bool whole = sscanf(p, "\"%63[EWa-z-]\"", code) == 1 && p[1 + strlen(code)] == '"';
            if (!whole || (strncmp(code, "E-", 2) && strncmp(code, "W-", 2)) || !code[2]) continue;
            if (diag_cure(code) || !strcmp(code, "E-limit")) continue;
            print_error("%s: %s has no cure\n", path, code);
            bad++;
        }
    }
    fclose(f);
    return bad;
}

/* Every code in the sources has its cure; skipped where the sources are not at hand. */
static void sources(void **state)
{
    (void)state;
    DIR *src = opendir("src");
    if (!src) skip();
    int bad = 0, stops = 0;
    for (struct dirent *folder; (folder = readdir(src));) {
        const char *path = arena_print(arena, "src/%s", folder->d_name);
        DIR *files = folder->d_name[0] == '.' ? NULL : opendir(path);
        if (!files) continue;
        for (struct dirent *file; (file = readdir(files));)
            if (strstr(file->d_name, ".c"))
                bad += without_cure(&stops, arena_print(arena, "%s/%s", path, file->d_name));
        closedir(files);
    }
    closedir(src);
    assert_int_equal(bad, 0);
    assert_true(stops > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(form, setup, teardown),
        cmocka_unit_test_setup_teardown(carets, setup, teardown),
        cmocka_unit_test_setup_teardown(long_lines, setup, teardown),
        cmocka_unit_test_setup_teardown(order_and_limit, setup, teardown),
        cmocka_unit_test_setup_teardown(told_once, setup, teardown),
        cmocka_unit_test_setup_teardown(color_and_paths, setup, teardown),
        cmocka_unit_test_setup_teardown(codes, setup, teardown),
        cmocka_unit_test_setup_teardown(sources, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
