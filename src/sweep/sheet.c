/* sheet.c -- see sheet.h */
#include "sweep/sheet.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "sweep/points.h"

/* The next field of a line, without its quotes; *line: what follows, NULL at the end. */
static const char *next_field(const char **line, struct arena *life)
{
    const char *at = *line;
    if (*at != '"') {
        const size_t n = strcspn(at, ",");
        *line = at[n] ? at + n + 1 : NULL;
        return arena_copy(life, at, n);
    }
    char *text = TAKE(life, char, strlen(at)), *to = text;
    for (at++; *at && (*at != '"' || at[1] == '"'); at++) {
        *to++ = *at;
        if (*at == '"') at++;
    }
    if (*at) at++;
    *line = *at == ',' ? at + 1 : NULL;
    return text;
}

static const char **split(int *n, const char *line, struct arena *life)
{
    const char **field = NULL;
    int capacity = 0;
    *n = 0;
    while (line) {
        field = arena_more(life, field, *n, &capacity, sizeof *field);
        const char *next = next_field(&line, life);
        field[(*n)++] = next;
    }
    return field;
}

/* ---- reading ---- */

static bool is_head(const struct sheet *o, int n, const char *const *field)
{
    bool same = n == o->n;
    for (int i = 0; same && i < n; i++) same = strcmp(field[i], o->column[i].name) == 0;
    return same;
}

static void take_head(struct sheet *o, int n, const char *const *field)
{
    struct table_column *column = TAKE(o->life, struct table_column, n);
    for (int i = 0; i < n; i++) column[i].name = field[i];
    o->column = column;
    o->n = n;
}

static enum status read_row(struct sheet *o, int n, const char **field, const char *name, long number,
                            struct report *report)
{
    char *end;
    const long point = strtol(field[0], &end, 10);
    if (end == field[0] || *end || point < 1 || point > MOST_POINTS)
        return fail(report, E_FILE, "%s:%ld: no row of a sweep: '%.40s' is no number of a point", name, number,
                    field[0]);
    if (n != o->n)
        return fail(report, E_FILE, "%s:%ld: no row of a sweep: %d fields, its table has %d", name, number, n, o->n);
    if (point > o->rows || !o->row[point - 1]) return sheet_keep(o, point - 1, field), OK;
    for (int i = 0; i < n; i++)
        if (strcmp(o->row[point - 1][i], field[i]) != 0)
            return fail(report, E_FILE, "%s:%ld: point %ld is there already, and has another '%.40s'", name, number,
                        point, o->column[i].name);
    return OK;
}

enum status sheet_read(struct sheet *o, FILE *file, const char *name, struct report *report)
{
    char *line = NULL;
    size_t room = 0;
    ssize_t length;
    enum status status = OK;
    for (long number = 1; status == OK && (length = line_or_end(&line, &room, '\n', file)) >= 0; number++) {
        int n;
        if (length == 0 || line[length - 1] != '\n') break;
        line[strcspn(line, "\r\n")] = 0;
        const char **field = split(&n, line, o->life);
        if (strcmp(field[0], "point") != 0) {
            status = o->n ? read_row(o, n, field, name, number, report)
                          : fail(report, E_FILE, "%s:%ld: no table of a sweep: it begins with 'point,'", name, number);
        } else if (!o->n)
            take_head(o, n, field);
        else if (!is_head(o, n, field))
            status = fail(report, E_FILE, "%s:%ld: the table of another sweep: its columns are not those of this one",
                          name, number);
    }
    free(line);
    if (status == OK && ferror(file)) status = fail(report, E_FILE, "%s: cannot read", name);
    return status;
}

void sheet_keep(struct sheet *o, long i, const char **text)
{
    while (o->rows <= i) {
        o->row = arena_more(o->life, o->row, (int)o->rows, &o->capacity, sizeof *o->row);
        o->row[o->rows++] = NULL;
    }
    o->row[i] = text;
}

/* ---- writing ---- */

static void put_field(struct table_line *line, const struct table_column *column, const char *text)
{
    char *end;
    const double x = strtod(text, &end);
    if (line->form != TABLE_CSV && (*text == 0 || (*end == 0 && strchr("+-.0123456789", *text))))
        table_line_number(line, column, *text ? x : NAN);
    else
        table_line_text(line, column, text);
}

enum status sheet_begin(const struct sheet *o, struct table_line *line, struct stream *stream, struct report *report)
{
    table_line_open(line);
    table_line_head(line, o->column, o->n);
    return table_line_send(line, stream, report);
}

enum status sheet_put(const struct sheet *o, long i, struct table_line *line, struct stream *stream,
                      struct report *report)
{
    table_line_open(line);
    table_line_begin(line);
    for (int c = 0; c < o->n; c++) put_field(line, &o->column[c], o->row[i][c]);
    table_line_end(line);
    return table_line_send(line, stream, report);
}

enum status sheet_end(struct table_line *line, struct stream *stream, struct report *report)
{
    table_line_open(line);
    table_line_foot(line);
    return table_line_send(line, stream, report);
}
