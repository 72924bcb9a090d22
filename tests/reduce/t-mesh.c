/* t-mesh.c -- nodes, sets and elements as files for CalculiX write them; what is no such file is refused by its line. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "reduce/mesh.h"

/* the harness has a macro of that name */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

struct folder {
    char path[40];
    struct arena *life;
    struct report report;
    struct mesh mesh;
};

static void begin(void **state, struct folder *o)
{
    (void)state;
    *o = (struct folder){.path = "/tmp/t-mesh-XXXXXX", .life = arena_open()};
    assert_non_null(mkdtemp(o->path));
}

static void end(struct folder *o)
{
    rmdir(o->path);
    arena_close(o->life);
}

static const char *beside(const struct folder *o, const char *name)
{
    return arena_print(o->life, "%s/%s", o->path, name);
}

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static enum status read_text(struct folder *o, const char *text)
{
    const char *path = beside(o, "a.inp");
    write_file(path, text);
    o->report = (struct report){0};
    const enum status status = mesh_read_inp(&o->mesh, path, o->life, &o->report);
    unlink(path);
    return status;
}

static void has_set(const struct folder *o, const char *name, int n, const int *id)
{
    const struct mesh_set *set = mesh_set(&o->mesh, name);
    assert_non_null(set);
    assert_int_equal(set->n, n);
    for (int i = 0; i < n; i++) assert_int_equal(set->id[i], id[i]);
}

/* Blanks, comments, commas at ends of lines, lower case; a node given again has its last place; what is no solid is passed over. */
static void test_cards(void **state)
{
    struct folder o;
    begin(state, &o);
    assert_int_equal(read_text(&o, "*HEADING\nno, cards, here\n"
                                   "*NODE, NSET=all\n"
                                   " 4 , 0 , 0 , 3 ,\n"
                                   "1, 9, 9, 9\n"
                                   "** 7, 1, 1, 1\n"
                                   "2, 1.5, 0.\n"
                                   "\n"
                                   "3, 0, 2,\n"
                                   "1, 0.5, -1, 2.5e-1\n"
                                   "*Nset , Generate, nset = odd \n"
                                   "1, 5, 2\n"
                                   "*NSET, NSET=run, GENERATE\n"
                                   "2, 4,\n"
                                   "*NSET, NSET=one, GENERATE\n"
                                   "3, 3, 1\n"
                                   "*NSET, NSET=some\n"
                                   " 4, 2,\n"
                                   "odd, 4\n"
                                   "*NODE PRINT, NSET=some\n"
                                   "U\n"
                                   "*ELEMENT, ELSET=e, TYPE = c3d4 \n"
                                   "12, 1, 2, 3,\n"
                                   "4\n"
                                   "7,\n"
                                   "1, 2, 4, 3\n"
                                   "*ELEMENT, TYPE=S4\n"
                                   "8, 1, 2\n"),
                     OK);
    static const double x[] = {.5, -1, .25, 1.5, 0, 0, 0, 2, 0, 0, 0, 3};
    assert_int_equal(o.mesh.n, 4);
    for (int i = 0; i < 4; i++) assert_int_equal(o.mesh.id[i], i + 1);
    for (int i = 0; i < 12; i++) assert_true(o.mesh.x[i] == x[i]);
    for (int i = 0; i < 4; i++) assert_int_equal(mesh_node(&o.mesh, i + 1), i);
    assert_int_equal(mesh_node(&o.mesh, 0), -1);
    assert_int_equal(mesh_node(&o.mesh, 5), -1);
    has_set(&o, "all", 4, (int[]){1, 2, 3, 4});
    has_set(&o, "ODD", 3, (int[]){1, 3, 5});
    has_set(&o, "run", 3, (int[]){2, 3, 4});
    has_set(&o, "one", 1, (int[]){3});
    has_set(&o, "some", 5, (int[]){1, 2, 3, 4, 5});
    assert_null(mesh_set(&o.mesh, "e"));
    assert_int_equal(o.mesh.nelement, 2);
    for (int i = 0; i < 2; i++) {
        const struct mesh_element *e = &o.mesh.element[i];
        static const int corners[2][4] = {{1, 2, 3, 4}, {1, 2, 4, 3}};
        assert_int_equal(e->id, i ? 7 : 12);
        assert_int_equal(e->nodes, 4);
        assert_string_equal(e->type, "C3D4");
        for (int k = 0; k < 4; k++) assert_int_equal(e->node[k], corners[i][k]);
    }
    end(&o);
}

/* From the folder of the file that says so, with quotes or without, and from its own place by a path from the root; behind it
 * lines belong to no card. */
static void test_include(void **state)
{
    struct folder o;
    begin(state, &o);
    const char *more = beside(&o, "more.inp"), *last = beside(&o, "last.inp");
    write_file(more, "*NODE\n2, 2, 0, 0\n*INCLUDE, INPUT=last.inp\n");
    write_file(last, "*NODE\n3, 3, 0, 0\n");
    assert_int_equal(read_text(&o, "*NODE\n1, 1, 0, 0\n*INCLUDE, INPUT=\"more.inp\"\nwords of nobody\n"), OK);
    assert_int_equal(o.mesh.n, 3);
    for (int i = 0; i < 3; i++) assert_true(o.mesh.x[3 * i] == i + 1);
    assert_int_equal(o.mesh.read.n, 3);
    assert_int_equal(read_text(&o, arena_print(o.life, "*NODE\n1, 1, 0, 0\n*INCLUDE, INPUT=%s\n", last)), OK);
    assert_int_equal(o.mesh.n, 2);
    write_file(last, "*NODE\n3, 3, 0, x\n");
    assert_int_equal(read_text(&o, "*NODE\n1, 1, 0, 0\n*INCLUDE, INPUT=more.inp\n"), E_DECK);
    assert_string_equal(o.report.text,
                        arena_print(o.life, "%s:2: error: node 3: a coordinate is not a finite number", last));
    write_file(last, "*INCLUDE, INPUT=last.inp\n");
    assert_int_equal(read_text(&o, "*INCLUDE, INPUT=last.inp\n"), E_DECK);
    assert_non_null(strstr(o.report.text, "last.inp:1: error: *INCLUDE goes deeper than "));
    unlink(more);
    unlink(last);
    assert_int_equal(read_text(&o, "*INCLUDE, INPUT=last.inp\n"), E_FILE);
    end(&o);
}

static void test_refused(void **state)
{
    static const struct {
        const char *text, *said; /* behind the path */
    } bad[] = {
        {"*HEADING\n", ": error: there is no *NODE"},
        {"*NODE\n0, 1, 1, 1\n", ":2: error: expected a node number and three coordinates"},
        {"*NODE\nx, 1, 1, 1\n", ":2: error: expected a node number and three coordinates"},
        {"*NODE\n1, 1, inf, 1\n", ":2: error: node 1: a coordinate is not a finite number"},
        {"*NODE\n1, 1, x\n", ":2: error: node 1: a coordinate is not a finite number"},
        {"*NODE\n1, 1, 1, 1, 1\n", ":2: error: node 1 has more than three coordinates"},
        {"*NODE\n1, 1, 1, 1 1\n", ":2: error: node 1: expected 'number, x, y, z'"},
        {"*NODE\n1 1 1 1\n", ":2: error: node 1: expected 'number, x, y, z'"},
        {"*NODE, SYSTEM=C\n1, 1, 1, 1\n", ":1: error: *NODE with SYSTEM is not read"},
        {"*NODE\n1, 1\n*TRANSFORM, NSET=a\n", ":3: error: *TRANSFORM: nodes with axes of their own are not read"},
        {"*NODE\n1, 1\n*NSET\n1\n", ":3: error: *NSET has no NSET=name"},
        {"*NODE\n1, 1\n*NSET, NSET=\n1\n", ":3: error: *NSET has no NSET=name"},
        {"*NODE\n1, 1\n*NSET, NSET=a, GENERATE\n1\n", ":4: error: GENERATE expects 'first, last, step'"},
        {"*NODE\n1, 1\n*NSET, NSET=a, GENERATE\n2, 1\n", ":4: error: GENERATE expects 'first, last, step'"},
        {"*NODE\n1, 1\n*NSET, NSET=a, GENERATE\n1, 2, 0\n", ":4: error: GENERATE expects 'first, last, step'"},
        {"*NODE\n1, 1\n*NSET, NSET=a, GENERATE\n1, 2, x\n", ":4: error: GENERATE expects 'first, last, step'"},
        {"*NODE\n1, 1\n*NSET, NSET=a, GENERATE\n-2147483647, 2147483647\n", ":4: error: GENERATE makes more than "},
        {"*NODE\n1, 1\n*NSET, NSET=a\n1, b\n", ":4: error: 'b' is neither a node number nor a node set"},
        {"*NODE\n1, 1\n*NSET, NSET=a\n1, , 2\n", ":4: error: '' is neither a node number nor a node set"},
        {"*NODE\n1, 1\n*NSET, NSET=a\n1 2\n", ":4: error: expected node numbers separated by commas"},
        {"*NODE\n1, 1\n*ELEMENT, TYPE=C3D4\nx\n", ":4: error: expected an element number and its nodes"},
        {"*NODE\n1, 1\n*ELEMENT, TYPE=C3D4\n5, 1, 2, x\n", ":4: error: element 5: expected 4 nodes"},
        {"*NODE\n1, 1\n*ELEMENT, TYPE=C3D4\n5, 1, 2, 3, 4, 6\n", ":4: error: element 5: expected 4 nodes"},
        {"*NODE\n1, 1\n*ELEMENT, TYPE=C3D4\n5, 1, 2, 3 4\n", ":4: error: element 5: expected 4 nodes"},
        {"*NODE\n1, 1\n*ELEMENT, TYPE=C3D4\n5, 1, 2,\n", ":4: error: the file ends within element 5"},
        {"*NODE\n1, 1\n*INCLUDE\n", ":3: error: *INCLUDE has no INPUT=file"},
        {"*NODE\n1, 1\n*INCLUDE, INPUT=\n", ":3: error: *INCLUDE has no INPUT=file"},
    };
    struct folder o;
    begin(state, &o);
    const char *path = beside(&o, "a.inp");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(read_text(&o, bad[i].text), E_DECK);
        const char *expected = arena_print(o.life, "%s%s", path, bad[i].said);
        if (strncmp(o.report.text, expected, strlen(expected)) != 0) fail_msg("%s: %s", bad[i].text, o.report.text);
    }
    end(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_cards), cmocka_unit_test(test_include),
                                       cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
