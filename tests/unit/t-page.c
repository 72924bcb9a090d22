/* t-page.c -- the manual says what the program's tables and source say. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <ctype.h>
#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/page.h"

#include <cmocka.h>

enum { TEXT = 1 << 20, WORDS = 8 };
static const char mark[] = ".\\\" from: fmdsub list page";

/* Tests run where the repository's man/ is; the text is the caller's to free. */
static char *read_text(const char *path)
{
    FILE *f = fopen(path, "r");
    if (!f) fail_msg("%s cannot be opened from here", path);
    char *text = calloc(1, TEXT);
    size_t n = fread(text, 1, TEXT - 1, f);
    fclose(f);
    assert_true(n > 0 && n < TEXT - 1);
    return text;
}

static char *printed(int n, char *const *word, enum status *status)
{
    char *text = NULL;
    size_t size;
    struct report report = {0};
    FILE *f = open_memstream(&text, &size);
    *status = page_print(f, n, word, &report);
    fclose(f);
    return text;
}

/* The words after `mark` of a line, cut in place. */
static int split(char **word, char *line)
{
    int n = 0;
    for (char *w = strtok(line, " "); w && n < WORDS; w = strtok(NULL, " ")) word[n++] = w;
    return n;
}

/* One part of a page: from the line after its mark to its end. */
static void compare_part(const char *path, const char *at)
{
    char line[200], *word[WORDS];
    size_t len = strcspn(at, "\n");
    enum status status;
    assert_true(len - strlen(mark) < sizeof line);
    snprintf(line, sizeof line, "%.*s", (int)(len - strlen(mark)), at + strlen(mark));
    char *name = strdup(line);
    char *wanted = printed(split(word, line), word, &status);
    assert_int_equal(status, OK);
    const char *body = at + len + 1, *end = strstr(body, ".\\\" end\n");
    assert_non_null(end);
    if (strlen(wanted) != (size_t)(end - body) || strncmp(wanted, body, strlen(wanted)) != 0)
        fail_msg("%s: the part '%s' is not what the program prints: BUILD=... sh man/refresh.sh", path, name + 1);
    free(wanted);
    free(name);
}

static void test_parts(void **state)
{
    glob_t pages;
    int parts = 0;
    (void)state;
    assert_int_equal(glob("man/*.[157]", 0, NULL, &pages), 0);
    for (size_t i = 0; i < pages.gl_pathc; i++) {
        char *text = read_text(pages.gl_pathv[i]);
        for (const char *at = strstr(text, mark); at; at = strstr(at + 1, mark)) {
            compare_part(pages.gl_pathv[i], at);
            parts++;
        }
        free(text);
    }
    globfree(&pages);
    assert_true(parts > 10);
}

/* Every section of a deck has its part, and so have the other tables. */
static void test_nothing_left_out(void **state)
{
    char *text = read_text("man/fmdsub-deck.5"), line[200];
    const char *const others[] = {"coordinates", "functions", "schemes", "codes"};
    struct section s;
    struct arena *life = arena_open();
    (void)state;
    for (int i = 0; sim_section(&s, i, life); i++) {
        snprintf(line, sizeof line, "%s keys%s%s\n", mark, *s.path ? " " : "", s.path);
        if (!strstr(text, line)) fail_msg("fmdsub-deck.5 lacks '%s'", line);
    }
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        snprintf(line, sizeof line, "%s %s\n", mark, others[i]);
        if (!strstr(text, line)) fail_msg("fmdsub-deck.5 lacks '%s'", line);
    }
    arena_close(life);
    free(text);
}

static void test_unknown_part(void **state)
{
    char *const none[] = {"nonsense"}, *const section[] = {"keys", "nowhere"};
    enum status status;
    (void)state;
    free(printed(1, none, &status));
    assert_int_equal(status, E_USAGE);
    free(printed(2, section, &status));
    assert_int_equal(status, E_USAGE);
    free(printed(0, NULL, &status));
    assert_int_equal(status, E_USAGE);
}

/* ---- fmdsub.1: its options are those of the program ---- */

static const struct cli_option *option_find(const char *name, size_t len)
{
    for (const struct cli_option *o = cli_options; o->name; o++)
        if (strlen(o->name) == len && strncmp(o->name, name, len) == 0) return o;
    return NULL;
}

static void test_options(void **state)
{
    char *text = read_text("man/fmdsub.1"), entry[100];
    (void)state;
    for (const struct cli_option *o = cli_options; o->name; o++) {
        if (o->letter)
            snprintf(entry, sizeof entry, "\n.It Fl %c , Fl -%s", o->letter, o->name);
        else
            snprintf(entry, sizeof entry, "\n.It Fl -%s", o->name);
        const char *at = strstr(text, entry);
        while (at && at[strlen(entry)] != ' ' && at[strlen(entry)] != '\n') at = strstr(at + 1, entry);
        if (!at) fail_msg("fmdsub.1 lacks --%s", o->name);
    }
    for (const char *at = strstr(text, "Fl -"); at; at = strstr(at + 1, "Fl -")) {
        size_t len = strspn(at + 4, "abcdefghijklmnopqrstuvwxyz-");
        if (!option_find(at + 4, len)) fail_msg("fmdsub.1 has --%.*s", (int)len, at + 4);
    }
    free(text);
}

/* ---- fmdsub-equations.7: the places that it names are there ---- */

/* Is name defined or declared in text, as "name(" after a blank or a star? */
static bool has_function(const char *text, const char *name)
{
    size_t len = strlen(name);
    for (const char *at = strstr(text, name); at; at = strstr(at + 1, name))
        if (at[len] == '(' && at > text && (at[-1] == ' ' || at[-1] == '*')) return true;
    return false;
}

/* A line ".D1 Pa src/FILE Fn a , Fn b". */
static int check_places(char *line)
{
    int found = 0;
    char *text = NULL, *path = NULL, *save;
    for (char *word = strtok_r(line, " ", &save); word; word = strtok_r(NULL, " ", &save)) {
        if (strcmp(word, "Pa") == 0) {
            path = strtok_r(NULL, " ", &save);
            assert_non_null(path);
            free(text);
            text = read_text(path);
        } else if (strcmp(word, "Fn") == 0) {
            char *name = strtok_r(NULL, " ", &save);
            assert_true(name && text);
            if (!has_function(text, name)) fail_msg("%s has no %s()", path, name);
            found++;
        }
    }
    free(text);
    return found;
}

static void test_places(void **state)
{
    char *text = read_text("man/fmdsub-equations.7"), line[300];
    int found = 0;
    (void)state;
    for (const char *at = text; *at; at += strcspn(at, "\n"), at += *at == '\n') {
        snprintf(line, sizeof line, "%.*s", (int)strcspn(at, "\n"), at);
        if (strncmp(line, ".D1 Pa ", 7) == 0) found += check_places(line);
        if (strncmp(line, ".Pa ", 4) == 0) {
            line[4 + strcspn(line + 4, " ")] = 0;
            free(read_text(line + 4));
        }
    }
    assert_true(found > 30);
    free(text);
}

/* A tag at `at`, such as (2-4), (2-16*) or (S3): its length, 0 if there is none. */
static size_t tag_at(const char *at)
{
    size_t letters = strncmp(at, "(2-", 3) == 0 ? 3 : strncmp(at, "(S", 2) == 0 ? 2 : 0;
    size_t digits = letters ? strspn(at + letters, "0123456789") : 0, len = letters + digits;
    if (!digits) return 0;
    len += at[len] == '*';
    return at[len] == ')' ? len + 1 : 0;
}

/* Marks the numbers of the paper, and of the scheme subcycle, that text carries. */
static void collect_tags(bool *print, bool *scheme, const char *text)
{
    for (const char *at = strchr(text, '('); at; at = strchr(at + 1, '(')) {
        int number = tag_at(at) ? atoi(at + (at[1] == 'S' ? 2 : 3)) : 0;
        if (number > 0 && number < 40) (at[1] == 'S' ? scheme : print)[number] = true;
    }
}

/* Every number of the paper and of subcycle is in the source and explained; so is every tag with a star. */
static void test_equations(void **state)
{
    char *text = read_text("man/fmdsub-equations.7"), tag[24];
    bool print[2][40] = {{0}}, scheme[2][40] = {{0}};
    glob_t files;
    (void)state;
    collect_tags(print[0], scheme[0], text);
    assert_int_equal(glob("src/*/*.[ch]", 0, NULL, &files), 0);
    for (size_t i = 0; i < files.gl_pathc; i++) {
        char *source = read_text(files.gl_pathv[i]);
        collect_tags(print[1], scheme[1], source);
        for (const char *at = strchr(source, '('); at; at = strchr(at + 1, '(')) {
            size_t len = tag_at(at);
            if (len == 0 || len >= sizeof tag || at[len - 2] != '*') continue;
            snprintf(tag, sizeof tag, "%.*s", (int)len, at);
            if (!strstr(text, tag)) fail_msg("%s has %s, fmdsub-equations.7 has not", files.gl_pathv[i], tag);
        }
        free(source);
    }
    for (int k = 1; k < 40; k++) {
        if (print[0][k] != (k <= 26) || print[1][k] != (k <= 26)) fail_msg("(2-%d) in the manual or the source", k);
        if (scheme[0][k] != (k <= 15) || scheme[1][k] != (k <= 15)) fail_msg("(S%d) in the manual or the source", k);
    }
    globfree(&files);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parts),   cmocka_unit_test(test_nothing_left_out), cmocka_unit_test(test_unknown_part),
        cmocka_unit_test(test_options), cmocka_unit_test(test_places),           cmocka_unit_test(test_equations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
