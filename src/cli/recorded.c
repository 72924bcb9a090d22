/* recorded.c -- see recorded.h */
#include "cli/recorded.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

enum form { NONE, CSV, NDJSON, JSON };

static enum form form_of(const char *path)
{
    static const struct {
        const char *ending;
        enum form form;
    } forms[] = {{".csv", CSV}, {".ndjson", NDJSON}, {".jsonl", NDJSON}, {".json", JSON}};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (text_ends(path, forms[i].ending)) return forms[i].form;
    return NONE;
}

bool recorded_is(const char *path)
{
    return form_of(path) != NONE;
}

double *recorded_row(struct curves *o, struct arena *life)
{
    o->x = arena_more(life, o->x, o->rows, &o->capacity, (size_t)o->n * sizeof *o->x);
    double *x = o->x + (size_t)o->rows++ * (size_t)o->n;
    for (int i = 0; i < o->n; i++) x[i] = NAN;
    return x;
}

/* ---- CSV ---- */

static void read_name(struct curves *o, char *word, int *capacity, struct arena *life)
{
    const size_t n = strlen(word);
    if (n > 1 && *word == '"' && word[n - 1] == '"') word[n - 1] = 0, word++;
    o->column = arena_more(life, o->column, o->n, capacity, sizeof *o->column);
    o->column[o->n++] = (struct column){.name = arena_copy(life, word, strlen(word))};
}

static void read_names(struct curves *o, char *line, struct arena *life)
{
    int capacity = 0;
    for (char *word; (word = strsep(&line, ","));) read_name(o, word, &capacity, life);
}

/* One row; a field that is empty is a value that there is none of. */
static const char *read_row(struct curves *o, char *line, struct arena *life)
{
    int i = 0;
    double *x = recorded_row(o, life);
    for (char *word; (word = strsep(&line, ",")); i++) {
        char *end = word;
        const double value = strtod(word, &end);
        if (i == o->n) return "more fields than the first line names";
        if (*end) return "a field that is no number";
        if (*word) x[i] = value;
    }
    return i < o->n ? arena_print(life, "%d fields, the first line names %d", i, o->n) : "";
}

/* The units that `run --units` writes below the names: fields in brackets. */
static bool is_units(const struct curves *o, const char *line)
{
    return o->rows == 0 && *line == '[';
}

static void read_units(struct curves *o, char *line, struct arena *life)
{
    int i = 0;
    for (char *word; (word = strsep(&line, ",")) && i < o->n; i++) {
        const size_t n = strlen(word);
        if (n > 2 && *word == '[' && word[n - 1] == ']') o->column[i].unit = arena_copy(life, word + 1, n - 2);
    }
}

static const char *read_csv_line(struct curves *o, char *line, struct arena *life)
{
    if (o->n == 0) return read_names(o, line, life), "";
    if (is_units(o, line)) return read_units(o, line, life), "";
    return read_row(o, line, life);
}

/* ---- files ---- */

static enum status read_lines(struct curves *o, FILE *file, enum form form, struct arena *life, struct report *report)
{
    char *line = NULL;
    size_t room = 0;
    long number = 0;
    const char *wrong = "";
    while (!*wrong && line_or_end(&line, &room, '\n', file) >= 0) {
        number++;
        line[strcspn(line, "\r\n")] = 0;
        if (*line) wrong = form == CSV ? read_csv_line(o, line, life) : recorded_line(o, line, life);
    }
    free(line);
    return *wrong ? fail(report, E_FILE, "%s:%ld: %s", o->file, number, wrong) : OK;
}

static enum status read_text(struct curves *o, FILE *file, struct arena *life, struct report *report)
{
    char *text = NULL;
    size_t room = 0;
    const char *wrong = line_or_end(&text, &room, 0, file) < 0 ? "no records" : recorded_whole(o, text, life);
    free(text);
    return *wrong ? fail(report, E_FILE, "%s: %s", o->file, wrong) : OK;
}

enum status recorded_read(struct curves *o, struct arena *life, struct report *report)
{
    const enum form form = form_of(o->file);
    FILE *file = file_to_read(o->file);
    if (!file) return fail(report, E_FILE, "cannot read '%s': %s", o->file, strerror(errno));
    enum status status = form == JSON ? read_text(o, file, life, report) : read_lines(o, file, form, life, report);
    if (status == OK && ferror(file)) status = fail(report, E_FILE, "%s: cannot read", o->file);
    (void)fclose(file);
    if (status != OK || (o->n > 1 && o->rows > 0)) return status;
    return fail(report, E_FILE, "%s: no records%s", o->file,
                form == CSV ? ": a line of names, then rows of numbers, with commas" : "");
}
