/* rows.c -- see rows.h */
#include "study/rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "out/number.h"

enum { MOST_LINE = 1 << 12, TEXTS = 20 };

/* One without a heading is not for people. */
static const struct table_column columns[] = {
    {"scheme", "scheme", 0},   {"tolerance", "tolerance", 2}, {"step", "h [s]", 4},
    {"ratio", "ratio", 4},     {"error", "error", 2},         {"worst", "worst column", 0},
    {"error_fast", "fast", 2}, {"error_slow", "slow", 2},     {"work", "work", 4},
    {"cpu", "CPU [s]", 2},     {"cpu_ratio", NULL, 3},        {"slow", NULL, 9},
    {"fast", NULL, 9},         {"factors", NULL, 7},          {"energy", "energy", 2},
    {"status", "status", 0},   {"uncertain", NULL, 3},        {"unit", NULL, 0},
    {"order", "order", 1},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

/* A row's cells: texts where the column is one. */
struct cells {
    const char *text[COLUMNS];
    double x[COLUMNS];
};

static const char *status_word(const struct study_row *r)
{
    return r->doubtful ? "reference" : r->status == OK ? "ok" : r->status == E_VERDICT ? "unbalanced" : "stopped";
}

static void fill(struct cells *c, const struct study_row *r, const struct rows *o)
{
    const double scale = o->absolute && r->errors.worst > 0 ? r->errors.absolute / r->errors.worst : 1;
    const double x[] = {0,
                        r->setting.tolerance,
                        r->setting.step,
                        r->setting.ratio,
                        o->absolute ? r->errors.absolute : r->errors.worst,
                        0,
                        r->errors.fast,
                        r->errors.slow,
                        r->work,
                        r->cpu,
                        r->cpu / o->first,
                        (double)r->effort.slow,
                        (double)r->effort.fast,
                        (double)r->effort.factors,
                        r->energy,
                        0,
                        scale * r->uncertain,
                        0,
                        r->setting.order > 0 ? r->setting.order : NAN};
    memcpy(c->x, x, sizeof x);
    for (int i = 0; i < COLUMNS; i++) c->text[i] = "";
    c->text[0] = r->setting.kind->name;
    c->text[5] = r->worst;
    c->text[15] = status_word(r);
    c->text[17] = o->absolute ? r->unit : "";
}

/* Wide enough for every number of so many digits, and for the heading. */
static int width(int i)
{
    const int head = (int)strlen(columns[i].head), need = columns[i].digits ? columns[i].digits + 5 : TEXTS;
    return i == 0 ? 9 : i + 2 > COLUMNS - 1 ? 0 : head > need ? head : need;
}

static char *put_table(char *to, const struct cells *c)
{
    char number[NUMBER_MOST + 1];
    for (int i = 0; i < COLUMNS; i++) {
        if (!columns[i].head) continue;
        if (!columns[i].digits) {
            to += sprintf(to, "%-*s  ", width(i), c ? c->text[i] : columns[i].head);
            continue;
        }
        strcpy(number, "-");
        if (c && isfinite(c->x[i])) number[number_round(number, c->x[i], columns[i].digits)] = 0;
        to += sprintf(to, "%*s  ", width(i), c ? number : columns[i].head);
    }
    while (to[-1] == ' ') to--;
    return stpcpy(to, "\n");
}

static enum status send(struct rows *o, const char *end, struct report *report)
{
    TRY(stream_end(o->stream, end, report));
    return stream_flush(o->stream, report);
}

static enum status begin(struct rows *o, struct report *report)
{
    o->begun = true;
    o->first = NAN;
    if (o->line.form == TABLE_DRAWN) return send(o, put_table(stream_begin(o->stream, MOST_LINE), NULL), report);
    table_line_open(&o->line);
    table_line_head(&o->line, columns, COLUMNS);
    return table_line_send(&o->line, o->stream, report);
}

static void put_line(struct table_line *line, const struct cells *c)
{
    table_line_begin(line);
    for (int i = 0; i < COLUMNS; i++)
        if (columns[i].digits)
            table_line_number(line, &columns[i], c->x[i]);
        else
            table_line_text(line, &columns[i], c->text[i]);
    table_line_end(line);
}

enum status rows_put(void *self, const struct study_row *row, struct report *report)
{
    struct rows *o = self;
    struct cells cells;
    if (!o->begun) TRY(begin(o, report));
    if (o->n++ == 0) o->first = row->cpu;
    fill(&cells, row, o);
    if (o->line.form == TABLE_DRAWN)
        return send(o, put_table(stream_begin(o->stream, MOST_LINE + strlen(row->worst)), &cells), report);
    table_line_open(&o->line);
    put_line(&o->line, &cells);
    return table_line_send(&o->line, o->stream, report);
}

enum status rows_end(struct rows *o, enum status status, struct report *report)
{
    if (!o->begun && status != OK) return OK;
    if (!o->begun) TRY(begin(o, report));
    if (o->line.form == TABLE_DRAWN) return stream_flush(o->stream, report);
    table_line_open(&o->line);
    table_line_foot(&o->line);
    return table_line_send(&o->line, o->stream, report);
}
