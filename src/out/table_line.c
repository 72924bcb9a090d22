/* table_line.c -- a line of a table as CSV, NDJSON or JSON; see table.h */
#include <stdlib.h>
#include <string.h>

#include "out/cell.h"
#include "out/table.h"

/* A text field of RFC 4180: quoted when it must be, quotes in it doubled. */
static void put_csv_text(FILE *to, const char *text)
{
    const bool quote = strpbrk(text, ",\"\r\n") || *text == ' ' || (*text && text[strlen(text) - 1] == ' ');
    if (quote) putc('"', to);
    for (; *text; text++) {
        if (*text == '"') putc('"', to);
        putc(*text, to);
    }
    if (quote) putc('"', to);
}

static void put_json_text(FILE *to, const char *text)
{
    putc('"', to);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(to, "\\%c", c);
        else if (c < 0x20)
            fprintf(to, "\\u%04x", c);
        else
            putc(c, to);
    }
    putc('"', to);
}

enum table_form table_form_of(const char *word, bool terminal)
{
    if (!word) return terminal ? TABLE_DRAWN : TABLE_CSV;
    return strcmp(word, "csv") == 0 ? TABLE_CSV : strcmp(word, "ndjson") == 0 ? TABLE_NDJSON : TABLE_JSON;
}

void table_line_head(struct table_line *o, const struct table_column *columns, int n)
{
    if (o->form == TABLE_JSON) fputs("{\"rows\":[", o->to);
    for (int c = 0; c < n && o->form == TABLE_CSV; c++) {
        if (c) putc(',', o->to);
        put_csv_text(o->to, columns[c].name);
    }
    if (o->form != TABLE_NDJSON) putc('\n', o->to);
}

void table_line_begin(struct table_line *o)
{
    if (o->form == TABLE_JSON && o->rows) putc(',', o->to);
    if (o->form != TABLE_CSV) putc('{', o->to);
    o->rows++;
    o->n = 0;
}

static void put_name(struct table_line *o, const struct table_column *column)
{
    if (o->n++) putc(',', o->to);
    if (o->form == TABLE_CSV) return;
    put_json_text(o->to, column->name);
    putc(':', o->to);
}

void table_line_number(struct table_line *o, const struct table_column *column, double x)
{
    char number[NUMBER_MOST + 1];
    put_name(o, column);
    *cell_put(number, x, o->form == TABLE_CSV ? "" : "null") = 0;
    fputs(number, o->to);
}

void table_line_text(struct table_line *o, const struct table_column *column, const char *text)
{
    put_name(o, column);
    if (o->form == TABLE_CSV)
        put_csv_text(o->to, text);
    else
        put_json_text(o->to, text);
}

void table_line_end(struct table_line *o)
{
    if (o->form != TABLE_CSV) putc('}', o->to);
    putc('\n', o->to);
}

void table_line_foot(struct table_line *o)
{
    if (o->form == TABLE_JSON) fputs("]}\n", o->to);
}

void table_line_open(struct table_line *o)
{
    o->to = words_open(&o->text, &o->size);
}

enum status table_line_send(struct table_line *o, struct stream *stream, struct report *report)
{
    words_close(o->to, &o->text);
    const enum status status = stream_put(stream, o->text, o->size, report);
    free(o->text);
    return status == OK ? stream_flush(stream, report) : status;
}
