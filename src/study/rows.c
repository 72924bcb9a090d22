/* rows.c -- see rows.h */
#include "study/rows.h"

#include <math.h>
#include <string.h>

#include "out/cell.h"
#include "out/number.h"

enum { MOST_LINE = 1 << 12, TEXTS = 20 };

/* A column of a text has no digits; one without a heading is not for people. */
static const struct {
    const char *name, *head;
    int digits;
} columns[] = {
    {"scheme", "scheme", 0},   {"tolerance", "tolerance", 2}, {"step", "h [s]", 4},
    {"ratio", "ratio", 4},     {"error", "error", 2},         {"worst", "worst column", 0},
    {"error_fast", "fast", 2}, {"error_slow", "slow", 2},     {"work", "work", 4},
    {"cpu", "CPU [s]", 2},     {"cpu_ratio", NULL, 3},        {"slow", NULL, 9},
    {"fast", NULL, 9},         {"factors", NULL, 7},          {"energy", "energy", 2},
    {"status", "status", 0},   {"uncertain", NULL, 3},        {"unit", NULL, 0},
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
                        0};
    memcpy(c->x, x, sizeof x);
    for (int i = 0; i < COLUMNS; i++) c->text[i] = "";
    c->text[0] = r->setting.kind->name;
    c->text[5] = r->worst;
    c->text[15] = status_word(r);
    c->text[17] = o->absolute ? r->unit : "";
}

/* Names are of letters, digits, '.' and '_': nothing needs a quote. */
static char *put_csv(char *to, const struct cells *c)
{
    for (int i = 0; i < COLUMNS; i++) {
        to = columns[i].digits ? cell_put(to, c->x[i], "") : stpcpy(to, c->text[i]);
        *to++ = i + 1 < COLUMNS ? ',' : '\n';
    }
    return to;
}

static char *put_object(char *to, const struct cells *c)
{
    for (int i = 0; i < COLUMNS; i++) {
        to += sprintf(to, "%s\"%s\":", i ? "," : "{", columns[i].name);
        if (columns[i].digits)
            to = cell_put(to, c->x[i], "null");
        else
            to += sprintf(to, "\"%s\"", c->text[i]);
    }
    return stpcpy(to, "}\n");
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

enum status rows_begin(struct rows *o, struct report *report)
{
    char *to = stream_begin(o->stream, MOST_LINE);
    o->first = NAN;
    if (o->form == TABLE_DRAWN) to = put_table(to, NULL);
    for (int i = 0; o->form == TABLE_CSV && i < COLUMNS; i++)
        to += sprintf(to, "%s%s", columns[i].name, i + 1 < COLUMNS ? "," : "\n");
    if (o->form == TABLE_JSON) to = stpcpy(to, "{\"rows\":[\n");
    return send(o, to, report);
}

enum status rows_put(void *self, const struct study_row *row, struct report *report)
{
    struct rows *o = self;
    struct cells cells;
    if (o->n == 0) o->first = row->cpu;
    fill(&cells, row, o);
    char *to = stream_begin(o->stream, MOST_LINE + strlen(row->worst) + strlen(row->unit));
    if (o->form == TABLE_JSON && o->n) *to++ = ',';
    to = o->form == TABLE_DRAWN ? put_table(to, &cells)
         : o->form == TABLE_CSV ? put_csv(to, &cells)
                                : put_object(to, &cells);
    o->n++;
    return send(o, to, report);
}

enum status rows_end(struct rows *o, struct report *report)
{
    char *to = stream_begin(o->stream, MOST_LINE);
    if (o->form == TABLE_JSON) to = stpcpy(to, "]}\n");
    return send(o, to, report);
}
