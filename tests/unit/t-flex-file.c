/* t-flex-file.c -- reduced bodies as JSON: written, read to the same bits, and what a wrong file must get. */
#include "flex/file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { N = 2 };

/* Two particles of 1.5 kg on springs beside a third at rest: numbers that no text has in few digits. */
static struct flex_body *make(struct arena *life)
{
    struct flex_body *o = flex_body_take(N, 2, 1, true, life);
    o->mass = 4.5;
    for (int k = 0; k < 3; k++) o->xx[4 * k] = (k + 1) / 3.0;
    for (int j = 0; j < N; j++) {
        o->ff[4 * j + 9 * (j + N * j)] = 1.5;
        o->f[j + 3 * j] = sqrt(1.5 + j);
        o->K[j + N * j] = 1e6 * (j + 1) / 7;
        o->hertz[j] = sqrt(o->K[j + N * j] / 1.5) / 6.28318530717958647693;
        o->node[1].phi[j + 3 * j] = 1 / sqrt(3 + j);
    }
    for (int k = 0; k < 9 * N; k++) o->xf[k] = sin(k) * 1e-9;
    for (int k = 0; k < 6 * N; k++) o->stress[0].tensor[k] = exp(3.0 * k);
    for (int k = 0; k < 3 * N * N; k++) o->s[k] = 0.1 * (k % 3 + k / 3 % 2 + k / 6); /* the same for i, j and j, i */
    o->D[0] = 0.1 + 0.2;
    o->node[0].name = "root";
    o->node[1].name = "tip \"upper\" \\ end\n";
    o->stress[0].name = "root";
    return o;
}

static const char *put_file(const char *text)
{
    static const char path[] = "t-flex-file.json";
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    fclose(file);
    return path;
}

static void test_bits(void **state)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *o = make(life), *back;
    const double at[3] = {0.1, -2.0 / 3, 1e-300};
    double place[3];
    (void)state;
    const char *text = flex_file_text(o, at, life), *path = put_file(text);
    enum status status = flex_file_read(&back, place, path, life, &report);
    if (status != OK) fail_msg("%s", report.text);
    assert_memory_equal(place, at, sizeof at);
    assert_memory_equal(back->xx, o->xx, sizeof(double[9]));
    assert_memory_equal(back->f, o->f, sizeof(double[3 * N]));
    assert_memory_equal(back->xf, o->xf, sizeof(double[9 * N]));
    assert_memory_equal(back->ff, o->ff, sizeof(double[9 * N * N]));
    assert_memory_equal(back->s, o->s, sizeof(double[3 * N * N]));
    assert_memory_equal(back->K, o->K, sizeof(double[N * N]));
    assert_memory_equal(back->D, o->D, sizeof(double[N * N]));
    assert_memory_equal(back->hertz, o->hertz, sizeof(double[N]));
    assert_memory_equal(back->stress[0].tensor, o->stress[0].tensor, sizeof(double[6 * N]));
    assert_memory_equal(back->node[1].phi, o->node[1].phi, sizeof(double[3 * N]));
    assert_string_equal(back->node[1].name, o->node[1].name);
    assert_string_equal(flex_file_text(back, place, life), text);
    remove(path);
    arena_close(life);
}

/* Optional members may be missing. */
static void test_sparing(void **state)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *o = make(life), *back;
    const double at[3] = {0};
    (void)state;
    o->s = o->xs = o->D = o->hertz = NULL;
    o->stress[0].axial = o->stress[0].bending = NULL;
    o->node[0].S = o->node[1].S = NULL;
    o->node[1].name = NULL;
    const char *path = put_file(flex_file_text(o, at, life));
    assert_int_equal(flex_file_read(&back, NULL, path, life, &report), OK);
    assert_null(back->s);
    assert_null(back->xs);
    assert_null(back->D);
    assert_null(back->hertz);
    assert_null(back->node[1].S);
    assert_null(back->node[1].name);
    assert_null(back->stress[0].axial);
    remove(path);
    arena_close(life);
}

/* The text with the first `old` after `after` replaced. */
static const char *changed(const char *text, const char *after, const char *old, const char *new, struct arena *life)
{
    const char *from = strstr(text, after);
    assert_non_null(from);
    const char *at = strstr(from, old);
    assert_non_null(at);
    return arena_print(life, "%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
}

static void refuse(const char *text, enum status wanted, const char *words, struct arena *life)
{
    struct report report = {0};
    struct flex_body *back;
    const char *path = put_file(text);
    enum status status = flex_file_read(&back, NULL, path, life, &report);
    remove(path);
    if (status != wanted || !strstr(report.text, words))
        fail_msg("%d '%s', expected %d '%s'", status, report.text, wanted, words);
}

/* Without the checksum, which says of any change only that there is one. */
static const char *unsealed(const char *text, struct arena *life)
{
    const char *at = strstr(text, ",\n \"checksum\"");
    assert_non_null(at);
    return arena_print(life, "%.*s}\n", (int)(at - text), text);
}

static void test_changed(void **state)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *back;
    const double at[3] = {0};
    const char *text = flex_file_text(make(life), at, life);
    (void)state;
    refuse(changed(text, "{", "\"mass\": 4.5", "\"mass\": 5.5", life), E_DECK, "was changed since it was written",
           life);
    refuse(changed(text, "{", "\"checksum\": \"", "\"checksum\": \"0", life), E_DECK, "'checksum': does not fit", life);
    refuse(changed(text, "{", "\"checksum\": \"", "\"checksum\": 0, \"of\": \"", life), E_DECK, "does not fit", life);
    const char *path = put_file(changed(text, "{", "\"mass\": 4.5", "\"mass\":\n\t4.5", life)); /* laid out anew */
    assert_int_equal(flex_file_read(&back, NULL, path, life, &report), OK);
    path = put_file(changed(unsealed(text, life), "{", "\"mass\": 4.5", "\"mass\": 5.5", life)); /* made by hand */
    assert_int_equal(flex_file_read(&back, NULL, path, life, &report), OK);
    assert_true(back->mass == 5.5);
    remove(path);
    arena_close(life);
}

static void test_refused(void **state)
{
    static const struct {
        const char *after, *old, *new, *words;
    } cases[] = {
        {"{", "\"fmdsub_flex\": 1", "\"fmdsub_flex\": 2", "'fmdsub_flex': expected a whole number from 1 to 1"},
        {"{", "\"modes\": 2", "\"modes\": 2.5", "'modes': expected a whole number"},
        {"{", "\"modes\": 2", "\"modes\": 1000000", "'modes': expected a whole number"},
        {"{", "\"modes\": 2", "\"modes\": 3", "numbers, expected 9"},
        {"{", "\"reference\": 0", "\"reference\": 2", "'reference': expected a whole number from 0 to 1"},
        {"{", "\"reference\": 0", "\"reference\": 1", "'reference': the reference node should not move"},
        {"{", "\"mass\": 4.5", "\"mass\": 0", "'mass': should be positive"},
        {"{", "\"mass\": 4.5", "\"mass\": 4.5, \"mass\": 5", "'mass': given twice"},
        {"{", "\"mass\": 4.5", "\"weight\": 4.5", "'weight': unknown member"},
        {"{", "\"mass\": 4.5,", "", "'mass': missing"},
        {"{", "\"mass\": 4.5", "\"mass\": 4.5, \"Mass\": 4.5", "'Mass': unknown member: did you mean 'mass'?"},
        {"\"nodes\"", "\"S\"", "\"SS\"", "nodes[0].SS: unknown member: did you mean 'S'?"},
        {"\"K\"", "\"hertz\"", "\"herz\"", "'herz': unknown member: did you mean 'hertz'?"},
        {"{", "\"mass\": 4.5", "\"mass\": \"4.5\"", "'mass': expected a finite number"},
        {"\"xx\"", "0.333333333333333", "-0.333333333333333", "'xx': is no inertia"},
        {"\"xx\"", "[", "[7, ", "'xx': 10 numbers, expected 9"},
        {"\"f\"", "[", "[null, ", "'f': something in the list is no number"},
        {"\"f\"", "1.22", "1e999, 1.22", "'f': a number is not finite"},
        {"\"ff\"", "1.5", "-1.5", "'ff': gives a mass matrix that is not positive"},
        {"\"K\"", "142857.14285714", "-142857.14285714", "'K': should be symmetric, not negative"},
        {"\"K\"", ", 0", ", 1000", "'K': should be symmetric"},
        {"\"ff\"", "0, 0", "0, 7", "'ff': block i, j is not that of j, i"},
        {"\"s\"", "0, 0.1, 0.2, 0.1", "0, 0.1, 0.2, 0.5", "'s': is not symmetric in i, j"},
        {"\"nodes\"", "\"S\": [0, 0, 0, 0", "\"S\": [0, 0, 0, 1", "nodes[0].S: is not symmetric"},
        {"\"nodes\"", "\"S\": [0", "\"S\": [2", "'reference': the reference node should not move"},
        {"\"xs\"", "\"xs\"", "\"comment\"", "'s': s and xs go together"},
        {"\"xs\"", "\"xs\"", "\"sx\"", "'sx': unknown member"},
        {"\"nodes\"", "\"psi\"", "\"phi\"", "nodes[0].phi: given twice"},
        {"\"tip", "\"psi\"", "\"phi\"", "nodes[1].phi: given twice"},
        {"\"nodes\"", "\"psi\": [0, 0, 0, 0, 0, 0]", "\"psi\": [0, 0, 0, 0, 0, 1]",
         "the reference node should not move"},
        {"\"nodes\"", "\"phi\": [0, 0, 0, 0, 0, 0]", "\"phi\": [0, 0, 0, 0, 0, 1]",
         "the reference node should not move"},
        {"\"nodes\"", "\"name\": \"root\"", "\"name\": 5", "nodes[0].name: expected a text"},
        {"\"stresses\"", "\"name\"", "\"comment\"", "stresses[0].name: missing"},
        {"\"stresses\"", "\"bending\"", "\"comment\"", "stresses[0].axial: axial and bending go together"},
        {"\"stresses\"", "\"bending\"", "\"bent\"", "stresses[0].bent: unknown member"},
        {"\"stresses\"", "]}", "]]", ": error: this is not JSON"},
        {"\"stresses\"", "]}\n", "]} {}\n", ": error: this is not JSON"},
    };
    struct arena *life = arena_open();
    const double at[3] = {0};
    const char *text = unsealed(flex_file_text(make(life), at, life), life);
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        refuse(changed(text, cases[k].after, cases[k].old, cases[k].new, life), E_DECK, cases[k].words, life);
    refuse("", E_DECK, "t-flex-file.json:1: error: this is not JSON", life);
    refuse("[1]", E_DECK, "no JSON object", life);
    refuse("{}", E_DECK, "'fmdsub_flex': missing", life);
    arena_close(life);
}

static void test_no_file(void **state)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *back;
    (void)state;
    assert_int_equal(flex_file_read(&back, NULL, "none.json", life, &report), E_FILE);
    assert_string_equal(report.text, "none.json: No such file or directory");
    memset(&report, 0, sizeof report);
    assert_int_equal(flex_file_read(&back, NULL, "/", life, &report), E_FILE);
    assert_string_equal(report.text, "/: cannot be read as a file");
    memset(&report, 0, sizeof report);
    assert_int_equal(flex_file_read(&back, NULL, "/dev/null", life, &report), E_FILE);
    assert_string_equal(report.text, "/dev/null: cannot be read as a file");
    arena_close(life);
}

/* A file with nothing in it but its size: a byte more than is read. */
static void test_large(void **state)
{
    struct arena *life = arena_open();
    struct report report = {0};
    struct flex_body *back;
    (void)state;
    const char *path = put_file("");
    assert_int_equal(truncate(path, (1 << 28) + 1), 0);
    assert_int_equal(flex_file_read(&back, NULL, path, life, &report), E_LIMIT);
    assert_string_equal(report.text, "t-flex-file.json: larger than 268435456 bytes");
    remove(path);
    arena_close(life);
}

int main(void)
{
    char folder[] = "/tmp/t-flex-file-XXXXXX";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bits),    cmocka_unit_test(test_sparing), cmocka_unit_test(test_changed),
        cmocka_unit_test(test_refused), cmocka_unit_test(test_no_file), cmocka_unit_test(test_large),
    };
    if (!mkdtemp(folder) || chdir(folder) != 0) return 1;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rmdir(folder) != 0 || failed;
}
