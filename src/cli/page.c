/* page.c -- the tables of the program as mdoc: keys, coordinates, columns, functions, schemes, messages; see page.h */
#include "cli/page.h"
#include "multirate/schemes.h"

#include <math.h>
#include <string.h>

#include "cli/cli.h"
#include "sim/load.h"
#include "sim/sim.h"

/* Text that roff takes as it is: no escapes, no request at the start of a line, every sentence on a line of its own. */
static void put(FILE *to, const char *text)
{
    if (*text == '.' || *text == '\'') fputs("\\&", to);
    for (char before = 0; *text; before = *text++) {
        if (*text == '\\')
            fputs("\\e", to);
        else if (text[0] == '.' && text[1] == ' ' && before != '.')
            text++, fputs(text[1] == '\'' || text[1] == '.' ? ".\n\\&" : ".\n", to);
        else
            putc(*text, to);
    }
}

static void put_all(FILE *to, const char *a, const char *b, const char *c)
{
    fputs(a, to);
    put(to, b);
    fputs(c, to);
}

/* ---- keys ---- */

const char *page_type(const struct key *k)
{
    switch (k->type) {
    case KEY_REAL:
        return "number";
    case KEY_INT:
        return k->words ? "whole number or auto" : "whole number";
    case KEY_BOOL:
        return "true or false";
    case KEY_TEXT:
        return "text";
    case KEY_VECTOR:
        return k->flags & KEY_ABOUT ? "[x, y, z], 2-D: number" : "[x, y, z]";
    case KEY_WORD:
    case KEY_TABLE:
    case KEY_CSV:
    case KEY_NODE:
        break;
    }
    return k->words;
}

/* "newmark|midpoint" as "newmark, midpoint" */
static void put_choices(FILE *to, const char *words)
{
    for (; *words; words++) {
        if (*words == '|')
            fputs(", ", to);
        else
            putc(*words, to);
    }
}

static void put_range(FILE *to, const struct key *k)
{
    if (k->type != KEY_REAL && k->type != KEY_INT && k->type != KEY_VECTOR) return;
    if (k->lo == k->hi) return;
    bool from = !isinf(k->lo), until = !isinf(k->hi);
    if (from) fprintf(to, ", %s %.10g", k->flags & KEY_ABOVE ? "above" : "from", k->lo);
    if (until) fprintf(to, "%s %s %.10g", from ? "" : ",", k->flags & KEY_BELOW ? "below" : "to", k->hi);
}

static void print_key(FILE *to, const struct key *k)
{
    fprintf(to, ".It Cm %s\n", k->name);
    if (k->type == KEY_WORD && strchr(k->words, '|')) {
        fputs("one of ", to);
        put_choices(to, k->words);
    } else {
        put(to, page_type(k));
    }
    if (k->unit) put_all(to, " [", k->unit, "]");
    put_range(to, k);
    if (k->flags & KEY_REQUIRED) fputs(", required", to);
    if (k->flags & KEY_PLANAR) fputs(", 2-D only", to);
    if (k->flags & KEY_SPATIAL) fputs(", 3-D only", to);
    if (k->fallback) put_all(to, ", default ", k->fallback, "");
    put_all(to, "\n\\(em ", k->brief, "\n");
}

static void print_list(FILE *to, const struct key *keys)
{
    size_t widest = 0;
    for (const struct key *k = keys; k->name; k++) widest = strlen(k->name) > widest ? strlen(k->name) : widest;
    if (!widest) return;
    fprintf(to, ".Bl -tag -width %zun -compact\n", widest);
    for (const struct key *k = keys; k->name; k++) print_key(to, k);
    fputs(".El\n", to);
}

/* The sections of one path; where it has kinds, each under its own word. */
static enum status print_keys(FILE *to, const char *path, struct report *report)
{
    struct section s;
    struct arena *life = arena_open();
    int found = 0, kinds = 0;
    for (int i = 0; sim_section(&s, i, life); i++) {
        if (strcmp(s.path, path) != 0) continue;
        if (s.word && !kinds++) fputs(".Bl -tag -width 4n\n", to);
        if (s.word) fprintf(to, ".It Ic %s\n", s.word);
        if (s.word) put_all(to, "", s.brief, ".\n");
        print_list(to, s.keys);
        found++;
    }
    if (kinds) fputs(".El\n", to);
    arena_close(life);
    return found ? OK : fail(report, E_USAGE, "no section '%.60s'", path);
}

/* ---- coordinates of joints ---- */

/* "x, y, z [m], qw, qx, qy, qz [1]": names, and the unit after the last one it belongs to. */
static void put_names(FILE *to, const struct joint_kind *j, int order)
{
    const int n = joint_size(j, order);
    for (int i = 0; i < n; i++) {
        const char *unit = joint_unit(j, order, i);
        fprintf(to, "%s%s", i ? ", " : "", joint_name(j, order, i));
        if (i + 1 == n || strcmp(unit, joint_unit(j, order, i + 1)) != 0) fprintf(to, " [%s]", unit);
    }
}

static void print_coordinate(FILE *to, const struct joint_kind *j, const char *where)
{
    fprintf(to, ".It %s%s\n", j->name, where);
    put_names(to, j, 0);
    fputs(";\nrates ", to);
    put_names(to, j, 1);
    fputs(";\naccelerations ", to);
    put_names(to, j, 2);
    fputs("\n", to);
}

static void print_coordinates(FILE *to)
{
    fputs(".Bl -tag -width cylindrical\n", to);
    for (int i = 0; joint_kind_at(i); i++) {
        const enum joint_type type = joint_kind_at(i)->type;
        const struct joint_kind *plane = joint_kind(type, 0), *space = joint_kind(type, 1);
        bool two = plane && joint_size(plane, 0) != joint_size(space, 0);
        if (joint_size(space, 0) == 0) continue;
        if (two) print_coordinate(to, plane, ", 2-D");
        print_coordinate(to, space, two ? ", 3-D" : "");
    }
    fputs(".El\n", to);
}

/* ---- columns ---- */

/* ".x .y .z" with another text in place of the blanks */
static void put_endings(FILE *to, const char *words, const char *between)
{
    for (; *words; words++) fputs(*words == ' ' ? between : (char[]){*words, 0}, to);
}

/* "J Ns Cm .fx , .fy": capitals and s stand for names, the rest are names. */
static void print_column(FILE *to, const struct column_table *t, const struct column_kind *row)
{
    const char *words = row->space ? row->space : row->plane, *second = row->angular;
    const bool stands = strcmp(t->thing, "s") == 0 || (*t->thing >= 'A' && *t->thing <= 'Z');
    fprintf(to, ".It %s%s%s", stands ? "" : "Cm ", t->thing, stands && *words ? " Ns Cm " : "");
    put_endings(to, words, " , "); /* delimiters of mdoc */
    put_all(to, "\n", row->brief, "");
    if (row->unit)
        fprintf(to, " [%s]%s%s%s", row->unit, second ? " or [" : "", second ? second : "", second ? "]" : "");
    if (t->of) fprintf(to, "; of %s", t->of);
    if (!row->plane || !row->space) fprintf(to, "; %s only", row->plane ? "2-D" : "3-D");
    if (row->plane && row->space && strcmp(row->plane, row->space) != 0) {
        fputs("; 2-D: ", to);
        put_endings(to, row->plane, ", ");
    }
    fputs("\n", to);
}

static void print_columns(FILE *to)
{
    for (const struct column_table *t = column_tables; t->rows; t++)
        for (const struct column_kind *row = t->rows; row->brief; row++) print_column(to, t, row);
}

/* ---- functions, schemes, messages ---- */

static void print_functions(FILE *to)
{
    fputs(".Bl -tag -width log10 -compact\n", to);
    for (const struct expr_function *f = expr_functions; f->name; f++) {
        fprintf(to, ".It Ic %s\n", f->name);
        put_all(to, "", f->brief, "\n");
    }
    fputs(".El\n", to);
}

static void print_scheme(FILE *to, const struct stepper_kind *k)
{
    fprintf(to, ".It Ic %s\n", k->name);
    put_all(to, "", k->brief, ".\n");
    fprintf(to, "Order %d%s%s.\n", k->order, k->two_rates ? ", two rates" : "",
            k->adaptive   ? ", steps of its own"
            : k->tolerant ? ", steps of its own where there is a tolerance"
                          : "");
    if (k->needs) fprintf(to, "Only in builds with %s.\n", k->needs);
}

/* Of this build or not: the manual is the same everywhere. */
static void print_schemes(FILE *to)
{
    fputs(".Bl -tag -width subcycle\n", to);
    for (int i = 0; stepper_kinds[i]; i++) print_scheme(to, stepper_kinds[i]);
    for (int i = 0; stepper_absent[i]; i++) print_scheme(to, stepper_absent[i]);
    fputs(".El\n", to);
}

static void print_codes(FILE *to)
{
    fputs(".Bl -tag -width Ds\n", to);
    for (const struct diag_help *h = diag_helps; h->code; h++) {
        fprintf(to, ".It Er %s\n", h->code);
        put_all(to, "", h->cure, "\n");
    }
    fputs(".El\n", to);
}

enum status page_print(FILE *to, int n, char *const *word, struct report *report)
{
    static const struct {
        const char *name;
        void (*print)(FILE *to);
    } parts[] = {{"columns", print_columns},
                 {"coordinates", print_coordinates},
                 {"functions", print_functions},
                 {"schemes", print_schemes},
                 {"codes", print_codes}};
    if (n >= 1 && strcmp(word[0], "keys") == 0) return print_keys(to, n > 1 ? word[1] : "", report);
    for (size_t i = 0; n == 1 && i < sizeof parts / sizeof *parts; i++)
        if (strcmp(parts[i].name, word[0]) == 0) return parts[i].print(to), OK;
    return fail(report, E_USAGE,
                "no part of the manual '%.40s' (keys PATH, columns, coordinates, functions, schemes, codes)",
                n ? word[0] : "");
}
